//! A garden shed of lapped boards under a shingled roof.

use super::{model::Model, random::Random, shapes};
use glam::{Mat4, Vec3};

/// Half the width (x) and depth (z), height of the eaves and of the ridge, which runs along z.
const HALF: [f32; 2] = [1.45, 1.15];
const EAVES: f32 = 1.95;
const RIDGE: f32 = 2.85;
/// Height that one lapped board shows.
const LAP: f32 = 0.14;

/// Materials of a shed.
#[derive(Debug, Clone, Copy)]
pub(super) struct Paint {
    pub(super) boards: usize,
    pub(super) trim: usize,
    pub(super) door: usize,
    pub(super) glass: usize,
    pub(super) roof: usize,
}

/// Its door faces +z.
pub(super) fn shed(paint: Paint, random: &mut Random) -> Model {
    let mut shed = Model::default();
    let [w, d] = HALF;
    // A solid core behind the boards keeps light out.
    let core = [[-w, -0.02], [w, -0.02], [w, EAVES], [0.0, RIDGE], [-w, EAVES]];
    shed.put(paint.boards, &shapes::extruded(&core, 2.0 * d));
    boards(&mut shed, paint.boards);
    for x in [-w, w] {
        for z in [-d, d] {
            let corner = Vec3::new(x + 0.022 * x.signum(), 0.5 * EAVES - 0.01, z + 0.022 * z.signum());
            shed.block(paint.trim, corner, Vec3::new(0.09, EAVES, 0.09));
        }
    }
    door(&mut shed, paint);
    window(&mut shed, paint);
    roof(&mut shed, paint, random);
    shed
}

/// Boards around, each leaning out over the one below.
fn boards(shed: &mut Model, material: usize) {
    let [w, d] = HALF;
    let rows = ((RIDGE - 0.1) / LAP) as u32;
    for row in 0..rows {
        let y = LAP * (row as f32 + 0.5);
        let top = y + 0.5 * LAP;
        let half = if top < EAVES { w } else { w * (RIDGE - top) / (RIDGE - EAVES) - 0.03 };
        if half < 0.1 {
            break;
        }
        for side in [-1.0, 1.0] {
            let z = side * (d + 0.014);
            let face = Vec3::new(0.0, -0.16, side);
            shed.board(material, [Vec3::new(-half, y, z), Vec3::new(half, y, z)], [LAP + 0.02, 0.016], face);
            if top < EAVES {
                let x = side * (w + 0.014);
                let face = Vec3::new(side, -0.16, 0.0);
                shed.board(material, [Vec3::new(x, y, -d), Vec3::new(x, y, d)], [LAP + 0.02, 0.016], face);
            }
        }
    }
}

/// A boarded door with two ledges, a brace, hinges and a handle.
fn door(shed: &mut Model, paint: Paint) {
    let z = HALF[1] + 0.045;
    let left = -0.95;
    for i in 0..6 {
        let x = left + 0.075 + 0.145 * i as f32;
        shed.block(paint.door, Vec3::new(x, 0.93, z), Vec3::new(0.137, 1.82, 0.03));
    }
    let [a, b] = [left - 0.045, left + 0.92];
    for x in [a, b] {
        shed.block(paint.trim, Vec3::new(x, 0.95, z), Vec3::new(0.075, 1.9, 0.06));
    }
    shed.block(paint.trim, Vec3::new(0.5 * (a + b), 1.94, z), Vec3::new(b - a + 0.16, 0.08, 0.075));
    let front = z + 0.026;
    for y in [0.35, 1.5] {
        shed.block(paint.door, Vec3::new(left + 0.437, y, front), Vec3::new(0.83, 0.11, 0.028));
        shed.block(paint.glass, Vec3::new(left + 0.19, y, front + 0.018), Vec3::new(0.36, 0.035, 0.012));
    }
    let brace = [Vec3::new(left + 0.06, 0.43, front - 0.003), Vec3::new(left + 0.8, 1.42, front - 0.003)];
    shed.board(paint.door, brace, [0.1, 0.026], Vec3::Z);
    shed.rod(
        paint.glass,
        [Vec3::new(left + 0.81, 0.92, front + 0.03), Vec3::new(left + 0.81, 1.08, front + 0.03)],
        0.012,
        12,
    );
}

/// A window of four panes with a sill.
fn window(shed: &mut Model, paint: Paint) {
    let (x, y, z) = (0.78, 1.25, HALF[1] + 0.04);
    shed.block(paint.glass, Vec3::new(x, y, z - 0.008), Vec3::new(0.72, 0.66, 0.02));
    for (dx, dy, width, height) in [
        (0.0, 0.36, 0.84, 0.07),
        (0.0, -0.36, 0.84, 0.07),
        (0.385, 0.0, 0.07, 0.648),
        (-0.385, 0.0, 0.07, 0.648),
        (0.0, 0.0, 0.03, 0.64),
    ] {
        shed.block(paint.trim, Vec3::new(x + dx, y + dy, z), Vec3::new(width, height, 0.06));
    }
    for side in [-1.0, 1.0] {
        shed.block(paint.trim, Vec3::new(x + side * 0.182, y, z), Vec3::new(0.33, 0.03, 0.05));
    }
    shed.block(paint.trim, Vec3::new(x, y - 0.41, z + 0.04), Vec3::new(0.94, 0.035, 0.14));
}

/// Two slabs with rows of shingles, and a ridge.
fn roof(shed: &mut Model, paint: Paint, random: &mut Random) {
    let [w, d] = HALF;
    let length = 2.0 * d + 0.5;
    for side in [-1.0_f32, 1.0] {
        let down = Vec3::new(side * w, EAVES - RIDGE, 0.0).normalize();
        let face = Vec3::new(-down.y * side, down.x * side, 0.0);
        let top = Vec3::new(0.0, RIDGE, 0.0) + face * 0.03;
        let slope = w.hypot(RIDGE - EAVES) + 0.26;
        shed.board(paint.roof, [top + down * 0.02, top + down * slope], [length, 0.03], face);
        let (rows, columns) = (11, 16);
        for row in 0..rows {
            // From the eaves up: each row lies on the one below.
            let from = top + down * (slope + 0.03 - (slope - 0.02) / rows as f32 * row as f32) + face * 0.028;
            let to = from - down * 0.24 - face * 0.008;
            for column in 0..columns {
                let width = length / columns as f32;
                let shift = if row % 2 == 0 { 0.0 } else { 0.35 * width };
                let z = -0.5 * length + width * (column as f32 + 0.5) + shift - 0.17 * width;
                let nudge = down * random.around(0.008) + face * random.between(0.0, 0.003);
                let ends = [from, to].map(|p| p + nudge + Vec3::Z * z);
                shed.board(paint.roof, ends, [width - 0.008, 0.012], face);
            }
        }
        for z in [-1.0, 1.0] {
            let end = Vec3::Z * z * (0.5 * length + 0.012) - face * 0.03;
            shed.board(paint.trim, [top + end, top + end + down * (slope + 0.01)], [0.022, 0.13], face);
        }
    }
    let ridge = shapes::extruded(&[[-0.14, -0.087], [0.14, -0.087], [0.0, 0.035]], length + 0.06);
    shed.add(paint.roof, &ridge, Mat4::from_translation(Vec3::Y * (RIDGE + 0.085)));
}
