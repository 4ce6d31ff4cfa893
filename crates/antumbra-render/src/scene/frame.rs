//! The camera and the light as shaders read them, and the camera's matrix.

use super::nearest;
use antumbra_scene::{Camera, Geometry, Light, Projection};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3, Vec4, camera::rh};

/// Rust side of `Frame` in `scene/frame.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
pub(super) struct Frame {
    /// Camera matrix; world positions are taken relative to the eye first, for precision.
    pub(super) clip_from_relative: [[f32; 4]; 4],
    pub(super) eye: [f32; 4],
    /// Picture coordinates (0, 0), and what is gained per pixel to the right and down: the direction of the
    /// ray from the eye, or, where rays are parallel, its start relative to the eye.
    pub(super) ray: [f32; 4],
    pub(super) ray_right: [f32; 4],
    pub(super) ray_down: [f32; 4],
    /// Towards the light; w = 1 for a spot's position.
    pub(super) to_light: [f32; 4],
    /// Cosine of a spot's half angle; −2 for the sun.
    pub(super) cone: [f32; 4],
    /// The way the camera looks; w = 1 if its rays are parallel.
    pub(super) forward: [f32; 4],
}

impl Frame {
    /// The frame, and the matrix from world to clip space: reversed depth keeps precision far away.
    pub(super) fn new(
        camera: &Camera,
        light: &Light,
        [width, height]: [u32; 2],
        geometry: &Geometry,
    ) -> (Self, Mat4) {
        let aspect = width as f32 / height as f32;
        // In f64: squares of tiny and of huge lengths are no numbers in f32.
        let forward = (camera.target.as_dvec3() - camera.position.as_dvec3()).normalize().as_vec3();
        let right = forward.cross(camera.up).normalize();
        let up = right.cross(forward);
        // Half the picture's height: at distance 1, or everywhere.
        let (half, is_parallel, lens) = match camera.projection {
            Projection::Perspective { fov_y } => {
                let half = (fov_y / 2.0).tan();
                let near = near(geometry, camera.position);
                (half, false, rh::proj::directx::perspective_infinite_reverse(fov_y, aspect, near))
            }
            Projection::Orthographic { height } => {
                let half = height / 2.0;
                (half, true, parallel(half, aspect, far(geometry, camera.position, forward)))
            }
        };
        let matrix = lens * rh::view::look_to_mat4(Vec3::ZERO, forward, up);
        let ahead = if is_parallel { Vec3::ZERO } else { forward };
        let mut frame = Self {
            clip_from_relative: matrix.to_cols_array_2d(),
            eye: camera.position.extend(1.0).to_array(),
            ray: (ahead - right * (half * aspect) + up * half).extend(0.0).to_array(),
            ray_right: (right * (2.0 * half * aspect / width as f32)).extend(0.0).to_array(),
            ray_down: (up * (-2.0 * half / height as f32)).extend(0.0).to_array(),
            to_light: [0.0; 4],
            cone: [-2.0; 4],
            forward: forward.extend(if is_parallel { 1.0 } else { 0.0 }).to_array(),
        };
        match *light {
            Light::Directional { direction } => frame.to_light = (-direction).extend(0.0).to_array(),
            Light::Spot { position, direction, outer_angle } => {
                frame.to_light = position.extend(1.0).to_array();
                let [x, y, z] = direction.normalize().to_array();
                frame.cone = [outer_angle.cos(), x, y, z];
            }
        }
        (frame, matrix * Mat4::from_translation(-camera.position))
    }

    /// The same with rays through other points of pixels, `offset` from their centres.
    pub(super) fn shifted(&self, offset: Vec2, [width, height]: [u32; 2]) -> Self {
        let [ray, right, down] = [self.ray, self.ray_right, self.ray_down].map(Vec4::from_array);
        let clip = Vec3::new(-2.0 * offset.x / width as f32, 2.0 * offset.y / height as f32, 0.0);
        let matrix = Mat4::from_translation(clip) * Mat4::from_cols_array_2d(&self.clip_from_relative);
        Self {
            clip_from_relative: matrix.to_cols_array_2d(),
            ray: (ray + right * offset.x + down * offset.y).to_array(),
            ..*self
        }
    }
}

/// View to clip space of parallel rays, depth 1 at the eye's plane and 0 at `far`.
fn parallel(half: f32, aspect: f32, far: f32) -> Mat4 {
    Mat4::from_cols(Vec4::X / (half * aspect), Vec4::Y / half, Vec4::Z / far, Vec4::new(0.0, 0.0, 1.0, 1.0))
}

/// How far the scene reaches from the plane of the eye, with a little room; some length if not at all.
fn far(geometry: &Geometry, eye: Vec3, forward: Vec3) -> f32 {
    let corners = geometry.bounds().map(|b| b.corners()).unwrap_or_default();
    let far = corners.iter().map(|corner| (*corner - eye).dot(forward)).fold(0.0, f32::max);
    if far > 0.0 { far * 1.001 } else { 1.0 }
}

/// A near plane that cuts off nothing: a hundredth of the distance to the nearest triangle at most, which
/// is less than the cosine in a corner of any picture. Powers of two, so that it rests while the camera
/// moves a little; so close that light views fitted to the picture do not tell it from the eye. Where the
/// eye lies on a surface it is a rounding error away.
fn near(geometry: &Geometry, eye: Vec3) -> f32 {
    let rounding = f32::EPSILON * eye.abs().max_element().max(1e-25);
    let near = 0.01 * nearest::distance(geometry, eye).min(f32::MAX);
    near.max(rounding).log2().floor().exp2()
}
