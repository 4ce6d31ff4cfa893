//! The nearest triangles that touch each texel, for [`Caster::Ranked`]: an atomic maximum for each entry of
//! a texel passes the lesser key on to the next entry, so that all end in order, whatever order they are
//! drawn in.
//!
//! [`Caster::Ranked`]: crate::technique::Caster::Ranked

use super::{
    Probe,
    caster::{self, CasterView, VIEW_BYTES},
    create::{self, ATOMIC, UNIFORM},
    memory::{Lifetime, MemoryItem},
    pipelines::Pipelines,
};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    shader::{self, TrianglePass},
    technique::{Coverage, Ranked, Technique},
};
use std::num::NonZeroU64;
use wgpu::{
    BindGroup, BindGroupLayout, Buffer, BufferUsages, CompareFunction, RenderPass, RenderPipeline,
    ShaderStages, TextureView,
};

/// Bytes of a triangle's corners.
const CORNERS: u64 = 48;

/// What a map has room for.
#[derive(Debug, Clone, Copy)]
pub(super) struct RankedRoom {
    pub(super) size: Size,
    pub(super) views: u32,
    pub(super) keeps: u32,
    pub(super) triangles: u32,
}

impl RankedRoom {
    /// Bytes of the keys of a view.
    fn view_bytes(&self) -> u64 {
        4 * u64::from(self.size.width) * u64::from(self.size.height) * u64::from(self.keeps)
    }

    /// Bytes of all keys.
    pub(super) fn key_bytes(&self) -> u64 {
        self.view_bytes() * u64::from(self.views)
    }

    /// Bytes of all corners.
    pub(super) fn corner_bytes(&self) -> u64 {
        CORNERS * u64::from(self.triangles) * u64::from(self.views)
    }
}

/// Rust side of `RankedPass` in `ranked.wgsl.in`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct RankedPass {
    view: u32,
    keeps: u32,
    triangles: u32,
    bits: u32,
}

/// Pipelines and buffers.
#[derive(Debug)]
pub(super) struct RankedTriangles {
    /// Under the sun, under a spot.
    pipelines: [RenderPipeline; 2],
    room: RankedRoom,
    views: Buffer,
    passes: Buffer,
    stride: u64,
    keys: Buffer,
    /// Of triangles whose corners are kept already, where fragments have to keep them.
    marks: Option<Buffer>,
    corners: Buffer,
    /// Per view.
    groups: Vec<BindGroup>,
}

