//! A backyard [Annen et al. 2008, "Exponential shadow maps", figures 1, 8 and 10]: a shed, a picket
//! fence, trees, and what people leave lying about. Much touches much: a shadow that begins a
//! millimetre from its caster is beside one that has crossed the whole yard.

use super::{
    Procedural,
    model::Model,
    plants, props,
    random::Random,
    shapes::{self, Builder},
    shed::{self, Paint},
    tree::{self, Generation},
};
use crate::{Camera, Light, Mesh, Projection, Scene};
use glam::{Mat4, Quat, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, TAU};

pub(super) const BACKYARD: Procedural = Procedural {
    name: "backyard",
    description: "a shed, a picket fence, trees, a bicycle and garden furniture in low sun",
    stresses: "contact points everywhere, long thin shadows, edges at many depths, dense foliage",
    source: "Annen et al. 2008, Exponential shadow maps, figures 1, 8 and 10",
    triangles: 363_375,
    build,
};

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("backyard");
    let lawn = scene.material("lawn", [0.21, 0.26, 0.11], 0.95);
    let ground = scene.mesh("ground", shapes::ground(26.0), lawn);
    scene.place(ground, Mat4::IDENTITY);
    fence(&mut scene, &mut random);
    shed_and_ladder(&mut scene, &mut random);
    furniture(&mut scene, &mut random);
    clutter(&mut scene, &mut random);
    trees(&mut scene, &mut random);
    grass(&mut scene, &mut random);
    scene.finish(
        Camera {
            position: Vec3::new(-0.9, 2.9, 9.6),
            target: Vec3::new(0.25, 0.75, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.64 },
        },
        Light::Directional { direction: Vec3::new(0.80, -0.62, -0.50).normalize() },
    )
}

/// Places a model on the ground at (x, z), turned about the vertical.
fn stand(scene: &mut Builder, model: &[usize], [x, z]: [f32; 2], turn: f32) {
    scene.place_all(model, Mat4::from_translation(Vec3::new(x, 0.0, z)) * Mat4::from_rotation_y(turn));
}

/// White pickets on two rails behind the yard and on its left.
fn fence(scene: &mut Builder, random: &mut Random) {
    let white = scene.material("white paint", [0.66, 0.65, 0.61], 0.7);
    let outline = [[-0.04, -0.03], [0.04, -0.03], [0.04, 1.0], [0.0, 1.08], [-0.04, 1.0]];
    let picket = scene.mesh("picket", shapes::extruded(&outline, 0.018), white);
    let rail = scene.mesh("rail", shapes::cuboid(Vec3::new(1.0, 0.07, 0.035)), white);
    let post = scene.mesh("post", shapes::cuboid(Vec3::new(0.09, 1.25, 0.09)), white);
    for ([a, b], [c, d]) in [([-5.4, -5.6], [9.4, -5.6]), ([-5.4, 7.4], [-5.4, -5.6])] {
        let (from, to) = (Vec2::new(a, b), Vec2::new(c, d));
        let (length, along) = (from.distance(to), (to - from).normalize());
        let turn = Quat::from_rotation_y(-along.y.atan2(along.x));
        let at = |distance: f32, y: f32, aside: f32| {
            let p = from + along * distance + along.perp() * aside;
            Vec3::new(p.x, y, p.y)
        };
        for y in [0.28, 0.78] {
            let stretch = Vec3::new(length, 1.0, 1.0);
            let place = at(0.5 * length, y, 0.0);
            scene.place(rail, Mat4::from_scale_rotation_translation(stretch, turn, place));
        }
        for i in 0..(length / 0.125) as u32 {
            let lean = Quat::from_rotation_z(random.around(0.02));
            let place = at(0.125 * (i as f32 + 0.5), random.around(0.012), 0.0265);
            scene.place(picket, Mat4::from_rotation_translation(turn * lean, place));
        }
        for i in 0..=(length / 2.1) as u32 {
            scene.place(post, Mat4::from_rotation_translation(turn, at(2.1 * i as f32, 0.6, -0.062)));
        }
    }
}

