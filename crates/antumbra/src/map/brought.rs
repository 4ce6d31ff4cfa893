//! Depth that a renderer brings.

use crate::{error::Unsupported, light::Size};
use std::ops::Range;
use wgpu::{CompareFunction, TextureDimension, TextureFormat, TextureUsages};

/// A depth texture that a renderer draws itself, for [`ShadowMap::from_depth`](crate::ShadowMap::from_depth). A
/// `&wgpu::Texture` alone stands for all of its layers, with depth that grows from near to far.
#[derive(Debug, Clone)]
pub struct Depth<'a> {
    texture: &'a wgpu::Texture,
    layers: Range<u32>,
    reversed: bool,
}

impl<'a> From<&'a wgpu::Texture> for Depth<'a> {
    fn from(texture: &'a wgpu::Texture) -> Self {
        Self { texture, layers: 0..texture.depth_or_array_layers(), reversed: false }
    }
}

impl<'a> Depth<'a> {
    /// All layers of a texture: 2-D, of any depth format (beside a stencil, the depth alone is read), with usage
    /// `TEXTURE_BINDING`.
    #[must_use]
    pub fn new(texture: &'a wgpu::Texture) -> Self {
        texture.into()
    }

    /// Some layers of an array: one per view and caster pass.
    #[must_use]
    pub fn layers(self, layers: Range<u32>) -> Self {
        Self { layers, ..self }
    }

    /// Depth that falls from 1 at the near plane to 0 far away, cleared to 0. Its views must be such too, as those
    /// that [`View::of_matrix`](crate::View::of_matrix) makes of a reversed matrix are. Receivers compare one minus the stored depth, so that
    /// comparisons are as precise as with depth that grows; maps that are filtered keep all of its bits.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { reversed: true, ..self }
    }

    /// Texels and layers, if it can be read by a technique with so many caster passes per view.
    ///
    /// # Errors
    /// [`Unsupported::Depth`].
    pub(super) fn check(&self, casts: u32) -> Result<(Size, u32), Unsupported> {
        let wrong = |what, found: String, needed: &str| {
            Err(Unsupported::Depth { what, found, needed: needed.into() })
        };
        let Self { texture, layers, .. } = self;
        let format = texture.format();
        if !format.has_depth_aspect() {
            return wrong("format", format!("{format:?}"), "a depth format");
        }
        if !texture.usage().contains(TextureUsages::TEXTURE_BINDING) {
            return wrong("usage", format!("{:?}", texture.usage()), "TEXTURE_BINDING");
        }
        if texture.dimension() != TextureDimension::D2 {
            return wrong("dimension", format!("{:?}", texture.dimension()), "2-D, one layer per view");
        }
        if texture.sample_count() != 1 {
            return wrong("samples", texture.sample_count().to_string(), "1");
        }
        let all = texture.depth_or_array_layers();
        if layers.is_empty() || layers.end > all {
            return wrong(
                "layers",
                format!("{layers:?}"),
                &format!("a range within 0..{all} that is not empty"),
            );
        }
        let count = layers.end - layers.start;
        if !count.is_multiple_of(casts) {
            return wrong(
                "layers",
                count.to_string(),
                &format!("a multiple of {casts}, one per caster pass"),
            );
        }
        Ok((Size { width: texture.width(), height: texture.height() }, count / casts))
    }

    pub(super) fn texture(&self) -> &'a wgpu::Texture {
        self.texture
    }

    pub(super) fn layer_range(&self) -> Range<u32> {
        self.layers.clone()
    }

    pub(super) fn is_reversed(&self) -> bool {
        self.reversed
    }
}

/// Step of the stored depth as a share of its range, 0 for floats.
pub(super) fn quantum(texture: &wgpu::Texture) -> f32 {
    match texture.format() {
        TextureFormat::Depth16Unorm => 1.0 / f32::from(u16::MAX),
        TextureFormat::Depth24Plus | TextureFormat::Depth24PlusStencil8 => 1.0 / ((1 << 24) - 1) as f32,
        _ => 0.0,
    }
}

/// Comparison of samplers: lit where it holds between the receiver's depth and the stored one.
pub(super) fn comparison(reversed: bool) -> CompareFunction {
    if reversed { CompareFunction::GreaterEqual } else { CompareFunction::LessEqual }
}
