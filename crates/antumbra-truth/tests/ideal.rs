//! The light-space ideal against integrals that can be done by hand.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use antumbra_scene::Light;
use antumbra_truth::{CameraRays, Kernel, TexelAxes, Tracer};
use common::{geometry, grid, picture, sphere, sun};
use glam::{DVec3, Vec3};

/// Texels of side `size`, turned by `angle` about the light's axis.
fn plane(light: &Light, size: f64, angle: f64) -> TexelAxes {
    let (Light::Directional { direction } | Light::Spot { direction, .. }) = *light;
    let axis = direction.as_dvec3().normalize();
    let (a, b) = axis.any_orthonormal_pair();
    let (sin, cos) = angle.sin_cos();
    TexelAxes { right_per_texel: size * (cos * a + sin * b), down_per_texel: size * (cos * b - sin * a) }
}

/// Share of the kernel left of `x` texels, straight from the definition.
fn cumulative(kernel: &Kernel, x: f64) -> f64 {
    let middle = 0.5 * (kernel.taps().len() as f64 - 1.0);
    let hat = |x: f64| match x {
        x if x <= -1.0 => 0.0,
        x if x <= 0.0 => 0.5 * (x + 1.0) * (x + 1.0),
        x if x < 1.0 => 1.0 - 0.5 * (1.0 - x) * (1.0 - x),
        _ => 1.0,
    };
    kernel.taps().iter().enumerate().map(|(i, tap)| tap * hat(x - (i as f64 - middle))).sum()
}

/// Share of the kernel on the side dx·x + dy·y < limit, by the trapezium rule over rows.
fn half_plane(kernel: &Kernel, direction: [f64; 2], limit: f64) -> f64 {
    let rows = 300;
    let share = |i: i32| (f64::from(i) + 0.5) / f64::from(rows);
    let [dx, dy] = direction;
    let row = |y: f64| match (limit - dy * y) / dx {
        x if dx > 0.0 => cumulative(kernel, x),
        x => 1.0 - cumulative(kernel, x),
    };
    (0..rows).map(|i| row(kernel.offset(share(i)))).sum::<f64>() / f64::from(rows)
}

/// A large square one unit above the ground whose edge x = 0 throws the shadow, and the root mean
/// square error against integration over its penumbra, with the number of pixels in it.
fn penumbra_error(kernel: &Kernel, angle: f64) -> (f64, usize) {
    let ground = grid(DVec3::new(-8.0, 0.0, -8.0), DVec3::X * 16.0, DVec3::Z * 16.0, 4);
    let roof = grid(DVec3::new(-8.0, 1.0, -8.0), DVec3::X * 8.0, DVec3::Z * 16.0, 1);
    let geometry = geometry(&[ground, roof].concat());
    let tracer = Tracer::new(&geometry).unwrap();
    let light = sun(DVec3::new(0.5, 1.0, 0.25));
    let toward = DVec3::new(0.5, 1.0, 0.25).normalize();
    let plane = plane(&light, 0.06, angle);
    let rays = picture(DVec3::new(0.5, 0.9, 1.5), DVec3::new(-0.5, 0.0, 0.0), [100, 75]);
    let ideal = tracer.light_space_ideal(&rays, &light, kernel, &plane, &|_| ());
    let (mut sum, mut count) = (0.0, 0);
    for (hit, value) in tracer.primary(&rays).iter().zip(&ideal.values).filter(|(hit, _)| hit.triangle < 32) {
        // Lit where the path at height 1 has x > 0: x moves with an offset's component across the
        // light, seen along the light onto the level.
        let shift = |step: DVec3| (step - toward * (step.y / toward.y)).x;
        let direction = [-shift(plane.right_per_texel), -shift(plane.down_per_texel)];
        let limit = hit.position.x + toward.x / toward.y * (1.0 - hit.position.y);
        let expected = half_plane(kernel, direction, limit);
        if expected > 1e-3 && expected < 1.0 - 1e-3 {
            sum += (f64::from(*value) - expected).powi(2);
            count += 1;
        }
    }
    ((sum / count as f64).sqrt(), count)
}

#[test]
fn straight_edges_to_a_128th() {
    for taps in [vec![1.0], vec![1.0; 5], vec![1.0, 4.0, 6.0, 4.0, 1.0], vec![1.0; 8]] {
        let kernel = Kernel::new(taps).unwrap();
        for angle in [0.0, 0.3, 0.7] {
            let (error, count) = penumbra_error(&kernel, angle);
            println!("{} taps at {angle}: {error:.5} over {count}", kernel.taps().len());
            assert!(error < 1.0 / 128.0, "{error}");
            assert!(count > 400, "{count}");
        }
    }
}

