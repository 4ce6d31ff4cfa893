//! Reconstructable geometry shadow maps: every texel keeps the triangle that is seen at its centre, and
//! lookups intersect the receiver's ray with the triangles of a few texels.
//!
//! Where every triangle near a shadow's edge is seen at some centre, the edge is exact. Triangles
//! smaller than a texel, or slimmer, are not: there rays pass between those that are stored, and the
//! shadow has holes or, with the answer of an ordinary map in their place, that map's edge. The
//! published technique keeps nine floats per texel; this one packs as [`Spsm`](super::Spsm) does.
//!
//! Dai, Yang, Feng 2008, "Reconstructable Geometry Shadow Maps".

use super::{About, CasterStorage, Constant, Coverage, Description, Family, Technique, spsm::Packing};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter, choice},
};

choice! {
    /// What a receiver's ray that meets no stored triangle says.
    Missed {
        /// Lit: as published.
        Lit = "lit",
        /// What an ordinary shadow map says: the triangle at the texel's centre before it or not. Closes
        /// holes; behind receivers that cast nothing, edges have that map's steps.
        Centre = "centre",
    }
}

/// Reconstructable geometry shadow map. `neighbours`² lookups everywhere but in shadow; 16 bytes per
/// texel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Rgsm {
    /// Side of the square of texels whose triangles are intersected, odd, 1 to 7; 3 and 5 as published.
    pub neighbours: u32,
    /// How a triangle is kept.
    pub packing: Packing,
    /// What a ray that meets no stored triangle says.
    pub missed: Missed,
}

impl Default for Rgsm {
    fn default() -> Self {
        Self { neighbours: 3, packing: Packing::Edges, missed: Missed::Centre }
    }
}

impl Technique for Rgsm {
    fn about(&self) -> About {
        About {
            name: "rgsm",
            title: "Reconstructable geometry shadow map",
            family: Family::Geometry,
            paper: "Dai, Yang, Feng 2008",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new(
                "neighbours",
                "texels",
                Field::Odd(&mut self.neighbours, 1..=7),
                "side of the square of texels whose triangles are intersected",
            ),
            Parameter::new(
                "packing",
                "",
                Field::Choice(&mut self.packing),
                "how a triangle is kept in 128 bits: corners over the map, corners relative to the texel, edges",
            ),
            Parameter::new(
                "missed",
                "",
                Field::Choice(&mut self.missed),
                "what a ray that meets no triangle says: lit, as published, or as an ordinary map at the texel's centre",
            ),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let caster = CasterStorage::NearestTriangle(&[Coverage::Centre]);
        Ok(Description {
            slots: self.packing.slots(),
            constants: vec![
                Constant::Count("rgsm_neighbours", self.neighbours),
                Constant::Count("rgsm_compares", u32::from(self.missed == Missed::Centre)),
            ],
            fetches: self.neighbours * self.neighbours,
            ..Description::triangles(self.about(), include_str!("rgsm.wgsl"), caster)
        })
    }
    fn variants(&self) -> Vec<&'static str> {
        vec!["packing=map,neighbours=5", "packing=texel,neighbours=1"]
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's answer in f64.
#[doc(hidden)]
pub mod reference {
    /// Whether a stored triangle with corners (x, y, depth) is before a receiver; `None` if the
    /// receiver's ray does not meet it.
    #[must_use]
    pub fn before(corners: [[f64; 3]; 3], point: [f64; 2], depth: f64) -> Option<bool> {
        let ever = crate::technique::spsm::reference::intersects(corners, point, f64::INFINITY);
        ever.then(|| crate::technique::spsm::reference::intersects(corners, point, depth))
    }
}
