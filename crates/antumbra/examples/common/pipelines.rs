//! Pipelines of a small renderer.

use super::{COLOR, DEPTH};
use wgpu::{BindGroupLayout, Device, RenderPipeline};

/// A pipeline for [`Mesh`] with these bind groups: with a fragment stage into [`COLOR`], or depth
/// alone; casters should be clamped to the depth range where the device can.
pub fn pipeline(
    device: &Device,
    module: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    vertex: &str,
    fragment: Option<&str>,
) -> RenderPipeline {
    let attributes = wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3];
    pipeline_of(device, module, groups, Stages::of(vertex, fragment), &[&attributes])
}

/// The same for positions in one buffer and texture coordinates in another, with a fragment stage that leaves
/// holes, whether it has a colour or not.
pub fn pipeline_of_uvs(
    device: &Device,
    module: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    fragment: &str,
    colours: bool,
) -> RenderPipeline {
    let positions = wgpu::vertex_attr_array![0 => Float32x3];
    let uvs = wgpu::vertex_attr_array![1 => Float32x2];
    let stages = Stages { vertex: "vertex", fragment: Some(fragment), colours };
    pipeline_of(device, module, groups, stages, &[&positions, &uvs])
}

/// Entry points, and whether there is a colour to write.
pub struct Stages<'a> {
    vertex: &'a str,
    fragment: Option<&'a str>,
    colours: bool,
}

impl<'a> Stages<'a> {
    /// A fragment stage writes a colour; without one there is depth alone.
    pub fn of(vertex: &'a str, fragment: Option<&'a str>) -> Self {
        Self { vertex, fragment, colours: fragment.is_some() }
    }
}

/// The same for any stages, and vertices of such attributes, one list for each buffer.
pub fn pipeline_of(
    device: &Device,
    module: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    stages: Stages<'_>,
    buffers: &[&[wgpu::VertexAttribute]],
) -> RenderPipeline {
    let buffers = buffers.iter().map(|attributes| {
        let array_stride = attributes.iter().map(|attribute| attribute.format.size()).sum();
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    });
    let buffers: Vec<_> = buffers.collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: groups,
        ..Default::default()
    });
    let targets = [Some(COLOR.into())];
    let clamps = device.features().contains(wgpu::Features::DEPTH_CLIP_CONTROL);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(stages.vertex),
            compilation_options: Default::default(),
            buffers: &buffers,
        },
        primitive: wgpu::PrimitiveState { unclipped_depth: clamps && !stages.colours, ..Default::default() },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: stages.fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: if stages.colours { &targets } else { &[] },
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A pipeline for the only entry point of a compute shader.
pub fn compute_pipeline(
    device: &Device,
    source: wgpu::ShaderSource<'_>,
    groups: &[Option<&BindGroupLayout>],
) -> wgpu::ComputePipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: groups,
        ..Default::default()
    });
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: None,
        layout: Some(&layout),
        module: &module,
        entry_point: None,
        compilation_options: Default::default(),
        cache: None,
    })
}
