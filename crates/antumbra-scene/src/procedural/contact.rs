//! A low box and a polygon that leans on the ground [Annen et al. 2007, "Convolution shadow maps",
//! figures 4 and 6]: near the line of contact the occluder is barely above the receiver, and
//! filtered shadows fade where they should be darkest.

use super::{Procedural, shapes};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};

pub(super) const CONTACT: Procedural = Procedural {
    name: "contact",
    description: "a low box and a slanted polygon that touches the ground",
    stresses: "contact shadows: occluder and receiver distances that go to zero",
    source: "Annen et al. 2007, Convolution shadow maps, figures 4 and 6",
    triangles: 17,
    build,
};

fn build(_seed: u64) -> Scene {
    let mut scene = shapes::Builder::new("contact");
    let floor = scene.material("floor", [0.58, 0.56, 0.52], 0.9);
    let clay = scene.material("clay", [0.52, 0.24, 0.15], 0.8);
    let slate = scene.material("slate", [0.18, 0.27, 0.33], 0.8);
    let plane = scene.mesh("ground", shapes::ground(6.0), floor);
    scene.place(plane, Mat4::IDENTITY);
    let size = Vec3::new(1.4, 0.35, 0.8);
    let low = scene.mesh("box", shapes::cuboid(size), clay);
    // Sunk by a hair, so that no face lies in the ground.
    scene.place(
        low,
        Mat4::from_translation(Vec3::new(-0.95, size.y * 0.5 - 0.005, 0.35)) * Mat4::from_rotation_y(0.35),
    );
    // A pentagon whose first edge lies on the ground; it rises 60° and its tip is 1.2 m up.
    let along = Vec3::new(0.3, 0.0, -1.0).normalize();
    let level = along.cross(Vec3::Y).normalize();
    let slope = level * 0.5 + Vec3::Y * 0.866;
    let corner = |s: f32, t: f32| Vec3::new(0.3, 0.0, 0.85) + along * s + slope * t;
    let corners =
        [corner(0.0, 0.0), corner(1.25, 0.0), corner(1.5, 0.8), corner(0.625, 1.44), corner(-0.25, 0.8)];
    let slanted = scene.mesh("slanted polygon", shapes::polygon(&corners), slate);
    scene.place(slanted, Mat4::IDENTITY);
    scene.finish(
        Camera {
            position: Vec3::new(1.0, 2.6, 4.3),
            target: Vec3::new(0.25, 0.2, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.7 },
        },
        Light::Directional { direction: Vec3::new(0.55, -1.0, -0.55).normalize() },
    )
}
