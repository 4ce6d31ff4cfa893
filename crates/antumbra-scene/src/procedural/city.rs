//! A city [Lecocq, Marvie, Sourimant, Gautron 2014, "Sub-pixel shadow mapping", figure 1, shows one of
//! about 2,300,000 triangles under a single shadow map]: a texel is as wide as a window frame, and
//! balconies, lamps and leaves are all smaller than that.

use super::{
    Procedural,
    buildings::{self, Roof, Style},
    growth::{self, Habit},
    model::Model,
    plants,
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Quat, Vec3};
use std::f32::consts::{FRAC_PI_2, TAU};

pub(super) const CITY: Procedural = Procedural {
    name: "city",
    description: "twenty-five blocks of houses, towers and a church, with trees, cars and lamps",
    stresses: "size: detail smaller than a texel everywhere, one map for shadows of all lengths",
    source: "Lecocq et al. 2014, Sub-pixel shadow mapping, figure 1",
    triangles: 2_299_574,
    build,
};

/// Blocks along each side of the city.
const BLOCKS: i32 = 5;
/// Width of a block with its pavement, and from one block to the next.
const BLOCK: f32 = 50.0;
const PITCH: f32 = 64.0;
/// Width of one of the nine plots of a block.
const PLOT: f32 = 15.4;
/// Height of the pavement.
const KERB: f32 = 0.15;

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("city");
    let asphalt = scene.material("asphalt", [0.20, 0.20, 0.21], 0.95);
    let paving = scene.material("paving", [0.43, 0.41, 0.38], 0.9);
    let lawn = scene.material("lawn", [0.20, 0.27, 0.11], 0.95);
    let ground = scene.mesh("ground", shapes::ground(420.0), asphalt);
    scene.place(ground, Mat4::IDENTITY);
    let pavement = scene.mesh("pavement", shapes::cuboid(Vec3::new(BLOCK, 1.0, BLOCK)), paving);
    let court = scene.mesh("court", shapes::cuboid(Vec3::new(PLOT, 1.0, PLOT)), lawn);
    let park = scene.mesh("park", shapes::cuboid(Vec3::new(BLOCK - 6.0, 1.0, BLOCK - 6.0)), lawn);
    let buildings = houses(&mut scene);
    let trees = trees(&mut scene);
    let street = Street::new(&mut scene);
    for (row, column) in (0..BLOCKS).flat_map(|row| (0..BLOCKS).map(move |column| (row, column))) {
        let [x, z] = [column, row].map(|i| PITCH * (i - BLOCKS / 2) as f32);
        let at = |dx: f32, y: f32, dz: f32| Vec3::new(x + dx, y, z + dz);
        scene.place(pavement, Mat4::from_translation(at(0.0, KERB - 0.5, 0.0)));
        let kind = (3 * row + 5 * column) % 13;
        if kind == 4 {
            scene.place(park, Mat4::from_translation(at(0.0, KERB - 0.42, 0.0)));
            for i in 0..36 {
                let [dx, dz] = [i % 6, i / 6].map(|k| 7.2 * (k as f32 - 2.5) + random.around(2.2));
                plant(&mut scene, trees[i % 3], at(dx, KERB, dz), &mut random);
            }
        } else {
            scene.place(court, Mat4::from_translation(at(0.0, KERB - 0.42, 0.0)));
            for i in 0..3 {
                let place = at(random.around(4.0), KERB, 4.4 * (i as f32 - 1.0));
                plant(&mut scene, trees[i % 3], place, &mut random);
            }
            plots(&mut scene, &buildings, kind as usize, at(0.0, KERB, 0.0), &mut random);
        }
        street.furnish(&mut scene, &trees, at(0.0, 0.0, 0.0), &mut random);
    }
    scene.finish(
        Camera {
            position: Vec3::new(-96.0, 62.0, 186.0),
            target: Vec3::new(-22.0, 4.0, 38.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.62 },
        },
        Light::Directional { direction: Vec3::new(0.72, -0.72, -0.24).normalize() },
    )
}

