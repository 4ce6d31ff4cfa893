//! The limit of shadow maps that keep triangles is what rays see: every pixel that differs lies within a
//! small part of a texel of a shadow's edge, or shows another triangle to rays than to the rasteriser.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{Capacity, Technique, View, technique::Bias};
use antumbra_lab::{image::GrayImage, readback, specs};
use antumbra_scene::{Light, procedural};
use antumbra_testing::{Gpu, Trials};
use antumbra_truth::{Hit, Tracer, Visibility};
use common::Picture;
use glam::DVec3;

const RESOLUTION: [u32; 2] = [256, 192];

/// Scene, texels along a side of the map, least pixel match.
const CASES: [(&str, u32, f64); 5] = [
    ("contact", 256, 0.9995),
    ("fence", 512, 0.9990),
    ("layers", 128, 0.9995),
    ("spheres", 256, 0.9995),
    ("spot", 256, 0.9990),
];

/// Memory for all triangles of these scenes and for what shares their texels.
const ENOUGH: Capacity = Capacity { triangles: 1 << 19, triangles_per_texel: 64 };

/// How far a receiver is moved to see whether it is at an edge, in texels.
const NEAR: f64 = 0.02;

fn main() {
    let mut trials = Trials::default();
    for (scene, size, min) in CASES {
        trials.add(format!("{scene}: what rays see"), move |gpu| {
            let found = Differences::of("exact", ENOUGH, gpu, scene, size);
            if std::env::var_os("ANTUMBRA_MEASURE").is_some() {
                eprintln!("{scene}: {found:?}");
            }
            assert_eq!(found.unexplained, 0, "{found:?}");
            assert!(found.pixel_match() >= min, "{found:?}");
        });
        trials.add(format!("{scene}: rejected: one triangle per texel"), move |gpu| {
            let found = Differences::of("hard", ENOUGH, gpu, scene, size);
            assert!(found.unexplained > 50, "{found:?}");
        });
    }
    trials.add("rejected: lists that are cut", |gpu| {
        let few = Capacity { triangles: 1000, ..ENOUGH };
        let found = Differences::of("exact", few, gpu, "spheres", 256);
        assert!(found.unexplained > 50, "{found:?}");
    });
    trials.run();
}

/// Pixels that can be in shadow, and those that differ, by reason.
#[derive(Debug, Default)]
struct Differences {
    shadowable: usize,
    /// The rasteriser shows another triangle than the ray.
    other_triangle: usize,
    /// Rays next to it agree.
    edge: usize,
    unexplained: usize,
}

impl Differences {
    fn of(spec: &str, capacity: Capacity, gpu: &Gpu, scene: &str, size: u32) -> Self {
        let scene = procedural::by_name(scene).unwrap().scene(1);
        let mut shot = Picture::new(gpu, &scene, RESOLUTION);
        shot.capacity = capacity;
        let technique = specs::techniques(&[spec.into()], 5).unwrap().remove(0);
        let technique: &dyn Technique = technique.as_ref();
        let (maps, view) = shot.maps(&[technique], size, Bias::Auto);
        let answer = shot.visibility(&maps[0]);
        let tracer = Tracer::new(&shot.geometry).unwrap();
        let hits = tracer.primary(&shot.rays());
        let drawn = readback::triangle_ids(&shot.gpu, &shot.gpu_scene, &shot.geometry).unwrap();
        Self::count(&tracer, &shot.light, &view, &hits, &drawn, &answer, &shot.hard_truth())
    }

    fn count(
        tracer: &Tracer<'_>,
        light: &Light,
        view: &View,
        hits: &[Hit],
        drawn: &[u32],
        answer: &GrayImage,
        truth: &Visibility,
    ) -> Self {
        let mut found = Self::default();
        for (i, hit) in hits.iter().enumerate().filter(|(i, _)| truth.shadowable[*i]) {
            let (x, y) = (i as u32 % answer.width, i as u32 / answer.width);
            let lit = answer.get(x, y).unwrap() >= 0.5;
            found.shadowable += 1;
            if lit == (truth.values[i] >= 0.5) {
                continue;
            }
            if drawn[i] != hit.triangle {
                found.other_triangle += 1;
            } else if near(light, view, hit)
                .iter()
                .any(|hit| tracer.visibility(light, hit).is_some_and(|v| (v >= 0.5) == lit))
            {
                found.edge += 1;
            } else {
                found.unexplained += 1;
            }
        }
        found
    }

    fn pixel_match(&self) -> f64 {
        1.0 - (self.other_triangle + self.edge + self.unexplained) as f64 / self.shadowable as f64
    }
}

/// The receiver moved on its plane, seen from the light in eight directions and not at all, and towards
/// the light, as biases do.
fn near(light: &Light, view: &View, hit: &Hit) -> Vec<Hit> {
    let (to_light, distance) = match *light {
        Light::Directional { direction } => (-direction.as_dvec3().normalize(), 1.0),
        Light::Spot { position, direction, .. } => {
            let arm = position.as_dvec3() - hit.position;
            (arm.normalize(), -arm.dot(direction.as_dvec3().normalize()))
        }
    };
    let reach = NEAR * f64::from(view.texel_world) * distance;
    let (right, down) = to_light.any_orthonormal_pair();
    let rise = hit.normal.dot(to_light).max(1e-3);
    let around = (0..9).map(|k| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
        if k == 8 { DVec3::ZERO } else { reach * (cosine * right + sine * down) }
    });
    let on_plane = around.map(|step| step - to_light * (hit.normal.dot(step) / rise));
    on_plane
        .flat_map(|step| [0.0, 1.0].map(|lift| hit.position + step + lift * reach / rise * to_light))
        .map(|position| Hit { position, ..*hit })
        .collect()
}
