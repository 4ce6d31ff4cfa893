//! What passes that leave triangles in buffers have in common: short ways to create them.

use super::{DEPTH_FORMAT, caster};
use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingType, Buffer, BufferUsages,
    RenderPipeline, ShaderStages,
};

pub(super) fn buffer(device: &wgpu::Device, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
    device.create_buffer(&descriptor)
}

pub(super) fn bind<'a>(
    device: &wgpu::Device,
    layout: &BindGroupLayout,
    resources: impl IntoIterator<Item = wgpu::BindingResource<'a>>,
) -> BindGroup {
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("numbered triangles"),
        layout,
        entries: &entries,
    })
}

pub(super) const UNIFORM: BindingType = BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

pub(super) const ATOMIC: BindingType = BindingType::Buffer {
    ty: wgpu::BufferBindingType::Storage { read_only: false },
    has_dynamic_offset: false,
    min_binding_size: None,
};

pub(super) fn layout(device: &wgpu::Device, types: &[(ShaderStages, BindingType)]) -> BindGroupLayout {
    let entries: Vec<BindGroupLayoutEntry> = (0..)
        .zip(types)
        .map(|(binding, (visibility, ty))| BindGroupLayoutEntry {
            binding,
            visibility: *visibility,
            ty: *ty,
            count: None,
        })
        .collect();
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("numbered triangles"), entries: &entries };
    device.create_bind_group_layout(&descriptor)
}

pub(super) fn module(device: &wgpu::Device, shader: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("numbered triangles"),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    })
}

pub(super) fn pipeline_layout(
    device: &wgpu::Device,
    groups: &[Option<&BindGroupLayout>],
) -> wgpu::PipelineLayout {
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("numbered triangles"),
        bind_group_layouts: groups,
        immediate_size: 0,
    })
}

/// A pipeline that draws triangles; it writes depth unless that compares as `Always`.
pub(super) fn compile(
    device: &wgpu::Device,
    shader: &str,
    depth: wgpu::CompareFunction,
    own: &BindGroupLayout,
    user: &[&BindGroupLayout],
) -> RenderPipeline {
    let module = module(device, shader);
    let mesh = caster::mesh_layout(device);
    let groups: Vec<_> = [own, &mesh].into_iter().chain(user.iter().copied()).map(Some).collect();
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("numbered triangles"),
        layout: Some(&pipeline_layout(device, &groups)),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(depth != wgpu::CompareFunction::Always),
            depth_compare: Some(depth),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}