/// The shed at the back on the right; a ladder, planks and the bicycle lean on it.
fn shed_and_ladder(scene: &mut Builder, random: &mut Random) {
    let paint = Paint {
        boards: scene.material("barn red", [0.36, 0.12, 0.08], 0.8),
        trim: scene.material("cream", [0.64, 0.59, 0.48], 0.7),
        door: scene.material("teal", [0.13, 0.29, 0.29], 0.7),
        glass: scene.material("dark glass", [0.05, 0.07, 0.08], 0.2),
        roof: scene.material("shingles", [0.26, 0.24, 0.23], 0.9),
    };
    let wood = scene.material("weathered wood", [0.44, 0.36, 0.27], 0.9);
    let rubber = scene.material("rubber", [0.05, 0.05, 0.05], 0.8);
    let steel = scene.material("steel", [0.42, 0.43, 0.44], 0.4);
    let mustard = scene.material("mustard", [0.62, 0.42, 0.08], 0.4);
    let world = Mat4::from_translation(Vec3::new(2.55, 0.0, -2.3)) * Mat4::from_rotation_y(0.33);
    let shed = shed::shed(paint, random).finish(scene, "shed");
    scene.place_all(&shed, world);
    // In the shed's own axes: its left wall is at x = −1.5, the door's at z = 1.2.
    let ladder = props::ladder(wood, 9).finish(scene, "ladder");
    let lean = Mat4::from_translation(Vec3::new(-2.32, -0.02, -0.55)) * Mat4::from_rotation_y(FRAC_PI_2);
    scene.place_all(&ladder, world * lean * Mat4::from_rotation_x(0.24));
    let bicycle = props::bicycle(mustard, rubber, steel).finish(scene, "bicycle");
    let lean = Mat4::from_translation(Vec3::new(-1.83, -0.004, 0.42)) * Mat4::from_rotation_y(-FRAC_PI_2);
    scene.place_all(&bicycle, world * lean * Mat4::from_rotation_x(0.13));
    let mut planks = Model::default();
    for (i, x) in [1.58, 1.74, 1.95].into_iter().enumerate() {
        let foot = Vec3::new(x, 0.003, 0.75 - 0.3 * i as f32);
        let top = Vec3::new(1.535, 1.5 + 0.2 * i as f32, foot.z - 0.02);
        planks.board(wood, [foot, top], [0.2, 0.025], Vec3::X);
    }
    let planks = planks.finish(scene, "planks");
    scene.place_all(&planks, world);
}

/// A table, chairs and a wheelbarrow.
fn furniture(scene: &mut Builder, random: &mut Random) {
    let teak = scene.material("teak", [0.50, 0.31, 0.16], 0.8);
    let blue = scene.material("blue paint", [0.20, 0.36, 0.50], 0.6);
    let iron = scene.material("iron", [0.10, 0.11, 0.11], 0.5);
    let rubber = scene.material("tyre", [0.05, 0.05, 0.05], 0.8);
    let green = scene.material("green enamel", [0.12, 0.27, 0.17], 0.4);
    let table = props::table(teak, iron).finish(scene, "table");
    stand(scene, &table, [-2.2, 0.9], 0.4);
    let chair = props::chair(blue).finish(scene, "chair");
    for ([x, z], turn) in [([-3.15, 0.55], 1.15), ([-2.05, -0.1], 0.1), ([-1.55, 1.9], 3.6)] {
        stand(scene, &chair, [x, z], turn + random.around(0.1));
    }
    let fallen = Mat4::from_translation(Vec3::new(3.35, 0.29, 1.3)) * Mat4::from_rotation_y(0.5);
    scene.place_all(&chair, fallen * Mat4::from_rotation_z(FRAC_PI_2));
    let barrow = props::wheelbarrow(green, teak, rubber, iron).finish(scene, "wheelbarrow");
    stand(scene, &barrow, [0.75, 1.75], 0.55);
}

