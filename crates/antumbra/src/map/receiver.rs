//! What receivers bind.

use super::{
    textures::{self, Textures},
    uniforms::{self, Uniforms},
};
use crate::{
    capabilities::Capabilities,
    describe::{Binding, Description},
};

/// Layout and bind group of the receiver: its uniforms, what the technique names, and what casters leave beside.
pub(super) fn group(
    device: &wgpu::Device,
    description: &Description,
    capabilities: &Capabilities,
    textures: &Textures,
    uniforms: &Uniforms,
    kept: &[(wgpu::BindingType, wgpu::BindingResource<'_>)],
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    use wgpu::{BindingResource, BindingType, SamplerBindingType, TextureSampleType};
    let texture = |sample_type| BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2Array,
        multisampled: false,
    };
    let filterable = textures.maps().iter().all(|m| capabilities.filters(m.texture.format()));
    let bindings = &description.bindings;
    let samplers: Vec<wgpu::Sampler> = bindings
        .iter()
        .map(|binding| textures::sampler(device, *binding, filterable, textures.is_reversed()))
        .collect();
    let mut layout = vec![uniforms::layout_entry(0)];
    let mut group = vec![wgpu::BindGroupEntry { binding: 0, resource: uniforms.receiver() }];
    for (i, binding) in bindings.iter().enumerate() {
        let (ty, resource) = match binding {
            Binding::Depth => {
                (texture(TextureSampleType::Depth), BindingResource::TextureView(textures.casters_array()))
            }
            Binding::Compare(_) => {
                (BindingType::Sampler(SamplerBindingType::Comparison), BindingResource::Sampler(&samplers[i]))
            }
            Binding::Map(m) => {
                let map = &textures.maps()[*m];
                let format = map.texture.format();
                let kind = match format.sample_type(None, None) {
                    Some(TextureSampleType::Uint) => TextureSampleType::Uint,
                    _ => TextureSampleType::Float { filterable: capabilities.filters(format) },
                };
                (texture(kind), BindingResource::TextureView(&map.array))
            }
            Binding::Sampler => {
                let kind =
                    if filterable { SamplerBindingType::Filtering } else { SamplerBindingType::NonFiltering };
                (BindingType::Sampler(kind), BindingResource::Sampler(&samplers[i]))
            }
        };
        layout.push(layout_entry(i as u32 + 1, ty));
        group.push(wgpu::BindGroupEntry { binding: i as u32 + 1, resource });
    }
    for (binding, (ty, resource)) in (bindings.len() as u32 + 1..).zip(kept.iter().cloned()) {
        layout.push(layout_entry(binding, ty));
        group.push(wgpu::BindGroupEntry { binding, resource });
    }
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("shadow map"),
        entries: &layout,
    });
    let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("shadow map"),
        layout: &layout,
        entries: &group,
    });
    (layout, bind_group)
}

fn layout_entry(binding: u32, ty: wgpu::BindingType) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    }
}
