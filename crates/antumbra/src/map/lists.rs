//! Lists of the triangles that touch each texel, for [`Caster::Lists`]: drawn once to count them, given
//! room, drawn again to fill it.
//!
//! [`Caster::Lists`]: crate::technique::Caster::Lists

use super::{
    Probe,
    caster::{self, CasterView, VIEW_BYTES},
    create::{self, ATOMIC, UNIFORM},
    draw,
    memory::{Lifetime, MemoryItem},
    pipelines::Pipelines,
};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    shader::{self, TrianglePass},
    technique::{Coverage, List, Technique},
};
use std::num::NonZeroU64;
use wgpu::{
    BindGroup, BindGroupLayout, BindingType, Buffer, BufferUsages, CompareFunction, ComputePipeline,
    RenderPass, RenderPipeline, ShaderStages, Texture, TextureFormat, TextureView,
};

/// Texels across and, at most, down of textures that are arrays, as in `lists.wgsl.in` and `exact.wgsl`.
pub(super) const ROW: u32 = 2048;
/// Texels of an invocation of `scan.wgsl`.
const SEGMENT: u32 = 128;
/// Invocations of its workgroups.
const WORKGROUP: u32 = 64;
/// Bytes of `ListTotals`.
const TOTALS: u64 = 8;

/// What a map has room for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Room {
    pub(super) size: Size,
    pub(super) views: u32,
    pub(super) per_texel: u32,
    pub(super) triangles: u32,
}

impl Room {
    /// Rows of the textures of corners.
    pub(super) fn rows(&self) -> u32 {
        self.triangles.div_ceil(ROW)
    }

    /// Bytes of the count of every texel.
    pub(super) fn count_bytes(&self) -> u64 {
        4 * u64::from(self.size.width) * u64::from(self.size.height)
    }

    /// Entries of a view.
    fn entries(&self) -> u32 {
        (self.count_bytes() / 4 * u64::from(self.per_texel)).min(u64::from(u32::MAX)) as u32
    }

    /// Layers of a view's numbers.
    pub(super) fn number_layers(&self) -> u32 {
        self.entries().div_ceil(ROW * ROW)
    }
}

/// Rust side of `ListPass` in `lists.wgsl.in` and `scan.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ListPass {
    view: u32,
    fills: u32,
    entries: u32,
    triangles: u32,
}

/// Pipelines, buffers and textures of the lists.
#[derive(Debug)]
pub(super) struct Lists {
    /// Under the sun, under a spot.
    pipelines: [RenderPipeline; 2],
    scan: ComputePipeline,
    room: Room,
    views: Buffer,
    passes: Buffer,
    stride: u64,
    counts: Buffer,
    marks: Buffer,
    totals: Buffer,
    /// In the order of [`List`], each with a view of all of it.
    textures: [(Texture, TextureView); 3],
    /// Per view: to count, to fill.
    draws: Vec<[BindGroup; 2]>,
    /// Per view.
    scans: Vec<BindGroup>,
}