/// Pots, buckets, a watering can, logs, a ball and stepping stones.
fn clutter(scene: &mut Builder, random: &mut Random) {
    let clay = scene.material("terracotta", [0.50, 0.22, 0.12], 0.85);
    let earth = scene.material("earth", [0.12, 0.085, 0.06], 1.0);
    let zinc = scene.material("zinc", [0.46, 0.47, 0.48], 0.4);
    let bark = scene.material("log", [0.36, 0.26, 0.17], 0.9);
    let stone = scene.material("stone", [0.47, 0.45, 0.42], 0.9);
    let red = scene.material("red ball", [0.62, 0.09, 0.07], 0.4);
    let herb = scene.material("herb", [0.16, 0.27, 0.09], 0.8);
    let pot = props::pot(clay, earth).finish(scene, "pot");
    let bush = plants::leaves(&shapes::sphere(16, 8), -0.4, 420, 0.34, random);
    let bush = scene.mesh("bush", bush, herb);
    for (i, ([x, z], size)) in [
        ([1.15, -0.15], 0.40),
        ([1.55, 0.10], 0.30),
        ([2.95, -0.55], 0.46),
        ([3.45, -0.75], 0.34),
        ([-4.7, 1.9], 0.5),
        ([-4.8, 0.9], 0.42),
        ([-0.85, 3.15], 0.36),
    ]
    .into_iter()
    .enumerate()
    {
        let place = Mat4::from_translation(Vec3::new(x, 0.0, z))
            * Mat4::from_rotation_y(random.between(0.0, TAU))
            * Mat4::from_scale(Vec3::splat(size));
        scene.place_all(&pot, place);
        if i % 3 != 1 {
            let crown = Mat4::from_translation(Vec3::Y * 1.1) * Mat4::from_scale(Vec3::splat(0.55));
            scene.place(bush, place * crown);
        }
    }
    let upright = props::bucket(zinc, 1.35).finish(scene, "bucket");
    let lifted = props::bucket(zinc, 0.15).finish(scene, "bucket");
    stand(scene, &upright, [0.1, 0.55], 0.7);
    stand(scene, &lifted, [-3.7, 1.75], 1.9);
    let tipped = Mat4::from_translation(Vec3::new(1.95, 0.136, 2.15)) * Mat4::from_rotation_y(2.3);
    scene.place_all(&upright, tipped * Mat4::from_rotation_x(FRAC_PI_2 + 0.14));
    let can = props::watering_can(zinc).finish(scene, "watering can");
    stand(scene, &can, [-0.35, 2.45], 0.5);
    let ball = Mat4::from_translation(Vec3::new(1.25, 0.108, 3.2)) * Mat4::from_scale(Vec3::splat(0.11));
    let sphere = scene.mesh("ball", shapes::sphere(56, 28), red);
    scene.place(sphere, ball);
    logs(scene, random, bark);
    let slab = shapes::turned(&[[0.27, -0.02], [0.28, 0.02], [0.26, 0.035]], 14);
    let slab = scene.mesh("stepping stone", slab, stone);
    for Vec2 { x, y: z } in stepping_stones() {
        let place = Vec3::new(x, 0.0, z);
        let turn = Quat::from_rotation_y(random.between(0.0, TAU));
        let stretch = Vec3::new(random.between(0.85, 1.15), 1.0, random.between(0.85, 1.15));
        scene.place(slab, Mat4::from_scale_rotation_translation(stretch, turn, place));
    }
}

/// Where the stones of the path lie (x, z).
fn stepping_stones() -> impl Iterator<Item = Vec2> {
    (0..8).map(|i| {
        let along = i as f32 / 7.0;
        Vec2::new(0.9 - 1.2 * along + 0.35 * (along * 5.0).sin(), 0.3 + 5.4 * along)
    })
}

/// A pile of firewood along the fence on the left.
fn logs(scene: &mut Builder, random: &mut Random, bark: usize) {
    let log = shapes::turned(&[[0.1, -0.5], [0.105, -0.48], [0.095, 0.1], [0.1, 0.48], [0.095, 0.5]], 20);
    let log = scene.mesh("log", log, bark);
    for row in 0..5 {
        for i in 0..9 - row {
            let z = -2.6 + 0.205 * (i as f32 + 0.5 * row as f32);
            let y = 0.098 + 0.176 * row as f32;
            let place = Vec3::new(-4.65 + random.around(0.05), y, z);
            let turn = Quat::from_rotation_x(random.between(0.0, TAU)) * Quat::from_rotation_z(FRAC_PI_2);
            let size = Vec3::new(1.0, random.between(0.9, 1.1), 1.0);
            scene.place(log, Mat4::from_scale_rotation_translation(size, turn, place));
        }
    }
}

