//! Prints what the truth costs on a scene: `cargo run --release --example time_truth [scene]`.

use antumbra_scene::{Camera, Geometry, Light};
use antumbra_truth::{CameraRays, Tracer};
use glam::Vec3;
use std::time::Instant;

fn boxes(count: i32) -> Geometry {
    let mut geometry = Geometry::default();
    let mut add = |low: Vec3, high: Vec3| {
        for face in 0..6 {
            let (axis, side) = (face / 2, face % 2);
            let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
            let base = geometry.positions.len() as u32;
            for (s, t) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
                let mut corner = low;
                corner[axis] = if side == 0 { low[axis] } else { high[axis] };
                corner[i] = if s == 0 { low[i] } else { high[i] };
                corner[j] = if t == 0 { low[j] } else { high[j] };
                geometry.positions.push(corner);
            }
            geometry.indices.extend([0, 1, 2, 0, 2, 3].map(|k| base + k));
        }
    };
    add(Vec3::new(-20.0, -0.2, -20.0), Vec3::new(20.0, 0.0, 20.0));
    for i in 0..count {
        for j in 0..count {
            let at =
                Vec3::new(i as f32, 0.0, j as f32) * (30.0 / count as f32) - 15.0 * Vec3::new(1.0, 0.0, 1.0);
            let tall = 0.3 + 0.1 * ((i * 7 + j * 13) % 11) as f32;
            add(at, at + Vec3::new(0.02, tall, 0.02));
        }
    }
    geometry
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let geometry = boxes(174);
    let camera = Camera {
        position: Vec3::new(9.0, 5.0, 16.0),
        target: Vec3::new(0.0, 0.0, 0.0),
        up: Vec3::Y,
        fov_y: 0.8,
    };
    let light = Light::Directional { direction: Vec3::new(-0.5, -0.7, -0.3).normalize() };
    let start = Instant::now();
    let tracer = Tracer::new(&geometry)?;
    println!("build      {:6.2} s  {} triangles", start.elapsed().as_secs_f64(), geometry.triangle_count());
    let rays = CameraRays::new(&camera, 1024, 768)?;
    let count = rays.pixel_count() as f64;
    let report = |name: &str, start: Instant, traced: f64| {
        let seconds = start.elapsed().as_secs_f64();
        println!("{name:10} {seconds:6.2} s  {:6.2} Mrays/s", traced / seconds * 1e-6);
    };
    let start = Instant::now();
    let hits = tracer.primary(&rays);
    report("primary", start, count);
    println!("{} hits", hits.iter().filter(|h| h.is_hit()).count());
    let start = Instant::now();
    let hard = tracer.hard(&rays, &light);
    report("hard", start, 2.0 * count);
    println!("{} lit", hard.values.iter().filter(|&&v| v > 0.5).count());
    let start = Instant::now();
    let _ = tracer.supersampled(&rays, &light, 4, &|_| ());
    report("4x4", start, 32.0 * count);
    Ok(())
}
