//! A camera and a sun for scenes that bring none, chosen so that the picture shows shadows.
//!
//! A few cameras (from outside, and from inside as for a building) and suns (all around, at three heights) are
//! tried with rays on a picture of 48×36 pixels. The score of a pair is the share of the picture that can be in
//! shadow, weighed by how evenly light and shadow divide it; the first pair that comes near the best wins, so
//! that the usual three-quarter view stays where it does its work.

use antumbra_scene::{Camera, Geometry, Light, Projection, Scene};
use antumbra_truth::{CameraRays, Tracer, TruthError};
use glam::{DVec3, Quat, Vec3};

/// Pixels of the trial pictures.
const PICTURE: [u32; 2] = [48, 36];
/// A pair that has this share of the best score is as good.
const AS_GOOD: f64 = 0.8;
/// Heights of the suns above the horizon that are tried, radians.
const HEIGHTS: [f32; 3] = [0.79, 0.52, 1.05];
/// Suns around the horizon that are tried.
const AROUND: u32 = 8;
/// Height of the eye above the floor, as a share of the scene's height, for views from inside.
const EYE_HEIGHT: f32 = 0.12;

/// The given camera and light, or where one is missing the candidate that shows shadows best.
///
/// Cost: one tree over the triangles and some 300,000 rays; nothing if both are given.
///
/// # Errors
/// [`TruthError`], as [`Tracer::new`].
pub fn choose(
    scene: &Scene,
    geometry: &Geometry,
    camera: Option<Camera>,
    light: Option<Light>,
) -> Result<(Camera, Light), TruthError> {
    if let (Some(camera), Some(light)) = (camera, light) {
        return Ok((camera, light));
    }
    let tracer = Tracer::new(geometry)?;
    let cameras = camera.map_or_else(|| cameras(scene, &tracer), |camera| vec![camera]);
    let mut pairs: Vec<(f64, Camera, Light)> = Vec::new();
    for camera in &cameras {
        let rays = CameraRays::new(camera, PICTURE[0], PICTURE[1])?;
        for light in light.map_or_else(|| suns(camera), |light| vec![light]) {
            pairs.push((score(&tracer, &rays, &light), *camera, light));
        }
    }
    let best = pairs.iter().map(|pair| pair.0).fold(0.0, f64::max);
    let chosen = pairs.iter().find(|pair| pair.0 >= AS_GOOD * best);
    Ok(chosen
        .map_or_else(|| (scene.main_camera(), scene.main_light()), |(_, camera, light)| (*camera, *light)))
}

/// How well a picture shows shadows, 0 to 1.
fn score(tracer: &Tracer<'_>, rays: &CameraRays, light: &Light) -> f64 {
    let picture = tracer.hard(rays, light);
    let shadowable = picture.shadowable.iter().filter(|s| **s).count() as f64;
    let dark =
        picture.values.iter().zip(&picture.shadowable).filter(|(v, s)| **s && **v < 0.5).count() as f64;
    if shadowable == 0.0 {
        return 0.0;
    }
    let share = dark / shadowable;
    4.0 * share * (1.0 - share) * shadowable / picture.values.len() as f64
}

/// The usual view from outside, then two from inside, along the longer side.
fn cameras(scene: &Scene, tracer: &Tracer<'_>) -> Vec<Camera> {
    let outside = scene.default_camera();
    let Some(bounds) = tracer.geometry().bounds() else { return vec![outside] };
    let (middle, size) = (bounds.center(), bounds.size());
    let along = if size.x >= size.z { Vec3::X * size.x } else { Vec3::Z * size.z };
    let inside = |side: f32| {
        let eye = middle - along * (0.3 * side);
        let floor = below(tracer, outside, eye)?;
        let position = Vec3::new(eye.x, floor + EYE_HEIGHT * size.y, eye.z);
        // A little above the eye: roofs and upper storeys are in the picture too.
        let target = Vec3::new(middle.x, position.y + 0.05 * size.y, middle.z) + along * (0.2 * side);
        Some(Camera { position, target, projection: Projection::Perspective { fov_y: 1.0 }, ..outside })
    };
    [Some(outside), inside(1.0), inside(-1.0)].into_iter().flatten().collect()
}

