//! The textures that a technique keeps, and how they are filtered.

use crate::{kernel::Kernel, table::Table};

/// One texture array that a technique keeps per view.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Map {
    /// Name in memory listings.
    pub name: &'static str,
    /// Storage; must be a colour format that can be rendered to, or, for summed-area tables, one
    /// that compute shaders can store.
    pub format: wgpu::TextureFormat,
    /// Array layers per view.
    pub layers: u32,
    /// What makes texels from depth.
    pub encode: Encode,
    /// What happens between casting and lighting, in order.
    pub passes: Vec<Pass>,
    /// How receivers read it, for [`ShadowMap::explain`](crate::ShadowMap::explain).
    pub access: Access,
    /// The stored value that stands for zero, for debug views: ½ where signed numbers are kept in an
    /// unsigned format.
    pub zero_level: f32,
}

impl Map {
    /// One layer per view, unfiltered and read texel by texel.
    #[must_use]
    pub fn new(name: &'static str, format: wgpu::TextureFormat, encode: Encode) -> Self {
        Self { name, format, layers: 1, encode, passes: Vec::new(), access: Access::Texel, zero_level: 0.0 }
    }

    /// Whether shaders read whole numbers from it.
    pub(crate) fn holds_integers(&self) -> bool {
        self.format.sample_type(None, None) == Some(wgpu::TextureSampleType::Uint)
    }
}

/// The WGSL function that makes layer `layer` of a [`Map`] from linear depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Encode {
    /// `(depth: f32, layer: u32) -> vec4f`: a texel depends on its own depth alone. A blur
    /// that follows runs its rows on the encoded depths, without storing them first.
    Texel(&'static str),
    /// `(depths: mat3x3f, layer: u32) -> vec4f`: `depths[1][1]` is the texel itself,
    /// `depths[1 + dx][1 + dy]` its neighbour. What is not read is not fetched.
    Neighbours(&'static str),
}

/// A step of the pre-filter.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Pass {
    /// Separable convolution of every layer, edge texels repeated.
    Blur(Kernel, Combine),
    /// The full mip chain, each level from 2×2 texels of the one above.
    Mips(Combine),
    /// A summed-area table in whole numbers: no other pass beside it.
    Sum(Table),
}

/// How a filter puts texels together.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Combine {
    /// Weighted mean.
    Mean,
    /// The greatest of all whose weight is not zero.
    Greatest,
    /// 1/c · log of the weighted mean of e^(c·texel): filters logarithms as if they were the powers.
    LogMean(f32),
}

/// How receivers read a [`Map`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Access {
    /// One texel at a time.
    Texel,
    /// Interpolated by the sampler.
    Sampler,
    /// Interpolated by the shader, from four loads: the device cannot filter the format.
    Shader,
    /// Interpolated by the shader, from four loads, as the powers that logarithms stand for.
    Powers,
    /// Sixteen loads from a summed-area table.
    Sums,
}

impl Access {
    /// The end of the sentence about a map.
    pub(crate) fn words(self) -> &'static str {
        match self {
            Self::Texel => "read one texel at a time",
            Self::Sampler => "interpolated by the sampler",
            Self::Shader => "interpolated by the shader (four loads)",
            Self::Powers => "interpolated as powers by the shader (four loads)",
            Self::Sums => "a summed-area table (sixteen loads)",
        }
    }
}
