//! What must hold before anything is created, so that wgpu has nothing to complain about.

use super::{
    Capacity, Options,
    lists::{ListSize, ROW},
    ranked::RankedSize,
    uniforms,
};
use crate::{
    describe::{Caster, Description},
    error::{SettingError, Unsupported},
    light::Size,
    shader::split::{Split, Splits},
};
use wgpu::TextureUsages;

/// GL only compares depth textures: nothing could be converted.
fn backend(backend: wgpu::Backend) -> Result<(), Unsupported> {
    match backend {
        wgpu::Backend::Gl => Err(Unsupported::Backend { backend: backend.to_string() }),
        _ => Ok(()),
    }
}

/// Backend, size and layers against the device.
pub(super) fn device(
    device: &wgpu::Device,
    description: &Description,
    options: &Options,
) -> Result<(), Unsupported> {
    backend(device.adapter_info().backend)?;
    let limits = device.limits();
    let Size { width, height } = options.size;
    let max = limits.max_texture_dimension_2d;
    if !(1..=max).contains(&width) || !(1..=max).contains(&height) {
        return Err(Unsupported::Size { width, height, max });
    }
    let layers = description.maps.iter().map(|m| m.layers).max().unwrap_or(1).saturating_mul(options.views);
    let max = limits.max_texture_array_layers;
    if !(1..=max).contains(&layers) {
        return Err(Unsupported::Layers { views: options.views, layers, max });
    }
    let most_bytes = limits.max_uniform_buffer_binding_size;
    let most = most_bytes.saturating_sub(uniforms::bytes(description, 0)) / uniforms::view_bytes(description);
    if u64::from(options.views) > most {
        return Err(Unsupported::Feature {
            technique: description.about.name.into(),
            what: format!(
                "a uniform binding of {} bytes for {} views ({most_bytes} are possible)",
                uniforms::bytes(description, options.views),
                options.views
            ),
            instead: format!("take at most {most} views"),
        });
    }
    Ok(())
}

/// Groups of the library's own in the pass that draws triangles.
const CASTER_GROUPS: usize = 2;

/// Whether a pass for cut-outs may have as many groups.
pub(super) fn cutout(
    device: &wgpu::Device,
    description: &Description,
    groups: usize,
) -> Result<(), Unsupported> {
    let (needed, max) = (CASTER_GROUPS + groups, device.limits().max_bind_groups as usize);
    if needed <= max {
        return Ok(());
    }
    let most = max.saturating_sub(CASTER_GROUPS);
    let reason = format!(
        "{needed} bind groups, {groups} of the caller's, where {max} are possible; put what the shader reads into at most {most}"
    );
    Err(Unsupported::Cutout { technique: description.about.name.into(), reason })
}

/// Whether the casters can leave what the technique keeps.
pub(super) fn caster(description: &Description, depth: Option<&wgpu::Texture>) -> Result<(), Unsupported> {
    let name = description.about.name.to_string();
    match (description.caster, depth, description.maps.as_slice()) {
        (Caster::Depth, ..) => Ok(()),
        (Caster::Triangles(_) | Caster::Lists | Caster::Ranked { .. }, Some(_), _) => {
            Err(Unsupported::Triangles { technique: name })
        }
        (Caster::Lists | Caster::Ranked { .. }, None, _) if description.sample_offsets.len() == 1 => Ok(()),
        (Caster::Lists | Caster::Ranked { .. }, None, _) => Err(Unsupported::Feature {
            technique: name,
            what: "a single caster pass".into(),
            instead: "leave no more in Description::sample_offsets".into(),
        }),
        (Caster::Triangles(all), None, [map]) if map.layers as usize == all.len() => Ok(()),
        (Caster::Triangles(_), None, _) => Err(Unsupported::Feature {
            technique: name,
            what: "one map with a layer for each of its casters' passes".into(),
            instead: "leave just that in Description::maps".into(),
        }),
    }
}

/// What a technique needs that the device lacks, and what to do.
fn refused(description: &Description, what: String, instead: String) -> Result<(), Unsupported> {
    Err(Unsupported::Feature { technique: description.about.name.into(), what, instead })
}

/// Whether a capacity holds anything, and ids can tell all of it apart.
fn capacity(capacity: Capacity) -> Result<(), Unsupported> {
    let within = |name: &str, value: u32, most: u32| match (1..=most).contains(&value) {
        true => Ok(()),
        false => Err(Unsupported::Setting(SettingError::OutOfRange {
            parameter: format!("Options::capacity.{name}"),
            value: value.to_string(),
            allowed: format!("1 to {most}"),
        })),
    };
    within("triangles", capacity.triangles, Capacity::MAX_TRIANGLES)?;
    within("triangles_per_texel", capacity.triangles_per_texel, u32::MAX)
}