/// A bare tree in the yard, another outside on the left whose shadow crosses it, leafy ones behind.
fn trees(scene: &mut Builder, random: &mut Random) {
    let bark = scene.material("bark", [0.27, 0.21, 0.16], 0.9);
    let leaf = scene.material("leaves", [0.20, 0.30, 0.10], 0.8);
    let generation =
        |count, pieces, sides, length, spread| Generation { count, pieces, sides, length, spread };
    let bare = [
        generation(1, 8, 16, 2.3, 0.0),
        generation(8, 7, 9, 0.62, 0.8),
        generation(6, 5, 6, 0.55, 0.8),
        generation(5, 4, 5, 0.55, 0.8),
        generation(4, 3, 4, 0.6, 0.7),
    ];
    for (i, ([x, z], size)) in [([-3.5, -3.2], 1.0), ([-5.3, 5.7], 1.2)].into_iter().enumerate() {
        let mesh = tree::grow(&bare, 0.15, random);
        let mesh = scene.mesh(&format!("bare tree {i}"), mesh, bark);
        let place = Mat4::from_translation(Vec3::new(x, 0.0, z));
        scene.place(mesh, place * Mat4::from_scale(Vec3::splat(size)));
    }
    let leafy = [
        generation(1, 6, 14, 2.4, 0.0),
        generation(9, 5, 7, 0.65, 0.75),
        generation(6, 4, 5, 0.5, 0.8),
        generation(4, 3, 4, 0.5, 0.8),
    ];
    let wood: Mesh = tree::grow(&leafy, 0.16, random);
    let crown = plants::leaves(&wood, 1.6, 18_000, 0.12, random);
    let tree = [scene.mesh("leafy tree", wood, bark), scene.mesh("crown", crown, leaf)];
    for ([x, z], turn) in [([0.3, -7.4], 0.5), ([6.1, -6.9], 2.6), ([-6.8, -7.2], 4.0)] {
        stand(scene, &tree, [x, z], turn);
    }
}

/// Tufts along the fence and the shed, and some on the lawn.
fn grass(scene: &mut Builder, random: &mut Random) {
    let blade = scene.material("grass", [0.25, 0.35, 0.11], 0.9);
    let tufts: Vec<usize> = [0.1, 0.17, 0.26]
        .into_iter()
        .map(|height| {
            let mesh = plants::tuft(36, height, random);
            scene.mesh("tuft", mesh, blade)
        })
        .collect();
    let put = |scene: &mut Builder, kind: usize, [x, z]: [f32; 2], random: &mut Random| {
        let size = Mat4::from_scale(Vec3::splat(random.between(0.7, 1.2)));
        let turn = Mat4::from_rotation_y(random.between(0.0, TAU));
        scene.place(tufts[kind], Mat4::from_translation(Vec3::new(x, 0.0, z)) * turn * size);
    };
    for i in 0..110 {
        let z = -5.4 + 0.115 * i as f32 + random.around(0.08);
        put(scene, 1 + i % 2, [-5.25 + random.around(0.14), z], random);
        let x = -5.2 + 0.13 * i as f32 + random.around(0.08);
        put(scene, 1 + (i + 1) % 2, [x, -5.42 + random.around(0.14)], random);
    }
    let lawn = (0..).map(|_| Vec2::new(random.between(-5.0, 7.5), random.between(-5.2, 6.5)));
    let free = |p: &Vec2| stepping_stones().all(|stone| stone.distance(*p) > 0.34);
    let places: Vec<Vec2> = lawn.filter(free).take(900).collect();
    for (i, place) in places.into_iter().enumerate() {
        put(scene, usize::from(i % 9 == 0), place.to_array(), random);
    }
}
