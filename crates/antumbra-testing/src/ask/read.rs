//! Texels as numbers.

use crate::Gpu;

/// Bytes of floats.
pub fn bytes_of(values: &[f32]) -> &[u8] {
    bytemuck::cast_slice(values)
}

/// Floats of bytes.
pub fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
}

fn words(bytes: &[u8]) -> impl Iterator<Item = u16> {
    bytes.chunks_exact(2).map(|b| u16::from_ne_bytes([b[0], b[1]]))
}

/// Value of a finite 16-bit float.
fn from_half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let size = match exponent {
        0 => fraction * 2f64.powi(-14),
        _ => (1.0 + fraction) * 2f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// Texels of one layer and level of a map, up to four channels, in f64.
pub fn texels(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, mip: u32) -> Vec<[f64; 4]> {
    let bytes = gpu.read_texture(texture, layer, mip);
    let pack = |values: &[f64], channels: usize| -> Vec<[f64; 4]> {
        values
            .chunks_exact(channels)
            .map(|c| std::array::from_fn(|i| c.get(i).copied().unwrap_or(0.0)))
            .collect()
    };
    let wide = || floats(&bytes).into_iter().map(f64::from).collect::<Vec<f64>>();
    let halves = || words(&bytes).map(from_half).collect::<Vec<f64>>();
    let shares = || words(&bytes).map(|w| f64::from(w) / 65535.0).collect::<Vec<f64>>();
    use wgpu::TextureFormat as F;
    match texture.format() {
        F::Rgba8Unorm => pack(&bytes.iter().map(|b| f64::from(*b) / 255.0).collect::<Vec<f64>>(), 4),
        F::R16Unorm => pack(&shares(), 1),
        F::Rg16Unorm => pack(&shares(), 2),
        F::Rgba16Unorm => pack(&shares(), 4),
        F::R16Float => pack(&halves(), 1),
        F::Rg16Float => pack(&halves(), 2),
        F::Rgba16Float => pack(&halves(), 4),
        F::R32Float => pack(&wide(), 1),
        F::Rg32Float => pack(&wide(), 2),
        F::Rgba32Float => pack(&wide(), 4),
        format => panic!("teach this test to read {format:?}"),
    }
}