#[test]
fn tilted_lit_planes_stay_lit() {
    let normal = DVec3::new(0.3, 0.8, -0.2).normalize();
    let along = normal.cross(DVec3::Z).normalize();
    let across = normal.cross(along);
    let geometry = geometry(&grid(-4.0 * (along + across), along * 8.0, across * 8.0, 40));
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = picture(4.0 * normal + along, DVec3::ZERO, [60, 45]);
    let kernel = Kernel::new(vec![1.0; 9]).unwrap();
    for degrees in [80.0_f64, 20.0, 1.0, 0.1] {
        let angle = degrees.to_radians();
        let toward = normal * angle.sin() + (0.8 * along + 0.6 * across) * angle.cos();
        let apex = (3.0 * toward).as_vec3();
        let spot = Light::Spot { position: apex, direction: -toward.as_vec3(), outer_angle: 1.2 };
        for light in [sun(toward), spot] {
            let plane = plane(&light, 0.02, 0.4);
            let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane, &|_| ());
            assert!(ideal.shadowable.iter().filter(|&&s| s).count() > 500);
            assert!(ideal.values.iter().all(|&v| v == 1.0), "{light:?} {degrees}°");
        }
    }
}

/// A shallow bowl of small facets, each 1.5 texels wide, none of which can shadow another; `apart`
/// pulls the facets off each other by a hair, so that they are bodies of their own.
fn bowl_values(apart: f32) -> Vec<f32> {
    let level = grid(DVec3::new(-1.0, 0.0, -1.0), DVec3::X * 2.0, DVec3::Z * 2.0, 64);
    let bend = |p: Vec3| Vec3::new(p.x, 0.2 * (p.x * p.x + p.z * p.z), p.z);
    let facets: Vec<[Vec3; 3]> = level
        .iter()
        .map(|corners| {
            let [a, b, c] = corners.map(bend);
            let middle = (a + b + c) / 3.0;
            [a, b, c].map(|p| p + (middle - p) * apart)
        })
        .collect();
    let geometry = geometry(&facets);
    let tracer = Tracer::new(&geometry).unwrap();
    let light = sun(DVec3::new(0.6, 1.0, 0.2));
    let rays = picture(DVec3::new(0.3, 1.5, 0.5), DVec3::ZERO, [60, 45]);
    let kernel = Kernel::new(vec![1.0; 5]).unwrap();
    let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane(&light, 0.02, 0.3), &|_| ());
    let hits = tracer.primary(&rays);
    let inner = hits.iter().zip(&ideal.values).filter(|(hit, _)| hit.position.abs().max_element() < 0.8);
    inner.map(|(_, value)| *value).collect()
}

#[test]
fn a_surface_does_not_shadow_itself_where_it_curves() {
    let values = bowl_values(0.0);
    assert!(values.len() > 500);
    assert!(values.iter().all(|&v| v == 1.0));
    // Without knowing that the facets hang together, most of them would be in their own shadow.
    let apart = bowl_values(1e-3);
    assert!(apart.iter().filter(|&&v| v < 1.0).count() > apart.len() / 2);
}

/// Visibility under a spot above the edge of a roof, along a line across the shadow's edge.
#[test]
fn spots_widen_with_distance() {
    let ground = grid(DVec3::new(-8.0, 0.0, -8.0), DVec3::X * 16.0, DVec3::Z * 16.0, 4);
    let roof = grid(DVec3::new(-8.0, 1.0, -8.0), DVec3::X * 8.0, DVec3::Z * 16.0, 1);
    let geometry = geometry(&[ground, roof].concat());
    let tracer = Tracer::new(&geometry).unwrap();
    let light = Light::Spot { position: Vec3::Y * 3.0, direction: Vec3::NEG_Y, outer_angle: 1.0 };
    let kernel = Kernel::new(vec![1.0; 5]).unwrap();
    let plane = TexelAxes { right_per_texel: DVec3::X * 0.01, down_per_texel: DVec3::Z * 0.01 };
    let rays = picture(DVec3::new(0.4, 0.8, 0.0), DVec3::ZERO, [100, 75]);
    let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane, &|_| ());
    let mut mixed = 0;
    for (hit, value) in tracer.primary(&rays).iter().zip(&ideal.values).filter(|(hit, _)| hit.triangle < 32) {
        // The edge stands at x = 0 straight below the apex: x/3 at unit distance, in texels.
        let expected = cumulative(&kernel, hit.position.x / 3.0 / 0.01);
        assert!((f64::from(*value) - expected).abs() < 0.02, "{value} {expected}");
        mixed += usize::from(expected > 0.01 && expected < 0.99);
    }
    assert!(mixed > 500, "{mixed}");
}

