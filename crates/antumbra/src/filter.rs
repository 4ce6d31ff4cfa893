//! The pre-filter settings that every member of the linear-basis family shares.

use crate::{
    capabilities::Capabilities,
    kernel::{Kernel, Weights},
    parameter::{Field, Parameter, choice},
    technique::{Constant, Pass},
};

choice! {
    /// How a receiver reads a filtered map.
    Sampling {
        /// One texel.
        Nearest = "nearest",
        /// Four texels of the finest level.
        Bilinear = "bilinear",
        /// Two mip levels chosen by the longer side of the pixel's footprint.
        Trilinear = "trilinear",
        /// Several trilinear lookups along the longer side of the footprint.
        Anisotropic = "anisotropic",
    }
}

/// Blur, mips and sampling, in the order in which they act.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Filter {
    /// Width of the blur in texels, odd, 1 (none) to 31.
    pub kernel: u32,
    /// Shape of the blur.
    pub weights: Weights,
    /// Standard deviation of the Gaussian in texels, 0 for [`Kernel::usual_sigma`].
    pub sigma: f32,
    /// How receivers read the map; mips are built only if it uses them.
    pub sampling: Sampling,
    /// Most lookups along the footprint with anisotropic sampling, 1 to 16.
    pub anisotropy: u32,
}

impl Default for Filter {
    fn default() -> Self {
        Self {
            kernel: 3,
            weights: Weights::Gaussian,
            sigma: 0.0,
            sampling: Sampling::Trilinear,
            anisotropy: 16,
        }
    }
}

impl Filter {
    /// The rows of these settings in a technique's parameter table.
    pub fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new(
                "kernel",
                "texels",
                Field::Odd(&mut self.kernel, 1..=31),
                "width of the blur; 1 is none",
            ),
            Parameter::new("weights", "", Field::Choice(&mut self.weights), "shape of the blur"),
            Parameter::new(
                "sigma",
                "texels",
                Field::Number(&mut self.sigma, 0.0..=31.0),
                "standard deviation of the Gaussian; 0 is 0.15·kernel + 0.35",
            ),
            Parameter::new("sampling", "", Field::Choice(&mut self.sampling), "how receivers read the map"),
            Parameter::new(
                "anisotropy",
                "lookups",
                Field::Count(&mut self.anisotropy, 1..=16),
                "most trilinear lookups along a stretched footprint; only with sampling=anisotropic",
            ),
        ]
    }

    /// What happens between casting and lighting.
    #[must_use]
    pub fn passes(&self) -> Vec<Pass> {
        let blur = (self.kernel > 1).then(|| Pass::Blur(Kernel::new(self.weights, self.kernel, self.sigma)));
        let mips = matches!(self.sampling, Sampling::Trilinear | Sampling::Anisotropic).then_some(Pass::Mips);
        blur.into_iter().chain(mips).collect()
    }

    /// The WGSL files behind `lookup_filtered`, for a map of this format on this device.
    #[must_use]
    pub fn parts(&self, device: &Capabilities, format: wgpu::TextureFormat) -> Vec<&'static str> {
        let lookup = match self.sampling {
            Sampling::Nearest => return vec!["lookup_nearest"],
            Sampling::Bilinear => "lookup_bilinear",
            Sampling::Trilinear => "lookup_trilinear",
            Sampling::Anisotropic => "lookup_anisotropic",
        };
        vec![lookup, if device.filters(format) { "level_hardware" } else { "level_manual" }]
    }

    /// Compile-time settings of those files.
    #[must_use]
    pub fn constants(&self) -> Vec<Constant> {
        match self.sampling {
            Sampling::Anisotropic => vec![Constant::Count("lookup_most_taps", self.anisotropy)],
            _ => Vec::new(),
        }
    }

    /// See [`Technique::reach_texels`](crate::Technique::reach_texels).
    #[must_use]
    pub fn reach_texels(&self) -> f32 {
        self.kernel as f32 / 2.0 + 0.5
    }
}