impl RankedTriangles {
    pub(super) fn new(
        device: &wgpu::Device,
        technique: &dyn Technique,
        room: RankedRoom,
        pipelines: &Pipelines,
    ) -> Self {
        let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
        let stride = VIEW_BYTES.next_multiple_of(alignment);
        let uniforms = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let slots = u64::from(room.views);
        let views = create::buffer(device, "ranked views", slots * stride, uniforms);
        let passes = passes(device, room, stride);
        let keys = create::buffer(device, "ranked triangles", room.key_bytes(), storage);
        let mark_bytes = 4 * u64::from(room.triangles.div_ceil(32));
        let marks = (!Capabilities::of(device).stores_from_vertices())
            .then(|| create::buffer(device, "ranked marks", mark_bytes, storage));
        let corners = create::buffer(device, "ranked corners", room.corner_bytes(), storage);
        let layout = layout(device);
        let slot = |buffer, index: u32, bytes| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer,
                offset: u64::from(index) * stride,
                size: NonZeroU64::new(bytes),
            })
        };
        let group = |view: u32| {
            create::bind(
                device,
                &layout,
                [
                    slot(&views, view, VIEW_BYTES),
                    slot(&passes, view, size_of::<RankedPass>() as u64),
                    keys.as_entire_binding(),
                    corners.as_entire_binding(),
                ]
                .into_iter()
                .chain(marks.as_ref().map(Buffer::as_entire_binding)),
            )
        };
        let compiled = |spot| {
            let pass = TrianglePass::Pulled(Coverage::Touched, spot);
            let shader = shader::triangles(technique, &Capabilities::of(device), None, pass);
            pipelines.caster(&shader, &[], |device| {
                create::compile(device, &shader, CompareFunction::Less, &layout, &[])
            })
        };
        Self {
            groups: (0..room.views).map(group).collect(),
            pipelines: [compiled(false), compiled(true)],
            room,
            views,
            passes,
            stride,
            keys,
            marks,
            corners,
        }
    }

    /// The pipeline that leaves out what the caller's WGSL says.
    pub(super) fn cutout(
        &self,
        device: &wgpu::Device,
        technique: &dyn Technique,
        wgsl: &str,
        user: &[&BindGroupLayout],
    ) -> RenderPipeline {
        let shader = shader::triangles(technique, &Capabilities::of(device), Some(wgsl), TrianglePass::Any);
        create::compile(device, &shader, CompareFunction::Less, &layout(device), user)
    }

    /// The pipeline for a view of this kind.
    pub(super) fn pipeline(&self, view: &View) -> &RenderPipeline {
        &self.pipelines[caster::perspective(view) as usize]
    }

    pub(super) fn write(&self, queue: &wgpu::Queue, views: &[View]) {
        for (i, view) in views.iter().enumerate() {
            let bytes = CasterView::new(view, self.room.size, Coverage::Touched);
            queue.write_buffer(&self.views, i as u64 * self.stride, bytemuck::bytes_of(&bytes));
        }
    }

    /// Draws the casters of a view into its keys; `depth` gets that of the texels' centres.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (index, view): (usize, &View),
        depth: &TextureView,
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&View, &mut RenderPass<'_>),
    ) {
        encoder.clear_buffer(&self.keys, index as u64 * self.room.view_bytes(), Some(self.room.view_bytes()));
        if let Some(marks) = &self.marks {
            encoder.clear_buffer(marks, 0, None);
        }
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow cast"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: probe.pass("cast", index),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(self.pipeline(view));
        pass.set_bind_group(0, &self.groups[index], &[]);
        caster::number_anew();
        draw(view, &mut pass);
    }

    /// One sentence for `explain`.
    pub(super) fn explain(&self) -> String {
        let RankedRoom { keeps, triangles, .. } = self.room;
        format!(
            "{keeps} triangles per texel, of {triangles} different ones in each view; triangles_drawn() tells whether that was enough"
        )
    }

    /// The buffer that a binding names.
    pub(super) fn buffer(&self, ranked: Ranked) -> &Buffer {
        match ranked {
            Ranked::Keys => &self.keys,
            Ranked::Corners => &self.corners,
        }
    }

    pub(super) fn memory(&self) -> Vec<MemoryItem> {
        let texels = MemoryItem::texels("ranked triangles", &self.keys, self.room.size);
        let buffers = [
            ("ranked corners", &self.corners),
            ("ranked views", &self.views),
            ("ranked passes", &self.passes),
        ];
        let marks = self.marks.as_ref().map(|marks| MemoryItem {
            lifetime: Lifetime::Transient,
            ..MemoryItem::buffer("ranked marks", marks)
        });
        let others = buffers.into_iter().map(|(name, buffer)| MemoryItem::buffer(name, buffer));
        [texels].into_iter().chain(others).chain(marks).collect()
    }
}

/// `RankedPass` of every view; never changes.
fn passes(device: &wgpu::Device, room: RankedRoom, stride: u64) -> Buffer {
    let passes = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("ranked passes"),
        size: u64::from(room.views) * stride,
        usage: BufferUsages::UNIFORM,
        mapped_at_creation: true,
    });
    for view in 0..room.views {
        let at = u64::from(view) * stride;
        let bits = Ranked::number_bits(room.triangles);
        let pass = RankedPass { view, keeps: room.keeps, triangles: room.triangles, bits };
        if let Ok(mut bytes) = passes.get_mapped_range_mut(at..at + size_of::<RankedPass>() as u64) {
            bytes.copy_from_slice(bytemuck::bytes_of(&pass));
        }
    }
    passes.unmap();
    passes
}

fn layout(device: &wgpu::Device) -> BindGroupLayout {
    let by_vertices = Capabilities::of(device).stores_from_vertices();
    let fragment = |ty| (ShaderStages::FRAGMENT, ty);
    let both = |ty| (ShaderStages::VERTEX_FRAGMENT, ty);
    let types = [
        both(UNIFORM),
        both(UNIFORM),
        fragment(ATOMIC),
        if by_vertices { both(ATOMIC) } else { fragment(ATOMIC) },
        fragment(ATOMIC),
    ];
    create::layout(device, &types[..if by_vertices { 4 } else { 5 }])
}
