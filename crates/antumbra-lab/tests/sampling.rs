//! What the default way of reading filtered maps is for: shadows far away on open ground, where a pixel's
//! footprint is long and narrow, and shadows that are finer than pixels.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{Technique, technique::Bias};
use antumbra_lab::{image::GrayImage, specs};
use antumbra_scene::{Camera, Light, Projection, Scene, procedural};
use antumbra_testing::{Gpu, Trials};
use antumbra_truth::{Tracer, Visibility};
use common::{KERNEL, Picture};
use glam::{Mat4, Vec3};

const MAP: u32 = 1024;
const FILTERED: [&str; 6] = ["vsm", "csm", "esm", "evsm", "msm", "lvsm"];
/// On open ground the error may be so many times that of four texels of the finest level, which blur no more
/// than the kernel. By area a footprint ten times as long as wide reads texels of √10 widths at most.
const NEARLY: f64 = 1.25;

/// A square of ground, 240 m wide, with blocks (centre and sides) on it, seen from one point to another.
fn ground_with(blocks: impl Iterator<Item = [Vec3; 2]>, [eye, target]: [Vec3; 2], sun: Vec3) -> Scene {
    let mut scene = procedural::by_name("contact").unwrap().scene(1);
    let mesh = |name: &str| scene.meshes.iter().position(|m| m.name == name).unwrap();
    let (ground, low) = (mesh("ground"), mesh("box"));
    scene.instances.retain(|instance| instance.mesh == ground);
    scene.instances[0].world_from_mesh = Mat4::from_scale(Vec3::new(40.0, 1.0, 40.0)).as_dmat4();
    for [centre, sides] in blocks {
        let scale = Mat4::from_scale(sides / Vec3::new(1.4, 0.35, 0.8));
        let mut block = scene.instances[0];
        block.mesh = low;
        block.world_from_mesh = (Mat4::from_translation(centre) * scale).as_dmat4();
        scene.instances.push(block);
    }
    scene.cameras = vec![Camera {
        position: eye,
        target,
        up: Vec3::Y,
        projection: Projection::Perspective { fov_y: 1.0 },
    }];
    scene.lights = vec![Light::Directional { direction: sun.normalize() }];
    scene
}

/// Posts and boxes, seen from 2.3 m.
fn open_ground() -> Scene {
    let block = |i: i32| {
        let side = if i % 3 == 0 { 0.15 } else { 0.8 };
        let centre = Vec3::new(5.0 * (i % 12) as f32 - 30.0, 0.9, 48.0 - 4.0 * (i / 12) as f32);
        [centre, Vec3::new(side, 2.0, side)]
    };
    let camera = [Vec3::new(0.5, 2.3, 55.0), Vec3::new(3.0, 1.0, 0.0)];
    ground_with((0..240).map(block), camera, Vec3::new(0.6, -0.8, 0.25))
}

/// A wall of 220 m, seen along it.
fn long_wall() -> Scene {
    let wall = [Vec3::new(-6.0, 3.0, 0.0), Vec3::new(0.6, 6.0, 220.0)];
    let camera = [Vec3::new(2.0, 1.7, 115.0), Vec3::new(2.0, 0.5, -100.0)];
    ground_with([wall].into_iter(), camera, Vec3::new(0.6, -0.8, 0.0))
}

fn technique(spec: &str) -> Box<dyn Technique> {
    specs::techniques(&[spec.into()], KERNEL).unwrap().remove(0)
}

/// RMSE over the pixels of a mask.
fn rmse(answer: &GrayImage, truth: &Visibility, mask: &[bool]) -> f64 {
    let pairs = answer.values.iter().zip(&truth.values).zip(mask).filter(|(_, chosen)| **chosen);
    let (sum, count) = pairs.fold((0.0, 0u32), |(s, n), ((v, t), _)| (s + f64::from(v - t).powi(2), n + 1));
    assert!(count > 1000, "only {count} pixels");
    (sum / f64::from(count)).sqrt()
}

