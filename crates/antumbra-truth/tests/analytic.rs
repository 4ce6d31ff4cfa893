//! Hard truth against shadows that can be computed by hand, and two broken starts that must fail.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use antumbra_scene::{Geometry, Light};
use antumbra_truth::{CameraRays, Hit, Tracer};
use common::{Random, geometry, grid, picture, sphere, sun, zoom};
use glam::{DVec2, DVec3, Vec3};

/// Unit vector from `point` to the light.
fn toward(light: &Light, point: DVec3) -> DVec3 {
    match *light {
        Light::Directional { direction } => -direction.as_dvec3().normalize(),
        Light::Spot { position, .. } => (position.as_dvec3() - point).normalize(),
    }
}

/// What the analysis says of a point: how far inside a shadow it is (negative: outside), world
/// units.
type Depth<'a> = &'a dyn Fn(DVec3) -> f64;

/// Pixels on the ground (triangles below `ground`) that disagree with the analysis although they
/// are farther than `tolerance` from the shadow's edge; and how many were nearer than 100 times
/// that, so that one knows that the edge was looked at.
fn disagreements(
    tracer: &Tracer,
    rays: &CameraRays,
    light: &Light,
    ground: u32,
    depth: Depth,
    tolerance: f64,
) -> (usize, usize) {
    let (mut wrong, mut near) = (0, 0);
    let hits = tracer.primary(rays);
    let truth = tracer.hard(rays, light);
    for (hit, value) in hits.iter().zip(&truth.values).filter(|(hit, _)| hit.triangle < ground) {
        let depth = depth(hit.position);
        near += usize::from(depth.abs() < 100.0 * tolerance);
        wrong += usize::from(depth.abs() > tolerance && (*value < 0.5) != (depth > 0.0));
    }
    (wrong, near)
}

/// How deep `point` is in the shadow of the square of half side `half` around `center`, level.
fn depth_in_square(light: &Light, center: DVec3, half: f64, point: DVec3) -> f64 {
    let direction = toward(light, point);
    let crossing = point + direction * ((center.y - point.y) / direction.y);
    let arm = (crossing - center).abs();
    half - arm.x.max(arm.z)
}

/// A square of side 1 one unit above a square of side 8, both around `center`.
fn square_over_ground(center: DVec3) -> (Geometry, u32) {
    let ground = grid(center - DVec3::new(4.0, 0.0, 4.0), DVec3::X * 8.0, DVec3::Z * 8.0, 8);
    let count = ground.len() as u32;
    let square = grid(center + DVec3::new(-0.5, 1.0, -0.5), DVec3::X, DVec3::Z, 1);
    (geometry(&[ground, square].concat()), count)
}

fn lights(center: DVec3) -> Vec<Light> {
    let apex = (center + DVec3::new(0.5, 3.0, -0.75)).as_vec3();
    let spot = Light::Spot { position: apex, direction: Vec3::NEG_Y, outer_angle: 1.2 };
    vec![sun(DVec3::new(0.3, 1.0, 0.2)), sun(DVec3::new(-1.5, 1.0, 0.4)), spot]
}

/// Checks the square's shadow in an overview and through microscopes on its edges.
fn square_shadow_is_exact(origin: DVec3) {
    let (geometry, ground) = square_over_ground(origin);
    let tracer = Tracer::new(&geometry).unwrap();
    let center = origin + DVec3::Y;
    for light in lights(origin) {
        let depth = |point: DVec3| depth_in_square(&light, center, 0.5, point);
        let rays = picture(origin + DVec3::new(1.0, 5.0, 6.0), origin, [200, 150]);
        let (wrong, _) = disagreements(&tracer, &rays, &light, ground, &depth, 1e-5);
        assert_eq!(wrong, 0, "{light:?}");
        for corner in [DVec3::new(0.5, 0.0, 0.1), DVec3::new(-0.2, 0.0, -0.5), DVec3::new(-0.5, 0.0, 0.5)] {
            // Where this point of the square's edge throws its shadow.
            let edge = center + corner;
            let direction = toward(&light, edge);
            let shadow = edge - direction / direction.y;
            let eye = shadow + DVec3::new(2.0, 2.0, 2.5) * (corner - DVec3::Y * corner.y + DVec3::Y);
            let rays = zoom(eye, shadow, 1e-2);
            let (wrong, near) = disagreements(&tracer, &rays, &light, ground, &depth, 1e-5);
            assert_eq!(wrong, 0, "{light:?} at {corner}");
            assert!(near > 50, "{near} pixels near the edge");
        }
    }
}

#[test]
fn square_shadow_near_the_origin() {
    square_shadow_is_exact(DVec3::ZERO);
}

#[test]
fn square_shadow_far_from_the_origin() {
    square_shadow_is_exact(DVec3::new(1e4, -2e4, 1.5e4));
}

