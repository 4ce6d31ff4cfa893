//! Percentage-closer filtering over the pixel's footprint: what Reeves et al. did.
//!
//! The kernel is the parallelogram that the pixel covers in the map, one bilinear comparison per texel
//! up to a budget, so that a distant or grazing receiver is antialiased and a near one stays sharp.
//! Where a footprint has more texels than the budget allows, the comparisons spread out and thin
//! casters alias; magnified edges are as hard as a bilinear comparison.
//!
//! Reeves, Salesin, Cook 1987, "Rendering antialiased shadows with depth maps"; Brabec & Seidel 2001,
//! §6, ask for it.

use super::{About, Constant, Description, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter},
    precision::Precision,
};

/// Footprint-sized percentage-closer filtering. 1 to `budget` bilinear lookups; 4 bytes per texel
/// (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Footprint {
    /// Most lookups, 1 to 256.
    pub budget: u32,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Footprint {
    fn default() -> Self {
        Self { budget: 16, precision: Precision::Float32 }
    }
}

impl Technique for Footprint {
    fn about(&self) -> About {
        About {
            name: "footprint",
            title: "Footprint-sized percentage-closer filtering",
            family: Family::Comparison,
            paper: "Reeves et al. 1987",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new("budget", "lookups", Field::Count(&mut self.budget, 1..=256), "most lookups per pixel"),
            self.precision.parameter(),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let (wgsl, linear) = (include_str!("footprint.wgsl"), wgpu::FilterMode::Linear);
        // Radius and fetches of a footprint below a texel. Wider ones repeat the border of the map.
        let mut described = Description::comparison(self.about(), wgsl, linear, self.precision);
        described.constants.push(Constant::Count("footprint_budget", self.budget));
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        Precision::VARIANTS.to_vec()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The number of lookups in whole numbers.
#[doc(hidden)]
pub mod reference {
    /// Lookups along both sides of a footprint of those lengths in texels: at most `budget`, in the
    /// proportion of the sides.
    #[must_use]
    pub fn counts(texels: [f64; 2], budget: u32) -> [u32; 2] {
        let wanted = texels.map(|t| t.ceil().max(1.0));
        let excess = (wanted[0] * wanted[1] / f64::from(budget)).max(1.0).sqrt();
        let fair = wanted.map(|w| (w / excess).floor().max(1.0) as u32);
        let across = fair[0].min(budget);
        [across, fair[1].min(budget / across)]
    }

    #[cfg(test)]
    mod tests {
        use super::counts;

        #[test]
        fn the_budget_holds_and_is_used() {
            for budget in [1, 2, 5, 16, 64, 256] {
                for x in 0..60 {
                    for y in 0..60 {
                        let texels = [f64::from(x) * 1.7, f64::from(y) * 3.1];
                        let [a, b] = counts(texels, budget);
                        assert!(a >= 1 && b >= 1 && a * b <= budget, "{a}×{b} of {budget}");
                        let wanted = texels.map(|t| t.ceil().max(1.0) as u32);
                        let all = wanted[0] * wanted[1] <= budget;
                        assert!(!all || [a, b] == wanted, "{a}×{b} for {texels:?} of {budget}");
                        // Rounding down both sides leaves at least a quarter.
                        assert!(all || 4 * a * b >= budget, "{a}×{b} of {budget}");
                    }
                }
            }
        }
    }
}
