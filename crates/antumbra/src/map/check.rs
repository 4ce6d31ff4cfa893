//! What must hold before anything is created, so that wgpu has nothing to complain about.

use super::{Depth, Options, uniforms};
use crate::{
    describe::{CasterStorage, Description},
    error::Unsupported,
    light::Size,
};

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
    if options.lights == 0 {
        return Err(Unsupported::Lights);
    }
    let most = description.maps.iter().map(|m| m.layers).max().unwrap_or(1);
    let layers = if options.views == 0 { 0 } else { most.saturating_mul(options.layer_count()) };
    let max = limits.max_texture_array_layers;
    if !(1..=max).contains(&layers) {
        return Err(Unsupported::Layers { views: options.views, layers, max });
    }
    let most_bytes = limits.max_uniform_buffer_binding_size;
    let most = most_bytes
        .saturating_sub(uniforms::bytes(description, &Options { views: 0, ..options.clone() }))
        / uniforms::view_bytes(description);
    if u64::from(options.views) > most {
        return Err(Unsupported::Feature {
            technique: description.about.name.into(),
            what: format!(
                "a uniform binding of {} bytes for {} views ({most_bytes} are possible)",
                uniforms::bytes(description, options),
                options.views
            ),
            instead: format!("take at most {most} views"),
        });
    }
    Ok(())
}

/// Whether depth is all that the casters leave, if that is what the caller has.
pub(super) fn caster(description: &Description, depth: Option<&Depth<'_>>) -> Result<(), Unsupported> {
    match (description.storage, depth) {
        (CasterStorage::Depth, _) | (_, None) => Ok(()),
        (_, Some(_)) => Err(Unsupported::Triangles { technique: description.about.name.into() }),
    }
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
