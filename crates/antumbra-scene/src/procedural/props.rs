//! Things that lie about in a garden. Each stands on y = 0, sunk by a few millimetres, and is as
//! closed as the real thing.

use super::{model::Model, shapes};
use glam::{Mat4, Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, PI, TAU};

/// Points of an arc from `start` to `end` (radians) about the z axis.
fn arc(center: Vec3, radius: f32, [start, end]: [f32; 2], pieces: u32) -> Vec<Vec3> {
    let angle = |i: u32| start + (end - start) * i as f32 / pieces as f32;
    (0..=pieces).map(|i| center + radius * Vec3::new(angle(i).cos(), angle(i).sin(), 0.0)).collect()
}

/// A slatted garden chair that faces +z, 0.56 m wide.
pub(super) fn chair(wood: usize) -> Model {
    let mut chair = Model::default();
    for i in 0..6 {
        let z = -0.2 + 0.082 * i as f32;
        let y = 0.405 + 0.01 * i as f32;
        let ends = [Vec3::new(-0.26, y, z), Vec3::new(0.26, y, z)];
        chair.board(wood, ends, [0.066, 0.018], Vec3::new(0.0, 1.0, -0.12));
    }
    for i in 0..6 {
        let x = -0.215 + 0.086 * i as f32;
        let top = 0.95 - 0.006 * ((i as f32 - 2.5) * 2.0).powi(2);
        chair.board(
            wood,
            [Vec3::new(x, 0.40, -0.262), Vec3::new(x * 1.1, top, -0.455)],
            [0.062, 0.016],
            Vec3::Z,
        );
    }
    for y in [0.50, 0.80] {
        let z = -0.288 - 0.35 * (y - 0.40);
        let ends = [Vec3::new(-0.25, y, z), Vec3::new(0.25, y, z)];
        chair.board(wood, ends, [0.05, 0.02], Vec3::new(0.0, 0.3, 1.0));
    }
    for side in [-1.0, 1.0] {
        let x = 0.272 * side;
        let leg = |z: f32, top: f32, lean: f32| [Vec3::new(x, -0.004, z + lean), Vec3::new(x, top, z)];
        chair.board(wood, leg(0.21, 0.63, 0.03), [0.05, 0.024], Vec3::X);
        chair.board(wood, leg(-0.30, 0.66, -0.06), [0.05, 0.024], Vec3::X);
        let rail = [Vec3::new(0.95 * x, 0.375, -0.33), Vec3::new(0.95 * x, 0.43, 0.24)];
        chair.board(wood, rail, [0.05, 0.02], Vec3::X);
        let arm = [Vec3::new(x, 0.645, -0.36), Vec3::new(x, 0.66, 0.28)];
        chair.board(wood, arm, [0.085, 0.022], Vec3::Y);
    }
    chair
}

/// A round garden table of slats on crossed legs, 0.72 m high.
pub(super) fn table(wood: usize, iron: usize) -> Model {
    let mut table = Model::default();
    for i in -5..=5 {
        let x = 0.09 * i as f32;
        let half = (0.54_f32.powi(2) - x * x).sqrt() - 0.03;
        table.board(wood, [Vec3::new(x, 0.71, -half), Vec3::new(x, 0.71, half)], [0.074, 0.02], Vec3::Y);
    }
    let ring: Vec<Vec3> = (0..=32)
        .map(|i| Quat::from_rotation_y(TAU * (i % 32) as f32 / 32.0) * Vec3::new(0.5, 0.688, 0.0))
        .collect();
    table.rods(iron, &ring, 0.01, 8);
    for i in 0..4 {
        let turn = Quat::from_rotation_y(FRAC_PI_2 * (i as f32 + 0.5));
        let leg = [Vec3::new(0.46, -0.004, 0.02), Vec3::new(0.03, 0.36, 0.02), Vec3::new(0.46, 0.69, 0.02)];
        table.rods(iron, &leg.map(|p| turn * p), 0.012, 8);
    }
    table
}

