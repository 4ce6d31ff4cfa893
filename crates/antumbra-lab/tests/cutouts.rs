//! Lookups that ask about cut-outs see through the very holes that rays do, on maps whose texels are as
//! large as holes.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capacity,
    technique::{self, Bias},
};
use antumbra_lab::{gpu::Gpu, session::Session, shot::Shot};
use antumbra_scene::{AlphaMode, Camera, Image, Instance, Light, Material, Mesh, Projection, Scene};
use antumbra_testing::Trials;
use common::{Picture, score};
use glam::{DMat4, Mat4, Vec2, Vec3, Vec4};
use std::sync::Arc;

const RESOLUTION: [u32; 2] = [256, 192];
/// Texels along a side of maps: each leaf is two or three of them wide.
const SIZE: u32 = 48;
/// Pixels of a picture that rounding may turn, beside those at edges of holes that bias moves.
const LEAST: f64 = 0.999;

fn lights() -> [(&'static str, Light); 2] {
    let sun = Light::Directional { direction: Vec3::new(0.3, -1.0, -0.2).normalize() };
    let (position, direction) = (Vec3::new(0.2, 4.0, 0.4), Vec3::new(0.0, -1.0, -0.05).normalize());
    [("sun", sun), ("spot", Light::Spot { position, direction, outer_angle: 0.7 })]
}

fn main() {
    let mut trials = Trials::default();
    for (name, light) in lights() {
        trials.add(format!("exact sees what rays see under a {name}"), move |gpu| {
            let found = matched(gpu, light, "exact", true);
            assert!(found >= LEAST, "{found}");
        });
        trials.add(format!("so does dpm that keeps all, under a {name}"), move |gpu| {
            let found = matched(gpu, light, "dpm.keeps=32", true);
            assert!(found >= LEAST, "{found}");
        });
        trials.add(format!("rejected: holes as coarse as texels, under a {name}"), move |gpu| {
            let found = matched(gpu, light, "exact", false);
            assert!(found < 0.99, "{found}");
        });
    }
    trials.add("coarse holes are told", coarse);
    trials.run();
}

/// A device that binds less than the alphas of the leaves' image says so, where a technique would have asked.
fn coarse(gpu: &antumbra_testing::Gpu) {
    let limits = wgpu::Limits {
        max_storage_buffer_binding_size: 1 << 16,
        max_color_attachment_bytes_per_sample: 48,
        ..wgpu::Limits::default()
    };
    let small = antumbra_testing::gpu_with(wgpu::Features::empty(), limits).unwrap();
    let mut scene = leaves(lights()[0].1);
    scene.images[0] = Image { width: 512, height: 512, rgba: vec![200; 4 << 18], ..scene.images[0].clone() };
    let shot = Shot {
        name: scene.name.clone(),
        geometry: Arc::new(scene.flatten()),
        tree: Default::default(),
        camera: scene.main_camera(),
        light: scene.main_light(),
        resolution: RESOLUTION,
        map_size: SIZE,
        kernel: 3,
        cascades: 1,
        bias: Bias::Auto,
    };
    let notes = |gpu: &antumbra_testing::Gpu, specs: &[&str]| {
        let gpu = Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone());
        let techniques: Vec<_> = specs.iter().map(|spec| technique::parse(spec).unwrap()).collect();
        Session::new(&gpu, &shot, &techniques).unwrap().notes()
    };
    let told = notes(&small, &["hard", "exact"]);
    let [note] = told.as_slice() else { panic!("{told:?}") };
    for text in ["exact: holes", "alphas of cut-outs' images take 262148 bytes", "binds 65536", "scale"] {
        assert!(note.contains(text), "{text} is missing in: {note}");
    }
    assert_eq!(notes(&small, &["hard"]), [""; 0]);
    assert_eq!(notes(gpu, &["hard", "exact"]), [""; 0]);
}

/// Share of pixels that show what rays see.
fn matched(gpu: &antumbra_testing::Gpu, light: Light, spec: &str, cutouts: bool) -> f64 {
    let mut shot = Picture::new(gpu, &leaves(light), RESOLUTION);
    shot.cutouts = cutouts;
    shot.capacity = Capacity { triangles_per_texel: 32, ..shot.capacity };
    let technique = technique::parse(spec).unwrap();
    let found = score(&shot.answer(technique.as_ref(), SIZE, Bias::Auto), &shot.hard_truth()).pixel_match;
    if std::env::var_os("ANTUMBRA_MEASURE").is_some() {
        eprintln!("{spec}, {cutouts}: {found}");
    }
    found
}

/// Tilted leaves over the ground, whose image repeats on every other one, with a vertex alpha that closes the
/// holes towards one corner.
fn leaves(light: Light) -> Scene {
    let disc = |i: usize| (Vec2::new((i % 16) as f32, (i / 16) as f32) - 7.5).length();
    let rgba = (0..256).flat_map(|i| [90, 160, 60, (255.0 * (disc(i) / 10.0).min(1.0)) as u8]).collect();
    let image = Image { name: "holes".into(), width: 16, height: 16, rgba, repeat: [true, false] };
    let leaf = Material {
        name: "leaf".into(),
        base_color: Vec4::new(1.0, 1.0, 1.0, 0.9),
        base_color_image: Some(0),
        alpha: AlphaMode::Mask { cutoff: 0.4 },
        ..Material::default()
    };
    let solid = Material { alpha: AlphaMode::Mask { cutoff: 0.5 }, ..Material::default() };
    let mut meshes = vec![quad(Mat4::from_scale(Vec3::splat(4.0)), 0, 1.0)];
    for i in 0..60 {
        let turn = i as f32 * 2.4;
        let place = Vec3::new(turn.cos(), 0.0, turn.sin()) * (0.18 * (i as f32).sqrt())
            + Vec3::Y * (0.2 + 0.02 * (i % 9) as f32);
        let tilt = Mat4::from_rotation_y(turn) * Mat4::from_rotation_x(0.5 * (turn * 3.0).sin());
        let material = if i % 10 == 3 { 2 } else { 1 };
        let matrix = Mat4::from_translation(place) * tilt * Mat4::from_scale(Vec3::splat(0.16));
        meshes.push(quad(matrix, material, [1.0, 2.5][i % 2]));
    }
    let position = Vec3::new(0.6, 2.6, 2.4);
    Scene {
        instances: (0..meshes.len()).map(|mesh| Instance::new(mesh, DMat4::IDENTITY)).collect(),
        meshes,
        materials: vec![Material::default(), leaf, solid],
        images: vec![image],
        cameras: vec![Camera {
            position,
            target: Vec3::ZERO,
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.9 },
        }],
        lights: vec![light],
        ..Scene::default()
    }
}

/// The square from −1 to 1 in x and z; its texture is that often beside itself.
fn quad(matrix: Mat4, material: usize, repeats: f32) -> Mesh {
    let corners = [Vec2::new(-1.0, 1.0), Vec2::ONE, Vec2::new(1.0, -1.0), Vec2::splat(-1.0)];
    let alphas = [0.7, 0.7, 1.0, 0.7];
    Mesh {
        positions: corners.iter().map(|c| matrix.transform_point3(Vec3::new(c.x, 0.0, c.y))).collect(),
        normals: vec![matrix.transform_vector3(Vec3::Y).normalize(); 4],
        uvs: corners.iter().map(|c| (0.5 * *c + 0.5) * repeats).collect(),
        colors: alphas.map(|alpha| Vec4::new(1.0, 1.0, 1.0, alpha)).to_vec(),
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
        ..Mesh::default()
    }
}
