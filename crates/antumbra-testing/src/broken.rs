//! Techniques that are broken on purpose: what a test that cannot tell them from whole ones is worth.

use antumbra::{
    Capabilities, Parameter, Technique, Unsupported, technique,
    technique::{
        Adaptive, BiasTerms, Binding, Caster, Class, Constant, Coverage, DepthSpace, Map, Page, Pass,
        Uniform, Width,
    },
};

/// A technique with one thing wrong; everything else is that of `inner`.
#[derive(Debug, Clone)]
pub struct Broken {
    /// The whole technique.
    pub inner: Box<dyn Technique>,
    /// Its WGSL.
    pub wgsl: &'static str,
    /// Factor of all kernel weights.
    pub weights: f32,
    /// A uniform with a wrong value.
    pub uniform: Option<Uniform>,
    /// Storage that it was not made for.
    pub format: Option<wgpu::TextureFormat>,
    /// A bias that it was not made for.
    pub bias: Option<BiasTerms>,
    /// Texels that triangles are drawn to.
    pub coverages: Option<&'static [Coverage]>,
    /// Takes one texel where it should interpolate by itself.
    pub careless: bool,
}

impl Broken {
    /// Nothing wrong yet.
    ///
    /// # Panics
    /// If the library cannot read `spec`.
    #[must_use]
    #[allow(clippy::expect_used, reason = "tests fail by panicking")]
    pub fn new(spec: &str) -> Self {
        let inner = technique::parse(spec).expect("a technique");
        Self {
            wgsl: inner.wgsl(),
            inner,
            weights: 1.0,
            uniform: None,
            format: None,
            bias: None,
            coverages: None,
            careless: false,
        }
    }

    /// With other words in its WGSL.
    ///
    /// # Panics
    /// If `right` is not in it.
    #[must_use]
    pub fn saying(spec: &str, right: &str, wrong: &str) -> Self {
        let plain = Self::new(spec);
        assert!(plain.wgsl.contains(right), "{right}");
        Self { wgsl: plain.wgsl.replace(right, wrong).leak(), ..plain }
    }
}

impl Technique for Broken {
    fn page(&self) -> Page {
        self.inner.page()
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        self.inner.parameters()
    }
    fn jitter(&self) -> Vec<glam::Vec2> {
        self.inner.jitter()
    }
    fn maps(&self, device: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        let mut maps = self.inner.maps(device)?;
        for map in &mut maps {
            map.format = self.format.unwrap_or(map.format);
            for pass in &mut map.passes {
                if let Pass::Blur(kernel, _) = pass {
                    kernel.taps.iter_mut().for_each(|w| *w *= self.weights);
                }
            }
        }
        Ok(maps)
    }
    fn caster(&self) -> Caster {
        self.coverages.map_or_else(|| self.inner.caster(), Caster::Triangles)
    }
    fn bindings(&self) -> Vec<Binding> {
        self.inner.bindings()
    }
    fn wgsl(&self) -> &'static str {
        self.wgsl
    }
    fn uniforms(&self) -> Vec<Uniform> {
        let wrong = |u: Uniform| self.uniform.filter(|w| w.0 == u.0).unwrap_or(u);
        self.inner.uniforms().into_iter().map(wrong).collect()
    }
    fn widths(&self) -> Vec<(&'static str, Width)> {
        self.inner.widths()
    }
    fn blur(&self) -> Option<Adaptive> {
        self.inner.blur()
    }
    fn constants(&self) -> Vec<Constant> {
        let mut constants = self.inner.constants();
        for constant in &mut constants {
            if let Constant::Array(_, values) = constant {
                values.iter_mut().for_each(|w| *w *= self.weights);
            }
        }
        constants
    }
    fn parts(&self, device: &Capabilities) -> Vec<&'static str> {
        let parts = self.inner.parts(device);
        if self.careless && parts.contains(&"level_manual") { vec!["lookup_nearest"] } else { parts }
    }
    fn classes(&self) -> &'static [Class] {
        self.inner.classes()
    }
    fn bias(&self) -> BiasTerms {
        self.bias.unwrap_or_else(|| self.inner.bias())
    }
    fn depth_step(&self) -> f32 {
        self.inner.depth_step()
    }
    fn depth_space(&self) -> DepthSpace {
        self.inner.depth_space()
    }
    fn reach_texels(&self) -> f32 {
        self.inner.reach_texels()
    }
    fn ripple(&self) -> f32 {
        self.inner.ripple()
    }
    fn stored_zero(&self, map: usize) -> f32 {
        self.inner.stored_zero(map)
    }
    fn lookups(&self) -> u32 {
        self.inner.lookups()
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}
