//! What shaders need of a light: one map's worth of it.

use super::Size;
use glam::{Mat4, Vec2, Vec3, Vec4};

/// One map's worth of a light: matrices and units, all that shaders need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World to clip space: x, y in `[−1,1]` (y up), z in `[0,1]` from near to far.
    pub clip_from_world: Mat4,
    /// Linear depth in `[0,1]` of a world point p is `dot(depth_plane, (p, 1))`.
    pub depth_plane: Vec4,
    /// Unit vector towards a directional light with w = 0, or position of a spot with w = 1.
    pub to_light: Vec4,
    /// World size of a texel: everywhere (directional), or at unit distance along the axis (spot).
    pub texel_world: f32,
    /// Near over far distance of a spot, 1 for parallel light: linearises projected depth.
    pub near_over_far: f32,
    /// World length of the depth range `[0,1]`.
    pub depth_world: f32,
}

impl View {
    /// The same view with the image plane shifted, so that texel centres lie `offset` texels further on,
    /// y down.
    #[must_use]
    pub fn jittered(&self, size: Size, offset: Vec2) -> Self {
        let shift = Vec3::new(-2.0 * offset.x / size.width as f32, 2.0 * offset.y / size.height as f32, 0.0);
        Self { clip_from_world: Mat4::from_translation(shift) * self.clip_from_world, ..*self }
    }
}
