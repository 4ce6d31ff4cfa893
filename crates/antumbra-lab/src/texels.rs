//! What the bytes of a texture mean.

use crate::image::GrayImage;
use anyhow::{Context, Result, bail};
use wgpu::TextureFormat;

/// How one channel of a texel is stored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Component {
    Unorm8,
    Unorm16,
    Float16,
    Float32,
    Uint32,
}

impl Component {
    fn bytes(self) -> usize {
        match self {
            Self::Unorm8 => 1,
            Self::Unorm16 | Self::Float16 => 2,
            Self::Float32 | Self::Uint32 => 4,
        }
    }

    /// The value that a shader reads. `bytes` are as many as [`bytes`](Self::bytes) says.
    fn value(self, bytes: &[u8]) -> f32 {
        let word = || u16::from_ne_bytes([bytes[0], bytes[1]]);
        let long = || u32::from_ne_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]);
        match self {
            Self::Unorm8 => f32::from(bytes[0]) / 255.0,
            Self::Unorm16 => f32::from(word()) / 65535.0,
            Self::Float16 => half::f16::from_bits(word()).to_f32(),
            Self::Float32 => f32::from_bits(long()),
            Self::Uint32 => long() as f32,
        }
    }
}

fn layout(format: TextureFormat) -> Option<(Component, usize)> {
    use TextureFormat as F;
    Some(match format {
        F::R8Unorm => (Component::Unorm8, 1),
        F::Rg8Unorm => (Component::Unorm8, 2),
        F::Rgba8Unorm => (Component::Unorm8, 4),
        F::R16Unorm => (Component::Unorm16, 1),
        F::Rg16Unorm => (Component::Unorm16, 2),
        F::Rgba16Unorm => (Component::Unorm16, 4),
        F::R16Float => (Component::Float16, 1),
        F::Rg16Float => (Component::Float16, 2),
        F::Rgba16Float => (Component::Float16, 4),
        F::R32Float | F::Depth32Float => (Component::Float32, 1),
        F::Rg32Float => (Component::Float32, 2),
        F::Rgba32Float => (Component::Float32, 4),
        F::R32Uint => (Component::Uint32, 1),
        F::Rg32Uint => (Component::Uint32, 2),
        F::Rgba32Uint => (Component::Uint32, 4),
        _ => return None,
    })
}

/// One plane per channel of an image of that format, rows without padding.
///
/// # Errors
/// A format that no shadow map keeps, or too few bytes.
pub(crate) fn planes(
    format: TextureFormat,
    [width, height]: [u32; 2],
    bytes: &[u8],
) -> Result<Vec<GrayImage>> {
    let (component, channels) = layout(format).with_context(|| format!("{format:?} cannot be shown"))?;
    let step = component.bytes();
    if bytes.len() != width as usize * height as usize * channels * step {
        bail!("{} bytes are no {width}x{height} texels of {format:?}", bytes.len());
    }
    let plane = |channel: usize| {
        let texels = bytes.chunks_exact(channels * step);
        let values = texels.map(|t| component.value(&t[channel * step..])).collect();
        Ok(GrayImage::new(width, height, values)?)
    };
    (0..channels).map(plane).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_of_number_is_read() {
        let read = |format, bytes: &[u8]| -> Vec<f32> {
            planes(format, [1, 1], bytes).unwrap().iter().map(|p| p.values[0]).collect()
        };
        assert_eq!(read(TextureFormat::Rgba8Unorm, &[0, 51, 102, 255]), [0.0, 0.2, 0.4, 1.0]);
        assert_eq!(read(TextureFormat::R16Unorm, &u16::MAX.to_ne_bytes()), [1.0]);
        assert_eq!(read(TextureFormat::R16Float, &0xc100_u16.to_ne_bytes()), [-2.5]);
        let two = [1.5_f32.to_ne_bytes(), (-3.0_f32).to_ne_bytes()].concat();
        assert_eq!(read(TextureFormat::Rg32Float, &two), [1.5, -3.0]);
        assert_eq!(read(TextureFormat::R32Uint, &7_u32.to_ne_bytes()), [7.0]);
        assert!(planes(TextureFormat::R32Float, [2, 1], &[0; 4]).is_err());
        assert!(planes(TextureFormat::Bc1RgbaUnorm, [4, 4], &[0; 8]).is_err());
    }
}
