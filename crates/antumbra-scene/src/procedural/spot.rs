//! A lamp in a corner: a spot light close to its casters, where the size of a texel on the receivers
//! and the ratio of occluder to receiver distance change much within one map
//! [Donnelly and Lauritzen 2006, "Variance shadow maps", section 4].

use super::{Procedural, random::Random, shapes};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};

pub(super) const SPOT: Procedural = Procedural {
    name: "spot",
    description: "a spot light shines through a lattice onto pillars and a wall",
    stresses: "perspective light views: non-linear depth, close casters, a cone's edge",
    source: "Donnelly and Lauritzen 2006, Variance shadow maps, section 4",
    triangles: 8_030,
    build,
};

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = shapes::Builder::new("spot");
    let plaster = scene.material("plaster", [0.60, 0.57, 0.51], 0.9);
    let slate = scene.material("slate", [0.18, 0.27, 0.33], 0.8);
    let clay = scene.material("clay", [0.52, 0.24, 0.15], 0.7);
    let wood = scene.material("wood", [0.42, 0.29, 0.17], 0.85);
    let floor = scene.mesh("floor", shapes::ground(14.0), plaster);
    scene.place(floor, Mat4::IDENTITY);
    let wall = scene.mesh("wall", shapes::cuboid(Vec3::new(14.0, 5.0, 0.3)), plaster);
    scene.place(wall, Mat4::from_translation(Vec3::new(0.0, 2.49, -3.15)));

    let pillar =
        shapes::turned(&[[0.3, -0.01], [0.3, 0.12], [0.2, 0.2], [0.17, 1.9], [0.27, 2.0], [0.27, 2.1]], 32);
    let pillar = scene.mesh("pillar", pillar, slate);
    for x in [-2.4, -0.6, 1.2] {
        let z = -1.7 + random.around(0.1);
        scene.place(pillar, Mat4::from_translation(Vec3::new(x, 0.0, z)));
    }
    let ball = scene.mesh("ball", shapes::sphere(48, 24), clay);
    for [x, radius, z] in [[0.3, 0.35, -0.4], [-1.5, 0.25, -0.3], [2.1, 0.45, -1.1]] {
        let at = Mat4::from_translation(Vec3::new(x, radius - 0.003, z));
        scene.place(ball, at * Mat4::from_scale(Vec3::splat(radius)));
    }
    let slat = scene.mesh("slat", shapes::cuboid(Vec3::new(0.03, 1.5, 0.02)), wood);
    let beam = scene.mesh("beam", shapes::cuboid(Vec3::new(1.6, 0.03, 0.024)), wood);
    let lattice = Mat4::from_translation(Vec3::new(-1.3, 0.8, 1.3)) * Mat4::from_rotation_y(-0.45);
    for i in -5..=5 {
        scene.place(slat, lattice * Mat4::from_translation(Vec3::new(0.15 * i as f32, 0.0, 0.0)));
    }
    for i in -4..=4 {
        scene.place(beam, lattice * Mat4::from_translation(Vec3::new(0.0, 0.17 * i as f32, 0.0)));
    }
    let position = Vec3::new(-2.6, 2.7, 3.6);
    scene.finish(
        Camera {
            position: Vec3::new(2.9, 2.5, 5.4),
            target: Vec3::new(-0.2, 0.8, -1.2),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.66 },
        },
        Light::Spot {
            position,
            direction: (Vec3::new(-0.1, 0.5, -1.3) - position).normalize(),
            outer_angle: 0.52,
        },
    )
}
