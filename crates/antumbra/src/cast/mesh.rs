//! Meshes that cast shadows where techniques keep triangles.

use super::pipeline::mesh_layout;
use crate::error::MeshError;
use glam::Mat4;
use std::{
    num::NonZeroU64,
    ops::{Bound, Range, RangeBounds},
};
use wgpu::{BindGroup, Buffer, BufferUsages, RenderPass};

/// Most triangles in one draw. Software drivers keep the vertices of a draw, which should fit their
/// caches, and treat all of them as clipped if one is.
const DRAWN_TOGETHER: u32 = 2048;
/// Bytes of a vertex and of the indices of a triangle.
const BYTES: u64 = 12;

/// Triangles that cast shadows for a technique whose storage is not [`CasterStorage::Depth`]: positions and
/// indices that the library's vertex shader reads from storage buffers, so that it sees whole
/// triangles. [`CasterPass::draw_mesh`](crate::CasterPass::draw_mesh) draws them.
///
/// [`CasterStorage::Depth`]: crate::technique::CasterStorage::Depth
#[derive(Debug)]
pub struct CasterMesh {
    place: Buffer,
    indices: Buffer,
    windows: Vec<Window>,
    triangles: Range<u32>,
}

/// Some triangles of a mesh and all vertices that they use, for [`CasterMesh::in_parts`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct MeshPart {
    /// Counted from the first index.
    pub triangles: Range<u32>,
    /// Counted from the first position.
    pub vertices: Range<u32>,
}

/// What is bound at a time.
#[derive(Debug)]
struct Window {
    group: BindGroup,
    triangles: Range<u32>,
}

impl CasterMesh {
    /// Of two buffers with usage `STORAGE`: `positions`, three `f32` each, tightly packed (a vertex
    /// buffer of stride 12), at most as large as a storage binding of the device (`WebGPU` promises
    /// 128 MiB: 11 million vertices; see [`in_parts`](Self::in_parts)); `indices`, with usage `INDEX` too,
    /// `u32`, three per triangle, of which the triangles of the range are drawn. Either winding. Indices must
    /// be in range: what lies beyond a buffer is unspecified.
    ///
    /// # Errors
    /// [`MeshError`]: usage, size against the device's limits, a range beyond the indices.
    pub fn new(
        device: &wgpu::Device,
        positions: &Buffer,
        indices: &Buffer,
        triangles: Range<u32>,
        world_from_object: Mat4,
    ) -> Result<Self, MeshError> {
        let part = MeshPart { triangles, vertices: 0..vertices_of(positions) };
        Self::in_parts(device, positions, indices, &[part], world_from_object)
    }

    /// The same for positions that are larger than a storage binding of the device: each part takes the
    /// vertices that its triangles use, at most as many as a binding holds. Indices count from the first
    /// position all the same.
    ///
    /// # Errors
    /// As [`new`](Self::new), for each part; no part at all.
    pub fn in_parts(
        device: &wgpu::Device,
        positions: &Buffer,
        indices: &Buffer,
        parts: &[MeshPart],
        world_from_object: Mat4,
    ) -> Result<Self, MeshError> {
        check_usage("positions", positions, BufferUsages::STORAGE)?;
        check_usage("indices", indices, BufferUsages::STORAGE | BufferUsages::INDEX)?;
        let place = uniform(device, bytemuck::bytes_of(&world_from_object));
        let mut windows = Vec::new();
        let mut triangles = parts.first().map_or(0..0, |part| part.triangles.clone());
        for part in parts {
            let limits = Limits::of(device);
            let vertices = limits.vertices(positions, &part.vertices)?;
            for range in limits.triangles(indices, &part.triangles)? {
                let from = limits.floor(range.start);
                let first = uniform(device, bytemuck::bytes_of(&[from, vertices.start, 0, 0]));
                let entries = [
                    wgpu::BindGroupEntry { binding: 0, resource: place.as_entire_binding() },
                    bound(1, positions, &vertices),
                    bound(2, indices, &(from..range.end)),
                    wgpu::BindGroupEntry { binding: 3, resource: first.as_entire_binding() },
                ];
                let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("caster mesh"),
                    layout: &mesh_layout(device),
                    entries: &entries,
                });
                windows.push(Window { group, triangles: range });
            }
            triangles = triangles.start.min(part.triangles.start)..triangles.end.max(part.triangles.end);
        }
        Ok(Self { place, indices: indices.clone(), windows, triangles })
    }

    /// Moves it.
    pub fn place(&self, queue: &wgpu::Queue, world_from_object: Mat4) {
        queue.write_buffer(&self.place, 0, bytemuck::bytes_of(&world_from_object));
    }

    /// Which of these triangles it was made of.
    pub(super) fn within(&self, triangles: impl RangeBounds<u32>) -> Range<u32> {
        let start = match triangles.start_bound() {
            Bound::Included(start) => *start,
            Bound::Excluded(before) => before.saturating_add(1),
            Bound::Unbounded => 0,
        };
        let end = match triangles.end_bound() {
            Bound::Included(last) => last.saturating_add(1),
            Bound::Excluded(end) => *end,
            Bound::Unbounded => u32::MAX,
        };
        common(&(start..end), &self.triangles)
    }

    /// Draws some of them with so many `vertices` each, for shaders that read whole triangles; `first` is the
    /// index of the only instance.
    pub(super) fn draw(&self, pass: &mut RenderPass<'_>, triangles: Range<u32>, vertices: u32, first: u32) {
        for (group, Range { start, end }) in self.windows(triangles) {
            pass.set_bind_group(1, group, &[]);
            for start in (start..end).step_by(DRAWN_TOGETHER as usize) {
                let end = end.min(start.saturating_add(DRAWN_TOGETHER));
                pass.draw(vertices * start..vertices * end, first..first + 1);
            }
        }
    }

    /// Draws some of them with vertices that they share; the index of the only instance is that of the first
    /// triangle.
    pub(super) fn draw_indexed(&self, pass: &mut RenderPass<'_>, triangles: Range<u32>) {
        for (group, Range { start, end }) in self.windows(triangles) {
            pass.set_bind_group(1, group, &[]);
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(3 * start..3 * end, 0, start..start + 1);
        }
    }

    /// What to bind in turn, and the triangles that are drawn from it.
    fn windows(&self, triangles: Range<u32>) -> impl Iterator<Item = (&BindGroup, Range<u32>)> {
        let windows = self.windows.iter();
        windows
            .map(move |window| (&window.group, common(&triangles, &window.triangles)))
            .filter(|(_, triangles)| !triangles.is_empty())
    }
}