/// Beyond 12 m each technique errs hardly more than without mips; by the longer side of footprints it does.
fn far_shadows_stay(gpu: &Gpu) {
    let mut shot = Picture::new(gpu, &open_ground(), [320, 240]);
    let (_, view) = shot.maps(&[technique("vsm").as_ref()], MAP, Bias::Auto);
    let ideal = shot.light_space_ideal(&view);
    let eye = shot.camera.position.as_dvec3();
    let hits = Tracer::new(&shot.geometry).unwrap().primary(&shot.rays());
    let far: Vec<bool> = std::iter::zip(&hits, &ideal.shadowable)
        .map(|(hit, shadowable)| *shadowable && hit.position.distance(eye) > 12.0)
        .collect();
    let mut error = |spec: &str| rmse(&shot.answer(technique(spec).as_ref(), MAP, Bias::Auto), &ideal, &far);
    for name in FILTERED {
        let [default, bilinear, longer] = [
            error(name),
            error(&format!("{name}.sampling=bilinear")),
            error(&format!("{name}.sampling=trilinear")),
        ];
        let told = format!("{name}: {default}, bilinear {bilinear}, trilinear {longer}");
        println!("{told}");
        assert!(default <= NEARLY * bilinear, "{told}");
        // Where casters are low the ramps of `csm` and `esm` err more than any sampling.
        let sampling_decides = !["csm", "esm"].contains(&name);
        assert!(!sampling_decides || longer > NEARLY * bilinear, "the longer side goes unnoticed: {told}");
    }
}

/// Exponentials make streaks of light in the shadow of a wall that is seen along it, where the farthest
/// parts of a long footprint outweigh all others. A kernel that is no wider than set makes none.
fn no_streaks_along_a_wall(gpu: &Gpu) {
    let mut shot = Picture::new(gpu, &long_wall(), [320, 240]);
    let (_, view) = shot.maps(&[technique("esm").as_ref()], 2 * MAP, Bias::Auto);
    let ideal = shot.light_space_ideal(&view);
    let mut error = |spec: &str| {
        let answer = shot.answer(technique(spec).as_ref(), 2 * MAP, Bias::Auto);
        rmse(&answer, &ideal, &ideal.shadowable)
    };
    let [default, bilinear, longer] =
        ["esm", "esm.sampling=bilinear", "esm.sampling=trilinear"].map(&mut error);
    let told = format!("{default}, bilinear {bilinear}, trilinear {longer}");
    println!("{told}");
    // A short range of depth leaves bilinear lookups next to nothing to err by.
    assert!(default <= (NEARLY * bilinear).max(0.25 * longer), "{told}");
    assert!(longer > NEARLY * bilinear, "streaks go unnoticed: {told}");
}

/// From four times the distance bars are finer than pixels: means over pixels are nearer with mips than
/// without. One texel is farther still.
fn fine_shadows_are_averaged(gpu: &Gpu) {
    let mut scene = procedural::by_name("trees").unwrap().scene(1);
    let mut camera = scene.main_camera();
    camera.position = camera.target + 4.0 * (camera.position - camera.target);
    scene.cameras = vec![camera];
    let mut shot = Picture::new(gpu, &scene, [200, 150]);
    let tracer = Tracer::new(&shot.geometry).unwrap();
    let truth = tracer.supersampled(&shot.rays(), &shot.light, 4, &|_| ());
    drop(tracer);
    let mask = truth.shadowable.clone();
    let mut error = |spec: &str| rmse(&shot.answer(technique(spec).as_ref(), MAP, Bias::Auto), &truth, &mask);
    let [default, bilinear, nearest] =
        ["vsm.kernel=1", "vsm.kernel=1,sampling=bilinear", "vsm.kernel=1,sampling=nearest"].map(&mut error);
    println!("{default}, bilinear {bilinear}, nearest {nearest}");
    assert!(default < 0.95 * bilinear, "{default}, bilinear {bilinear}");
    assert!(nearest > 0.95 * bilinear, "{nearest}, bilinear {bilinear}");
}

fn main() {
    let mut trials = Trials::default();
    trials.add("shadows beyond 12 m on open ground stay", far_shadows_stay);
    trials.add("no streaks in the shadow of a wall seen along it", no_streaks_along_a_wall);
    trials.add("shadows finer than pixels are averaged", fine_shadows_are_averaged);
    trials.run();
}
