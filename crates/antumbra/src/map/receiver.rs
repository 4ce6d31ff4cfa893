//! What receivers bind.

use super::{
    ShadowMap, Uniforms,
    textures::{self, Textures},
};
use crate::{
    capabilities::Capabilities,
    cast::Cast,
    describe::{Binding, Description},
};
use wgpu::{
    BindGroupEntry, BindGroupLayoutEntry, BindingResource, BindingType, SamplerBindingType, ShaderStages,
    TextureSampleType,
};

/// The samplers that a technique names, and what both they and its maps are bound as.
#[derive(Debug)]
pub(super) struct Samplers {
    /// One for each of the technique's bindings, unused for textures.
    samplers: Vec<wgpu::Sampler>,
    filterable: bool,
    /// Formats of maps that the device can filter.
    filters: Vec<wgpu::TextureFormat>,
}

impl Samplers {
    pub(super) fn new(
        device: &wgpu::Device,
        description: &Description,
        capabilities: &Capabilities,
        textures: &Textures,
    ) -> Self {
        let mut filters: Vec<_> = textures.maps().iter().map(|map| map.texture.format()).collect();
        filters.retain(|format| capabilities.filters(*format));
        let filterable = filters.len() == textures.maps().len();
        let sampler =
            |binding: &Binding| textures::sampler(device, *binding, filterable, textures.is_reversed());
        Self { samplers: description.bindings.iter().map(sampler).collect(), filterable, filters }
    }
}

impl ShadowMap {
    /// Entries of a bind group layout of the user's own, from `@binding(first)` on, where
    /// [`bind_group_entries`](Self::bind_group_entries) go and [`wgsl_at`](Self::wgsl_at) looks: so that several maps, or a
    /// map and other things, share one of the four groups that WebGPU has. Any stage may look shadows up.
    #[must_use]
    pub fn layout_entries(&self, first: u32, visibility: ShaderStages) -> Vec<BindGroupLayoutEntry> {
        let entry = |(binding, (ty, _))| BindGroupLayoutEntry { binding, visibility, ty, count: None };
        (first..).zip(self.resources()).map(entry).collect()
    }

    /// What [`layout_entries`](Self::layout_entries) describe. Stays the same for the life of the map.
    #[must_use]
    pub fn bind_group_entries(&self, first: u32) -> Vec<BindGroupEntry<'_>> {
        let entry = |(binding, (_, resource))| BindGroupEntry { binding, resource };
        (first..).zip(self.resources()).map(entry).collect()
    }

    fn resources(&self) -> Vec<(BindingType, BindingResource<'_>)> {
        let Self { composition, textures, uniforms, samplers, cast, .. } = self;
        samplers.resources(&composition.description, textures, uniforms, cast.as_ref())
    }
}

impl Samplers {
    /// Layout and bind group with all that receivers bind from 0 on.
    pub(super) fn group(
        device: &wgpu::Device,
        resources: Vec<(BindingType, BindingResource<'_>)>,
    ) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
        let visibility = ShaderStages::FRAGMENT | ShaderStages::COMPUTE;
        let (layout, entries): (Vec<_>, Vec<_>) = (0..)
            .zip(resources)
            .map(|(binding, (ty, resource))| {
                let layout = BindGroupLayoutEntry { binding, visibility, ty, count: None };
                (layout, BindGroupEntry { binding, resource })
            })
            .unzip();
        let label = Some("shadow map");
        let layout =
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label, entries: &layout });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label,
            layout: &layout,
            entries: &entries,
        });
        (layout, group)
    }

    /// The receivers' uniforms, what the technique names, and what casters leave beside.
    pub(super) fn resources<'a>(
        &'a self,
        description: &Description,
        textures: &'a Textures,
        uniforms: &'a Uniforms,
        cast: &'a dyn Cast,
    ) -> Vec<(BindingType, BindingResource<'a>)> {
        let buffer = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let named = description.bindings.iter().zip(&self.samplers);
        let named = named.map(|(binding, sampler)| self.resource(*binding, sampler, textures));
        std::iter::once((buffer, uniforms.receiver())).chain(named).chain(cast.bindings()).collect()
    }

    fn resource<'a>(
        &'a self,
        binding: Binding,
        sampler: &'a wgpu::Sampler,
        textures: &'a Textures,
    ) -> (BindingType, BindingResource<'a>) {
        let texture = |sample_type| BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2Array,
            multisampled: false,
        };
        match binding {
            Binding::Depth => {
                (texture(TextureSampleType::Depth), BindingResource::TextureView(textures.casters_array()))
            }
            Binding::Compare(_) => {
                (BindingType::Sampler(SamplerBindingType::Comparison), BindingResource::Sampler(sampler))
            }
            Binding::Map(m) => {
                let map = &textures.maps()[m];
                let format = map.texture.format();
                let kind = match format.sample_type(None, None) {
                    Some(TextureSampleType::Uint) => TextureSampleType::Uint,
                    _ => TextureSampleType::Float { filterable: self.filters.contains(&format) },
                };
                (texture(kind), BindingResource::TextureView(&map.array))
            }
            Binding::Sampler => {
                let kind = match self.filterable {
                    true => SamplerBindingType::Filtering,
                    false => SamplerBindingType::NonFiltering,
                };
                (BindingType::Sampler(kind), BindingResource::Sampler(sampler))
            }
        }
    }
}
