//! Techniques that no user wants and experiments need.

use antumbra::{
    Capabilities, Description, Filter, Parameter, Sampling, Technique, Unsupported, Values,
    technique::{self, About, Encode, Family, Pcf},
    wgpu::TextureFormat,
};
use anyhow::Result;

/// The spec of filtered depth with a box of 5×5 texels and a bilinear lookup.
pub const FILTERED_DEPTH: &str = "filtered_depth";

/// What a spec means: a technique of the library, or one of these.
pub(super) fn parse(spec: &str) -> Result<Box<dyn Technique>> {
    if spec == FILTERED_DEPTH {
        return Ok(Box::new(FilteredDepth));
    }
    Ok(technique::parse(spec)?)
}

/// The mistake that percentage-closer filtering mends: depth is filtered like colour, then compared.
#[derive(Debug, Clone, Copy)]
struct FilteredDepth;

impl Technique for FilteredDepth {
    fn about(&self) -> About {
        About {
            name: FILTERED_DEPTH,
            title: "Filtered depth, then compared",
            family: Family::Basis,
            paper: "Annen et al. 2007, Eq. 5",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let filter = Filter { kernel: 5, sampling: Sampling::Bilinear, ..Filter::default() };
        let values = Values::new("depths", TextureFormat::R32Float, Encode::Texel("filtered_depth_encode"));
        let wgsl = include_str!("own/filtered_depth.wgsl");
        // As much bias as comparisons of the same texels have: lit surfaces are not what is tried.
        let compared = Pcf { kernel: 5, ..Pcf::default() }.describe(device)?;
        let mut described = Description::filtered(self.about(), wgsl, &filter, values, device);
        described.bias = compared.bias;
        Ok(described)
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
