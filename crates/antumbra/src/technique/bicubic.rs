//! Percentage-closer filtering with the cubic B-spline: the smoothest edge that four lookups give.
//!
//! The comparisons with 4×4 texels are convolved with the B-spline of degree 3, whose standard
//! deviation is 0.58 texels and whose second derivative is continuous: magnified edges show no facets.
//! Four bilinear lookups make the exact sum of 16 comparisons. The width is fixed.
//!
//! Sigg & Hadwiger 2005, "Fast third-order texture filtering", GPU Gems 2, ch. 20.

use super::{About, Description, Family, Technique};
use crate::{capabilities::Capabilities, error::Unsupported, parameter::Parameter, precision::Precision};

/// Bicubic percentage-closer filtering. 4 bilinear lookups; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bicubic {
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Technique for Bicubic {
    fn about(&self) -> About {
        About {
            name: "bicubic",
            title: "Bicubic percentage-closer filtering",
            family: Family::Comparison,
            paper: "Sigg & Hadwiger 2005",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![self.precision.parameter()]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let (wgsl, linear) = (include_str!("bicubic.wgsl"), wgpu::FilterMode::Linear);
        Ok(Description {
            filter_radius_texels: 2.0,
            fetches: 4,
            ..Description::comparison(self.about(), wgsl, linear, self.precision)
        })
    }
    fn variants(&self) -> Vec<&'static str> {
        Precision::VARIANTS.to_vec()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formula.
#[doc(hidden)]
pub mod reference {
    /// The uniform cubic B-spline at `x` texels from its centre.
    #[must_use]
    pub fn spline(x: f64) -> f64 {
        match x.abs() {
            x if x < 1.0 => (4.0 - 6.0 * x * x + 3.0 * x * x * x) / 6.0,
            x if x < 2.0 => (2.0 - x).powi(3) / 6.0,
            _ => 0.0,
        }
    }
}