/// A bucket with its handle up or down (an angle from the vertical), 0.27 m high.
pub(super) fn bucket(metal: usize, handle: f32) -> Model {
    let mut bucket = Model::default();
    let outside = [[0.095, -0.003], [0.10, 0.005], [0.135, 0.25], [0.143, 0.26], [0.140, 0.272]];
    let inside = [[0.130, 0.268], [0.092, 0.02], [0.0, 0.02]];
    bucket.put(metal, &shapes::turned(&[&outside[..], &inside].concat(), 40));
    let lift = Quat::from_rotation_x(handle);
    let bail: Vec<Vec3> =
        arc(Vec3::ZERO, 0.146, [0.0, PI], 20).into_iter().map(|p| Vec3::Y * 0.245 + lift * p).collect();
    bucket.rods(metal, &bail, 0.004, 6);
    bucket
}

/// A flower pot with earth in it, 1 m across its rim: scale it.
pub(super) fn pot(clay: usize, earth: usize) -> Model {
    let mut pot = Model::default();
    let outside = [[0.32, -0.01], [0.33, 0.0], [0.44, 0.66], [0.5, 0.67], [0.5, 0.86], [0.48, 0.88]];
    let inside = [[0.43, 0.88], [0.41, 0.74]];
    let profile: Vec<[f32; 2]> =
        outside.into_iter().chain(inside).chain([[0.39, 0.60], [0.0, 0.60]]).collect();
    pot.put(clay, &shapes::turned(&profile, 48));
    pot.put(earth, &shapes::turned(&[[0.405, 0.64], [0.405, 0.74], [0.2, 0.77], [0.0, 0.78]], 40));
    pot
}

/// A bicycle along x that leans to −z by `lean` radians: its handlebar is at +x.
pub(super) fn bicycle(paint: usize, rubber: usize, steel: usize) -> Model {
    let mut bicycle = Model::default();
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let (rear, front, crank) = (at(-0.52, 0.335, 0.0), at(0.54, 0.335, 0.0), at(-0.08, 0.29, 0.0));
    let upright = Mat4::from_rotation_x(FRAC_PI_2);
    for hub in [rear, front] {
        let place = Mat4::from_translation(hub) * upright;
        bicycle.add(rubber, &shapes::torus(0.325, 0.014, 72, 12), place);
        bicycle.add(steel, &shapes::torus(0.303, 0.011, 72, 8), place);
        bicycle.rod(steel, [hub - Vec3::Z * 0.055, hub + Vec3::Z * 0.055], 0.018, 16);
        for i in 0..28 {
            let angle = TAU * i as f32 / 28.0;
            let side = if i % 2 == 0 { 0.03 } else { -0.03 };
            let foot = hub + Quat::from_rotation_z(angle + 0.9) * at(0.017, 0.0, side);
            bicycle.rod(steel, [foot, hub + Quat::from_rotation_z(angle) * at(0.3, 0.0, 0.0)], 0.0016, 5);
        }
    }
    let (seat, head, fork) = (at(-0.235, 0.78, 0.0), at(0.37, 0.83, 0.0), at(0.405, 0.69, 0.0));
    for (ends, radius) in [
        ([crank, at(-0.26, 0.86, 0.0)], 0.016),
        ([seat, head - Vec3::Y * 0.04], 0.015),
        ([fork, crank], 0.018),
        ([fork, at(0.36, 0.9, 0.0)], 0.019),
    ] {
        bicycle.rod(paint, ends, radius, 16);
    }
    for side in [-1.0, 1.0] {
        let beside = |p: Vec3, z: f32| p + Vec3::Z * side * z;
        bicycle.rod(paint, [beside(crank, 0.03), beside(rear, 0.06)], 0.009, 12);
        bicycle.rod(paint, [beside(seat, 0.015), beside(rear, 0.06)], 0.008, 12);
        bicycle.rods(paint, &[fork, beside(at(0.42, 0.66, 0.0), 0.05), beside(front, 0.06)], 0.01, 12);
        let bar = [at(0.36, 0.955, 0.0), at(0.4, 0.98, 0.12), at(0.36, 0.985, 0.24), at(0.22, 0.96, 0.29)];
        bicycle.rods(steel, &bar.map(|p| at(p.x, p.y, side * p.z)), 0.011, 12);
        let pedal = crank + at(0.12 * side, -0.11 * side, 0.0);
        bicycle.rod(steel, [beside(crank, 0.07), beside(pedal, 0.07)], 0.009, 8);
        bicycle.block(rubber, beside(pedal, 0.12), at(0.09, 0.022, 0.085));
    }
    bicycle.rod(steel, [at(0.36, 0.89, 0.0), at(0.36, 0.96, 0.0)], 0.013, 12);
    bicycle.rod(steel, [crank - Vec3::Z * 0.07, crank + Vec3::Z * 0.07], 0.014, 12);
    let ring = Mat4::from_translation(crank + Vec3::Z * 0.045) * upright;
    bicycle.add(steel, &shapes::torus(0.085, 0.006, 48, 8), ring);
    let saddle = Mat4::from_translation(at(-0.27, 0.9, 0.0)) * Mat4::from_scale(at(0.14, 0.035, 0.08));
    bicycle.add(rubber, &shapes::sphere(28, 14), saddle);
    bicycle
}

