//! Percentage-closer filtering on a grid: compare first, average the answers.
//!
//! n×n comparisons around the receiver's place in the map, with box or Gaussian weights, each
//! nearest (k/n² grey levels) or interpolated by the comparison sampler (continuous). The quality
//! that pre-filtered techniques are measured by; the cost grows with n².
//!
//! Reeves, Salesin, Cook 1987, "Rendering antialiased shadows with depth maps".

use super::{Bias, Binding, Constant, DepthSpace, Family, Map, Page, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    kernel::{Kernel, Weights},
    parameter::{Field, Parameter, choice},
};

choice! {
    /// What one tap of a comparison kernel is.
    Taps {
        /// The nearest texel: 0 or 1.
        Nearest = "nearest",
        /// Four comparisons with bilinear weights, in one hardware lookup.
        Bilinear = "bilinear",
    }
}

/// Percentage-closer filtering. n² lookups; 4 bytes per texel (32-bit depth).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pcf {
    /// Taps along one side, 1 to 16.
    pub kernel: u32,
    /// Shape of the kernel.
    pub weights: Weights,
    /// Standard deviation of the Gaussian in texels, 0 for [`Kernel::usual_sigma`].
    pub sigma: f32,
    /// Nearest or bilinear comparisons.
    pub taps: Taps,
}

impl Default for Pcf {
    fn default() -> Self {
        Self { kernel: 3, weights: Weights::Gaussian, sigma: 0.0, taps: Taps::Bilinear }
    }
}

impl Technique for Pcf {
    fn page(&self) -> Page {
        Page {
            name: "pcf",
            title: "Percentage-closer filtering",
            family: Family::Comparison,
            paper: "Reeves et al. 1987",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new("kernel", "texels", Field::Count(&mut self.kernel, 1..=16), "taps along one side of the grid"),
            Parameter::new("weights", "", Field::Choice(&mut self.weights), "shape of the kernel"),
            Parameter::new(
                "sigma",
                "texels",
                Field::Number(&mut self.sigma, 0.0..=31.0),
                "standard deviation of the Gaussian; 0 is 0.15·kernel + 0.35",
            ),
            Parameter::new("taps", "", Field::Choice(&mut self.taps), "one texel, or 2×2 with bilinear weights, per tap"),
        ]
    }
    fn maps(&self, _: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(Vec::new())
    }
    fn bindings(&self) -> Vec<Binding> {
        let filter = match self.taps {
            Taps::Nearest => wgpu::FilterMode::Nearest,
            Taps::Bilinear => wgpu::FilterMode::Linear,
        };
        vec![Binding::Depth, Binding::Compare(filter)]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("pcf.wgsl")
    }
    fn constants(&self) -> Vec<Constant> {
        let kernel = Kernel::new(self.weights, self.kernel, self.sigma);
        vec![Constant::Array("pcf_weights", kernel.taps), Constant::Count("pcf_width", self.kernel)]
    }
    /// The taps follow the receiver's plane, so the slope term covers one tap only: half a texel
    /// nearest, one texel bilinear.
    fn bias(&self) -> Bias {
        let slope_texels = match self.taps {
            Taps::Nearest => 0.55,
            Taps::Bilinear => 1.05,
        };
        Bias { constant_texels: 0.1, slope_texels, normal_offset_texels: 0.1 }
    }
    fn depth_space(&self) -> DepthSpace {
        DepthSpace::Raster
    }
    fn reach_texels(&self) -> f32 {
        self.kernel as f32 / 2.0 + 0.5
    }
    fn lookups(&self) -> u32 {
        self.kernel * self.kernel
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
