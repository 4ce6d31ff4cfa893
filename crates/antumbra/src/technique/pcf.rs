//! Percentage-closer filtering on a grid: compare first, average the answers.
//!
//! n×n comparisons around the receiver's place in the map, with box or Gaussian weights, each
//! nearest (k/n² grey levels) or bilinear (continuous, over (n+1)² texels). The quality that
//! pre-filtered techniques are measured by; the cost grows with n².
//!
//! # Fewer lookups
//! n bilinear taps, a texel apart, with weights w₀ … wₙ₋₁ and the fraction f between two texels, give
//! texel j along each axis the weight tⱼ = wⱼ(1 − f) + wⱼ₋₁ f. One bilinear lookup between texels j and
//! j + 1, at the fraction tⱼ₊₁/(tⱼ + tⱼ₊₁), weighted by tⱼ + tⱼ₊₁, gives both their weights; weights of
//! rows and columns multiply, in the lookup as in the kernel. So ⌈(n+1)/2⌉² lookups make the whole n×n
//! kernel, whatever its weights, without approximation: 4 for 3×3, 9 for 5×5, 16 for 7×7
//! ([`Taps::Merged`]). A gather fetches the same four comparisons for weights in the shader
//! ([`Taps::Gather`]).
//!
//! Reeves, Salesin, Cook 1987, "Rendering antialiased shadows with depth maps".

use super::{About, BiasTerms, Constant, Description, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    kernel::{Kernel, Weights},
    parameter::{Field, Parameter, choice},
    precision::Precision,
};

choice! {
    /// How the comparisons of a grid are fetched.
    Taps {
        /// n² texels: 0 or 1 each.
        Nearest = "nearest",
        /// n² lookups of four comparisons with bilinear weights.
        Bilinear = "bilinear",
        /// The same sum in ⌈(n+1)/2⌉² lookups between the texels.
        Merged = "merged",
        /// The same sum from ⌈(n+1)/2⌉² gathers, weighted in the shader: exact where samplers round
        /// their weights to 8 bits.
        Gather = "gather",
    }
}

/// Percentage-closer filtering. ⌈(n+1)/2⌉² lookups, n² if nearest or one by one; 4 bytes per texel
/// (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pcf {
    /// Taps along one side, 1 to 16.
    pub kernel: u32,
    /// Shape of the kernel.
    pub weights: Weights,
    /// Standard deviation of the Gaussian in texels, 0 for [`Kernel::usual_sigma`].
    pub sigma: f32,
    /// Nearest or bilinear comparisons, and how they are fetched. One bilinear tap is the 2×2 comparison
    /// of a linear sampler.
    pub taps: Taps,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Pcf {
    fn default() -> Self {
        Self {
            kernel: 3,
            weights: Weights::Gaussian,
            sigma: 0.0,
            taps: Taps::Gather,
            precision: Precision::Float32,
        }
    }
}

impl Pcf {
    /// Pairs of texels along one side that bilinear taps cover.
    fn pairs(&self) -> u32 {
        (self.kernel + 1).div_ceil(2)
    }

    /// Peak and fall-off of the weights 2^−(fall-off · x²) at x texels from the middle, which sum to one
    /// as those of [`Kernel::new`] do.
    fn bell(&self) -> [f32; 2] {
        let sigma = match self.sigma {
            s if s > 0.0 => f64::from(s),
            _ => Kernel::usual_sigma(self.kernel as f32),
        };
        let falloff = match self.weights {
            Weights::Box => 0.0,
            // Beyond that all neighbours weigh nothing.
            Weights::Gaussian => (std::f64::consts::LOG2_E / (2.0 * sigma * sigma)).min(1e4),
        };
        let middle = (f64::from(self.kernel) - 1.0) / 2.0;
        let sum: f64 =
            (0..self.kernel).map(|i| (-falloff * (f64::from(i) - middle).powi(2)).exp2()).sum();
        [(1.0 / sum) as f32, falloff as f32]
    }
}

impl Technique for Pcf {
    fn about(&self) -> About {
        About {
            name: "pcf",
            title: "Percentage-closer filtering",
            family: Family::Comparison,
            paper: "Reeves et al. 1987",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new("kernel", "texels", Field::Count(&mut self.kernel, 1..=16), "taps along one side of the grid"),
            Parameter::new("weights", "", Field::Choice(&mut self.weights), "shape of the kernel"),
            Parameter::new(
                "sigma",
                "texels",
                Field::Number(&mut self.sigma, 0.0..=31.0),
                "standard deviation of the Gaussian; 0 is 0.15·kernel + 0.35",
            ),
            Parameter::new(
                "taps",
                "",
                Field::Choice(&mut self.taps),
                "one texel per tap, or 2×2 with bilinear weights: one by one, merged, or gathered (the same sum)",
            ),
            self.precision.parameter(),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        use wgpu::FilterMode::{Linear, Nearest};
        let side = self.kernel as f32;
        // Slot, filter of the comparisons, half the width of the kernel with theirs, lookups along one side.
        let (slot, filter, radius, lookups) = match self.taps {
            Taps::Nearest => ("taps_nearest", Nearest, side / 2.0, self.kernel),
            Taps::Bilinear => ("taps_bilinear", Linear, side / 2.0 + 0.5, self.kernel),
            Taps::Merged => ("taps_merged", Linear, side / 2.0 + 0.5, self.pairs()),
            Taps::Gather => ("taps_gather", Nearest, side / 2.0 + 0.5, self.pairs()),
        };
        let mut described =
            Description::comparison(self.about(), include_str!("pcf.wgsl"), filter, self.precision);
        if self.taps == Taps::Gather {
            described.bias = BiasTerms::FOURS;
        }
        described.slots.push(slot);
        described.constants.extend([
            Constant::Array("taps_bell", self.bell().to_vec()),
            Constant::Count("taps_width", self.kernel),
            Constant::Count("taps_pairs", self.pairs()),
        ]);
        Ok(Description { filter_radius_texels: radius, fetches: lookups.pow(2), ..described })
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Precision::VARIANTS[..], &["taps=nearest,kernel=5", "taps=bilinear", "taps=merged,kernel=4"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
