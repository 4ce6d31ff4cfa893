//! The tree finds what brute force finds, and closed meshes leak no ray.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use antumbra_scene::Geometry;
use antumbra_truth::{Hit, Ray, SharedTree, Tracer, TruthError};
use common::{Random, geometry, grid, sphere};
use glam::{DVec3, Vec3};

/// Möller–Trumbore over every triangle: nearest distance, and whether another triangle or an edge is
/// too near to tell.
fn brute_force(geometry: &Geometry, ray: &Ray) -> Option<f64> {
    (0..geometry.triangle_count())
        .filter_map(|t| {
            let [a, b, c] = geometry.triangle(t).map(|p| p.as_dvec3());
            let (e, f, arm) = (b - a, c - a, ray.origin - a);
            let p = ray.direction.cross(f);
            let det = e.dot(p);
            let (u, v) = (arm.dot(p) / det, ray.direction.dot(arm.cross(e)) / det);
            let t = f.dot(arm.cross(e)) / det;
            (det != 0.0 && u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0).then_some(t)
        })
        .min_by(f64::total_cmp)
}

fn agrees_with_brute_force(center: DVec3, size: f64) {
    let mut random = Random(7);
    let triangles: Vec<[Vec3; 3]> = (0..600)
        .map(|i| {
            // Every third triangle is small, every fifth a sliver.
            let reach = if i % 3 == 0 { 0.01 } else { 0.5 };
            let a = random.point();
            let b = a + reach * random.point();
            let c = if i % 5 == 0 { b + 1e-3 * random.point() } else { a + reach * random.point() };
            [a, b, c].map(|p| (center + size * p).as_vec3())
        })
        .collect();
    let geometry = geometry(&triangles);
    let tracer = Tracer::new(&geometry).unwrap();
    let mut hits = 0;
    for i in 0..20_000 {
        let far = if i % 2 == 0 { 1.0 } else { 40.0 };
        let origin = center + size * far * random.point();
        let mut direction = center + size * random.point() - origin;
        if i % 7 == 0 {
            direction[i % 3] = if i % 2 == 0 { 0.0 } else { -0.0 };
        }
        if i % 11 == 0 {
            direction = DVec3::AXES[i % 3] * if i % 2 == 0 { 1.0 } else { -1.0 };
        }
        let ray = Ray { origin, direction: direction.normalize() };
        let found = tracer.trace(&ray);
        let expected = brute_force(&geometry, &ray);
        assert_eq!(found.is_hit(), expected.is_some(), "ray {i} {ray:?}");
        if let Some(t) = expected {
            hits += 1;
            let distance = (found.position - ray.origin).length();
            assert!((distance - t).abs() < 1e-10 * (size * far + center.length()), "ray {i}");
        }
    }
    assert!(hits > 3000, "{hits}");
}

#[test]
fn brute_force_near_the_origin() {
    agrees_with_brute_force(DVec3::ZERO, 1.0);
}

#[test]
fn brute_force_for_a_tiny_scene() {
    agrees_with_brute_force(DVec3::ZERO, 1e-6);
}

#[test]
fn brute_force_far_away() {
    agrees_with_brute_force(DVec3::new(1e4, -2e4, 1.5e4), 30.0);
}

#[test]
fn no_ray_leaves_a_sphere() {
    let geometry = geometry(&sphere(DVec3::new(3.0, 0.1, -2.0), 1.0, 40));
    let tracer = Tracer::new(&geometry).unwrap();
    let center = DVec3::new(3.0, 0.1, -2.0);
    let mut random = Random(1);
    for i in 0..100_000 {
        // Half of the rays aim exactly at a corner or at the middle of an edge.
        let origin = center + 0.4 * random.point();
        let [a, b, _] = geometry.triangle(i % geometry.triangle_count()).map(|p| p.as_dvec3());
        let target = match i % 4 {
            0 => a,
            1 => 0.5 * (a + b),
            _ => origin + random.point(),
        };
        let ray = Ray { origin, direction: (target - origin).normalize() };
        assert!(tracer.trace(&ray).is_hit(), "{ray:?}");
    }
}