fn common(a: &Range<u32>, b: &Range<u32>) -> Range<u32> {
    a.start.max(b.start)..a.end.min(b.end)
}

/// What one binding may hold, and where it may begin.
#[derive(Debug, Clone, Copy)]
struct Limits {
    max_bytes: u64,
    /// Elements from one possible begin to the next.
    step: u32,
}

impl Limits {
    fn of(device: &wgpu::Device) -> Self {
        let limits = device.limits();
        // Offsets are multiples of a power of two from 32 on, and of the twelve bytes of an element.
        let step = (limits.min_storage_buffer_offset_alignment / 4).max(1);
        Self { max_bytes: limits.max_storage_buffer_binding_size, step }
    }

    /// The last possible begin up to an element.
    fn floor(self, element: u32) -> u32 {
        element / self.step * self.step
    }

    /// Vertices to bind for a part.
    fn vertices(self, positions: &Buffer, vertices: &Range<u32>) -> Result<Range<u32>, MeshError> {
        let &Range { start, end } = vertices;
        let count = vertices_of(positions);
        if start >= end || end > count {
            return Err(MeshError::Vertices { start, end, count });
        }
        let bytes = BYTES * u64::from(end - self.floor(start));
        match bytes <= self.max_bytes {
            true => Ok(self.floor(start)..end),
            false => Err(MeshError::Bytes { what: "positions", bytes, max: self.max_bytes }),
        }
    }

    /// A part's triangles, as many at a time as a binding of indices holds.
    fn triangles(self, indices: &Buffer, triangles: &Range<u32>) -> Result<Vec<Range<u32>>, MeshError> {
        let &Range { start, end } = triangles;
        // Six vertices per triangle are counted in 32 bits.
        let count = (indices.size() / BYTES).min(u64::from(u32::MAX / 6)) as u32;
        if start > end || end > count {
            return Err(MeshError::Triangles { start, end, count });
        }
        if start == end {
            return Ok(Vec::new());
        }
        let most = self.floor(u32::try_from(self.max_bytes / BYTES).unwrap_or(u32::MAX));
        if most == 0 {
            let bytes = BYTES * u64::from(self.step);
            return Err(MeshError::Bytes { what: "indices", bytes, max: self.max_bytes });
        }
        let begins = (self.floor(start)..end).step_by(most as usize);
        Ok(begins.map(|from| from.max(start)..end.min(from.saturating_add(most))).collect())
    }
}

fn vertices_of(positions: &Buffer) -> u32 {
    u32::try_from(positions.size() / BYTES).unwrap_or(u32::MAX)
}

fn check_usage(what: &'static str, buffer: &Buffer, needed: BufferUsages) -> Result<(), MeshError> {
    if !buffer.usage().contains(needed) {
        let [found, needed] = [buffer.usage(), needed].map(|usage| format!("{usage:?}"));
        return Err(MeshError::Usage { what, found, needed });
    }
    Ok(())
}

/// Elements of a buffer.
fn bound<'a>(binding: u32, buffer: &'a Buffer, elements: &Range<u32>) -> wgpu::BindGroupEntry<'a> {
    let resource = wgpu::BindingResource::Buffer(wgpu::BufferBinding {
        buffer,
        offset: BYTES * u64::from(elements.start),
        size: NonZeroU64::new(BYTES * u64::from(elements.end - elements.start)),
    });
    wgpu::BindGroupEntry { binding, resource }
}

fn uniform(device: &wgpu::Device, bytes: &[u8]) -> Buffer {
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("caster mesh"),
        size: bytes.len() as u64,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        mapped_at_creation: true,
    });
    if let Ok(mut mapped) = buffer.get_mapped_range_mut(..) {
        mapped.copy_from_slice(bytes);
    }
    buffer.unmap();
    buffer
}
