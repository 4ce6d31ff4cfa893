//! Town houses, towers and a church. Each stands on y = 0 around the origin, its front towards +z,
//! and is sunk by a hand's breadth.

use super::{model::Model, shapes};
use glam::{Mat4, Vec3};
use std::f32::consts::FRAC_PI_2;

/// Materials of a building.
#[derive(Debug, Clone, Copy)]
pub(super) struct Style {
    pub(super) wall: usize,
    pub(super) trim: usize,
    pub(super) glass: usize,
    pub(super) roof: usize,
}

/// What covers a house.
#[derive(Debug, Clone, Copy)]
pub(super) enum Roof {
    /// A ridge along x with chimneys.
    Gable,
    /// A parapet, a stair head, a tank and machines.
    Flat,
}

/// Height of a floor.
const FLOOR: f32 = 3.1;
/// Width of one window with the wall around it.
const BAY: f32 = 2.5;
/// Bays at the sides, where the two in the middle have windows.
const DEEP: u32 = 4;

/// A house with `floors` floors of `bays` windows.
pub(super) fn house(style: Style, floors: u32, bays: u32, roof: Roof) -> Model {
    let mut house = Model::default();
    let size = Vec3::new(BAY * bays as f32 + 0.8, FLOOR * floors as f32 + 0.4, BAY * DEEP as f32 + 0.8);
    house.block(style.wall, Vec3::Y * (0.5 * size.y - 0.05), size + Vec3::Y * 0.1);
    let plinth = Vec3::new(size.x + 0.16, 0.9, size.z + 0.16);
    house.block(style.trim, Vec3::Y * 0.35, plinth);
    let cornice = Vec3::new(size.x + 0.7, 0.35, size.z + 0.7);
    house.block(style.trim, Vec3::Y * (size.y - 0.1), cornice);
    house.block(style.trim, Vec3::Y * (FLOOR + 0.45), Vec3::new(size.x + 0.2, 0.2, size.z + 0.2));
    for side in 0..4 {
        let turn = Mat4::from_rotation_y(FRAC_PI_2 * side as f32);
        let (bays, out) = if side % 2 == 0 { (bays, 0.5 * size.z) } else { (DEEP - 2, 0.5 * size.x) };
        for floor in 0..floors {
            for bay in 0..bays {
                let x = BAY * (bay as f32 - 0.5 * (bays - 1) as f32);
                let door = floor == 0 && side == 0 && bay == bays / 2;
                let place = turn * Mat4::from_translation(Vec3::new(x, FLOOR * floor as f32 + 2.05, out));
                if door {
                    entrance(&mut house, style, place);
                } else {
                    window(&mut house, style, place, floor % 3 == 2 && side == 0);
                }
            }
        }
    }
    match roof {
        Roof::Gable => gable(&mut house, style, size),
        Roof::Flat => flat(&mut house, style, size),
    }
    house
}

/// A window around the origin of a wall that faces +z.
fn window(house: &mut Model, style: Style, place: Mat4, balcony: bool) {
    let mut block = |material, x, y, z, size: [f32; 3]| {
        let at = place * Mat4::from_translation(Vec3::new(x, y, z));
        house.add(material, &shapes::cuboid(size.into()), at);
    };
    block(style.trim, 0.0, 0.0, 0.0, [1.4, 1.7, 0.10]);
    block(style.glass, 0.0, 0.0, 0.0, [1.2, 1.6, 0.16]);
    block(style.trim, 0.0, 0.0, 0.0, [0.06, 1.58, 0.20]);
    block(style.trim, 0.0, 0.88, 0.03, [1.5, 0.18, 0.24]);
    block(style.trim, 0.0, -0.88, 0.06, [1.56, 0.12, 0.34]);
    if balcony {
        block(style.trim, 0.0, -1.05, 0.5, [2.2, 0.14, 1.0]);
        block(style.glass, 0.0, -0.15, 0.96, [2.2, 0.06, 0.05]);
        for i in 0..9 {
            block(style.glass, 0.26 * (i as f32 - 4.0), -0.58, 0.96, [0.03, 0.82, 0.03]);
        }
        for x in [-1.06, 1.06] {
            block(style.glass, x, -0.16, 0.48, [0.05, 0.06, 0.92]);
        }
    }
}

