//! Two leafless trees on a hillside, lit from the side [Annen et al. 2007, "Convolution shadow maps",
//! figure 7]: twigs thinner than a texel of the map cast long thin shadows on a tilted plane, which
//! break up without filtering. Near the trunks a branch and its shadow are close, far away the
//! shadows of all branches cross.

use super::{
    Procedural,
    growth::{self, Habit},
    random::Random,
    shapes::{self, Builder},
};
use crate::{Camera, Light, Projection, Scene};
use glam::{Mat4, Vec3};
use std::f32::consts::TAU;

pub(super) const TREES: Procedural = Procedural {
    name: "trees",
    description: "two finely branched leafless trees lit from the side on a tilted plane",
    stresses: "casters thinner than a texel, long thin shadows, a slanted receiver",
    source: "Annen et al. 2007, Convolution shadow maps, figure 7",
    triangles: 208_568,
    build,
};

/// How much the plane rises per metre towards +x and −z.
const RISE: [f32; 2] = [0.12, 0.26];

const OAK: Habit = Habit {
    seed: 11,
    trunk: 0.75,
    crown: Vec3::new(2.2, 3.5, 2.1),
    points: 9_500,
    step: 0.045,
    influence: 0.6,
    reach: 0.085,
    twig: 0.0030,
};

const ELM: Habit = Habit {
    seed: 29,
    trunk: 0.9,
    crown: Vec3::new(1.4, 3.9, 1.4),
    points: 6_500,
    step: 0.045,
    influence: 0.55,
    reach: 0.08,
    twig: 0.0029,
};

fn build(seed: u64) -> Scene {
    let mut random = Random::new(seed);
    let mut scene = Builder::new("trees");
    let grass = scene.material("dry grass", [0.50, 0.46, 0.36], 0.95);
    let bark = scene.material("bark", [0.23, 0.17, 0.12], 0.9);
    let [x, z] = RISE;
    let height = |p: [f32; 2]| x * p[0] - z * p[1];
    let corner = |x: f32, z: f32| Vec3::new(x, height([x, z]), z);
    let plane = [corner(-11.0, 7.0), corner(13.0, 7.0), corner(13.0, -10.0), corner(-11.0, -10.0)];
    let plane = scene.mesh("hillside", shapes::polygon(&plane), grass);
    scene.place(plane, Mat4::IDENTITY);
    for (name, habit, place) in [("oak", OAK, [-2.5, -0.3]), ("elm", ELM, [0.5, -3.4])] {
        let mesh = scene.mesh(name, growth::grow(&habit), bark);
        let foot = Vec3::new(place[0], height(place) - 0.02, place[1]);
        scene.place(mesh, Mat4::from_translation(foot) * Mat4::from_rotation_y(random.between(0.0, TAU)));
    }
    scene.finish(
        Camera {
            position: Vec3::new(1.9, 5.2, 11.9),
            target: Vec3::new(0.7, 1.68, -0.6),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.60 },
        },
        Light::Directional { direction: Vec3::new(0.85, -0.52, 0.22).normalize() },
    )
}
