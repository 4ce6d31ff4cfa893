//! Raster against rays, with rasterisers made wrong on purpose.

#![allow(clippy::unwrap_used, reason = "a test fails by panicking")]

mod common;

use antumbra_scene::{AlphaMode, Geometry, Image, Material};
use antumbra_truth::{CameraRays, Coverage, CoverageTolerance, Hit, Tracer};
use common::{geometry, grid, picture};
use glam::{DVec3, Vec2, Vec3};

fn scene() -> Geometry {
    let ground = grid(DVec3::new(-4.0, 0.0, -4.0), DVec3::X * 8.0, DVec3::Z * 8.0, 6);
    let square = grid(DVec3::new(-0.5, 1.0, -0.5), DVec3::X, DVec3::new(0.0, 0.4, 1.0), 2);
    geometry(&[ground, square].concat())
}

fn rays() -> CameraRays {
    picture(DVec3::new(1.0, 5.0, 6.0), DVec3::ZERO, [200, 150])
}

fn numbers(hits: &[Hit]) -> Vec<u32> {
    hits.iter().map(|hit| hit.triangle).collect()
}

/// Compares with the triangles seen by rays that pass `shift` pixels beside the centres.
fn shifted(shift: f64) -> Coverage {
    let (geometry, rays) = (scene(), rays());
    let tracer = Tracer::new(&geometry).unwrap();
    let raster: Vec<u32> = (0..rays.pixel_count())
        .map(|i| {
            let (x, y) = rays.pixel(i);
            tracer.trace(&rays.ray(f64::from(x) + 0.5 + shift, f64::from(y) + 0.5 - 0.5 * shift)).triangle
        })
        .collect();
    tracer.coverage(&rays, &tracer.primary(&rays), &raster, CoverageTolerance::default())
}

#[test]
fn identical_pictures_agree() {
    let coverage = shifted(0.0);
    assert_eq!((coverage.pixels, coverage.agreement(), coverage.unexplained), (30_000, 1.0, 0));
}

#[test]
fn snapping_is_explained_by_edges() {
    let coverage = shifted(0.008);
    assert!(coverage.edge > 5 && coverage.agreement() > 0.99, "{coverage:?}");
    assert_eq!(coverage.edge + coverage.agree, coverage.pixels, "{coverage:?}");
}

#[test]
fn a_wrong_camera_is_not_explained() {
    let coverage = shifted(0.5);
    assert!(coverage.unexplained > 100, "{coverage:?}");
    assert_eq!(coverage.first_unexplained.len(), Coverage::SHOWN);
    assert_eq!(coverage.agree + coverage.edge + coverage.depth_tie + coverage.unexplained, coverage.pixels);
}

/// Two grounds, the second higher by `lift`, the rasteriser showing the other one everywhere.
fn doubled(lift: f64) -> Coverage {
    let ground =
        |y: f64| grid(DVec3::new(-4.0, y, -4.0), DVec3::new(8.0, 0.3, 0.0), DVec3::new(0.1, 0.7, 8.0), 3);
    let (first, mut second) = (ground(0.0), ground(lift));
    // Wound the other way, as the back of a leaf is.
    second.iter_mut().for_each(|corners| corners.swap(0, 1));
    let count = first.len() as u32;
    let geometry = geometry(&[first, second].concat());
    let tracer = Tracer::new(&geometry).unwrap();
    let hits = tracer.primary(&rays());
    let other = |t: u32| if t < count { t + count } else { t - count };
    let raster: Vec<u32> =
        hits.iter().map(|hit| if hit.is_hit() { other(hit.triangle) } else { Hit::NONE }).collect();
    tracer.coverage(&rays(), &hits, &raster, CoverageTolerance::default())
}

#[test]
fn twins_in_one_plane_agree() {
    let coverage = doubled(0.0);
    assert!(coverage.twins > 10_000, "{coverage:?}");
    assert_eq!(coverage.agree + coverage.edge, coverage.pixels, "{coverage:?}");
}

#[test]
fn triangles_that_nearly_touch_tie_and_no_more() {
    let coverage = doubled(2e-5);
    assert!(coverage.depth_tie > 10_000 && coverage.unexplained == 0, "{coverage:?}");
    assert_eq!(coverage.twins, 0, "{coverage:?}");
    // Negative control: a step that a depth buffer can tell.
    let coverage = doubled(1e-2);
    assert!(coverage.unexplained > 10_000 && coverage.twins == 0, "{coverage:?}");
}

#[test]
fn a_twin_that_is_cut_out_is_none() {
    // The same square, whole and with its right half cut out: where that is, nothing can show it.
    let mut geometry = masked();
    geometry.positions.extend_from_within(..);
    geometry.uvs.extend_from_within(..);
    geometry.colors = vec![glam::Vec4::ONE; 12];
    geometry.normals = vec![Vec3::Y; 12];
    geometry.indices = (0..12).collect();
    geometry.materials.push(Material::default());
    geometry.groups = vec![(1, 0..2), (0, 2..4)];
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = picture(DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO, [81, 61]);
    let hits = tracer.primary(&rays);
    let raster: Vec<u32> =
        hits.iter().map(|h| if h.triangle < 2 { h.triangle + 2 } else { h.triangle }).collect();
    let coverage = tracer.coverage(&rays, &hits, &raster, CoverageTolerance::default());
    assert!(coverage.twins > 100 && coverage.unexplained > 100, "{coverage:?}");
}