/// A door under a canopy.
fn entrance(house: &mut Model, style: Style, place: Mat4) {
    for (material, x, y, z, size) in [
        (style.glass, 0.0, -0.75, 0.0, [1.3, 2.5, 0.2]),
        (style.trim, -0.78, -0.75, 0.05, [0.24, 2.6, 0.4]),
        (style.trim, 0.78, -0.75, 0.05, [0.24, 2.6, 0.4]),
        (style.trim, 0.0, 0.66, 0.45, [2.2, 0.2, 1.3]),
        (style.trim, 0.0, -1.99, 0.5, [1.7, 0.3, 1.1]),
    ] {
        let at = place * Mat4::from_translation(Vec3::new(x, y, z));
        house.add(material, &shapes::cuboid(Vec3::from(size)), at);
    }
}

fn gable(house: &mut Model, style: Style, size: Vec3) {
    let (half, rise) = (0.5 * size.z, 0.42 * size.z);
    let wall = shapes::extruded(&[[-half, 0.0], [half, 0.0], [0.0, rise]], size.x - 0.2);
    let along_x = Mat4::from_translation(Vec3::Y * (size.y - 0.02)) * Mat4::from_rotation_y(FRAC_PI_2);
    house.add(style.wall, &wall, along_x);
    for side in [-1.0, 1.0] {
        let ridge = Vec3::new(0.0, size.y + rise + 0.1, 0.0);
        let down = Vec3::new(0.0, -rise, side * half).normalize();
        let face = Vec3::new(0.0, half, side * rise).normalize();
        let eaves = ridge + down * (half.hypot(rise) + 0.7);
        house.board(style.roof, [ridge - down * 0.02, eaves], [size.x + 0.8, 0.22], face);
        for i in 0..9 {
            // Rolls over the seams of the metal.
            let x = (size.x - 0.4) * (i as f32 / 8.0 - 0.5);
            let ends = [ridge, eaves].map(|p| p + Vec3::X * x + face * 0.14);
            house.board(style.roof, ends, [0.1, 0.12], face);
        }
    }
    for x in [-0.3, 0.32] {
        let top = Vec3::new(x * size.x, size.y + 0.75 * rise + 0.7, 0.18 * size.z);
        house.block(style.wall, top, Vec3::new(0.9, 2.6, 0.9));
        house.block(style.trim, top + Vec3::Y * 1.35, Vec3::new(1.1, 0.2, 1.1));
        for dx in [-0.2, 0.2] {
            let pot = top + Vec3::new(dx, 1.4, 0.0);
            house.rod(style.wall, [pot, pot + Vec3::Y * 0.5], 0.13, 10);
        }
    }
}

fn flat(house: &mut Model, style: Style, size: Vec3) {
    house.block(style.roof, Vec3::Y * (size.y + 0.05), Vec3::new(size.x - 0.4, 0.2, size.z - 0.4));
    let top = size.y + 0.15;
    for side in [-1.0, 1.0] {
        let along = Vec3::new(0.0, top + 0.3, side * (0.5 * size.z - 0.1));
        house.block(style.wall, along, Vec3::new(size.x, 0.95, 0.24));
        let across = Vec3::new(side * (0.5 * size.x - 0.1), top + 0.3, 0.0);
        house.block(style.wall, across, Vec3::new(0.24, 0.93, size.z - 0.44));
    }
    house.block(style.wall, Vec3::new(-0.2 * size.x, top + 1.2, -0.2 * size.z), Vec3::new(3.2, 2.5, 2.6));
    for (x, z) in [(0.18, 0.22), (0.30, 0.22), (0.3, 0.02)] {
        let at = Vec3::new(x * size.x, top + 0.45, z * size.z);
        house.block(style.trim, at, Vec3::new(1.1, 1.0, 1.1));
    }
    let mut tank = Model::default();
    tank.put(style.roof, &shapes::turned(&[[1.2, 1.4], [1.2, 3.6], [1.25, 3.62], [0.0, 4.5]], 24));
    for (x, z) in [(0.8, 0.8), (-0.8, 0.8), (0.8, -0.8), (-0.8, -0.8)] {
        tank.rod(style.trim, [Vec3::new(x, -0.1, z), Vec3::new(x, 1.45, z)], 0.08, 8);
    }
    house.join(&tank, Mat4::from_translation(Vec3::new(0.22 * size.x, top, -0.22 * size.z)));
    let mast = Vec3::new(-0.34 * size.x, top, 0.3 * size.z);
    house.rod(style.trim, [mast - Vec3::Y * 0.1, mast + Vec3::Y * 4.0], 0.05, 8);
}

