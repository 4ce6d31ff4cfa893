//! Cascades in the lab: shadows where one view of everything in sight has none, and an ideal that knows which
//! map shades a pixel.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::technique::Bias;
use antumbra_lab::{
    compare::{self, Comparison, Request},
    gpu::Gpu,
    metrics::MIN_DEEP_PIXELS,
    progress::NoProgress,
    shot::Shot,
    specs,
};
use antumbra_scene::{Camera, Instance, Light, Material, Mesh, Projection, Scene};
use antumbra_testing::Trials;
use glam::{DMat4, Vec2, Vec3, Vec4};
use std::sync::Arc;

fn main() {
    let mut trials = Trials::default();
    trials.add("cascades_show_what_one_map_of_a_valley_loses", |gpu| {
        let [one, four] = [1, 4].map(|cascades| run(gpu, &Shot { cascades, ..valley() }, &["evsm"]));
        let scores = [&one, &four].map(|c| c.results.techniques[0].scores.hard);
        let none = one.results.truth.no_shadow.rmse;
        // With one view the board's shadow is narrower than a texel: hardly better than none at all.
        assert!(scores[0].rmse > 0.85 * none, "{} {none}", scores[0].rmse);
        assert!(scores[1].rmse < 0.6 * none, "{} {none}", scores[1].rmse);
        let texels: Vec<f32> = four.results.run.views.iter().map(|v| v.texel_world).collect();
        assert!(texels.len() == 4 && texels.is_sorted() && texels[0] < 0.3 * texels[3], "{texels:?}");
        assert_eq!(one.results.run.views.len(), 1);
    });
    trials.add("the_ideal_blurs_by_the_texels_of_each_pixel_s_own_map", |gpu| {
        // Filtered comparison is the ideal but for the size of texels, which this map makes small everywhere.
        let shot = Shot { map_size: 1024, cascades: 4, ..valley() };
        let score = |shot: &Shot| run(gpu, shot, &["pcf"]).results.techniques[0].scores.light_space;
        let rmse = score(&shot).rmse;
        let errors = |comparison: &Comparison| comparison.results.techniques[0].scores.light_space.rmse;
        // Negative control: the same map against the ideal of a kernel four times as wide.
        let wide = Request { shot: Shot { kernel: 17, ..shot.clone() }, ..request(&shot, &["pcf"]) };
        let wrong = errors(&compare::compare(&adopt(gpu), &wide, &NoProgress).unwrap());
        assert!(rmse < 0.05 && wrong > 1.5 * rmse, "{rmse} {wrong}");
    });
    trials.add("parallel_and_rolled_cameras_have_cascades", |gpu| {
        let own = valley();
        let up = Vec3::new(0.3, 1.0, 0.1).normalize();
        let projection = Projection::Orthographic { height: 12.0 };
        let camera = Camera { up, projection, ..own.camera };
        let results = run(gpu, &Shot { camera, cascades: 3, ..own }, &["hard", "dpm"]).results;
        assert_eq!(results.run.views.len(), 3);
        let agreement = results.truth.coverage_agreement;
        assert!(agreement > 0.99, "{agreement}");
        for technique in &results.techniques {
            let matched = technique.scores.hard.pixel_match;
            assert!(matched > results.truth.no_shadow.pixel_match, "{}: {matched}", technique.spec);
        }
    });
    trials.add("means_over_few_pixels_are_told_by_their_number", |gpu| {
        let small = Shot { resolution: [40, 30], ..valley() };
        let score = run(gpu, &small, &["hard"]).results.techniques[0].scores.hard;
        assert!(score.deep_shadow_pixels < MIN_DEEP_PIXELS && score.leak.is_none(), "{score:?}");
        assert!(score.deep_lit_pixels >= MIN_DEEP_PIXELS && score.over_darkening.is_some(), "{score:?}");
    });
    trials.add("every_technique_takes_eight_cascades", |gpu| {
        let shot = Shot { cascades: 8, map_size: 128, resolution: [32, 24], ..valley() };
        let results = run(gpu, &shot, &["all"]).results;
        assert!(results.left_out.is_empty(), "{:?}", results.left_out);
        assert!(results.techniques.iter().all(|t| t.invalid.is_none()), "{:?}", results.techniques);
    });
    trials.run();
}

fn adopt(gpu: &antumbra_testing::Gpu) -> Gpu {
    Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone())
}

fn request(shot: &Shot, specs: &[&str]) -> Request {
    let specs: Vec<String> = specs.iter().map(|s| (*s).into()).collect();
    let techniques = specs::techniques(&specs, shot.kernel).unwrap();
    Request { shot: shot.clone(), techniques, grid: 1, rounds: 1, command: Vec::new() }
}

fn run(gpu: &antumbra_testing::Gpu, shot: &Shot, specs: &[&str]) -> Comparison {
    compare::compare(&adopt(gpu), &request(shot, specs), &NoProgress).unwrap()
}

/// Ground of 3 km between slopes of 1.2 km, and a board of 6 m by 3 m near the camera.
fn valley() -> Shot {
    let mut mesh = Mesh::default();
    let quad = |mesh: &mut Mesh, corners: [[f32; 3]; 4]| {
        let corners = corners.map(Vec3::from);
        let first = mesh.positions.len() as u32;
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        mesh.positions.extend(corners);
        mesh.normals.extend([normal; 4]);
        mesh.uvs.extend([Vec2::ZERO; 4]);
        mesh.colors.extend([Vec4::ONE; 4]);
        mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
    };
    let (w, far, rise) = (200.0, 1500.0, 1200.0);
    quad(&mut mesh, [[-w, 0.0, -far], [-w, 0.0, far], [w, 0.0, far], [w, 0.0, -far]]);
    quad(&mut mesh, [[-2000.0, rise, -far], [-2000.0, rise, far], [-w, 0.0, far], [-w, 0.0, -far]]);
    quad(&mut mesh, [[w, 0.0, -far], [w, 0.0, far], [2000.0, rise, far], [2000.0, rise, -far]]);
    quad(&mut mesh, [[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 3.0, 0.0], [-3.0, 3.0, 0.0]]);
    let scene = Scene {
        name: "valley".into(),
        meshes: vec![mesh],
        instances: vec![Instance::new(0, DMat4::IDENTITY)],
        materials: vec![Material::default()],
        ..Scene::default()
    };
    scene.validate().unwrap();
    Shot {
        name: scene.name.clone(),
        geometry: Arc::new(scene.flatten()),
        tree: Default::default(),
        camera: Camera {
            position: Vec3::new(0.0, 5.0, 14.0),
            target: Vec3::new(0.0, 0.8, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.7 },
        },
        light: Light::Directional { direction: Vec3::new(0.5, -1.0, 0.6).normalize() },
        resolution: [160, 120],
        map_size: 512,
        kernel: 5,
        cascades: 1,
        bias: Bias::Auto,
    }
}
