//! Leaves whose every triangle has a twin with the other winding, folded along ribs, with many triangles in a
//! texel: maps that keep the first few of them shadow lit leaves no more than a plain map does.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::technique::{self, Bias};
use antumbra_scene::{Camera, Instance, Light, Material, Mesh, Projection, Scene};
use antumbra_testing::Trials;
use common::{Picture, score};
use glam::{DMat4, Mat4, Vec2, Vec3, Vec4};

const RESOLUTION: [u32; 2] = [320, 240];
/// Folds along half of a leaf.
const RIBS: u32 = 14;

fn main() {
    let mut trials = Trials::default();
    for (size, folds) in [(192, 0.03), (192, 0.08), (256, 0.08)] {
        trials.add(format!("folds of {folds} on a map of {size}"), move |gpu| {
            let mut picture = Picture::new(gpu, &plant(folds), RESOLUTION);
            let truth = picture.hard_truth();
            let [hard, exact, dpm] = ["hard", "exact", "dpm"].map(|spec| {
                let technique = technique::parse(spec).unwrap();
                let score = score(&picture.answer(technique.as_ref(), size, Bias::Auto), &truth);
                (score.acne.unwrap(), score.pixel_match)
            });
            if std::env::var_os("ANTUMBRA_MEASURE").is_some() {
                eprintln!("{size}, {folds}: hard {hard:?}, exact {exact:?}, dpm {dpm:?}");
            }
            assert!(hard.0 > 0.01, "a plain map has no difficulty: {hard:?}");
            assert!(exact.0 < 1e-4 && exact.1 > 0.9995, "{exact:?}");
            assert!(dpm.0 < 0.7 * hard.0 && dpm.1 > hard.1, "{dpm:?}, hard {hard:?}");
        });
    }
    trials.run();
}

/// Leaves over the ground, folded along their middle and, `folds` of their length high, along ribs from
/// there.
fn plant(folds: f32) -> Scene {
    let mut meshes = vec![ground()];
    for i in 0..40 {
        let turn = i as f32 * 2.4;
        let place = Vec3::new(turn.cos(), 0.0, turn.sin()) * (0.16 * (i as f32).sqrt())
            + Vec3::Y * (0.3 + 0.05 * (i % 9) as f32);
        let tilt = Mat4::from_rotation_y(-turn) * Mat4::from_rotation_z(-0.4 + 0.2 * (turn * 3.0).sin());
        meshes.push(leaf(Mat4::from_translation(place) * tilt * Mat4::from_scale(Vec3::splat(0.6)), folds));
    }
    Scene {
        instances: (0..meshes.len()).map(|mesh| Instance::new(mesh, DMat4::IDENTITY)).collect(),
        meshes,
        materials: vec![Material::default()],
        cameras: vec![Camera {
            position: Vec3::new(0.6, 2.6, 2.0),
            target: Vec3::new(0.0, 0.3, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.8 },
        }],
        lights: vec![Light::Directional { direction: Vec3::new(0.3, -1.0, -0.4).normalize() }],
        ..Scene::default()
    }
}

/// A leaf along +x, of length and width 1 and ½.
fn leaf(matrix: Mat4, folds: f32) -> Mesh {
    let at = |i: u32, side: f32| {
        let along = i as f32 / RIBS as f32;
        let half = side * 0.25 * (std::f32::consts::PI * (0.05 + 0.9 * along)).sin();
        let rib = if i.is_multiple_of(2) { folds } else { 0.0 };
        // Ribs run forward from the middle.
        Vec3::new(along + 0.4 * half.abs(), 0.3 * half.abs() + rib * side.abs(), half)
    };
    let rows = (0..=RIBS).flat_map(|i| [-1.0, 0.0, 1.0].map(|side| at(i, side)));
    let positions: Vec<Vec3> = rows.map(|p| matrix.transform_point3(p)).collect();
    let quads = (0..RIBS).flat_map(|i| [[3 * i, 3 * i + 1], [3 * i + 1, 3 * i + 2]]);
    let triangles = quads.flat_map(|[a, b]| [[a, b, a + 3], [b, b + 3, a + 3]]);
    let indices = triangles.flat_map(|[a, b, c]| [a, b, c, c, b, a]).collect();
    mesh(positions, indices)
}

fn ground() -> Mesh {
    let corners = [(-3.0, 3.0), (3.0, 3.0), (3.0, -3.0), (-3.0, -3.0)];
    mesh(corners.map(|(x, z)| Vec3::new(x, 0.0, z)).to_vec(), vec![0, 1, 2, 0, 2, 3])
}

fn mesh(positions: Vec<Vec3>, indices: Vec<u32>) -> Mesh {
    let count = positions.len();
    Mesh {
        positions,
        normals: vec![Vec3::Y; count],
        uvs: vec![Vec2::ZERO; count],
        colors: vec![Vec4::ONE; count],
        indices,
        ..Mesh::default()
    }
}
