//! Short ways to make wgpu's objects.

use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingResource, BindingType, Buffer,
    BufferUsages, ShaderStages,
};

pub(super) const UNIFORM: BindingType = BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A uniform of one view, of several in its buffer.
pub(super) const OF_VIEW: BindingType = BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: true,
    min_binding_size: None,
};

/// A storage buffer that is written, or only read.
pub(super) fn storage(read_only: bool) -> BindingType {
    let ty = wgpu::BufferBindingType::Storage { read_only };
    BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None }
}

pub(super) fn buffer(device: &wgpu::Device, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
    device.create_buffer(&descriptor)
}

/// A layout of bindings 0, 1 and so on.
pub(super) fn layout(
    device: &wgpu::Device,
    label: &str,
    types: &[(ShaderStages, BindingType)],
) -> BindGroupLayout {
    let entry = |(binding, (visibility, ty)): (u32, &(ShaderStages, BindingType))| BindGroupLayoutEntry {
        binding,
        visibility: *visibility,
        ty: *ty,
        count: None,
    };
    let entries: Vec<_> = (0..).zip(types).map(entry).collect();
    device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

/// A group of bindings 0, 1 and so on.
pub(super) fn bind<'a>(
    device: &wgpu::Device,
    label: &str,
    layout: &BindGroupLayout,
    resources: impl IntoIterator<Item = BindingResource<'a>>,
) -> BindGroup {
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some(label), layout, entries: &entries })
}

/// A uniform buffer with one value behind the other, and the bytes from one to the next.
pub(super) fn uniforms<T: bytemuck::Pod>(device: &wgpu::Device, label: &str, values: &[T]) -> (Buffer, u64) {
    let stride = stride::<T>(device);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: values.len() as u64 * stride,
        usage: BufferUsages::UNIFORM,
        mapped_at_creation: true,
    });
    for (index, value) in (0..).zip(values) {
        let at = index * stride;
        if let Ok(mut bytes) = buffer.get_mapped_range_mut(at..at + size_of::<T>() as u64) {
            bytes.copy_from_slice(bytemuck::bytes_of(value));
        }
    }
    buffer.unmap();
    (buffer, stride)
}

/// Bytes from one uniform to the next.
pub(super) fn stride<T>(device: &wgpu::Device) -> u64 {
    let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
    (size_of::<T>() as u64).next_multiple_of(alignment)
}

/// Part of a buffer that holds one uniform.
pub(super) fn element<T>(buffer: &Buffer, index: u64, stride: u64) -> BindingResource<'_> {
    BindingResource::Buffer(wgpu::BufferBinding {
        buffer,
        offset: index * stride,
        size: std::num::NonZeroU64::new(size_of::<T>() as u64),
    })
}

pub(super) fn module(device: &wgpu::Device, label: &str, shader: &str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    })
}

pub(super) fn pipeline_layout(
    device: &wgpu::Device,
    label: &str,
    groups: &[&BindGroupLayout],
) -> wgpu::PipelineLayout {
    let groups: Vec<_> = groups.iter().copied().map(Some).collect();
    device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    })
}