/// An office tower with fins between its windows.
pub(super) fn tower(style: Style, floors: u32) -> Model {
    const SIDE: f32 = 12.6;
    let mut tower = Model::default();
    let height = FLOOR * floors as f32 + 1.0;
    tower.block(style.glass, Vec3::Y * (0.5 * height - 0.05), Vec3::new(SIDE, height + 0.1, SIDE));
    for floor in 0..=floors {
        let y = FLOOR * floor as f32 + 0.55;
        tower.block(style.wall, Vec3::Y * y, Vec3::new(SIDE + 0.3, 0.9, SIDE + 0.3));
    }
    for side in 0..4 {
        let turn = Mat4::from_rotation_y(FRAC_PI_2 * side as f32);
        for i in 0..=12 {
            let x = (SIDE / 12.0) * (i as f32 - 6.0);
            let fin = Mat4::from_translation(Vec3::new(x, 0.5 * height, 0.5 * SIDE + 0.12));
            // Fins that cross at the corners end at different heights.
            let long = height - 0.2 - 0.1 * (side % 2) as f32;
            tower.add(style.trim, &shapes::cuboid(Vec3::new(0.16, long, 0.6)), turn * fin);
        }
        for floor in 0..floors {
            for i in 0..12 {
                let x = (SIDE / 12.0) * (i as f32 - 5.5);
                let y = FLOOR * floor as f32 + 2.45;
                let bar = Mat4::from_translation(Vec3::new(x, y, 0.5 * SIDE));
                tower.add(style.trim, &shapes::cuboid(Vec3::new(0.88, 0.1, 0.14)), turn * bar);
            }
        }
    }
    flat(&mut tower, style, Vec3::new(SIDE - 0.6, height, SIDE - 0.6));
    tower
}

/// A church with a steeple at +z.
pub(super) fn church(style: Style) -> Model {
    let mut church = Model::default();
    let nave = [[-5.0, -0.1], [5.0, -0.1], [5.0, 9.0], [0.0, 15.0], [-5.0, 9.0]];
    church.put(style.wall, &shapes::extruded(&nave, 22.0));
    for side in [-1.0, 1.0] {
        let ends = [Vec3::new(0.0, 15.15, 0.0), Vec3::new(side * 5.6, 8.45, 0.0)];
        church.board(style.roof, ends, [22.8, 0.25], Vec3::new(side * 6.0, 5.0, 0.0));
        for i in 0..6 {
            let z = 3.4 * (i as f32 - 2.5);
            church.block(style.wall, Vec3::new(side * 5.4, 3.4, z + 1.7), Vec3::new(0.9, 7.0, 0.7));
            church.block(style.glass, Vec3::new(side * 5.0, 4.8, z), Vec3::new(0.16, 4.6, 1.1));
        }
    }
    church.block(style.wall, Vec3::new(0.0, 9.9, 12.4), Vec3::new(5.0, 20.0, 5.0));
    church.block(style.trim, Vec3::new(0.0, 20.0, 12.4), Vec3::new(5.6, 0.5, 5.6));
    let spire = shapes::turned(&[[2.9, 20.2], [0.12, 33.0], [0.0, 33.4]], 8);
    church.add(style.roof, &spire, Mat4::from_translation(Vec3::Z * 12.4));
    church.block(style.glass, Vec3::new(0.0, 1.6, 14.9), Vec3::new(1.8, 3.3, 0.3));
    church
}
