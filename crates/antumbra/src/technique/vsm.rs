//! Variance shadow maps: keep the mean and the mean square of depth, bound the lit share.
//!
//! Both moments filter linearly. At lookup the one-sided Chebyshev inequality bounds the share of
//! the kernel that is not in front of the receiver: exact for one flat caster over one flat
//! receiver, too bright ("light bleeding") where casters at several depths overlap in the kernel.
//!
//! Donnelly & Lauritzen 2006, "Variance shadow maps".

use super::{Binding, Constant, Family, Map, Page, Technique, Uniform};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    filter::Filter,
    parameter::{Field, Parameter},
};

/// Variance shadow maps. 1 filtered lookup; 8 bytes per texel (two 32-bit floats).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vsm {
    /// Least variance, in squares of the depth range.
    pub least_variance: f32,
    /// Light-bleeding reduction, 0 to 0.99; 0 is the paper.
    pub reduction: f32,
    /// Factor of the slope term ¼(z_x² + z_y²).
    pub slope: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Vsm {
    fn default() -> Self {
        Self { least_variance: 1e-6, reduction: 0.0, slope: 1.0, filter: Filter::default() }
    }
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;

impl Technique for Vsm {
    fn page(&self) -> Page {
        Page {
            name: "vsm",
            title: "Variance shadow map",
            family: Family::Basis,
            paper: "Donnelly & Lauritzen 2006",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let own = vec![
            Parameter::new(
                "least_variance",
                "depth range²",
                Field::Number(&mut self.least_variance, 0.0..=0.01),
                "variance is kept at or above this",
            ),
            Parameter::new(
                "reduction",
                "",
                Field::Number(&mut self.reduction, 0.0..=0.99),
                "light-bleeding reduction: this much of the bound is cut off",
            ),
            Parameter::new(
                "slope",
                "",
                Field::Number(&mut self.slope, 0.0..=4.0),
                "times ¼(z_x² + z_y²), added to the square: the variance of a plane within a texel",
            ),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn maps(&self, _: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(vec![Map { name: "moments", format: FORMAT, layers: 1, encode: "vsm_encode", passes: self.filter.passes() }])
    }
    fn bindings(&self) -> Vec<Binding> {
        vec![Binding::Map(0), Binding::Sampler]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("vsm.wgsl")
    }
    fn uniforms(&self) -> Vec<Uniform> {
        vec![("least_variance", self.least_variance), ("reduction", self.reduction), ("slope", self.slope)]
    }
    fn constants(&self) -> Vec<Constant> {
        self.filter.constants()
    }
    fn parts(&self, device: &Capabilities) -> Vec<&'static str> {
        self.filter.parts(device, FORMAT)
    }
    fn reach_texels(&self) -> f32 {
        self.filter.reach_texels()
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
pub mod reference {
    /// Moments of a texel from its own depth and those of its neighbours, as the WGSL takes them:
    /// `depths[1 + dx][1 + dy]`.
    #[must_use]
    pub fn encode(depths: [[f64; 3]; 3], slope: f64) -> [f64; 2] {
        let z = depths[1][1];
        let x = (depths[2][1] - z).abs().min((z - depths[0][1]).abs());
        let y = (depths[1][2] - z).abs().min((z - depths[1][0]).abs());
        [z, z * z + slope * 0.25 * (x * x + y * y)]
    }
    /// Chebyshev bound of moments (μ, E z²) at depth d, floor σ²_min, reduction r.
    #[must_use]
    pub fn bound(d: f64, moments: [f64; 2], least_variance: f64, reduction: f64) -> f64 {
        let variance = (moments[1] - moments[0] * moments[0]).max(least_variance);
        let behind = (d - moments[0]).max(0.0);
        let bound = if behind == 0.0 { 1.0 } else { variance / (variance + behind * behind) };
        ((bound - reduction) / (1.0 - reduction)).clamp(0.0, 1.0)
    }
}
