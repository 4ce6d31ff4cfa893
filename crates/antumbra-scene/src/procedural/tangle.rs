//! A ball of tangled, fused tubes around a core of a gyroid's tubes [Lecocq, Marvie, Sourimant,
//! Gautron 2014, "Sub-pixel shadow mapping", figure 1, shows YeahRight, of about 150,000 triangles
//! and many handles]: thin curved parts before one another at every depth, so that nearly every texel
//! of the shadow is near a silhouette.

use super::{
    Procedural,
    isosurface::Grid,
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Mesh, Projection, Scene};
use glam::{DQuat, DVec3, Mat4, Vec3};
use std::f64::consts::TAU;

pub(super) const TANGLE: Procedural = Procedural {
    name: "tangle",
    description: "a ball of tangled, fused tubes with over a hundred handles on a plinth",
    stresses: "silhouettes everywhere, thin curved parts, self-shadowing, one texel with many triangles",
    source: "Lecocq et al. 2014, Sub-pixel shadow mapping, figure 1 (YeahRight)",
    triangles: 150_246,
    build,
};

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("tangle");
    let floor = scene.material("floor", [0.50, 0.48, 0.44], 0.9);
    let stone = scene.material("stone", [0.42, 0.40, 0.37], 0.8);
    let coral = scene.material("coral", [0.58, 0.22, 0.12], 0.5);
    let ground = scene.mesh("ground", shapes::ground(12.0), floor);
    scene.place(ground, Mat4::IDENTITY);
    let plinth = [[0.78, -0.01], [0.78, 0.07], [0.70, 0.10], [0.70, 0.14]];
    let plinth = scene.mesh("plinth", shapes::turned(&plinth, 96), stone);
    scene.place(plinth, Mat4::IDENTITY);
    let model = model();
    let foot = model.positions.iter().fold(f32::INFINITY, |min, p| min.min(p.y));
    let model = scene.mesh("tangle", model, coral);
    let lift = Mat4::from_translation(Vec3::Y * (0.135 - foot));
    scene.place(model, lift * Mat4::from_rotation_y(random.between(0.0, std::f32::consts::TAU)));
    scene.finish(
        Camera {
            position: Vec3::new(1.5, 2.5, 4.3),
            target: Vec3::new(0.45, 0.8, -0.1),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.66 },
        },
        Light::Directional { direction: Vec3::new(0.72, -0.82, -0.28).normalize() },
    )
}

/// A closed strand: a tilted circle that swings to both sides of its plane and in and out.
struct Strand {
    tilt: DQuat,
    swings: f64,
    waves: f64,
}

impl Strand {
    /// One of [`STRANDS`]. Their axes are spread evenly over a hemisphere.
    fn nth(i: u32) -> Self {
        let latitude = (1.0 - (f64::from(i) + 0.5) / f64::from(STRANDS)).acos();
        Self {
            tilt: DQuat::from_rotation_y(f64::from(i) * 2.399_963) * DQuat::from_rotation_x(latitude),
            swings: f64::from(2 + i % 3),
            waves: f64::from(3 + 2 * (i % 4)),
        }
    }

    /// The point at angle `t` of 2π, and the radius of the tube there.
    fn at(&self, t: f64) -> (DVec3, f64) {
        let latitude = 0.55 * (self.swings * t).sin();
        let reach = 0.78 + 0.20 * (self.waves * t + 1.0).sin();
        let (level, height) = (latitude.cos(), latitude.sin());
        let direction = DVec3::new(level * t.cos(), height, level * t.sin());
        (self.tilt * direction * reach, 0.033 + 0.011 * ((self.waves + 2.0) * t).sin())
    }
}

/// The model around the origin, about 1 m in radius. No strand comes near itself and all are joined
/// smoothly, so no gap is narrower than a cell.
fn model() -> Mesh {
    let empty = Grid::new(1.08, CELLS, FAR);
    let mut all = empty.clone();
    core(&mut all);
    for i in 0..STRANDS {
        let mut grid = empty.clone();
        tube(&mut grid, &Strand::nth(i));
        all.join(&grid, 0.06);
    }
    all.surface()
}

/// Number of strands.
const STRANDS: u32 = 11;
/// Cells along an edge of the grid.
const CELLS: usize = 106;
/// The field where nothing is near.
const FAR: f32 = 0.1;

/// A tube around a strand, as distances from short straight pieces.
fn tube(grid: &mut Grid, strand: &Strand) {
    const PIECES: u32 = 300;
    let at = |i: u32| strand.at(TAU * f64::from(i % PIECES) / f64::from(PIECES));
    for i in 0..PIECES {
        let ((a, from), (b, to)) = (at(i), at(i + 1));
        let along = b - a;
        grid.change((a + b) * 0.5, 0.5 * along.length() + 0.11, |p, old| {
            let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
            old.min((p.distance(a + along * t) - (from + (to - from) * t)) as f32)
        });
    }
}

/// One of the two nets of tubes that a gyroid surface parts, within a ball; it reaches the strands
/// where they dip inwards.
fn core(grid: &mut Grid) {
    const RADIUS: f64 = 0.52;
    const WAVE: f64 = TAU / 0.46;
    grid.change(DVec3::ZERO, RADIUS + 0.1, |p, old| {
        let ball = p.length() - RADIUS;
        if ball > 0.1 {
            return old;
        }
        let (sin, cos) = ((p * WAVE).map(f64::sin), (p * WAVE).map(f64::cos));
        let gyroid = sin.x * cos.y + sin.y * cos.z + sin.z * cos.x;
        // The gradient of the gyroid is about 1.3 · WAVE long: this is nearly a distance. The net
        // is cut off with rounded ends.
        let net = (1.12 - gyroid) / (1.3 * WAVE);
        let near = (0.06 - (net - ball).abs()).max(0.0);
        old.min((net.max(ball) + near * near / 0.24) as f32)
    });
}
