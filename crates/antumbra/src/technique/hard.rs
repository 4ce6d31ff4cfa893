//! The standard shadow map: one nearest texel, one comparison.
//!
//! Keeps the casters' depth. Aliased at every edge, blocky under magnification, and every point of
//! a tilted surface needs bias against its own texel: by default the receiver's plane at the texel's
//! centre. The yardstick of time and memory for the rest.
//!
//! Williams 1978, "Casting curved shadows on curved surfaces".

use super::{BiasTerms, Binding, Constant, DepthSpace, Family, Map, Page, Technique};
use crate::{
    capabilities::Capabilities, error::Unsupported, parameter::Parameter, precision::Precision,
};

/// The standard shadow map. 1 comparison; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hard {
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Technique for Hard {
    fn page(&self) -> Page {
        Page { name: "hard", title: "Standard shadow map", family: Family::Comparison, paper: "Williams 1978" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![self.precision.parameter()]
    }
    fn maps(&self, _: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(Vec::new())
    }
    fn bindings(&self) -> Vec<Binding> {
        vec![Binding::Depth, Binding::Compare(wgpu::FilterMode::Nearest)]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("hard.wgsl")
    }
    fn constants(&self) -> Vec<Constant> {
        self.precision.constants()
    }
    fn parts(&self, _: &Capabilities) -> Vec<&'static str> {
        vec![self.precision.part()]
    }
    fn bias(&self) -> BiasTerms {
        BiasTerms::TEXELS
    }
    fn depth_step(&self) -> f32 {
        self.precision.step()
    }
    fn depth_space(&self) -> DepthSpace {
        DepthSpace::Raster
    }
    fn reach_texels(&self) -> f32 {
        0.5
    }
    fn lookups(&self) -> u32 {
        1
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
