//! Small scenes with known shadows.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used, reason = "every test file uses its own part")]

use antumbra_scene::{Camera, Geometry, Light, Material, Projection};
use antumbra_truth::CameraRays;
use glam::{DVec3, Vec2, Vec3, Vec4};

/// Triangles of one opaque material.
pub fn geometry(triangles: &[[Vec3; 3]]) -> Geometry {
    let positions: Vec<Vec3> = triangles.iter().flatten().copied().collect();
    let count = positions.len();
    Geometry {
        normals: vec![Vec3::Y; count],
        uvs: vec![Vec2::ZERO; count],
        colors: vec![Vec4::ONE; count],
        indices: (0..count as u32).collect(),
        groups: vec![(0, 0..triangles.len() as u32)],
        materials: vec![Material::default()],
        positions,
        ..Geometry::default()
    }
}

/// The parallelogram from `corner` along `a` and `b`, cut into `n` × `n` cells of two triangles,
/// with corners rounded to f32.
pub fn grid(corner: DVec3, a: DVec3, b: DVec3, n: u32) -> Vec<[Vec3; 3]> {
    let at = |i: u32, j: u32| {
        (corner + a * (f64::from(i) / f64::from(n)) + b * (f64::from(j) / f64::from(n))).as_vec3()
    };
    (0..n)
        .flat_map(|j| (0..n).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[p, q, r], [p, r, s]]
        })
        .collect()
}

/// A sphere of `2 n²` quads.
pub fn sphere(center: DVec3, radius: f64, n: u32) -> Vec<[Vec3; 3]> {
    let at = |i: u32, j: u32| {
        let polar = std::f64::consts::PI * f64::from(j) / f64::from(n);
        let around = std::f64::consts::PI * f64::from(i % (2 * n)) / f64::from(n);
        let ring = if j == 0 || j == n { 0.0 } else { polar.sin() };
        let unit = DVec3::new(ring * around.cos(), polar.cos(), ring * around.sin());
        (center + radius * unit).as_vec3()
    };
    (0..n)
        .flat_map(|j| (0..2 * n).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[p, q, r], [p, r, s]]
        })
        .collect()
}

pub fn sun(toward: DVec3) -> Light {
    Light::Directional { direction: -toward.normalize().as_vec3() }
}

pub fn picture(position: DVec3, target: DVec3, size: [u32; 2]) -> CameraRays {
    with_fov(position, target, size, 0.8)
}

/// A microscope: some `width` of the world around `target`, 120 × 90 pixels.
pub fn zoom(position: DVec3, target: DVec3, width: f64) -> CameraRays {
    with_fov(position, target, [120, 90], width / (target - position).length())
}

fn with_fov(position: DVec3, target: DVec3, size: [u32; 2], fov_y: f64) -> CameraRays {
    let up = if (target - position).normalize().y.abs() > 0.99 { Vec3::Z } else { Vec3::Y };
    let projection = Projection::Perspective { fov_y: fov_y as f32 };
    let camera = Camera { position: position.as_vec3(), target: target.as_vec3(), up, projection };
    CameraRays::new(&camera, size[0], size[1]).unwrap()
}

/// Repeatable numbers in [0,1).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / (1u64 << 24) as f64
    }

    /// In [−1,1]³.
    pub fn point(&mut self) -> DVec3 {
        2.0 * DVec3::new(self.next(), self.next(), self.next()) - 1.0
    }
}
