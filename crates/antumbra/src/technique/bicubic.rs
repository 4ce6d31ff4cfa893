//! Percentage-closer filtering with the cubic B-spline: the smoothest edge that four lookups give.
//!
//! The comparisons with 4×4 texels are convolved with the B-spline of degree 3, whose standard
//! deviation is 0.58 texels and whose second derivative is continuous: magnified edges show no facets.
//! Four bilinear lookups make the exact sum of 16 comparisons. The width is fixed.
//!
//! Sigg & Hadwiger 2005, "Fast third-order texture filtering", GPU Gems 2, ch. 20.

use super::{BiasTerms, Binding, Constant, DepthSpace, Family, Map, Page, Technique};
use crate::{capabilities::Capabilities, error::Unsupported, parameter::Parameter, precision::Precision};

/// Bicubic percentage-closer filtering. 4 bilinear lookups; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Bicubic {
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Technique for Bicubic {
    fn page(&self) -> Page {
        Page {
            name: "bicubic",
            title: "Bicubic percentage-closer filtering",
            family: Family::Comparison,
            paper: "Sigg & Hadwiger 2005",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![self.precision.parameter()]
    }
    fn maps(&self, _: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(Vec::new())
    }
    fn bindings(&self) -> Vec<Binding> {
        vec![Binding::Depth, Binding::Compare(wgpu::FilterMode::Linear)]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("bicubic.wgsl")
    }
    fn constants(&self) -> Vec<Constant> {
        self.precision.constants()
    }
    fn parts(&self, _: &Capabilities) -> Vec<&'static str> {
        vec![self.precision.part()]
    }
    fn bias(&self) -> BiasTerms {
        BiasTerms::FOURS
    }
    fn depth_step(&self) -> f32 {
        self.precision.step()
    }
    fn depth_space(&self) -> DepthSpace {
        DepthSpace::Raster
    }
    fn reach_texels(&self) -> f32 {
        2.0
    }
    fn lookups(&self) -> u32 {
        4
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formula.
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
