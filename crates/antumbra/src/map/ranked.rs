//! The first triangles that touch each texel, for [`Caster::Ranked`]: an atomic maximum for each entry of
//! a texel passes the lesser key on to the next entry, so that all end in order, whatever order
//! fragments come in.
//!
//! [`Caster::Ranked`]: crate::technique::Caster::Ranked

use super::{
    Capacity, Probe,
    memory::{Lifetime, MemoryItem},
    numbered::{self, ATOMIC, Numbered, UNIFORM},
    pipelines::Pipelines,
};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    technique::{Ranked, Technique},
};
use wgpu::{
    BindGroup, BindGroupLayout, Buffer, BufferUsages, CompareFunction, RenderPass, ShaderStages, TextureView,
};

/// Bytes of a triangle's corners.
const CORNERS: u64 = 48;

/// How large a map is.
#[derive(Debug, Clone, Copy)]
pub(super) struct RankedSize {
    pub(super) size: Size,
    pub(super) views: u32,
    pub(super) keeps: u32,
    pub(super) capacity: Capacity,
}

impl RankedSize {
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
        CORNERS * u64::from(self.capacity.triangles) * u64::from(self.views)
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
    numbered: Numbered,
    extent: RankedSize,
    passes: Buffer,
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
        extent: RankedSize,
        pipelines: &Pipelines,
    ) -> Self {
        let RankedSize { size, views, keeps, capacity } = extent;
        let numbered =
            Numbered::new(device, technique, (size, views), CompareFunction::Less, layout(device), pipelines);
        let (triangles, bits) = (capacity.triangles, capacity.id_bits());
        let all: Vec<_> = (0..views).map(|view| RankedPass { view, keeps, triangles, bits }).collect();
        let passes = numbered.passes(device, "ranked passes", &all);
        let storage = |label, bytes| {
            let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
            numbered::buffer(device, label, bytes, usage)
        };
        let keys = storage("ranked triangles", extent.key_bytes());
        let marks = (!Capabilities::of(device).stores_from_vertices())
            .then(|| storage("ranked marks", 4 * u64::from(triangles.div_ceil(32))));
        let corners = storage("ranked corners", extent.corner_bytes());
        let group = |view: u32| {
            let own = [
                numbered.view(view),
                numbered.slot(&passes, view, size_of::<RankedPass>() as u64),
                keys.as_entire_binding(),
                corners.as_entire_binding(),
            ];
            let marks = marks.as_ref().map(Buffer::as_entire_binding);
            numbered::bind(device, numbered.layout(), own.into_iter().chain(marks))
        };
        let groups = (0..views).map(group).collect();
        Self { numbered, extent, passes, keys, marks, corners, groups }
    }

    /// Pipelines and views.
    pub(super) fn numbered(&self) -> &Numbered {
        &self.numbered
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
        encoder.clear_buffer(
            &self.keys,
            index as u64 * self.extent.view_bytes(),
            Some(self.extent.view_bytes()),
        );
        if let Some(marks) = &self.marks {
            encoder.clear_buffer(marks, 0, None);
        }
        self.numbered.draw(encoder, (index, view), &self.groups[index], depth, probe, draw);
    }

    /// One sentence for `explain`.
    pub(super) fn explain(&self) -> String {
        let RankedSize { keeps, capacity: Capacity { triangles, .. }, .. } = self.extent;
        format!(
            "{keeps} triangles per texel, of {triangles} different ones in each view; triangles_drawn() tells whether that was enough, Options::capacity sets it"
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
        let texels = MemoryItem::texels("ranked triangles", &self.keys, self.extent.size);
        let buffers = [
            ("ranked corners", &self.corners),
            ("ranked views", self.numbered.views()),
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

fn layout(device: &wgpu::Device) -> BindGroupLayout {
    let by_vertices = Capabilities::of(device).stores_from_vertices();
    let fragment = |ty| (ShaderStages::FRAGMENT, ty);
    let both = |ty| (ShaderStages::VERTEX_FRAGMENT, ty);
    let types = [
        both(UNIFORM),
        both(UNIFORM),
        fragment(ATOMIC),
        (if by_vertices { ShaderStages::VERTEX } else { ShaderStages::FRAGMENT }, ATOMIC),
        fragment(ATOMIC),
    ];
    numbered::layout(device, &types[..if by_vertices { 4 } else { 5 }])
}
