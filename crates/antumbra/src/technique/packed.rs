//! Fast percentage-closer filtering: four neighbouring depths packed into the channels of one texel.
//!
//! A pass over the map gathers every 2×2 texels into one RGBA texel, so that a single fetch brings all
//! the depths of a 2×2 footprint and four fetches those of a 4×4 one. One caster pass and the full
//! resolution of the map, but a footprint of whole texels: 5 or 17 levels of grey, in steps as wide as
//! a texel.
//!
//! # Packing
//! The paper's 3×3 colour convolution takes red from the lower left, green from below, blue from the left
//! and alpha from the texel itself. The four surround the texel's lower left corner and not its centre,
//! so the lookup is shifted by half a texel (figure 6) to find the corner nearest to the receiver.
//! Four phases, two texels apart, make 4×4. The paper packs a map of its own for every phase; here they
//! share one.
//!
//! # Levels
//! 16 comparisons have 17 sums. The paper's phases have 8 bits: 64 for a shadowed texel, and 63 in one of
//! the channels, so that all four make 255 (its footnote 2); here that channel is alpha. s shadowed texels,
//! a of them in alpha, add up to 64 s − a, a quarter of which comes back from the accumulation buffer as
//! 16 s where a < 3, and as 16 s − 1 from there on. 0 to 14 texels can have fewer than three in alpha, 3 to
//! 16 can have three: 15 + 14 = 29 levels ([`Accumulation::Bytes`]). The paper counts 4 · 5 = 20, which is
//! neither.
//!
//! Brabec & Seidel 2001, "Hardware-accelerated rendering of antialiased shadows with shadow maps", §4.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter, choice},
    precision::Precision,
};

choice! {
    /// Texels along one side of the footprint.
    Grid {
        /// One fetch, 5 levels.
        Two = "2",
        /// Four fetches, 17 levels.
        Four = "4",
    }
}

choice! {
    /// How the phases of a footprint are added up.
    Accumulation {
        /// In floats.
        Exact = "exact",
        /// In bytes that are rounded once, from a frame buffer of 8 bits: 29 levels from 4×4.
        Bytes = "bytes",
    }
}

/// Packed percentage-closer filtering. 1 or 4 fetches; 16 bytes per texel, 8 at 12 or 16 bits, 4 at 8.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Packed {
    /// Texels along one side of the footprint.
    pub grid: Grid,
    /// How the phases are added up.
    pub accumulation: Accumulation,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Packed {
    fn default() -> Self {
        Self { grid: Grid::Two, accumulation: Accumulation::Exact, precision: Precision::Float32 }
    }
}

impl Technique for Packed {
    fn about(&self) -> About {
        About {
            name: "packed",
            title: "Packed percentage-closer filtering",
            family: Family::Comparison,
            paper: "Brabec & Seidel 2001",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new("grid", "texels", Field::Choice(&mut self.grid), "side of the footprint"),
            Parameter::new(
                "accumulation",
                "",
                Field::Choice(&mut self.accumulation),
                "how the four fetches of a 4×4 footprint are added up",
            ),
            self.precision.parameter(),
        ]
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let phases = match self.grid {
            Grid::Two => 1,
            Grid::Four => 2,
        };
        let (wgsl, map) =
            (include_str!("packed.wgsl"), ("packed depth", 1, Encode::Neighbours("packed_encode")));
        let mut described = Description::stored_depth(self.about(), wgsl, map, self.precision, device);
        described.constants.extend([
            Constant::Count("packed_phases", phases),
            Constant::Count("packed_in_bytes", u32::from(self.accumulation == Accumulation::Bytes)),
        ]);
        Ok(Description { filter_radius_texels: phases as f32, fetches: phases.pow(2), ..described })
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Precision::VARIANTS[..], &["grid=4", "grid=4,accumulation=bytes,precision=8"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