#[test]
fn sphere_on_a_plane() {
    let ground = grid(DVec3::new(-8.0, 0.0, -8.0), DVec3::X * 16.0, DVec3::Z * 16.0, 3);
    let count = ground.len() as u32;
    let geometry = geometry(&[ground, sphere(DVec3::Y, 1.0, 150)].concat());
    let tracer = Tracer::new(&geometry).unwrap();
    for light in [sun(DVec3::new(0.6, 1.0, -0.3)), sun(DVec3::new(-2.0, 1.0, 0.0))] {
        // Shadowed where the light's line passes the centre at less than the radius.
        let depth = |point: DVec3| 1.0 - (DVec3::Y - point).cross(toward(&light, point)).length();
        for rays in [
            picture(DVec3::new(3.0, 4.0, 5.0), DVec3::ZERO, [200, 150]),
            zoom(DVec3::new(2.0, 0.4, 2.0), DVec3::ZERO, 0.02),
        ] {
            // The facets lie up to 1.4·10⁻⁴ inside the sphere.
            let (wrong, _) = disagreements(&tracer, &rays, &light, count, &depth, 2e-4);
            assert_eq!(wrong, 0, "{light:?}");
            for (hit, value) in tracer.primary(&rays).iter().zip(tracer.hard(&rays, &light).values) {
                let rise = hit.normal.dot(toward(&light, hit.position));
                if hit.triangle >= count && hit.is_hit() && rise > 0.03 {
                    assert_eq!(value, 1.0, "the sphere's own lit side, {rise}");
                }
            }
        }
    }
}

/// Where an ulp of f32 is a millimetre.
const FAR: DVec3 = DVec3::new(1e4, -9e3, 1.2e4);

/// Share of acne on a finely cut plane, tilted so that no corner is exact in f32, under light that grazes it.
fn acne(origin: DVec3, degrees: f64, clearance_ulps: f64) -> f64 {
    let normal = DVec3::new(0.31, 0.83, -0.27).normalize();
    let along = normal.cross(DVec3::new(0.2, 0.1, 1.0)).normalize();
    let across = normal.cross(along);
    let corner = origin - 4.0 * (along + across);
    let geometry = geometry(&grid(corner, along * 8.0, across * 8.0, 64));
    let tracer = Tracer::new(&geometry).unwrap().with_clearance_ulps(clearance_ulps);
    let angle = degrees.to_radians();
    let light = sun(normal * angle.sin() + (0.8 * along + 0.6 * across) * angle.cos());
    let rays = picture(origin + 5.0 * normal + along, origin, [160, 120]);
    let truth = tracer.hard(&rays, &light);
    let scored = truth.shadowable.iter().filter(|&&s| s).count();
    assert!(scored > 8000, "{scored}");
    truth.values.iter().filter(|&&v| v < 0.5).count() as f64 / scored as f64
}

#[test]
fn grazing_light_brings_no_acne() {
    assert_eq!(acne(DVec3::ZERO, 1.0, Tracer::CLEARANCE_ULPS), 0.0);
    assert_eq!(acne(DVec3::ZERO, 0.1, Tracer::CLEARANCE_ULPS), 0.0);
    assert_eq!(acne(FAR, 2.0, Tracer::CLEARANCE_ULPS), 0.0);
    assert_eq!(acne(FAR, 0.1, Tracer::CLEARANCE_ULPS), 0.0);
}

#[test]
fn without_clearance_there_is_acne() {
    assert!(acne(FAR, 0.1, 0.0) > 0.1);
}

/// A box on the ground, a slab 5 mm above it, and light at one degree behind a low wall: the
/// disagreements with analysis.
fn contact_errors(clearance_metres: Option<f64>) -> usize {
    let cube = |low: DVec3, high: DVec3| {
        let size = high - low;
        let [x, y, z] = [DVec3::X * size.x, DVec3::Y * size.y, DVec3::Z * size.z];
        [(low, x, z), (low + y, x, z), (low, x, y), (low + z, x, y), (low, z, y), (low + x, z, y)]
            .iter()
            .flat_map(|&(corner, a, b)| grid(corner, a, b, 1))
            .collect::<Vec<_>>()
    };
    let ground = grid(DVec3::new(-2.0, 0.0, -2.0), DVec3::X * 4.0, DVec3::Z * 4.0, 16);
    let count = ground.len() as u32;
    // Their shadows point to −x; all coordinates are exact in f32.
    let solids = [
        (DVec3::new(0.0, 0.0, -1.5), DVec3::new(0.25, 0.25, -0.5)),
        (DVec3::new(0.0, 1.0 / 256.0, -0.25), DVec3::new(0.25, 2.0 / 256.0, 0.5)),
        (DVec3::new(0.0, 0.0, 1.0), DVec3::new(1.0 / 64.0, 1.0 / 64.0, 1.5)),
    ];
    let triangles: Vec<_> = solids.iter().flat_map(|&(low, high)| cube(low, high)).collect();
    let geometry = geometry(&[ground, triangles].concat());
    let ulp = f64::from(2.0_f32.next_up() - 2.0);
    let tracer = Tracer::new(&geometry).unwrap();
    let tracer = match clearance_metres {
        Some(metres) => tracer.with_clearance_ulps(metres / ulp),
        None => tracer,
    };
    let mut wrong = 0;
    for degrees in [40.0_f64, 10.0, 1.0] {
        let light = sun(DVec3::new(degrees.to_radians().cos(), degrees.to_radians().sin(), 0.0));
        let depth = |point: DVec3| {
            let slope = toward(&light, point).y / toward(&light, point).x;
            // The ray is inside a solid's slab of heights between these two x.
            let inside = solids.iter().map(|(low, high)| {
                let (enters, leaves) =
                    (point.x + (low.y - point.y) / slope, point.x + (high.y - point.y) / slope);
                let in_x = (high.x - enters).min(leaves - low.x);
                in_x.min(point.z - low.z).min(high.z - point.z)
            });
            inside.fold(f64::NEG_INFINITY, f64::max)
        };
        for rays in [
            picture(DVec3::new(-1.5, 2.0, 0.2), DVec3::new(-0.3, 0.0, 0.0), [200, 150]),
            zoom(DVec3::new(-0.5, 0.6, -0.8), DVec3::new(0.0, 0.0, -0.8), 0.01),
            zoom(DVec3::new(-0.5, 0.6, 1.2), DVec3::new(0.0, 0.0, 1.25), 0.01),
            zoom(DVec3::new(-0.5, 0.6, 0.2), DVec3::new(0.0, 0.0, 0.25), 0.05),
        ] {
            wrong += disagreements(&tracer, &rays, &light, count, &depth, 2e-5).0;
        }
    }
    wrong
}

