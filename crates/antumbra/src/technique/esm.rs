//! Exponential shadow maps: keep e^(c z), which filters linearly and needs one channel.
//!
//! A receiver is never in front of the nearest caster, so the step of the shadow test may be
//! replaced by an exponential decay behind it, and e^(−c(d−z)) separates into a factor of the
//! receiver and one of the map. Where the kernel reaches casters behind the receiver the product
//! exceeds one and is clamped: too bright there, and it needs no bias on tilted receivers.
//!
//! Annen, Mertens, Seidel, Flerackers, Kautz 2008, "Exponential shadow maps".

use super::{Binding, Constant, Family, Map, Page, Technique, Uniform};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    filter::Filter,
    parameter::{Field, Parameter},
};

/// Exponential shadow maps. 1 filtered lookup; 4 bytes per texel (one 32-bit float).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Esm {
    /// Steepness per depth range. 87 is the largest that keeps e^c and e^−c normal 32-bit floats.
    pub c: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Esm {
    fn default() -> Self {
        Self { c: 80.0, filter: Filter::default() }
    }
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

impl Technique for Esm {
    fn page(&self) -> Page {
        Page {
            name: "esm",
            title: "Exponential shadow map",
            family: Family::Basis,
            paper: "Annen et al. 2008",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let c = Parameter::new(
            "c",
            "1/depth range",
            Field::Number(&mut self.c, 1.0..=87.0),
            "steepness of the decay behind a caster",
        );
        std::iter::once(c).chain(self.filter.parameters()).collect()
    }
    fn maps(&self, _: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(vec![Map { name: "exponentials", format: FORMAT, layers: 1, encode: "esm_encode", passes: self.filter.passes() }])
    }
    fn bindings(&self) -> Vec<Binding> {
        vec![Binding::Map(0), Binding::Sampler]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("esm.wgsl")
    }
    fn uniforms(&self) -> Vec<Uniform> {
        vec![("c", self.c)]
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
    /// e^(c z).
    #[must_use]
    pub fn encode(z: f64, c: f64) -> f64 {
        (c * z).exp()
    }
    /// min(e^(−c d) · B, 1).
    #[must_use]
    pub fn bound(d: f64, filtered: f64, c: f64) -> f64 {
        ((-c * d).exp() * filtered).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_largest_exponent_keeps_both_factors_normal() {
        let normal = |c: f32| c.exp().is_finite() && (-c).exp() >= f32::MIN_POSITIVE;
        assert!(normal(87.0));
        // e^88 still fits, but e^−88 is denormal, which GPUs flush to zero: everything would be black.
        assert!(!normal(88.0));
        assert!(!89f32.exp().is_finite());
    }
}
