//! The first triangles that touch each texel, for [`Caster::Ranked`]: an atomic maximum for each entry of
//! a texel passes the lesser key on to the next entry, so that all end in order, whatever order
//! fragments come in.
//!
//! [`Caster::Ranked`]: crate::technique::Caster::Ranked

use super::{
    Capacity, CasterPass, Probe,
    memory::{Lifetime, MemoryItem},
    numbered::{self, ATOMIC, Numbered, UNIFORM},
    pieces::Pieces,
    pipelines::Pipelines,
};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    shader::{
        Composition,
        split::{Split, Splits},
    },
    technique::Ranked,
};
use wgpu::{BindGroup, BindGroupLayout, Buffer, BufferUsages, CompareFunction, ShaderStages, TextureView};

/// Bytes of a key.
const KEY: u64 = 4;
/// Bytes of a triangle's corners.
const CORNERS: u64 = 48;

/// How large a map is.
#[derive(Debug, Clone, Copy)]
pub(super) struct RankedSize {
    pub(super) size: Size,
    pub(super) views: u32,
    pub(super) keeps: u32,
    pub(super) capacity: Capacity,
    /// Whether triangles have records.
    pub(super) cutouts: bool,
}

impl RankedSize {
    /// Keys of a view.
    fn view_keys(&self) -> u64 {
        u64::from(self.size.width) * u64::from(self.size.height) * u64::from(self.keeps)
    }

    /// How keys and corners are split.
    pub(super) fn splits(&self, limits: &wgpu::Limits) -> Splits {
        let max = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let views = u64::from(self.views);
        // As many records follow.
        let each = 1 + u64::from(self.cutouts);
        Splits {
            keys: Split::new(self.view_keys() * views, KEY, max),
            corners: Split::new(each * u64::from(self.capacity.triangles) * views, CORNERS, max),
            ..Splits::default()
        }
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
    keys: Pieces,
    /// Of triangles whose corners are kept already, where fragments have to keep them.
    marks: Option<Buffer>,
    corners: Pieces,
    /// Per view.
    groups: Vec<BindGroup>,
}

impl RankedTriangles {
    pub(super) fn new(
        device: &wgpu::Device,
        composition: &Composition,
        extent: RankedSize,
        pipelines: &Pipelines,
    ) -> Self {
        let RankedSize { size, views, keeps, capacity, .. } = extent;
        let splits = extent.splits(&device.limits());
        let layout = (layout(device, splits), splits);
        let numbered =
            Numbered::new(device, composition, (size, views), CompareFunction::Less, layout, pipelines);
        let (triangles, bits) = (capacity.triangles, capacity.id_bits());
        let all: Vec<_> = (0..views).map(|view| RankedPass { view, keeps, triangles, bits }).collect();
        let passes = numbered.passes(device, "ranked passes", &all);
        let keys = Pieces::new(device, "ranked triangles", splits.keys, KEY);
        let corners = Pieces::new(device, "ranked corners", splits.corners, CORNERS);
        let marks = (!Capabilities::of(device).stores_from_vertices()).then(|| {
            let bytes = 4 * u64::from(triangles.div_ceil(32));
            let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST;
            numbered::buffer(device, "ranked marks", bytes, usage)
        });
        let group = |view: u32| {
            let own = [numbered.view(view), numbered.slot(&passes, view, size_of::<RankedPass>() as u64)];
            let marks = marks.as_ref().map(Buffer::as_entire_binding);
            let all = own.into_iter().chain(keys.bindings()).chain(corners.bindings()).chain(marks);
            numbered::bind(device, numbered.layout(), all)
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
        draw: &mut impl FnMut(&mut CasterPass<'_>),
    ) {
        let (view_keys, index_of) = (self.extent.view_keys(), index as u64);
        self.keys.clear(encoder, index_of * view_keys..(index_of + 1) * view_keys);
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

    /// How its arrays are split.
    pub(super) fn splits(&self) -> Splits {
        self.numbered.splits()
    }

    /// The buffers that a binding names.
    pub(super) fn buffers(&self, ranked: Ranked) -> &Pieces {
        match ranked {
            Ranked::Keys => &self.keys,
            Ranked::Corners => &self.corners,
        }
    }

    pub(super) fn memory(&self) -> Vec<MemoryItem> {
        let texels = self.keys.memory("ranked triangles").texels(self.extent.size);
        let corners = self.corners.memory("ranked corners");
        let buffers = [("ranked views", self.numbered.views()), ("ranked passes", &self.passes)];
        let marks = self.marks.as_ref().map(|marks| MemoryItem {
            lifetime: Lifetime::Transient,
            ..MemoryItem::buffer("ranked marks", marks)
        });
        let others = buffers.into_iter().map(|(name, buffer)| MemoryItem::buffer(name, buffer));
        [texels, corners].into_iter().chain(others).chain(marks).collect()
    }
}

fn layout(device: &wgpu::Device, splits: Splits) -> BindGroupLayout {
    let by_vertices = Capabilities::of(device).stores_from_vertices();
    let keeping = if by_vertices { ShaderStages::VERTEX } else { ShaderStages::FRAGMENT };
    let views = [(ShaderStages::VERTEX_FRAGMENT, UNIFORM); 2];
    let keys = (0..splits.keys.count()).map(|_| (ShaderStages::FRAGMENT, ATOMIC));
    let corners = (0..splits.corners.count()).map(|_| (keeping, ATOMIC));
    let marks = (!by_vertices).then_some((ShaderStages::FRAGMENT, ATOMIC));
    let all: Vec<_> = views.into_iter().chain(keys).chain(corners).chain(marks).collect();
    numbered::layout(device, &all)
}
