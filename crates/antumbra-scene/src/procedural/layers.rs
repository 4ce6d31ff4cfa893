//! Three thin casters above one another [Lauritzen and McCool 2008, "Layered variance shadow maps",
//! show what such scenes do to variance shadow maps]. Their shadows fall on the
//! same patch of ground, which lies wholly in the dark under two and three of them. Wherever the
//! edge of a higher one crosses the shadow of a lower one, a texel of the map holds several depths,
//! and techniques that keep two moments draw that edge as a line of light.

use super::{
    Procedural,
    model::Model,
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};

pub(super) const LAYERS: Procedural = Procedural {
    name: "layers",
    description: "sun panels over a slatted roof over a round table, all shading the same ground",
    stresses: "light bleeding: full shadow under two and three casters at different depths",
    source: "Lauritzen and McCool 2008, Layered variance shadow maps",
    triangles: 1_510,
    build,
};

/// Where the shadows meet on the ground.
const SHADE: Vec3 = Vec3::new(1.1, 0.0, 1.1);
/// The way light travels, for one metre down.
const SUN: Vec3 = Vec3::new(0.85, -1.0, 0.40);

/// The point at that height whose shadow is [`SHADE`].
fn above(height: f32) -> Vec3 {
    SHADE - SUN * height
}

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("layers");
    let paving = scene.material("paving", [0.50, 0.47, 0.43], 0.9);
    let ground = scene.mesh("ground", shapes::ground(16.0), paving);
    scene.place(ground, Mat4::IDENTITY);
    table(&mut scene);
    roof(&mut scene);
    panels(&mut scene, &mut random);
    scene.finish(
        Camera {
            position: Vec3::new(4.9, 5.3, 7.8),
            target: Vec3::new(-0.05, 1.15, 0.35),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.68 },
        },
        Light::Directional { direction: SUN.normalize() },
    )
}

/// A round table: the lowest layer has no gaps, so all light in its shadow is leaked.
fn table(scene: &mut Builder) {
    let slate = scene.material("slate", [0.17, 0.28, 0.35], 0.6);
    let iron = scene.material("iron", [0.09, 0.10, 0.11], 0.5);
    let top = above(0.95);
    let mut table = Model::default();
    table.put(slate, &shapes::turned(&[[0.84, 0.93], [0.85, 0.94], [0.85, 0.96], [0.84, 0.97]], 64));
    table.put(
        iron,
        &shapes::turned(&[[0.30, -0.01], [0.30, 0.02], [0.045, 0.07], [0.04, 0.9], [0.16, 0.929]], 32),
    );
    let table = table.finish(scene, "table");
    scene.place_all(&table, Mat4::from_translation(Vec3::new(top.x, 0.0, top.z)));
}

/// A frame of slats on four posts.
fn roof(scene: &mut Builder) {
    const WIDTH: f32 = 3.2;
    const DEPTH: f32 = 2.6;
    let oak = scene.material("oak", [0.50, 0.33, 0.17], 0.8);
    let center = above(2.05);
    let mut roof = Model::default();
    for side in [-1.0, 1.0] {
        roof.block(oak, Vec3::new(0.0, -0.075, side * 0.5 * DEPTH), Vec3::new(WIDTH + 0.2, 0.10, 0.06));
        for end in [-1.0, 1.0] {
            let post = Vec3::new(end * 0.5 * WIDTH, -0.5 * center.y - 0.0675, side * 0.5 * DEPTH);
            roof.block(oak, post, Vec3::new(0.08, center.y - 0.115, 0.08));
        }
    }
    for i in -4..4 {
        let x = 0.4 * (i as f32 + 0.5);
        roof.block(oak, Vec3::new(x, -0.01, 0.0), Vec3::new(0.15, 0.028, DEPTH + 0.3));
    }
    let roof = roof.finish(scene, "roof");
    scene.place_all(&roof, Mat4::from_translation(center));
}

/// Square panels on the arms of a mast that stands aside.
fn panels(scene: &mut Builder, random: &mut Random) {
    const SPACING: f32 = 0.86;
    let colors = [("brick", [0.56, 0.20, 0.12]), ("ochre", [0.62, 0.44, 0.16]), ("sage", [0.30, 0.38, 0.24])]
        .map(|(name, color)| scene.material(name, color, 0.7));
    let iron = scene.material("mast", [0.12, 0.13, 0.14], 0.5);
    let center = above(3.5);
    let mut panels = Model::default();
    for row in -1_i32..=1 {
        for column in -1..=1 {
            let middle = Vec3::new(SPACING * column as f32, 0.0, SPACING * row as f32);
            let turn = Mat4::from_rotation_y(random.around(0.06));
            let material = colors[(row + 2 * column + 3) as usize % 3];
            let panel = shapes::cuboid(Vec3::new(0.62, 0.02, 0.62));
            panels.add(material, &panel, Mat4::from_translation(middle) * turn);
        }
        let arm = |x: f32| Vec3::new(x, -0.034, SPACING * row as f32);
        panels.rod(iron, [arm(-1.3), arm(1.2)], 0.022, 12);
    }
    let high = |z: f32| Vec3::new(-1.3, -0.034, z);
    panels.rod(iron, [high(-1.0), high(1.0)], 0.035, 16);
    let foot = Vec3::new(-1.3, -center.y - 0.02, 0.0);
    panels.put(
        iron,
        &shapes::turned(&[[0.24, foot.y], [0.24, foot.y + 0.06], [0.06, foot.y + 0.10], [0.045, -0.036]], 24),
    );
    let panels = panels.finish(scene, "panels");
    scene.place_all(&panels, Mat4::from_translation(center));
}