#[test]
fn narrow_kernels_approach_the_hard_truth() {
    let ground = grid(DVec3::new(-4.0, 0.0, -4.0), DVec3::X * 8.0, DVec3::Z * 8.0, 4);
    let geometry = geometry(&[ground, sphere(DVec3::Y, 0.8, 24)].concat());
    let tracer = Tracer::new(&geometry).unwrap();
    let light = sun(DVec3::new(0.5, 1.0, 0.25));
    let rays = picture(DVec3::new(2.0, 3.0, 4.0), DVec3::ZERO, [80, 60]);
    let hard = tracer.hard(&rays, &light);
    let kernel = Kernel::new(vec![1.0]).unwrap();
    let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane(&light, 1e-7, 0.0), &|_| ());
    assert_eq!(hard, ideal);
}

#[test]
fn repeats_exactly_and_reports_progress() {
    let geometry = geometry(&sphere(DVec3::ZERO, 1.0, 12));
    let tracer = Tracer::new(&geometry).unwrap();
    let light = sun(DVec3::new(0.5, 1.0, 0.25));
    let rays: CameraRays = picture(DVec3::new(0.0, 2.0, 4.0), DVec3::ZERO, [40, 30]);
    let kernel = Kernel::new(vec![1.0; 3]).unwrap();
    let run = |threads| {
        let seen = std::sync::Mutex::new(Vec::new());
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let note = |share| seen.lock().unwrap().push(share);
        let ideal = pool
            .install(|| tracer.light_space_ideal(&rays, &light, &kernel, &plane(&light, 0.1, 0.2), &note));
        let seen = seen.into_inner().unwrap();
        assert!(seen.len() == 60 && seen.contains(&1.0) && seen.iter().all(|&s| s > 0.0 && s <= 1.0));
        ideal
    };
    assert!(run(1) == run(3));
}

#[test]
fn chosen_points_get_what_their_pixels_get() {
    let ground = grid(DVec3::new(-4.0, 0.0, -4.0), DVec3::X * 8.0, DVec3::Z * 8.0, 4);
    let scene = geometry(&[ground, sphere(DVec3::new(0.0, 1.0, 0.0), 0.6, 12)].concat());
    let tracer = Tracer::new(&scene).unwrap();
    let light = sun(DVec3::new(0.5, 1.0, 0.25));
    let rays = picture(DVec3::new(0.5, 3.0, 4.0), DVec3::ZERO, [60, 45]);
    let hits = tracer.primary(&rays);
    let all: Vec<usize> = (0..hits.len()).collect();
    let value = |v: &Option<f32>| v.unwrap_or(1.0);
    let hard = tracer.hard(&rays, &light);
    assert!(tracer.hard_at(&hits, &light).iter().map(value).eq(hard.values));
    let fine = tracer.supersampled(&rays, &light, 3, &|_| ());
    assert!(tracer.supersampled_at(&rays, &all, &light, 3).iter().map(value).eq(fine.values));
    // Pixels whose own samples agree stop at 64 of them; the others are the same.
    let (kernel, plane) = (Kernel::new(vec![1.0; 5]).unwrap(), plane(&light, 0.05, 0.0));
    let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane, &|_| ());
    let chosen = tracer.light_space_ideal_at(&hits, &light, &kernel, &plane);
    let mixed = chosen.iter().filter(|v| v.is_some_and(|v| v > 0.0 && v < 1.0)).count();
    assert!(mixed > 50, "{mixed}");
    for (i, (a, b)) in chosen.iter().map(value).zip(&ideal.values).enumerate() {
        let same = if a > 0.0 && a < 1.0 { a == *b } else { (a - b).abs() < 0.02 };
        assert!(same && chosen[i].is_some() == ideal.shadowable[i], "pixel {i}: {a} and {b}");
    }
    // Another light: what matters is where the points are.
    let other = tracer.hard_at(&hits, &sun(DVec3::new(-0.5, 1.0, 0.25)));
    assert_ne!(other, tracer.hard_at(&hits, &light));
}
