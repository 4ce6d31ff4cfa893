//! Laws of what filters make of maps, and how receivers read them.

use super::cases::{SIZE, all_of, blocks, described, receivers, try_set};
use crate::{
    Gpu,
    ask::{self, Receiver, depth_texture, shadow_map, texels, visibility},
};
use antumbra::{
    Technique,
    technique::{Access, Combine, Pass},
};
use glam::Vec2;

/// How far a mean may move, absolutely and relatively: few bits round at every step, but by far less
/// than a level on average; 16-bit floats may be truncated at each of eight steps.
fn rounding(format: wgpu::TextureFormat) -> (f64, f64) {
    use wgpu::TextureFormat as F;
    match format {
        F::Rgba8Unorm => (1.0 / 255.0, 0.0),
        F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => (1.0 / 65535.0, 0.0),
        F::R16Float | F::Rg16Float | F::Rgba16Float => (1e-7, 8e-3),
        _ => (0.0, 1e-5),
    }
}

/// Blur with a constant border, and every mip level, keep the mean of what is stored, or of the powers
/// whose logarithms are. Summed-area tables and greatest values have no mean to keep.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn filtering_keeps_the_mean(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let inner = blocks(7, 1);
    let border = |x: u32| !(16..48).contains(&x);
    let depth = depth_texture(gpu, SIZE, |x, y| if border(x) || border(y) { 0.5 } else { inner(x, y) });
    let filtered = shadow_map(gpu, technique, &depth, SIZE.into());
    let mut plain = technique.clone_box();
    try_set(plain.as_mut(), "kernel", "1");
    let plain = shadow_map(gpu, plain.as_ref(), &depth, SIZE.into());
    for (index, map) in described(gpu, technique).maps.iter().enumerate() {
        let (Some(filtered), Some(plain)) = (filtered.map_texture(index), plain.map_texture(index)) else {
            return Err("a map is missing".into());
        };
        let combine = map.passes.iter().find_map(|p| match p {
            Pass::Blur(_, combine) | Pass::Mips(combine) => Some(*combine),
            _ => None,
        });
        let (absolute, relative) = rounding(filtered.format());
        let (power, relative) = match combine {
            None | Some(Combine::Greatest) => continue,
            Some(Combine::Mean) => (0.0, relative),
            // c times the rounding of a depth.
            Some(Combine::LogMean(c)) => {
                (f64::from(c), f64::from(c) * (8.0 * absolute.max(1e-6) + 0.5 * relative))
            }
            Some(other) => return Err(format!("this law does not know what {other:?} keeps")),
        };
        let value = |t: f64| if power > 0.0 { (power * (t - 1.0)).exp() } else { t };
        for layer in 0..filtered.depth_or_array_layers() {
            let mean = |texture: &wgpu::Texture, mip| -> [f64; 4] {
                let texels = texels(gpu, texture, layer, mip);
                std::array::from_fn(|i| texels.iter().map(|t| value(t[i])).sum::<f64>() / texels.len() as f64)
            };
            let expected = mean(plain, 0);
            for mip in 0..filtered.mip_level_count() {
                let found = mean(filtered, mip);
                // Each level rounds once more, by half a step.
                let steps = if gpu.is_software() { 1.0 } else { 0.5 * f64::from(mip + 2) };
                for (f, e) in found.iter().zip(expected) {
                    if (f - e).abs() > steps * absolute + relative * e.abs() {
                        return Err(format!("layer {layer}, level {mip}: mean {f} instead of {e}"));
                    }
                }
            }
        }
    }
    Ok(())
}

/// Interpolation in the shader gives what the sampler gives, and is told.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn fallbacks_agree(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let lesser = crate::gpu_without(wgpu::Features::FLOAT32_FILTERABLE).ok_or("no second device")?;
    let receivers = receivers(10, 4096);
    let ask = |gpu: &Gpu| {
        let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(11, 3)), SIZE.into());
        (visibility(gpu, &shadows, &receivers), shadows.explain().join("; "))
    };
    let (expected, _) = ask(gpu);
    let (found, explained) = lesser.checked(ask);
    // GPUs interpolate with 8-bit weights.
    let tolerance = if gpu.is_software() { described(gpu, technique).rounding } else { 2e-2 };
    let differ = expected.iter().zip(&found).filter(|(e, f)| (**e - **f).abs() > tolerance).count();
    // A texel or a level that weighs less than half a 256th weighs nothing, though it may hold a power of e
    // that outweighs all others.
    let allowed = if gpu.is_software() { 0 } else { receivers.len() / 50 };
    if differ > allowed {
        return Err(format!("{differ} of {} receivers differ by more than {tolerance}", receivers.len()));
    }
    if let Some(map) = described(&lesser, technique).maps.first() {
        let said =
            explained.contains(&format!("{} in {:?}, interpolated by the shader", map.name, map.format));
        if said != (map.access == Access::Shader) {
            return Err(format!("explain() says: {explained}"));
        }
    }
    Ok(())
}

/// A width in the world that is so many texels of the view is as good as so many texels.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn widths_in_the_world_are_texels_of_the_view(
    gpu: &Gpu,
    technique: &dyn Technique,
) -> Result<(), String> {
    let adapts =
        technique.clone_box().parameters().iter().any(|p| p.name == "width" && p.allowed() != "0 to 0");
    if !adapts {
        return Ok(());
    }
    let depth = depth_texture(gpu, SIZE, blocks(12, 3));
    // Away from the border, within which the wider margin makes a difference.
    let inner = |mut r: Receiver| {
        r.uv = Vec2::splat(0.3) + 0.4 * r.uv;
        r
    };
    let receivers: Vec<Receiver> = receivers(13, 2048).into_iter().map(inner).collect();
    let ask = |kernel: &str, texels: f32| {
        let mut technique = technique.clone_box();
        try_set(technique.as_mut(), "kernel", kernel);
        try_set(technique.as_mut(), "width", &(texels * ask::view(SIZE).texel_world).to_string());
        visibility(gpu, &shadow_map(gpu, technique.as_ref(), &depth, SIZE.into()), &receivers)
    };
    let (fixed, adapted) = (ask("5", 0.0), ask("9", 5.0));
    // Sums in another order.
    let tolerance = described(gpu, technique).rounding;
    all_of(receivers.iter().zip(fixed.iter().zip(adapted).map(|(f, a)| f - a)), |_, difference| {
        difference.abs() <= tolerance
    })
}
