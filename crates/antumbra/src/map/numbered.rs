//! What casters that number triangles have in common: pipelines, views, passes.

use super::{
    CasterPass, DEPTH_FORMAT, Probe,
    cast::MeshPipeline,
    caster::{self, CasterView, VIEW_BYTES},
    pipelines::Pipelines,
};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    shader::{self, Composition, Cutout, TrianglePass, split::Splits},
    technique::Coverage,
};
use std::num::NonZeroU64;
use wgpu::{
    BindGroup, BindGroupEntry, BindGroupLayout, BindGroupLayoutEntry, BindingResource, BindingType, Buffer,
    BufferUsages, CompareFunction, RenderPipeline, ShaderStages, TextureView,
};

/// Pipelines that draw all texels that triangles touch, and the views that they draw.
#[derive(Debug)]
pub(super) struct Numbered {
    /// Under the sun, under a spot.
    pipelines: [RenderPipeline; 2],
    /// Of group 0.
    layout: BindGroupLayout,
    /// How they compare depth; they write it unless that is `Always`.
    depth: CompareFunction,
    size: Size,
    views: Buffer,
    stride: u64,
    splits: Splits,
}

impl Numbered {
    pub(super) fn new(
        device: &wgpu::Device,
        composition: &Composition,
        (size, views): (Size, u32),
        depth: CompareFunction,
        (layout, splits): (BindGroupLayout, Splits),
        pipelines: &Pipelines,
    ) -> Self {
        let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
        let stride = VIEW_BYTES.next_multiple_of(alignment);
        let uniforms = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let compiled = |spot| {
            let pass = TrianglePass::Pulled(Coverage::Touched, spot);
            let shader = shader::triangles(composition, &Capabilities::of(device), None, pass, &splits);
            pipelines.caster(&shader, &[], |device| compile(device, &shader, depth, &layout, &[]))
        };
        Self {
            pipelines: [compiled(false), compiled(true)],
            depth,
            size,
            views: buffer(device, "caster views", u64::from(views) * stride, uniforms),
            stride,
            layout,
            splits,
        }
    }

    /// The pipeline that leaves out what the caller's WGSL says.
    pub(super) fn cutout(
        &self,
        device: &wgpu::Device,
        composition: &Composition,
        cutout: Cutout<'_>,
        user: &[&BindGroupLayout],
    ) -> RenderPipeline {
        let (device_can, pass) = (Capabilities::of(device), TrianglePass::Any);
        let shader = shader::triangles(composition, &device_can, Some(cutout), pass, &self.splits);
        compile(device, &shader, self.depth, &self.layout, user)
    }

    pub(super) fn write(&self, queue: &wgpu::Queue, views: &[View]) {
        for (i, view) in views.iter().enumerate() {
            let bytes = CasterView::new(view, self.size, Coverage::Touched);
            queue.write_buffer(&self.views, i as u64 * self.stride, bytemuck::bytes_of(&bytes));
        }
    }

    /// How the arrays of group 0 are split.
    pub(super) fn splits(&self) -> Splits {
        self.splits
    }

    /// Of group 0.
    pub(super) fn layout(&self) -> &BindGroupLayout {
        &self.layout
    }

    /// Those of all views.
    pub(super) fn views(&self) -> &Buffer {
        &self.views
    }

    /// What a view binds of them.
    pub(super) fn view(&self, view: u32) -> BindingResource<'_> {
        self.slot(&self.views, view, VIEW_BYTES)
    }

    /// A part of a buffer that [`passes`](Self::passes) made, or of the views.
    pub(super) fn slot<'a>(&self, buffer: &'a Buffer, index: u32, bytes: u64) -> BindingResource<'a> {
        BindingResource::Buffer(wgpu::BufferBinding {
            buffer,
            offset: u64::from(index) * self.stride,
            size: NonZeroU64::new(bytes),
        })
    }

    /// Uniforms of passes, which never change.
    pub(super) fn passes<T: bytemuck::Pod>(
        &self,
        device: &wgpu::Device,
        label: &str,
        passes: &[T],
    ) -> Buffer {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: passes.len() as u64 * self.stride,
            usage: BufferUsages::UNIFORM,
            mapped_at_creation: true,
        });
        for (slot, pass) in (0..).zip(passes) {
            let at = slot * self.stride;
            if let Ok(mut bytes) = buffer.get_mapped_range_mut(at..at + size_of::<T>() as u64) {
                bytes.copy_from_slice(bytemuck::bytes_of(pass));
            }
        }
        buffer.unmap();
        buffer
    }

    /// Draws the casters of a view with a group 0; `depth` is kept if it is written.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (index, view): (usize, &View),
        group: &BindGroup,
        depth: &TextureView,
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&mut CasterPass<'_>),
    ) {
        let writes = self.depth != CompareFunction::Always;
        let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow cast"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: if writes { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard },
                }),
                stencil_ops: None,
            }),
            timestamp_writes: probe.pass("cast", index),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        let pipeline = &self.pipelines[caster::perspective(view) as usize];
        let meshes = MeshPipeline { pipeline, group, indexed: false };
        draw(&mut CasterPass::new(pass, (index, view), Some(meshes)));
    }
}

pub(super) fn buffer(device: &wgpu::Device, label: &str, size: u64, usage: BufferUsages) -> Buffer {
    let descriptor = wgpu::BufferDescriptor { label: Some(label), size, usage, mapped_at_creation: false };
    device.create_buffer(&descriptor)
}

pub(super) fn bind<'a>(
    device: &wgpu::Device,
    layout: &BindGroupLayout,
    resources: impl IntoIterator<Item = BindingResource<'a>>,
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

fn compile(
    device: &wgpu::Device,
    shader: &str,
    depth: CompareFunction,
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
            depth_write_enabled: Some(depth != CompareFunction::Always),
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