#[test]
fn missing_geometry_is_not_explained() {
    let geometry = scene();
    let tracer = Tracer::new(&geometry).unwrap();
    let hits = tracer.primary(&rays());
    let blank = vec![Hit::NONE; hits.len()];
    let coverage = tracer.coverage(&rays(), &hits, &blank, CoverageTolerance::default());
    assert!(coverage.unexplained > 10_000, "{coverage:?}");
    let drawn = numbers(&hits).iter().map(|&t| if t < 72 { t } else { 0 }).collect::<Vec<_>>();
    let coverage = tracer.coverage(&rays(), &hits, &drawn, CoverageTolerance::default());
    assert!(coverage.unexplained > 500, "{coverage:?}");
}

#[test]
fn edges_that_pass_the_camera_are_clipped() {
    // A ground that reaches behind the camera, cut by an edge through the middle of the picture.
    let ground = [
        [Vec3::new(0.0, 0.0, -9.0), Vec3::new(0.0, 0.0, 9.0), Vec3::new(9.0, 0.0, 0.0)],
        [Vec3::new(0.0, 0.0, -9.0), Vec3::new(0.0, 0.0, 9.0), Vec3::new(-9.0, 0.0, 0.0)],
    ];
    let geometry = geometry(&ground);
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = picture(DVec3::new(0.0, 1.0, 2.0), DVec3::new(0.0, 0.5, 0.0), [41, 31]);
    let hits = tracer.primary(&rays);
    let raster: Vec<u32> = (0..hits.len())
        .map(|i| if i % 41 == 20 { 1 - hits[i].triangle.min(1) } else { hits[i].triangle })
        .collect();
    let coverage = tracer.coverage(&rays, &hits, &raster, CoverageTolerance::default());
    assert!(coverage.edge >= 15, "{coverage:?}");
}

/// A square whose right half is cut out, over nothing.
fn masked() -> Geometry {
    let mut geometry = geometry(&grid(DVec3::new(-1.0, 0.0, -1.0), DVec3::X * 2.0, DVec3::Z * 2.0, 1));
    geometry.uvs = geometry.positions.iter().map(|p| Vec2::new(p.x + 1.0, p.z + 1.0) * 0.5).collect();
    let rgba = [255, 255, 255, 255, 255, 255, 255, 0].to_vec();
    geometry.images = vec![Image { name: "half".into(), width: 2, height: 1, rgba, repeat: [false; 2] }];
    geometry.materials = vec![Material {
        base_color_image: Some(0),
        alpha: AlphaMode::Mask { cutoff: 0.5 },
        ..Material::default()
    }];
    geometry
}

#[test]
fn cut_out_points_let_rays_pass() {
    let geometry = masked();
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = picture(DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO, [81, 61]);
    let hits = tracer.primary(&rays);
    let mut both = [0, 0];
    for (i, hit) in hits.iter().enumerate() {
        let ray = rays.center_ray(i);
        let x = (ray.origin - ray.direction * (ray.origin.y / ray.direction.y)).truncate().x;
        if hit.is_hit() {
            assert!(x < 1e-6);
            both[0] += 1;
        } else if x.abs() < 0.99 && hits[i - 1].is_hit() | hits[(i + 1) % hits.len()].is_hit() {
            assert!(x > -1e-6);
            both[1] += 1;
        }
    }
    assert!(both[0] > 100 && both[1] > 10, "{both:?}");
}

#[test]
fn cut_out_points_let_light_pass() {
    let mut geometry = masked();
    let square = geometry.positions.clone();
    geometry.positions = square.iter().map(|&p| 4.0 * p - Vec3::Y).chain(square.iter().copied()).collect();
    geometry.uvs = geometry.positions.iter().map(|p| Vec2::new(p.x + 1.0, p.z + 1.0) * 0.5).collect();
    geometry.colors = vec![glam::Vec4::ONE; 12];
    geometry.normals = vec![Vec3::Y; 12];
    geometry.indices = (0..12).collect();
    geometry.materials.push(Material::default());
    geometry.groups = vec![(1, 0..2), (0, 2..4)];
    let tracer = Tracer::new(&geometry).unwrap();
    let rays = picture(DVec3::new(0.3, -0.5, 5.0), DVec3::new(0.0, -1.0, 0.0), [120, 90]);
    let truth = tracer.hard(&rays, &common::sun(DVec3::Y));
    let mut seen = [0, 0];
    for (hit, value) in tracer.primary(&rays).iter().zip(&truth.values).filter(|(hit, _)| hit.triangle < 2) {
        let place = hit.position;
        let shadowed = place.z.abs() < 1.0 && place.x > -1.0 && place.x < 0.0;
        assert!(place.x.abs() < 1e-6 || (*value < 0.5) == shadowed, "{place}");
        seen[usize::from(shadowed)] += 1;
    }
    assert!(seen[0] > 500 && seen[1] > 50, "{seen:?}");
}

#[test]
fn borders_of_cut_outs_explain() {
    let geometry = masked();
    let tracer = Tracer::new(&geometry).unwrap();
    // The middle column looks at the border of the cut-out.
    let rays = picture(DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO, [81, 61]);
    let hits = tracer.primary(&rays);
    let mut flipped = numbers(&hits);
    let middle = 20 * 81 + 40;
    flipped[middle] = if hits[middle].is_hit() { Hit::NONE } else { 0 };
    let coverage = tracer.coverage(&rays, &hits, &flipped, CoverageTolerance::default());
    assert_eq!((coverage.cutout, coverage.unexplained), (1, 0), "{coverage:?}");
}