/// Height of the first surface below a point; `None` if there is none.
fn below(tracer: &Tracer<'_>, camera: Camera, point: Vec3) -> Option<f32> {
    let down = Camera { position: point, target: point - Vec3::Y, up: Vec3::Z, ..camera };
    let hits = tracer.primary(&CameraRays::new(&down, 1, 1).ok()?);
    let position: DVec3 = hits.first().filter(|hit| hit.is_hit())?.position;
    Some(position.y as f32)
}

/// Suns all around a camera, the one over its left shoulder at 45° first.
fn suns(camera: &Camera) -> Vec<Light> {
    let forward = camera.target - camera.position;
    let level = Vec3::new(forward.x, 0.0, forward.z).normalize_or(Vec3::NEG_Z);
    let first = (level.cross(Vec3::Y) * 0.8 + level * 0.6).normalize();
    let turned = |i: u32| Quat::from_rotation_y(i as f32 * std::f32::consts::TAU / AROUND as f32) * first;
    let sun = |height: f32, i: u32| {
        let direction = (turned(i) * height.cos() - Vec3::Y * height.sin()).normalize();
        Light::Directional { direction }
    };
    HEIGHTS.iter().flat_map(|height| (0..AROUND).map(move |i| sun(*height, i))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra_scene::{Instance, Material, Mesh, procedural};

    /// Share of the shadowable pixels that are in shadow.
    fn shadow(geometry: &Geometry, camera: &Camera, light: &Light) -> f64 {
        let rays = CameraRays::new(camera, 96, 72).unwrap();
        let picture = Tracer::new(geometry).unwrap().hard(&rays, light);
        let shadowable = picture.shadowable.iter().filter(|s| **s).count();
        let dark = picture.values.iter().zip(&picture.shadowable).filter(|(v, s)| **s && **v < 0.5).count();
        dark as f64 / shadowable as f64
    }

    /// A box of quads around the origin, open at the top, whose walls cast shadows on its floor alone.
    fn courtyard() -> Scene {
        let (x, y, z) = (8.0, 5.0, 3.0);
        let corner = |i: u32| {
            Vec3::new([-x, x][(i & 1) as usize], [0.0, y][(i >> 1 & 1) as usize], [-z, z][(i >> 2) as usize])
        };
        let quads = [[0, 1, 5, 4], [0, 1, 3, 2], [4, 5, 7, 6], [0, 4, 6, 2], [1, 5, 7, 3]];
        let indices = quads.iter().flat_map(|[a, b, c, d]| [*a, *b, *c, *a, *c, *d]).collect();
        let mesh = Mesh {
            positions: (0..8).map(corner).collect(),
            normals: vec![Vec3::Y; 8],
            uvs: vec![Default::default(); 8],
            colors: vec![glam::Vec4::ONE; 8],
            indices,
            ..Default::default()
        };
        Scene {
            meshes: vec![mesh],
            instances: vec![Instance { mesh: 0, world_from_mesh: Default::default() }],
            materials: vec![Material::default()],
            ..Default::default()
        }
    }

    #[test]
    fn views_show_shadows_on_every_built_in_scene_without_its_own() {
        for entry in procedural::all().iter().filter(|entry| entry.triangles < 200_000) {
            let mut scene = entry.scene(1);
            (scene.cameras, scene.lights) = (Vec::new(), Vec::new());
            let geometry = scene.flatten();
            let (camera, light) = choose(&scene, &geometry, None, None).unwrap();
            let share = shadow(&geometry, &camera, &light);
            assert!((0.03..0.97).contains(&share), "{}: {share}", entry.name);
        }
    }

    #[test]
    fn buildings_are_seen_from_inside() {
        let scene = courtyard();
        let geometry = scene.flatten();
        let (camera, light) = choose(&scene, &geometry, None, None).unwrap();
        let share = shadow(&geometry, &camera, &light);
        assert!((0.1..0.9).contains(&share), "{share}");
    }

    #[test]
    fn what_is_given_stays() {
        let scene = courtyard();
        let geometry = scene.flatten();
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        let (camera, light) = choose(&scene, &geometry, None, Some(sun)).unwrap();
        assert_eq!(light, sun);
        let (again, other) = choose(&scene, &geometry, Some(camera), None).unwrap();
        assert_eq!(again, camera);
        assert_ne!(other, sun);
    }
}
