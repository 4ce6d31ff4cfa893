//! Squares that float over a plane and a slanted polygon that touches it [Annen et al. 2007,
//! "Convolution shadow maps", figures 4 and 6]. The squares are the same but for their height: the
//! lower one hangs, the lighter a smoothed step draws its shadow, down to a hair over the ground.

use super::{
    Procedural,
    model::Model,
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};

pub(super) const BLOCKS: Procedural = Procedural {
    name: "blocks",
    description: "squares floating at four heights, a slanted polygon and blocks that touch the ground",
    stresses: "shadows that pale as occluder and receiver come close; contact lines; stacked blocks",
    source: "Annen et al. 2007, Convolution shadow maps, figures 4 and 6",
    triangles: 133,
    build,
};

/// Undersides of the floating squares above the ground, from left to right.
const HEIGHTS: [f32; 4] = [0.05, 0.16, 0.45, 1.05];

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("blocks");
    let floor = scene.material("floor", [0.47, 0.45, 0.42], 0.9);
    let colors = [
        ("slate", [0.16, 0.27, 0.36]),
        ("moss", [0.27, 0.36, 0.17]),
        ("ochre", [0.62, 0.44, 0.14]),
        ("brick", [0.54, 0.19, 0.11]),
    ]
    .map(|(name, color)| scene.material(name, color, 0.75));
    let plane = scene.mesh("ground", shapes::ground(9.0), floor);
    scene.place(plane, Mat4::IDENTITY);
    for (i, (height, material)) in HEIGHTS.into_iter().zip(colors).enumerate() {
        let square = scene.mesh("square", shapes::cuboid(Vec3::new(0.7, 0.03, 0.7)), material);
        let at = Vec3::new(-1.85 + 1.0 * i as f32, height + 0.015, 0.95);
        scene.place(square, Mat4::from_translation(at) * Mat4::from_rotation_y(0.12));
    }
    slanted(&mut scene);
    toys(&mut scene, &mut random, &colors);
    scene.finish(
        Camera {
            position: Vec3::new(1.5, 2.9, 5.2),
            target: Vec3::new(0.05, 0.2, 0.05),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.66 },
        },
        Light::Directional { direction: Vec3::new(0.75, -1.0, 0.35).normalize() },
    )
}

/// A pentagon whose first edge lies on the ground. It rises at 62° against the sun, so that its
/// shadow begins on the line of contact and is seen beside it.
fn slanted(scene: &mut Builder) {
    let cream = scene.material("cream", [0.62, 0.55, 0.40], 0.8);
    let along = Vec3::new(0.30, 0.0, -0.95).normalize();
    let slope = along.cross(Vec3::NEG_Y) * -0.469 + Vec3::Y * 0.883;
    let corner = |s: f32, t: f32| Vec3::new(-1.55, 0.0, 0.0) + along * s + slope * t;
    let corners =
        [corner(0.0, 0.0), corner(1.3, 0.0), corner(1.55, 0.8), corner(0.65, 1.4), corner(-0.25, 0.8)];
    let polygon = scene.mesh("slanted polygon", shapes::polygon(&corners), cream);
    scene.place(polygon, Mat4::IDENTITY);
}

/// Building blocks: a gate, a wedge and some that lie about.
fn toys(scene: &mut Builder, random: &mut Random, colors: &[usize; 4]) {
    let [slate, moss, ochre, brick] = *colors;
    let mut gate = Model::default();
    // All sunk by a hair into what they stand on, so that no two faces coincide.
    gate.block(brick, Vec3::new(-0.45, 0.346, 0.0), Vec3::new(0.26, 0.7, 0.26));
    gate.block(brick, Vec3::new(0.45, 0.346, 0.0), Vec3::new(0.26, 0.7, 0.26));
    gate.block(slate, Vec3::new(0.0, 0.806, 0.0), Vec3::new(1.26, 0.224, 0.24));
    gate.put(ochre, &shapes::extruded(&[[-0.4, 0.914], [0.4, 0.914], [0.0, 1.294]], 0.22));
    let gate = gate.finish(scene, "gate");
    let turn = Mat4::from_rotation_y(-0.25 + random.around(0.03));
    scene.place_all(&gate, Mat4::from_translation(Vec3::new(0.55, 0.0, -0.95)) * turn);
    let cube = scene.mesh("cube", shapes::cuboid(Vec3::splat(0.3)), moss);
    let brick = scene.mesh("brick", shapes::cuboid(Vec3::new(0.6, 0.13, 0.26)), slate);
    for [x, z] in [[1.75, -0.35], [-0.25, -0.35]] {
        let at = Mat4::from_translation(Vec3::new(x, 0.146, z));
        scene.place(cube, at * Mat4::from_rotation_y(random.around(0.5)));
    }
    let at = Mat4::from_translation(Vec3::new(2.0, 0.061, 0.45));
    scene.place(brick, at * Mat4::from_rotation_y(0.8 + random.around(0.1)));
}
