//! A fenced yard [Annen et al. 2007, "Convolution shadow maps", figure 9]: light passes 760 thin bars
//! before it reaches objects, trees and the ground behind, so that a texel of the map holds many
//! depths and techniques that keep two moments leak light behind the fence.

use super::{
    Procedural,
    random::Random,
    shapes::{self, Builder},
    tree::{self, Generation},
};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Quat, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, TAU};

pub(super) const FENCE: Procedural = Procedural {
    name: "fence",
    description: "a yard behind 760 iron bars: stones, crates, rings and leafless trees",
    stresses: "thin casters, high depth complexity, light leaks behind the fence, contact points",
    source: "Annen et al. 2007, Convolution shadow maps, figure 9",
    triangles: 363_862,
    build,
};

/// Distance between the axes of neighbouring bars.
const SPACING: f32 = 0.1;
/// Height of the bars' tips.
const HEIGHT: f32 = 1.75;
/// Runs of the fence on the ground: from, to (x, z). Their lengths make 760 bars.
const RUNS: [([f32; 2], [f32; 2]); 5] = [
    ([-9.0, 6.0], [9.0, 6.0]),
    ([-9.0, 6.0], [-9.0, -6.0]),
    ([9.0, -6.0], [9.0, 6.0]),
    ([-9.0, -6.0], [9.0, -6.0]),
    ([-6.0, 1.5], [10.0, 1.5]),
];

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("fence");
    let gravel = scene.material("gravel", [0.50, 0.47, 0.42], 0.95);
    let ground = scene.mesh("ground", shapes::ground(30.0), gravel);
    scene.place(ground, Mat4::IDENTITY);
    fence(&mut scene, &mut random);
    objects(&mut scene, &mut random);
    trees(&mut scene, &mut random);
    scene.finish(
        Camera {
            position: Vec3::new(2.4, 3.3, 12.2),
            target: Vec3::new(0.3, 0.85, 1.6),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.62 },
        },
        Light::Directional { direction: Vec3::new(0.62, -0.62, -0.72).normalize() },
    )
}

/// Bars with spear tips, two rails and posts along each run.
fn fence(scene: &mut Builder, random: &mut Random) {
    let iron = scene.material("painted iron", [0.10, 0.14, 0.15], 0.5);
    let tip = HEIGHT;
    let bar = shapes::turned(
        &[
            [0.011, -0.05],
            [0.011, tip - 0.20],
            [0.019, tip - 0.19],
            [0.019, tip - 0.17],
            [0.011, tip - 0.16],
            [0.011, tip - 0.12],
            [0.024, tip - 0.085],
            [0.0, tip],
        ],
        14,
    );
    let bar = scene.mesh("bar", bar, iron);
    let post = shapes::turned(
        &[[0.055, -0.05], [0.055, 1.8], [0.075, 1.81], [0.075, 1.85], [0.04, 1.87], [0.06, 1.93], [0.0, 2.0]],
        24,
    );
    let post = scene.mesh("post", post, iron);
    let rail = scene.mesh("rail", shapes::cuboid(Vec3::new(1.0, 0.035, 0.014)), iron);
    for (from, to) in RUNS {
        let (from, to) = (Vec2::from(from), Vec2::from(to));
        let along = (to - from).normalize();
        let length = from.distance(to);
        let at = |distance: f32, height: f32| {
            let p = from + along * distance;
            Vec3::new(p.x, height, p.y)
        };
        let turn = Quat::from_rotation_y(-along.y.atan2(along.x));
        for height in [0.18, 1.38] {
            let stretch = Vec3::new(length, 1.0, 1.0);
            scene.place(rail, Mat4::from_scale_rotation_translation(stretch, turn, at(length * 0.5, height)));
        }
        for i in 0..=(length / 2.0).round() as u32 {
            scene.place(post, Mat4::from_translation(at(2.0 * i as f32, 0.0)));
        }
        for i in 0..(length / SPACING).round() as u32 {
            let lean =
                Quat::from_rotation_x(random.around(0.008)) * Quat::from_rotation_z(random.around(0.008));
            let spin = Quat::from_rotation_y(random.between(0.0, TAU));
            let size = Vec3::new(1.0, random.between(0.985, 1.015), 1.0);
            let place = at((i as f32 + 0.5) * SPACING, 0.0);
            scene.place(bar, Mat4::from_scale_rotation_translation(size, lean * spin, place));
        }
    }
}

/// Places a mesh at (x, z) with its origin `y` above the ground, turned about the vertical.
fn stand(scene: &mut Builder, mesh: usize, [x, y, z]: [f32; 3], turn: f32) {
    scene.place(mesh, Mat4::from_translation(Vec3::new(x, y, z)) * Mat4::from_rotation_y(turn));
}