/// The kinds of houses, and last the tower and the church.
fn houses(scene: &mut Builder) -> Vec<Vec<usize>> {
    let trim = scene.material("trim", [0.58, 0.55, 0.50], 0.8);
    let glass = scene.material("glass", [0.07, 0.10, 0.12], 0.2);
    let slate = scene.material("slate roof", [0.19, 0.21, 0.23], 0.8);
    let tile = scene.material("tile roof", [0.42, 0.17, 0.10], 0.85);
    let mut style = |name, color, roof| {
        let wall = scene.material(name, color, 0.9);
        Style { wall, trim, glass, roof }
    };
    let brick = style("brick", [0.42, 0.20, 0.14], slate);
    let ochre = style("ochre plaster", [0.60, 0.45, 0.24], tile);
    let cream = style("cream plaster", [0.62, 0.56, 0.44], tile);
    let sage = style("sage plaster", [0.40, 0.44, 0.35], slate);
    let concrete = style("concrete", [0.50, 0.50, 0.49], slate);
    let models = [
        buildings::house(brick, 5, 5, Roof::Flat),
        buildings::house(ochre, 4, 5, Roof::Gable),
        buildings::house(cream, 5, 4, Roof::Gable),
        buildings::house(sage, 6, 5, Roof::Flat),
        buildings::house(brick, 3, 5, Roof::Gable),
        buildings::house(cream, 7, 5, Roof::Flat),
        buildings::tower(concrete, 14),
        buildings::church(sage),
    ];
    models.into_iter().map(|model| model.finish(scene, "house")).collect()
}

/// Eight houses around a court, facing outwards. The kind of the block decides which.
fn plots(scene: &mut Builder, houses: &[Vec<usize>], kind: usize, middle: Vec3, random: &mut Random) {
    let around = [[-1, -1], [0, -1], [1, -1], [1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0]];
    for (i, [column, row]) in around.into_iter().enumerate() {
        // Corners face the street along z.
        let turn = match (column, row) {
            (1, 0) => FRAC_PI_2,
            (-1, 0) => -FRAC_PI_2,
            (_, -1) => 2.0 * FRAC_PI_2,
            _ => 0.0,
        };
        let choice = match (kind, i) {
            (2, 5) => 7,
            (_, 2) if kind.is_multiple_of(2) => 6,
            _ => (kind + 5 * i) % 6,
        };
        let size = Vec3::new(1.0, random.between(0.93, 1.07), 1.0);
        let place = middle + Vec3::new(column as f32, 0.0, row as f32) * PLOT - Vec3::Y * 0.02;
        let turn = Quat::from_rotation_y(turn);
        scene.place_all(&houses[choice], Mat4::from_scale_rotation_translation(size, turn, place));
    }
}

/// Three leafy street trees.
fn trees(scene: &mut Builder) -> [[usize; 2]; 3] {
    let bark = scene.material("bark", [0.25, 0.19, 0.14], 0.9);
    let leaf = scene.material("leaves", [0.19, 0.28, 0.09], 0.8);
    [(5, 2.0, 4.6), (6, 2.4, 5.4), (7, 1.7, 6.2)].map(|(seed, width, height)| {
        let habit = Habit {
            seed,
            trunk: 1.7,
            crown: Vec3::new(width, height, width),
            points: 60,
            step: 0.42,
            influence: 2.2,
            reach: 0.6,
            twig: 0.016,
        };
        let wood = growth::grow(&habit);
        // Chance of the leaves is that of the tree too: the seed of the scene places it.
        let crown = plants::leaves(&wood, 2.2, 505, 0.62, &mut Random::new(seed));
        [scene.mesh("tree", wood, bark), scene.mesh("crown", crown, leaf)]
    })
}

fn plant(scene: &mut Builder, tree: [usize; 2], at: Vec3, random: &mut Random) {
    let size = Vec3::splat(random.between(0.85, 1.3));
    let turn = Quat::from_rotation_y(random.between(0.0, TAU));
    scene.place_all(&tree, Mat4::from_scale_rotation_translation(size, turn, at));
}

/// What stands along the streets.
struct Street {
    lamp: Vec<usize>,
    cars: [Vec<usize>; 4],
    dash: usize,
}

