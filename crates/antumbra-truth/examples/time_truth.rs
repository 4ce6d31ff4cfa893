//! Prints what the truth costs on a scene: `cargo run --release --example time_truth -- [scene]`.

use antumbra_scene::Light;
use antumbra_scene::procedural::{self, Procedural};
use antumbra_truth::{CameraRays, Kernel, TexelAxes, Tracer, Visibility};
use std::time::Instant;

/// Texels of `size` world units (for a spot: at distance 1), facing the light.
fn texel_axes(light: &Light, size: f64) -> TexelAxes {
    let (Light::Directional { direction } | Light::Spot { direction, .. }) = *light;
    let right = direction.as_dvec3().any_orthonormal_vector();
    let down = direction.as_dvec3().cross(right).normalize();
    TexelAxes { right_per_texel: right * size, down_per_texel: down * size }
}

fn count_shadowable(visibility: &Visibility) -> f64 {
    visibility.shadowable.iter().filter(|&&s| s).count() as f64
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let name = std::env::args().nth(1).unwrap_or_else(|| "fence".into());
    let entry = procedural::by_name(&name).ok_or("no such scene")?;
    let scene = entry.scene(Procedural::DEFAULT_SEED);
    let geometry = scene.flatten();
    let (camera, light) = (scene.cameras[0], scene.lights[0]);
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
    let plane = texel_axes(&light, 0.015);
    for count in [5, 9] {
        let kernel = Kernel::new(vec![1.0; count])?;
        let start = Instant::now();
        let ideal = tracer.light_space_ideal(&rays, &light, &kernel, &plane, &|_| ());
        let mixed = ideal.values.iter().filter(|&&v| v > 0.0 && v < 1.0).count() as f64;
        // A lower bound: unmixed neighbours of mixed pixels were refined too.
        report(&format!("ideal {count}"), start, 66.0 * count_shadowable(&ideal) + 193.0 * mixed);
    }
    Ok(())
}
