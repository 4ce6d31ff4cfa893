//! How steps over texels are compiled and bound.

use crate::{
    pass::{FilterStep, Holder, Work},
    pipelines::{Compiled, Pipeline, Pipelines},
};
use std::sync::PoisonError;
use wgpu::{BindGroup, BindGroupLayout, BindingType, RenderPipeline, TextureFormat, TextureView};

impl Pipelines {
    /// The pipeline of a step whose targets have these formats.
    pub(super) fn get(&self, step: &FilterStep, formats: &[TextureFormat]) -> Pipeline {
        let mut made = self.made.lock().unwrap_or_else(PoisonError::into_inner);
        made.entry((step.shader.clone(), formats.to_vec()))
            .or_insert_with(|| self.compile(step, formats))
            .clone()
    }

    fn compile(&self, step: &FilterStep, formats: &[TextureFormat]) -> Pipeline {
        let module = self.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(step.label),
            source: wgpu::ShaderSource::Wgsl(step.shader.as_str().into()),
        });
        let layout = self.layout(step, formats);
        let pipeline_layout = self.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(step.label),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let run = match step.work {
            Work::Draw => Compiled::Draw(self.draw(step, &module, &pipeline_layout, formats)),
            Work::Lanes(_) => {
                Compiled::Dispatch(self.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label: Some(step.label),
                    layout: Some(&pipeline_layout),
                    module: &module,
                    entry_point: Some("compute"),
                    compilation_options: Default::default(),
                    cache: None,
                }))
            }
        };
        Pipeline { run, layout }
    }

    fn draw(
        &self,
        step: &FilterStep,
        module: &wgpu::ShaderModule,
        layout: &wgpu::PipelineLayout,
        formats: &[TextureFormat],
    ) -> RenderPipeline {
        let targets: Vec<_> = formats.iter().map(|f| Some((*f).into())).collect();
        self.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(step.label),
            layout: Some(layout),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some("vertex"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some("fragment"),
                compilation_options: Default::default(),
                targets: &targets,
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Binding 0 is the source; 1 what steps know of the view, at a dynamic offset; 2 a nearest sampler; 3 a storage target.
    fn layout(&self, step: &FilterStep, formats: &[TextureFormat]) -> BindGroupLayout {
        use wgpu::{SamplerBindingType, TextureSampleType, TextureViewDimension as Dimension};
        let texture = |sample_type, view_dimension| BindingType::Texture {
            sample_type,
            view_dimension,
            multisampled: false,
        };
        let uniform = BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: None,
        };
        let sampler = BindingType::Sampler(SamplerBindingType::NonFiltering);
        let floats = TextureSampleType::Float { filterable: false };
        let (source, sampler) = match (step.source.holder, step.work) {
            (Holder::Casters | Holder::Casts { .. }, _) => {
                (texture(TextureSampleType::Depth, Dimension::D2Array), Some(sampler))
            }
            (_, Work::Draw) => (texture(floats, Dimension::D2Array), Some(sampler)),
            (_, Work::Lanes(_)) => (texture(TextureSampleType::Uint, Dimension::D2Array), None),
        };
        let target = |format: &TextureFormat| BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: *format,
            view_dimension: Dimension::D2,
        };
        let stored = matches!(step.work, Work::Lanes(_)).then(|| formats.first().map(target)).flatten();
        let visibility = match step.work {
            Work::Draw => wgpu::ShaderStages::FRAGMENT,
            Work::Lanes(_) => wgpu::ShaderStages::COMPUTE,
        };
        let entry = |(i, ty): (u32, Option<BindingType>)| {
            ty.map(|ty| wgpu::BindGroupLayoutEntry { binding: i, visibility, ty, count: None })
        };
        let entries: Vec<_> =
            (0..).zip([Some(source), Some(uniform), sampler, stored]).filter_map(entry).collect();
        self.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(step.label),
            entries: &entries,
        })
    }

    /// What a step reads and stores; `uniforms` are those of all views.
    pub(super) fn bind(
        &self,
        pipeline: &Pipeline,
        step: &FilterStep,
        [source, target]: [&TextureView; 2],
        uniforms: wgpu::BindingResource<'_>,
    ) -> BindGroup {
        use wgpu::{BindGroupEntry, BindingResource};
        let sampler = match (step.source.holder, step.work) {
            (Holder::Map(_) | Holder::Scratch(_), Work::Lanes(_)) => None,
            _ => Some(BindingResource::Sampler(&self.nearest)),
        };
        let stored = matches!(step.work, Work::Lanes(_)).then_some(BindingResource::TextureView(target));
        let resources = [Some(BindingResource::TextureView(source)), Some(uniforms), sampler, stored];
        let entries: Vec<_> = (0..)
            .zip(resources)
            .filter_map(|(binding, resource)| Some(BindGroupEntry { binding, resource: resource? }))
            .collect();
        self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("shadow pass"),
            layout: &pipeline.layout,
            entries: &entries,
        })
    }
}