impl Street {
    fn new(scene: &mut Builder) -> Self {
        let iron = scene.material("lamp post", [0.10, 0.12, 0.12], 0.5);
        let lens = scene.material("lens", [0.62, 0.60, 0.52], 0.4);
        let white = scene.material("road paint", [0.60, 0.60, 0.58], 0.8);
        let window = scene.material("car window", [0.05, 0.06, 0.07], 0.2);
        let rubber = scene.material("tyre", [0.05, 0.05, 0.05], 0.9);
        let mut lamp = Model::default();
        lamp.put(iron, &shapes::turned(&[[0.16, -0.1], [0.16, 0.5], [0.07, 0.7], [0.05, 6.0]], 12));
        lamp.rods(iron, &[Vec3::Y * 5.9, Vec3::new(0.0, 6.5, 0.5), Vec3::new(0.0, 6.6, 1.6)], 0.04, 8);
        lamp.block(iron, Vec3::new(0.0, 6.62, 1.9), Vec3::new(0.3, 0.12, 0.8));
        lamp.block(lens, Vec3::new(0.0, 6.54, 1.9), Vec3::new(0.22, 0.06, 0.6));
        let paints = [
            ("red car", [0.50, 0.06, 0.05]),
            ("silver car", [0.50, 0.51, 0.52]),
            ("blue car", [0.08, 0.18, 0.40]),
            ("white car", [0.62, 0.62, 0.60]),
        ];
        let cars = paints.map(|(name, color)| {
            let paint = scene.material(name, color, 0.3);
            car(paint, window, rubber).finish(scene, name)
        });
        let dash = scene.mesh("dash", shapes::cuboid(Vec3::new(0.18, 0.06, 2.4)), white);
        Self { lamp: lamp.finish(scene, "lamp"), cars, dash }
    }

    /// Lamps, trees and parked cars along the four sides of a block, and the lanes on two.
    fn furnish(&self, scene: &mut Builder, trees: &[[usize; 2]; 3], middle: Vec3, random: &mut Random) {
        for side in 0..4 {
            let turn = Mat4::from_translation(middle) * Mat4::from_rotation_y(FRAC_PI_2 * side as f32);
            for i in 0..5 {
                let x = 10.0 * (i as f32 - 2.0);
                let tree = turn.transform_point3(Vec3::new(x, KERB, 0.5 * BLOCK - 1.0));
                if i % 2 == 0 {
                    let lamp = turn * Mat4::from_translation(Vec3::new(x + 5.0, KERB, 0.5 * BLOCK - 0.6));
                    scene.place_all(&self.lamp, lamp);
                }
                plant(scene, trees[(i + side) % 3], tree, random);
                let along = Vec3::new(x + random.around(1.6), 0.0, 0.5 * BLOCK + 1.25);
                let car = &self.cars[(3 * i + side) % 4];
                scene.place_all(car, turn * Mat4::from_translation(along));
            }
            for i in 0..if side < 2 { 10 } else { 0 } {
                let at = Vec3::new(6.4 * (i as f32 - 4.5), 0.0, 0.5 * PITCH);
                scene.place(self.dash, turn * Mat4::from_translation(at) * Mat4::from_rotation_y(FRAC_PI_2));
            }
        }
    }
}

/// A car along x.
fn car(paint: usize, window: usize, rubber: usize) -> Model {
    let mut car = Model::default();
    let body = [[-2.1, 0.3], [2.1, 0.3], [2.15, 0.7], [1.2, 0.92], [-2.05, 0.95], [-2.15, 0.7]];
    car.put(paint, &shapes::extruded(&body, 1.74));
    car.put(window, &shapes::extruded(&[[-1.75, 0.93], [1.1, 0.91], [0.35, 1.38], [-1.3, 1.38]], 1.5));
    car.put(paint, &shapes::extruded(&[[-1.33, 1.36], [0.38, 1.36], [0.28, 1.45], [-1.2, 1.45]], 1.46));
    for (x, z) in [(-1.3, -0.8), (-1.3, 0.8), (1.35, -0.8), (1.35, 0.8)] {
        car.rod(rubber, [Vec3::new(x, 0.31, z - 0.11), Vec3::new(x, 0.31, z + 0.11)], 0.32, 18);
    }
    car
}
