//! Shadow maps over any depth image, asked for their visibility at any point: light space is world
//! space, with x and y in `[−1,1]` (y up) and depth z in `[0,1]`.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use crate::Gpu;
use antumbra::{Pipelines, Size, View};
use glam::{Mat4, Vec2, Vec3, Vec4};
use std::{
    collections::HashMap,
    sync::{Arc, Mutex, OnceLock},
};

mod depth;
mod maps;
mod question;
mod read;

pub use depth::{Painter, depth_layers, depth_texture};
pub use maps::{caster_buffers, caster_mesh, shadow_map, shadow_map_of};
pub use question::{compute, read_rows, visibility};
pub use read::{bytes_of, floats, texels};

/// A point to be asked about.
#[derive(Debug, Clone, Copy)]
pub struct Receiver {
    /// Texture coordinates, y down.
    pub uv: Vec2,
    /// Linear depth.
    pub depth: f32,
    /// Change of uv to the next pixel in x and in y.
    pub footprint: Vec2,
    /// Unit normal.
    pub normal: Vec3,
}

impl Receiver {
    /// A point that faces the light, with a footprint far below a texel.
    pub fn point(u: f32, v: f32, depth: f32) -> Self {
        Self { uv: Vec2::new(u, v), depth, footprint: Vec2::splat(1e-6), normal: Vec3::NEG_Z }
    }
}

/// The view whose light space is world space.
pub fn view(size: Size) -> View {
    View {
        clip_from_world: Mat4::IDENTITY,
        depth_plane: Vec4::Z,
        to_light: Vec4::NEG_Z,
        texel_world: 2.0 / size.width as f32,
        linear_from_clip: [Vec4::Z, Vec4::W],
        depth_world: 1.0,
    }
}

/// What all tests of a program share, so that the driver compiles it once.
#[derive(Debug, Clone)]
struct Kept {
    pipelines: Pipelines,
    depth: wgpu::RenderPipeline,
    compute: Arc<Mutex<HashMap<String, wgpu::ComputePipeline>>>,
}

/// Devices of other instances cannot be told apart by comparing them: only the shared one keeps.
fn kept(gpu: &Gpu) -> Kept {
    static SHARED: OnceLock<Kept> = OnceLock::new();
    let make = || Kept {
        pipelines: Pipelines::new(&gpu.device),
        depth: depth::pipeline(gpu),
        compute: Arc::default(),
    };
    let shared = crate::gpu().is_some_and(|shared| std::ptr::eq(shared, gpu));
    if shared { SHARED.get_or_init(make).clone() } else { make() }
}

/// Pipelines that all maps share.
pub fn pipelines(gpu: &Gpu) -> Pipelines {
    kept(gpu).pipelines
}

/// Reproducible random numbers (xorshift).
#[derive(Debug)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Uniform in [0,1).
    pub fn unit(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Uniform in [low,high).
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }
}