#[test]
fn contact_shadows_touch() {
    assert_eq!(contact_errors(None), 0);
}

#[test]
fn a_centimetre_of_clearance_loses_contact() {
    assert!(contact_errors(Some(0.01)) > 100);
}

#[test]
fn only_pixels_that_face_the_light_count() {
    let (geometry, ground) = square_over_ground(DVec3::ZERO);
    let tracer = Tracer::new(&geometry).unwrap();
    // Light from below: the ground seen from above does not face it.
    let rays = picture(DVec3::new(0.0, 5.0, 3.0), DVec3::ZERO, [40, 30]);
    let below = tracer.hard(&rays, &sun(DVec3::NEG_Y));
    assert!(below.shadowable.iter().all(|&s| !s) && below.values.iter().all(|&v| v == 1.0));
    // A spot lights a disk of radius 3·tan(0.3) only.
    let spot = Light::Spot { position: Vec3::Y * 3.0, direction: Vec3::NEG_Y, outer_angle: 0.3 };
    let truth = tracer.hard(&rays, &spot);
    for (hit, shadowable) in tracer.primary(&rays).iter().zip(&truth.shadowable) {
        let height = 3.0 - hit.position.y;
        let radius = DVec2::new(hit.position.x, hit.position.z).length();
        let near_edge = (radius - height * 0.3_f64.tan()).abs() < 1e-6;
        assert!(near_edge || *shadowable == (hit.is_hit() && radius < height * 0.3_f64.tan()), "{hit:?}");
    }
    assert!(truth.shadowable.iter().any(|&s| s));
    assert!(tracer.primary(&rays).iter().any(|hit| hit.triangle >= ground && hit.triangle != Hit::NONE));
}

#[test]
fn supersampling_averages_the_hard_truth() {
    let (geometry, _) = square_over_ground(DVec3::ZERO);
    let tracer = Tracer::new(&geometry).unwrap();
    let light = sun(DVec3::new(0.3, 1.0, 0.2));
    let eye = DVec3::new(1.0, 5.0, 6.0);
    let coarse = tracer.supersampled(&picture(eye, DVec3::ZERO, [40, 30]), &light, 4, &|_| ());
    let fine = tracer.hard(&picture(eye, DVec3::ZERO, [160, 120]), &light);
    let mut partial = 0;
    for (i, value) in coarse.values.iter().enumerate() {
        let (x, y) = (4 * (i % 40), 4 * (i / 40));
        let samples = (0..16).map(|k| (y + k / 4) * 160 + x + k % 4).filter(|&s| fine.shadowable[s]);
        let values: Vec<f32> = samples.map(|s| fine.values[s]).collect();
        assert_eq!(coarse.shadowable[i], !values.is_empty());
        if !values.is_empty() {
            assert_eq!(*value, values.iter().sum::<f32>() / values.len() as f32);
        }
        partial += usize::from(*value > 0.0 && *value < 1.0);
    }
    assert!(partial > 5, "{partial}");
}

#[test]
fn threads_change_nothing() {
    let mut random = Random(3);
    let soup: Vec<[Vec3; 3]> = (0..3000)
        .map(|_| {
            let center = random.point();
            [0, 1, 2].map(|_| (center + 0.1 * random.point()).as_vec3())
        })
        .collect();
    let geometry = geometry(&soup);
    let rays = picture(DVec3::new(0.5, 2.0, 3.0), DVec3::ZERO, [80, 60]);
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let tracer = Tracer::new(&geometry).unwrap();
            (tracer.primary(&rays), tracer.hard(&rays, &sun(DVec3::new(0.3, 1.0, 0.2))))
        })
    };
    assert!(run(1) == run(3));
}
