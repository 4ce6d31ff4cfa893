//! The standard shadow map: one nearest texel, one comparison.
//!
//! Keeps the casters' depth. Aliased at every edge, blocky under magnification, and every point of
//! a tilted surface needs bias against its own texel. The yardstick of time and memory for the
//! rest.
//!
//! Williams 1978, "Casting curved shadows on curved surfaces".

use super::{Bias, Binding, DepthSpace, Family, Map, Page, Technique};
use crate::{capabilities::Capabilities, error::Unsupported, parameter::Parameter};

/// The standard shadow map. 1 comparison; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Hard;

impl Technique for Hard {
    fn page(&self) -> Page {
        Page { name: "hard", title: "Standard shadow map", family: Family::Comparison, paper: "Williams 1978" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
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
    fn bias(&self) -> Bias {
        Bias { constant_texels: 0.1, slope_texels: 0.55, normal_offset_texels: 0.1 }
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