impl Lists {
    pub(super) fn new(
        device: &wgpu::Device,
        technique: &dyn Technique,
        room: Room,
        pipelines: &Pipelines,
    ) -> Self {
        let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
        let stride = VIEW_BYTES.next_multiple_of(alignment);
        let uniforms = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let storage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let slots = u64::from(room.views);
        let views = create::buffer(device, "list views", slots * stride, uniforms);
        let passes = passes(device, room, stride);
        let counts = create::buffer(device, "list counts", room.count_bytes(), storage);
        let marks = create::buffer(device, "list marks", 4 * u64::from(room.triangles.div_ceil(32)), storage);
        let totals = create::buffer(device, "list totals", TOTALS * slots, storage);
        let Size { width, height } = room.size;
        let layers = [2, room.number_layers(), 3];
        let rows = room.entries().div_ceil(ROW).min(ROW);
        let texture = |i: usize, label, width, height, format| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: layers[i] * room.views },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            let view = part(&texture, 0, layers[i] * room.views);
            (texture, view)
        };
        let textures = [
            texture(0, "list ranges", width, height, TextureFormat::R32Uint),
            texture(1, "list numbers", ROW, rows, TextureFormat::R32Uint),
            texture(2, "list corners", ROW, room.rows(), TextureFormat::Rgba32Float),
        ];
        let (draw_layout, scan_layout) = (draw_layout(device), scan_layout(device));
        let slot = |buffer, index: u32, bytes| {
            wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                buffer,
                offset: u64::from(index) * stride,
                size: NonZeroU64::new(bytes),
            })
        };
        let pass = |view: u32, fills: u32| slot(&passes, 2 * view + fills, size_of::<ListPass>() as u64);
        let of_view = |i: usize, view: u32| part(&textures[i].0, view * layers[i], layers[i]);
        let draw = |view: u32, fills: u32| {
            let (numbers, corners) = (of_view(1, view), of_view(2, view));
            create::bind(
                device,
                &draw_layout,
                [
                    slot(&views, view, VIEW_BYTES),
                    pass(view, fills),
                    counts.as_entire_binding(),
                    marks.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&numbers),
                    wgpu::BindingResource::TextureView(&corners),
                ],
            )
        };
        let scan = |view: u32| {
            let ranges = of_view(0, view);
            create::bind(
                device,
                &scan_layout,
                [
                    pass(view, 0),
                    counts.as_entire_binding(),
                    totals.as_entire_binding(),
                    wgpu::BindingResource::TextureView(&ranges),
                ],
            )
        };
        let compiled = |spot| {
            let shader = shader::triangles(
                technique,
                &Capabilities::of(device),
                None,
                TrianglePass::Pulled(Coverage::Touched, spot),
            );
            pipelines.caster(&shader, &[], |device| {
                create::compile(device, &shader, CompareFunction::Always, &draw_layout, &[])
            })
        };
        Self {
            draws: (0..room.views).map(|view| [draw(view, 0), draw(view, 1)]).collect(),
            scans: (0..room.views).map(scan).collect(),
            pipelines: [compiled(false), compiled(true)],
            scan: compile_scan(device, &scan_layout),
            room,
            views,
            passes,
            stride,
            counts,
            marks,
            totals,
            textures,
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
        create::compile(device, &shader, CompareFunction::Always, &draw_layout(device), user)
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

    /// Counts, gives room, fills. `depth` is a target that the passes need and leave alone.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (index, view): (usize, &View),
        depth: &TextureView,
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&View, &mut RenderPass<'_>),
    ) {
        encoder.clear_buffer(&self.counts, 0, None);
        encoder.clear_buffer(&self.marks, 0, None);
        encoder.clear_buffer(&self.totals, index as u64 * TOTALS, Some(TOTALS));
        for fills in 0..2 {
            if fills == 1 {
                let timestamps = probe.pass("scan", index);
                let mut pass = draw::compute_pass(encoder, "scan", timestamps);
                pass.set_pipeline(&self.scan);
                pass.set_bind_group(0, &self.scans[index], &[]);
                let texels = (self.room.count_bytes() / 4) as u32;
                pass.dispatch_workgroups(texels.div_ceil(SEGMENT * WORKGROUP), 1, 1);
            }
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shadow cast"),
                color_attachments: &[],
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: depth,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(1.0),
                        store: wgpu::StoreOp::Discard,
                    }),
                    stencil_ops: None,
                }),
                timestamp_writes: probe.pass("cast", index),
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(self.pipeline(view));
            pass.set_bind_group(0, &self.draws[index][fills], &[]);
            caster::number_anew();
            draw(view, &mut pass);
        }
    }

    /// The texture that a binding names.
    pub(super) fn texture(&self, list: List) -> (&TextureView, TextureFormat) {
        let (texture, view) = &self.textures[list as usize];
        (view, texture.format())
    }

    /// What [`ShadowMap::list_totals`](super::ShadowMap::list_totals) promises.
    pub(super) fn totals(&self) -> &Buffer {
        &self.totals
    }

    pub(super) fn memory(&self) -> Vec<MemoryItem> {
        let texture = |(name, (texture, _)): (&str, &(Texture, TextureView))| {
            MemoryItem::texture(name, texture, Lifetime::Kept)
        };
        let buffer = |(name, buffer, lifetime): (&str, &Buffer, Lifetime)| MemoryItem {
            lifetime,
            ..MemoryItem::buffer(name, buffer)
        };
        let buffers = [
            ("list counts", &self.counts, Lifetime::Transient),
            ("list marks", &self.marks, Lifetime::Transient),
            ("list totals", &self.totals, Lifetime::Kept),
            ("list views", &self.views, Lifetime::Kept),
            ("list passes", &self.passes, Lifetime::Kept),
        ];
        let names = ["list ranges", "list numbers", "list corners"];
        names.into_iter().zip(&self.textures).map(texture).chain(buffers.into_iter().map(buffer)).collect()
    }

    /// One sentence for `explain`.
    pub(super) fn explain(&self) -> String {
        format!(
            "lists of {} triangles, {} per texel, of {} different ones in each view; list_totals() and triangles_drawn() tell whether that was enough",
            self.room.entries(),
            self.room.per_texel,
            self.room.triangles
        )
    }
}

/// `ListPass` of every view, to count and to fill; never changes.
fn passes(device: &wgpu::Device, room: Room, stride: u64) -> Buffer {
    let slots = 2 * room.views;
    let passes = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("list passes"),
        size: u64::from(slots) * stride,
        usage: BufferUsages::UNIFORM,
        mapped_at_creation: true,
    });
    for slot in 0..slots {
        let at = u64::from(slot) * stride;
        let pass =
            ListPass { view: slot / 2, fills: slot % 2, entries: room.entries(), triangles: room.triangles };
        if let Ok(mut bytes) = passes.get_mapped_range_mut(at..at + size_of::<ListPass>() as u64) {
            bytes.copy_from_slice(bytemuck::bytes_of(&pass));
        }
    }
    passes.unmap();
    passes
}

/// Some layers of a texture.
fn part(texture: &Texture, base_array_layer: u32, layers: u32) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_array_layer,
        array_layer_count: Some(layers),
        ..Default::default()
    })
}

fn stored(format: TextureFormat) -> BindingType {
    BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format,
        view_dimension: wgpu::TextureViewDimension::D2Array,
    }
}

fn draw_layout(device: &wgpu::Device) -> BindGroupLayout {
    let fragment = |ty| (ShaderStages::FRAGMENT, ty);
    create::layout(
        device,
        &[
            (ShaderStages::VERTEX_FRAGMENT, UNIFORM),
            fragment(UNIFORM),
            fragment(ATOMIC),
            fragment(ATOMIC),
            fragment(stored(TextureFormat::R32Uint)),
            fragment(stored(TextureFormat::Rgba32Float)),
        ],
    )
}

fn scan_layout(device: &wgpu::Device) -> BindGroupLayout {
    let all = [UNIFORM, ATOMIC, ATOMIC, stored(TextureFormat::R32Uint)];
    create::layout(device, &all.map(|ty| (ShaderStages::COMPUTE, ty)))
}

fn compile_scan(device: &wgpu::Device, layout: &BindGroupLayout) -> ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("scan"),
        layout: Some(&create::pipeline_layout(device, &[Some(layout)])),
        module: &create::module(device, shader::SCAN),
        entry_point: Some("compute"),
        compilation_options: Default::default(),
        cache: None,
    })
}
