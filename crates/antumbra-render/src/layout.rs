//! What bind groups, full-screen pipelines and attachments have in common.

use crate::Gpu;
use wgpu::{BindGroupLayout, RenderPipeline, TextureFormat};

/// Layout entry of a texture that is loaded, not sampled.
pub(crate) fn loaded(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

/// Layout entry of a buffer that is read.
pub(crate) fn loaded_buffer(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

/// Layout entry of a uniform buffer.
pub(crate) fn uniform(binding: u32) -> wgpu::BindGroupLayoutEntry {
    uniform_entry(binding, Offset::Fixed)
}

/// Whether a bind group's offset into its buffer is given when it is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Offset {
    Fixed,
    Dynamic,
}

/// The same, with an offset that is given when the group is set if asked for.
pub(crate) fn uniform_entry(binding: u32, offset: Offset) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: offset == Offset::Dynamic,
            min_binding_size: None,
        },
        count: None,
    }
}

/// A full-screen pipeline with entry points `vertex` and `fragment`.
pub(crate) fn fullscreen(
    gpu: &Gpu,
    label: &str,
    source: wgpu::ShaderSource<'_>,
    groups: &[&BindGroupLayout],
    format: TextureFormat,
) -> RenderPipeline {
    fullscreen_into(gpu, label, source, groups, &[Some(format.into())])
}

/// The same into several targets, or with blending.
pub(crate) fn fullscreen_into(
    gpu: &Gpu,
    label: &str,
    source: wgpu::ShaderSource<'_>,
    groups: &[&BindGroupLayout],
    targets: &[Option<wgpu::ColorTargetState>],
) -> RenderPipeline {
    let module = gpu.shader(label, source);
    let groups: Vec<_> = groups.iter().map(|g| Some(*g)).collect();
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(label),
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
            targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A cleared colour attachment.
pub(crate) fn overwrite(view: &wgpu::TextureView) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
            store: wgpu::StoreOp::Store,
        },
    }
}
