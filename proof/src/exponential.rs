//! An exponential shadow map.

use antumbra::{
    Capabilities, Description, Field, Filter, Parameter, Technique, Unsupported, Values,
    technique::{About, Encode, Family},
    wgpu::TextureFormat,
};

/// Keeps e^(c·depth), which is filtered, and bounds visibility by its product with e^(−c·depth).
#[derive(Debug, Clone)]
pub struct Exponential {
    /// Steepness c.
    pub c: f32,
    /// Blur and mips.
    pub filter: Filter,
}

impl Exponential {
    /// With the filter that techniques of the library begin with.
    #[must_use]
    pub fn new(c: f32) -> Self {
        Self { c, filter: Filter::default() }
    }
}

impl Technique for Exponential {
    fn about(&self) -> About {
        About { name: "exponential", title: "Exponential", family: Family::Basis, paper: "none" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let steepness = Parameter::new("c", "", Field::Number(&mut self.c, 1.0..=80.0), "steepness");
        [steepness].into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = include_str!("exponential.wgsl");
        let encode = Encode::Texel("exponential_encode");
        let values = Values::new("exponentials", TextureFormat::R32Float, encode);
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, values, device);
        described.uniforms = vec![("c", self.c)];
        // Where a thousandth of the light is left.
        described.ramp = 7.0 / self.c;
        Ok(described)
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}
