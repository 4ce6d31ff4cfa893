//! What shaders that draw triangles know of views.

use super::objects;
use crate::{
    describe::Coverage,
    light::{Size, View},
    memory::MemoryItem,
    tile::Tile,
};
use wgpu::{BindingResource, Buffer, BufferUsages};

/// Share of a spot's near distance in front of which casters are cut off.
const LEAST_DISTANCE: f32 = 1.0 / 64.0;

/// How far the planes of steep triangles may come before casters that are nearer, texels.
const LEAN: f32 = 2.0;

/// Rust side of `CasterView` in `mesh.wgsl.in`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct CasterView {
    clip_from_world: [[f32; 4]; 4],
    size: [f32; 2],
    least_distance: f32,
    perspective: u32,
    reach: f32,
    near_over_far: f32,
    lean: f32,
    layer: u32,
    origin: [f32; 2],
    layer_size: [u32; 2],
}

impl CasterView {
    /// Of one of the kinds of texels that triangles are drawn to.
    fn new((view, tile): (&View, &Tile), layer_size: Size, coverage: Coverage, among: &[Coverage]) -> Self {
        // The apex lies in front of the near plane by the near distance.
        let near = -view.depth_world * view.depth_plane.dot(view.to_light);
        let perspective = perspective(view);
        Self {
            clip_from_world: view.clip_from_world.to_cols_array_2d(),
            size: [tile.size.width as f32, tile.size.height as f32],
            least_distance: if perspective == 1 { near * LEAST_DISTANCE } else { f32::MIN },
            perspective,
            reach: match coverage {
                Coverage::Touched => 0.5,
                Coverage::Centre => 0.0,
            },
            near_over_far: view.near_over_far(),
            // Depth is even under the sun alone.
            lean: if coverage == Coverage::Touched && among.contains(&Coverage::Centre) && perspective == 0 {
                LEAN * view.texel_world / view.depth_world
            } else {
                0.0
            },
            layer: tile.layer,
            origin: tile.origin.map(|texels| texels as f32),
            layer_size: [layer_size.width, layer_size.height],
        }
    }
}

/// 1 for a spot's view, else 0.
pub(super) fn perspective(view: &View) -> u32 {
    u32::from(view.is_perspective())
}

/// The views of a map, once for each kind of texels that triangles are drawn to.
#[derive(Debug)]
pub(super) struct CasterViews {
    buffer: Buffer,
    stride: u64,
    /// Texels of a layer.
    size: Size,
    coverages: &'static [Coverage],
}

impl CasterViews {
    pub(super) fn new(
        device: &wgpu::Device,
        (size, views): (Size, u32),
        coverages: &'static [Coverage],
    ) -> Self {
        let stride = objects::stride::<CasterView>(device);
        let bytes = u64::from(views) * coverages.len() as u64 * stride;
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        Self { buffer: objects::buffer(device, "caster views", bytes, usage), stride, size, coverages }
    }

    pub(super) fn write(&self, queue: &wgpu::Queue, views: &[View], tiles: &[Tile]) {
        let all = views.iter().zip(tiles).flat_map(|at| self.coverages.iter().map(move |c| (at, c)));
        for (index, (placed, coverage)) in (0..).zip(all) {
            let bytes = CasterView::new(placed, self.size, *coverage, self.coverages);
            queue.write_buffer(&self.buffer, index * self.stride, bytemuck::bytes_of(&bytes));
        }
    }

    /// What a pass of a view binds, by its coverage's index.
    pub(super) fn binding(&self, view: usize, coverage: usize) -> BindingResource<'_> {
        let index = view * self.coverages.len() + coverage;
        objects::element::<CasterView>(&self.buffer, index as u64, self.stride)
    }

    /// Dynamic offset of a view's, where all views have one coverage.
    pub(super) fn offset(&self, view: usize) -> u32 {
        (view as u64 * self.stride) as u32
    }

    pub(super) fn memory(&self, name: &str) -> MemoryItem {
        MemoryItem::buffer(name, &self.buffer)
    }
}
