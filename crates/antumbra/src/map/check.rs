//! What must hold before anything is created, so that wgpu has nothing to complain about.

use super::{Options, uniforms};
use crate::{
    describe::{Caster, Description},
    error::Unsupported,
    light::Size,
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

/// Whether depth is all that the casters leave, if that is what the caller has.
pub(super) fn caster(description: &Description, depth: Option<&wgpu::Texture>) -> Result<(), Unsupported> {
    match (description.caster, depth) {
        (Caster::Depth, _) | (_, None) => Ok(()),
        (_, Some(_)) => Err(Unsupported::Triangles { technique: description.about.name.into() }),
    }
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
