//! Spheres over a plane [Lecocq, Marvie, Sourimant, Gautron 2014, "Sub-pixel shadow mapping"]: round
//! silhouettes at many heights, so that every texel of the map is crossed at some angle.

use super::{Procedural, random::Random, shapes};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};

pub(super) const SPHERES: Procedural = Procedural {
    name: "spheres",
    description: "nine spheres floating over, hovering above and standing on a slab",
    stresses: "curved silhouettes at all angles, a contact point, shadows of shadows",
    source: "Lecocq et al. 2014, Sub-pixel shadow mapping",
    triangles: 12_000,
    build,
};

/// Centre and radius; each touches or floats above y = 0.
const BALLS: [([f32; 3], f32); 9] = [
    ([-0.2, 1.0, 0.0], 1.0),
    ([-2.3, 1.6, 0.7], 0.55),
    ([1.9, 0.75, 1.2], 0.6),
    ([1.5, 2.5, -0.9], 0.5),
    ([-1.6, 0.45, 2.1], 0.45),
    ([3.2, 1.45, -0.4], 0.4),
    ([-3.5, 0.7, -0.9], 0.7),
    ([0.5, 0.35, 2.6], 0.3),
    ([0.2, 2.75, 0.9], 0.33),
];

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = shapes::Builder::new("spheres");
    let floor = scene.material("floor", [0.58, 0.56, 0.52], 0.9);
    let colors = [
        ("chalk", [0.62, 0.58, 0.52]),
        ("clay", [0.52, 0.24, 0.15]),
        ("slate", [0.18, 0.27, 0.33]),
        ("moss", [0.28, 0.34, 0.17]),
    ];
    let slab = scene.mesh("slab", shapes::cuboid(Vec3::new(12.0, 0.3, 9.0)), floor);
    scene.place(slab, Mat4::from_translation(Vec3::new(0.0, -0.15, 0.0)));
    let meshes = colors.map(|(name, color)| {
        let material = scene.material(name, color, 0.6);
        // 9 · 2 · 37 · 18 and the slab's 12 make 12,000.
        scene.mesh(name, shapes::sphere(37, 19), material)
    });
    for (i, (center, radius)) in BALLS.into_iter().enumerate() {
        let turn = Mat4::from_rotation_y(random.between(0.0, std::f32::consts::TAU));
        let nudge = Vec3::new(random.around(0.05), 0.0, random.around(0.05));
        let center = Vec3::from(center) + nudge;
        scene.place(
            meshes[i % meshes.len()],
            Mat4::from_translation(center) * turn * Mat4::from_scale(Vec3::splat(radius)),
        );
    }
    scene.finish(
        Camera {
            position: Vec3::new(1.5, 3.5, 7.6),
            target: Vec3::new(0.2, 1.05, 0.2),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.7 },
        },
        Light::Directional { direction: Vec3::new(0.62, -0.85, -0.45).normalize() },
    )
}