#[test]
fn hits_are_where_their_barycentrics_say() {
    let triangles = grid(DVec3::new(-1.0, 0.2, -1.0), DVec3::new(2.0, 0.3, 0.0), DVec3::Z * 2.0, 5);
    let geometry = geometry(&triangles);
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = common::picture(DVec3::new(0.4, 3.0, 0.2), DVec3::ZERO, [32, 24]);
    let hits = tracer.primary(&rays);
    assert_eq!(hits.len(), 32 * 24);
    for (i, hit) in hits.iter().enumerate().filter(|(_, hit)| hit.is_hit()) {
        let ray = rays.center_ray(i);
        let [a, b, c] = geometry.triangle(hit.triangle as usize).map(|p| p.as_dvec3());
        assert!((a + hit.u * (b - a) + hit.v * (c - a) - hit.position).length() < 1e-14);
        let arm = hit.position - ray.origin;
        assert!(arm.cross(ray.direction).length() < 1e-14, "on the ray");
        assert!(hit.normal.dot(ray.direction) < 0.0 && (hit.normal.length() - 1.0).abs() < 1e-14);
    }
    assert!(hits.iter().any(|hit| hit.triangle == Hit::NONE), "some look past the grid");
}

#[test]
fn small_and_degenerate_scenes() {
    let one = [Vec3::ZERO, Vec3::X, Vec3::Y];
    for triangles in [vec![one], vec![one, [Vec3::ONE; 3]], vec![one; 300]] {
        let geometry = geometry(&triangles);
        let tracer = Tracer::new(&geometry).unwrap();
        let ray = Ray { origin: DVec3::new(0.2, 0.2, 4.0), direction: DVec3::NEG_Z };
        assert_eq!(tracer.trace(&ray).triangle, 0, "lowest number of {}", triangles.len());
        let ray = Ray { origin: DVec3::new(0.2, 0.2, 4.0), direction: DVec3::Z };
        assert_eq!(tracer.trace(&ray), Hit::MISS, "nothing behind the start");
    }
    let point = geometry(&[[Vec3::ONE; 3]]);
    let ray = Ray { origin: DVec3::ZERO, direction: DVec3::ONE.normalize() };
    assert!(!Tracer::new(&point).unwrap().trace(&ray).is_hit());
}

#[test]
fn refuses_broken_geometry() {
    assert_eq!(Tracer::new(&Geometry::default()).unwrap_err(), TruthError::Empty);
    let good = geometry(&[[Vec3::ZERO, Vec3::X, Vec3::Y]; 2]);
    let mut bad = good.clone();
    bad.positions[4].y = f32::NAN;
    assert_eq!(Tracer::new(&bad).unwrap_err(), TruthError::BadTriangle { triangle: 1 });
    let mut bad = good.clone();
    bad.indices[1] = 6;
    assert_eq!(Tracer::new(&bad).unwrap_err(), TruthError::BadTriangle { triangle: 0 });
    let mut bad = good;
    bad.indices.pop();
    assert_eq!(Tracer::new(&bad).unwrap_err(), TruthError::BadIndices { indices: 5 });
}

/// A tree is shared by tracers of one geometry and never serves another, however alike.
#[test]
fn shared_trees_serve_their_own_geometry() {
    let ball = |radius| geometry(&sphere(DVec3::ZERO, radius, 12));
    let (small, large) = (ball(1.0), ball(1.5));
    let ray = Ray { origin: DVec3::new(0.1, 0.2, 9.0), direction: DVec3::NEG_Z };
    let tree = SharedTree::default();
    let met = |geometry: &Geometry| Tracer::sharing(geometry, &tree).unwrap().trace(&ray);
    let alone = |geometry: &Geometry| Tracer::new(geometry).unwrap().trace(&ray);
    for geometry in [&small, &small, &large, &small] {
        assert_eq!(met(geometry), alone(geometry));
    }
    assert_ne!(alone(&small), alone(&large));
    let broken = Geometry { indices: vec![0, 1, 999_999], ..small };
    assert!(matches!(Tracer::sharing(&broken, &tree), Err(TruthError::BadTriangle { .. })));
    let many = Geometry { indices: [0, 1, 999_999].repeat(large.triangle_count()), ..large };
    assert!(matches!(Tracer::sharing(&many, &tree), Err(TruthError::BadTriangle { .. })));
}
