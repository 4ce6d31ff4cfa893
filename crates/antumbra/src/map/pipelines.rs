//! One cache of full-screen pipelines per device.

use crate::pass::{Slot, Step};
use std::{
    collections::HashMap,
    sync::{Arc, Mutex, PoisonError},
};
use wgpu::{BindGroup, BindGroupLayout, RenderPipeline, TextureFormat, TextureView};

type Key = (String, Vec<TextureFormat>);

/// The pipelines of the passes between casting and lighting, each compiled once. Clones share.
#[derive(Debug, Clone)]
pub struct Pipelines {
    device: wgpu::Device,
    depth: BindGroupLayout,
    texture: BindGroupLayout,
    nearest: wgpu::Sampler,
    made: Arc<Mutex<HashMap<Key, RenderPipeline>>>,
}

impl Pipelines {
    /// An empty cache.
    #[must_use]
    pub fn new(device: &wgpu::Device) -> Self {
        use wgpu::{BindingType, SamplerBindingType, TextureSampleType};
        let texture = |sample_type| BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let layout = |label, types: [BindingType; 2]| {
            let entry = |(i, ty)| wgpu::BindGroupLayoutEntry {
                binding: i as u32,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty,
                count: None,
            };
            let entries: Vec<_> = types.into_iter().enumerate().map(entry).collect();
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
                label: Some(label),
                entries: &entries,
            })
        };
        let uniform = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        Self {
            device: device.clone(),
            depth: layout("shadow convert", [texture(TextureSampleType::Depth), uniform]),
            texture: layout(
                "shadow filter",
                [
                    texture(TextureSampleType::Float { filterable: false }),
                    BindingType::Sampler(SamplerBindingType::NonFiltering),
                ],
            ),
            nearest: device.create_sampler(&wgpu::SamplerDescriptor {
                label: Some("shadow nearest"),
                ..Default::default()
            }),
            made: Arc::default(),
        }
    }

    /// Number of pipelines compiled so far.
    #[must_use]
    pub fn len(&self) -> usize {
        self.made.lock().unwrap_or_else(PoisonError::into_inner).len()
    }

    /// Whether nothing was compiled yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    pub(super) fn get(&self, step: &Step, formats: &[TextureFormat]) -> RenderPipeline {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        made.entry((step.shader.clone(), formats.to_vec()))
            .or_insert_with(|| self.compile(step, formats))
            .clone()
    }

    /// A pipeline that someone else compiles, unless it is there.
    pub(super) fn keep(
        &self,
        shader: &str,
        formats: &[TextureFormat],
        compile: impl FnOnce(&wgpu::Device) -> RenderPipeline,
    ) -> RenderPipeline {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        made.entry((shader.to_string(), formats.to_vec())).or_insert_with(|| compile(&self.device)).clone()
    }

    fn compile(&self, step: &Step, formats: &[TextureFormat]) -> RenderPipeline {
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(step.label),
            source: wgpu::ShaderSource::Wgsl(step.shader.as_str().into()),
        });
        let group = match step.source.slot {
            Slot::Casters => &self.depth,
            Slot::Map(_) | Slot::Scratch(_) => &self.texture,
        };
        let layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(step.label),
            bind_group_layouts: &[Some(group)],
            immediate_size: 0,
        });
        let targets: Vec<_> = formats.iter().map(|f| Some(wgpu::ColorTargetState::from(*f))).collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(step.label),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    pub(super) fn bind_depth(&self, source: &TextureView, uniforms: wgpu::BindingResource<'_>) -> BindGroup {
        self.bind(&self.depth, source, uniforms)
    }

    pub(super) fn bind_texture(&self, source: &TextureView) -> BindGroup {
        self.bind(&self.texture, source, wgpu::BindingResource::Sampler(&self.nearest))
    }

    fn bind(
        &self,
        layout: &BindGroupLayout,
        source: &TextureView,
        second: wgpu::BindingResource<'_>,
    ) -> BindGroup {
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow pass"),
            layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(source) },
                wgpu::BindGroupEntry { binding: 1, resource: second },
            ],
        })
    }
}