/// Whether the lists of all triangles fit.
pub(super) fn lists(
    device: &wgpu::Device,
    description: &Description,
    extent: ListSize,
) -> Result<(), Unsupported> {
    capacity(extent.capacity)?;
    let limits = device.limits();
    let layers = extent.number_layers().max(3).saturating_mul(extent.views);
    let max = limits.max_texture_array_layers;
    if !(1..=max).contains(&layers) {
        return Err(Unsupported::Layers { views: extent.views, layers, max });
    }
    let refused = |what, instead| refused(description, what, instead);
    // Marks, and two of a mesh.
    buffers(description, &limits, &[extent.splits(&limits).counts], 3)?;
    let max = limits.max_texture_dimension_2d;
    if max < ROW {
        return refused(
            format!("textures of {ROW} texels ({max} are possible)"),
            "take another technique".into(),
        );
    }
    if extent.rows() > max {
        let what = format!(
            "corners of {} triangles in {} rows of {ROW} ({max} are possible)",
            extent.capacity.triangles,
            extent.rows()
        );
        return refused(what, format!("give Options::capacity at most {} triangles", max * ROW));
    }
    Ok(())
}

/// Whether arrays that are split, and `others`, are no more storage buffers than a stage may have.
fn buffers(
    description: &Description,
    limits: &wgpu::Limits,
    split: &[Split],
    others: u32,
) -> Result<(), Unsupported> {
    let counts = split.iter().map(|split| split.count());
    let needed = counts.clone().fold(others, u32::saturating_add);
    let found = limits.max_storage_buffers_per_shader_stage;
    // Shaders count elements with 32 bits.
    let few = |split: &Split| split.count() <= Split::MAX_BUFFERS && split.elements <= u64::from(u32::MAX);
    if needed <= found && split.iter().all(few) {
        return Ok(());
    }
    let what = format!("{needed} storage buffers in a stage ({found} are possible)");
    let instead = match counts.max() {
        Some(1) | None => "take another technique".into(),
        _ => {
            let max = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
            format!(
                "a buffer holds {max} bytes here: take fewer texels or views, or fewer triangles (Options::capacity)"
            )
        }
    };
    refused(description, what, instead)
}

/// Whether the first triangles of texels fit.
pub(super) fn ranked(
    device: &wgpu::Device,
    description: &Description,
    extent: RankedSize,
) -> Result<(), Unsupported> {
    capacity(extent.capacity)?;
    if extent.keeps == 0 {
        return refused(description, "0 triangles per texel".into(), "keep at least one".into());
    }
    let limits = device.limits();
    let Splits { keys, corners, .. } = extent.splits(&limits);
    // Marks, and two of a mesh.
    buffers(description, &limits, &[keys, corners], 3)
}

/// Whether the passes can read a caller's depth, which has that many layers for each view; options with its
/// size and its views.
pub(super) fn depth(depth: &wgpu::Texture, casts: u32, options: &Options) -> Result<Options, Unsupported> {
    let wrong =
        |what, found: String, needed: &str| Err(Unsupported::Depth { what, found, needed: needed.into() });
    let format = depth.format();
    if !format.has_depth_aspect() {
        return wrong("format", format!("{format:?}"), "a depth format");
    }
    if !depth.usage().contains(TextureUsages::TEXTURE_BINDING) {
        return wrong("usage", format!("{:?}", depth.usage()), "TEXTURE_BINDING");
    }
    if depth.dimension() != wgpu::TextureDimension::D2 {
        return wrong("dimension", format!("{:?}", depth.dimension()), "2-D, one layer per view");
    }
    if depth.sample_count() != 1 {
        return wrong("samples", depth.sample_count().to_string(), "1");
    }
    let layers = depth.depth_or_array_layers();
    if !layers.is_multiple_of(casts) {
        return wrong("layers", layers.to_string(), &format!("a multiple of {casts}, one per caster pass"));
    }
    let size = Size { width: depth.width(), height: depth.height() };
    Ok(Options { size, views: layers / casts, ..options.clone() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gl_alone_is_refused() {
        use wgpu::Backend;
        assert!(matches!(backend(Backend::Gl), Err(Unsupported::Backend { .. })));
        for good in [Backend::Vulkan, Backend::Metal, Backend::Dx12, Backend::BrowserWebGpu] {
            assert_eq!(backend(good), Ok(()));
        }
    }
}