/// Balls and rings on plinths, stacked crates, leaning planks, urns.
fn objects(scene: &mut Builder, random: &mut Random) {
    let stone = scene.material("limestone", [0.60, 0.57, 0.51], 0.9);
    let wood = scene.material("crate wood", [0.47, 0.32, 0.18], 0.85);
    let clay = scene.material("terracotta", [0.50, 0.23, 0.14], 0.8);
    let glaze = scene.material("blue glaze", [0.16, 0.27, 0.34], 0.35);
    let ochre = scene.material("ochre", [0.58, 0.42, 0.16], 0.6);

    let plinth = shapes::turned(
        &[
            [0.42, -0.02],
            [0.42, 0.12],
            [0.36, 0.16],
            [0.30, 0.20],
            [0.28, 0.55],
            [0.30, 0.60],
            [0.38, 0.64],
            [0.38, 0.72],
        ],
        48,
    );
    let plinth = scene.mesh("plinth", plinth, stone);
    let ball = scene.mesh("ball", shapes::sphere(72, 36), glaze);
    let stone_ball = scene.mesh("stone ball", shapes::sphere(72, 36), stone);
    let ring = scene.mesh("ring", shapes::torus(0.52, 0.13, 96, 32), ochre);
    for (place, [x, z]) in [[-3.9, 3.9], [-0.6, 3.6], [3.2, 4.0], [5.6, -1.2]].into_iter().enumerate() {
        stand(scene, plinth, [x, 0.0, z], random.between(0.0, TAU));
        let top = 0.715;
        if place % 2 == 0 {
            let lift = Mat4::from_translation(Vec3::new(x, top + 0.45, z));
            scene.place(ball, lift * Mat4::from_scale(Vec3::splat(0.45)));
        } else {
            let upright = Mat4::from_rotation_y(random.between(-0.5, 0.9)) * Mat4::from_rotation_x(FRAC_PI_2);
            scene.place(ring, Mat4::from_translation(Vec3::new(x, top + 0.64, z)) * upright);
        }
    }
    for ([x, z], radius) in [([-2.2, 2.5], 0.34), ([1.3, 2.7], 0.26), ([7.3, 4.2], 0.5), ([-7.6, -2.0], 0.6)]
    {
        let at = Mat4::from_translation(Vec3::new(x, radius - 0.004, z));
        scene.place(stone_ball, at * Mat4::from_scale(Vec3::splat(radius)));
    }
    crates(scene, random, wood);
    let urn = shapes::turned(&urn_profile(), 64);
    let urn = scene.mesh("urn", urn, clay);
    for [x, z] in [[-4.9, 4.9], [0.7, 4.4], [2.1, 2.3], [6.6, 2.9], [3.6, -0.6], [-5.2, -0.2]] {
        stand(scene, urn, [x, 0.0, z], random.between(0.0, TAU));
    }
}

/// Crates, some on others, and planks that lean on one.
fn crates(scene: &mut Builder, random: &mut Random, wood: usize) {
    let size = 0.8;
    let crate_mesh = scene.mesh("crate", shapes::cuboid(Vec3::splat(size)), wood);
    for [x, level, z] in [
        [-6.6, 0.0, 3.2],
        [-5.7, 0.0, 3.0],
        [-6.2, 1.0, 3.1],
        [5.0, 0.0, 3.1],
        [-2.9, 0.0, -1.0],
        [-2.7, 1.0, -1.0],
    ] {
        let y = size * (0.5 + level) - 0.004 * (1.0 + level);
        stand(scene, crate_mesh, [x, y, z], random.around(0.35));
    }
    let plank = scene.mesh("plank", shapes::cuboid(Vec3::new(0.24, 1.7, 0.04)), wood);
    for x in [4.72, 5.06, 5.4] {
        // Leans on the crate's back half: its lower edge touches the ground.
        let lean = Mat4::from_rotation_y(0.1) * Mat4::from_rotation_x(-0.52);
        scene.place(plank, Mat4::from_translation(Vec3::new(x, 0.742, 3.98)) * lean);
    }
}

/// Outline of an urn: a foot, a belly, a neck with a lip, and an inside.
fn urn_profile() -> Vec<[f32; 2]> {
    let belly = (0..=16).map(|i| {
        let t = i as f32 / 16.0;
        [0.13 + 0.20 * (t * 2.7).sin().powf(1.2), 0.06 + 0.58 * t]
    });
    let outside = [[0.18, -0.01], [0.18, 0.03]].into_iter().chain(belly);
    let lip =
        [[0.23, 0.70], [0.25, 0.72], [0.23, 0.74], [0.19, 0.72], [0.18, 0.60], [0.26, 0.35], [0.10, 0.08]];
    let inside = [0.0, 0.08];
    outside.chain(lip).chain([inside]).collect()
}

/// Three trees and some shrubs that share a mesh.
fn trees(scene: &mut Builder, random: &mut Random) {
    let bark = scene.material("bark", [0.26, 0.20, 0.15], 0.9);
    let generation =
        |count, pieces, sides, length, spread| Generation { count, pieces, sides, length, spread };
    let tree = [
        generation(1, 8, 14, 2.6, 0.0),
        generation(8, 6, 9, 0.55, 0.85),
        generation(5, 5, 6, 0.55, 0.8),
        generation(5, 4, 5, 0.55, 0.8),
        generation(4, 3, 4, 0.6, 0.7),
    ];
    for (i, [x, z]) in [[-7.0, 0.2], [2.6, 0.2], [7.1, -3.2]].into_iter().enumerate() {
        let mesh = tree::grow(&tree, 0.14, random);
        let mesh = scene.mesh(&format!("tree {i}"), mesh, bark);
        stand(scene, mesh, [x, 0.0, z], 0.0);
        if i == 0 {
            // Out of the picture on the left: its shadow falls through the fence into the yard.
            stand(scene, mesh, [-4.7, 0.0, 8.4], 2.0);
        }
    }
    let shrub = [
        generation(1, 3, 8, 0.5, 0.0),
        generation(7, 4, 6, 1.3, 0.6),
        generation(5, 3, 5, 0.6, 0.7),
        generation(4, 3, 4, 0.6, 0.7),
    ];
    let shrub = tree::grow(&shrub, 0.035, random);
    let shrub = scene.mesh("shrub", shrub, bark);
    for [x, z] in
        [[-1.9, 4.6], [4.4, 4.8], [-4.4, 2.2], [7.9, 0.6], [0.2, -2.6], [-8.0, 4.8], [6.4, 5.1], [-0.4, 0.3]]
    {
        stand(scene, shrub, [x, 0.0, z], random.between(0.0, TAU));
    }
}