/// A wheelbarrow along x, its wheel at +x.
pub(super) fn wheelbarrow(paint: usize, wood: usize, rubber: usize, steel: usize) -> Model {
    let mut barrow = Model::default();
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let wheel = Mat4::from_translation(at(0.62, 0.19, 0.0)) * Mat4::from_rotation_x(FRAC_PI_2);
    barrow.add(rubber, &shapes::torus(0.16, 0.034, 48, 16), wheel);
    barrow.rod(steel, [at(0.62, 0.19, -0.13), at(0.62, 0.19, 0.13)], 0.012, 10);
    for i in 0..6 {
        let spoke = Quat::from_rotation_z(TAU * i as f32 / 6.0) * at(0.14, 0.0, 0.0);
        barrow.rod(steel, [at(0.62, 0.19, 0.0), at(0.62, 0.19, 0.0) + spoke], 0.008, 8);
    }
    for side in [-1.0, 1.0] {
        let ends = [at(0.66, 0.2, 0.12 * side), at(-0.85, 0.50, 0.30 * side)];
        barrow.board(wood, ends, [0.04, 0.05], Vec3::Y);
        let leg = [at(-0.22, 0.37, 0.23 * side), at(-0.34, -0.003, 0.25 * side)];
        barrow.rod(steel, leg, 0.014, 10);
        barrow.rod(steel, [at(0.05, 0.33, 0.2 * side), leg[1] + Vec3::Y * 0.08], 0.011, 10);
        // The sides of the tray lean outwards.
        let middle = [at(-0.45, 0.53, 0.32 * side), at(0.55, 0.53, 0.28 * side)];
        barrow.board(paint, middle, [0.29, 0.012], at(0.0, 0.55, -side));
    }
    barrow.board(paint, [at(-0.34, 0.42, 0.0), at(0.42, 0.42, 0.0)], [0.48, 0.012], Vec3::Y);
    for (x, lean) in [(-0.42, -0.55), (0.50, 0.75)] {
        let ends = [at(x, 0.53, -0.31), at(x, 0.53, 0.31)];
        barrow.board(paint, ends, [0.27, 0.012], at(1.0, -lean, 0.0));
    }
    barrow
}

/// A ladder that stands upright: `rungs` of them 0.28 m apart, 0.42 m wide.
pub(super) fn ladder(wood: usize, rungs: u32) -> Model {
    let mut ladder = Model::default();
    let height = 0.28 * (rungs + 1) as f32;
    for x in [-0.21, 0.21] {
        ladder.board(wood, [Vec3::new(x, 0.0, 0.0), Vec3::new(x * 0.85, height, 0.0)], [0.03, 0.06], Vec3::Z);
    }
    for i in 1..=rungs {
        let y = 0.28 * i as f32;
        ladder.rod(wood, [Vec3::new(-0.2, y, 0.0), Vec3::new(0.2, y, 0.0)], 0.014, 12);
    }
    ladder
}

/// A watering can with its spout at +x, 0.3 m high.
pub(super) fn watering_can(metal: usize) -> Model {
    let mut can = Model::default();
    let at = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    let body = [[0.115, -0.003], [0.12, 0.01], [0.12, 0.24], [0.10, 0.27], [0.06, 0.275], [0.055, 0.25]];
    can.put(metal, &shapes::turned(&body, 40));
    can.rods(metal, &[at(0.10, 0.05), at(0.24, 0.18), at(0.34, 0.33)], 0.016, 14);
    let rose = Mat4::from_translation(at(0.335, 0.325)) * Mat4::from_rotation_z(-0.75);
    can.add(metal, &shapes::turned(&[[0.016, 0.0], [0.045, 0.04], [0.045, 0.05]], 24), rose);
    can.rods(metal, &arc(at(-0.07, 0.2), 0.12, [FRAC_PI_2 * 0.5, PI * 1.35], 18), 0.008, 8);
    can
}
