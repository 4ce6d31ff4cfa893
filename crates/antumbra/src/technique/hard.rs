//! The standard shadow map: one nearest texel, one comparison.
//!
//! Keeps the casters' depth. Aliased at every edge, blocky under magnification, and every point of
//! a tilted surface needs bias against its own texel: by default the receiver's plane at the texel's
//! centre. The yardstick of time and memory for the rest.
//!
//! Williams 1978, "Casting curved shadows on curved surfaces".

use super::{About, Description, Family, Technique};
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
    fn about(&self) -> About {
        About { name: "hard", title: "Standard shadow map", family: Family::Comparison, paper: "Williams 1978" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![self.precision.parameter()]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = include_str!("hard.wgsl");
        Ok(Description::comparison(self.about(), wgsl, wgpu::FilterMode::Nearest, self.precision))
    }
    fn variants(&self) -> Vec<&'static str> {
        Precision::VARIANTS.to_vec()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
