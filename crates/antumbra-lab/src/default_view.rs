//! A camera and a sun for scenes that bring none, chosen so that the picture shows shadows.
//!
//! Cameras (from outside, or from inside where walls show their front all around) and suns (all around, at
//! three heights) are tried with rays on a picture of 48×36 pixels. The score of a pair is the share of the
//! picture that can be in shadow, weighed by how evenly light and shadow divide it; the first pair that comes
//! near the best wins, so that the usual sun over the left shoulder stays where it does its work.

use antumbra_scene::{Aabb, Camera, Geometry, Light, Projection, Scene};
use antumbra_truth::{CameraRays, Hit, SharedTree, Tracer, TruthError};
use glam::{Quat, Vec3};
use std::f32::consts::TAU;

/// Pixels of the trial pictures.
const PICTURE: [u32; 2] = [48, 36];
/// A pair that has this share of the best score is as good.
const AS_GOOD: f64 = 0.8;
/// Heights of the suns above the horizon that are tried, radians.
const HEIGHTS: [f32; 3] = [0.79, 0.52, 1.05];
/// Suns around the horizon that are tried.
const AROUND: u32 = 8;
/// Places of the eye, as shares of the scene's length from its middle, for views from inside.
const EYES: [f32; 4] = [0.25, -0.25, 0.15, -0.15];
/// Distance to what stands before the camera, as a share of the scene's size, that leaves the view clear.
const CLEARANCE: f32 = 0.06;
/// Closer views: the part of the picture's height that is to be filled. Shadows are to be seen beside it.
const NEARNESS: [f32; 2] = [0.5, 1.0];
/// Triangles that are looked at to find where most of them are.
const SAMPLE: usize = 1 << 16;
/// Share of the triangles at either end of an axis that a closer view does not have to hold.
const FEW: f32 = 0.02;
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
    (geometry, tree): (&Geometry, &SharedTree),
    camera: Option<Camera>,
    light: Option<Light>,
) -> Result<(Camera, Light), TruthError> {
    if let (Some(camera), Some(light)) = (camera, light) {
        return Ok((camera, light));
    }
    let tracer = Tracer::sharing(geometry, tree)?;
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

/// Cameras that are tried: of a building views from inside, along its longer side, of all else views from
/// outside.
fn cameras(scene: &Scene, tracer: &Tracer<'_>) -> Vec<Camera> {
    let outside = scene.default_camera();
    let Some(bounds) = scene.main_bounds() else { return vec![outside] };
    let (middle, size) = (bounds.center(), bounds.size());
    let along = if size.x >= size.z { Vec3::X * size.x } else { Vec3::Z * size.z };
    let inside = |offset: f32| {
        let eye = middle - along * offset;
        let floor = look(tracer, eye, Vec3::NEG_Y)?.position.y as f32;
        let position = Vec3::new(eye.x, floor + EYE_HEIGHT * size.y, eye.z);
        // A little above the eye: roofs and upper storeys are in the picture too.
        let target = position + along * offset.signum() * 0.4 + Vec3::Y * (0.04 * size.y);
        let camera =
            Camera { position, target, projection: Projection::Perspective { fov_y: 1.0 }, ..outside };
        is_clear(tracer, &camera, CLEARANCE * size.length()).then_some(camera)
    };
    if !is_inside(tracer, middle) {
        let closer = main_box(tracer.geometry()).into_iter().flat_map(|main| {
            NEARNESS.into_iter().filter_map(move |nearness| closer(main, &outside, nearness))
        });
        return std::iter::once(outside).chain(closer).collect();
    }
    EYES.into_iter().filter_map(inside).chain([outside]).collect()
}

/// What most triangles are in: an object rather than the ground that it stands on.
///
/// Cost: looks at [`SAMPLE`] triangles at most, at equal distances in the list of all.
fn main_box(geometry: &Geometry) -> Option<Aabb> {
    let stride = geometry.triangle_count().div_ceil(SAMPLE).max(1);
    let sample: Vec<Vec3> = (0..geometry.triangle_count())
        .step_by(stride)
        .map(|t| geometry.triangle(t).iter().sum::<Vec3>() / 3.0)
        .collect();
    let along = |axis: usize| {
        let mut centres: Vec<f32> = sample.iter().map(|centre| centre[axis]).collect();
        centres.sort_by(f32::total_cmp);
        let last = centres.len().checked_sub(1)?;
        Some([FEW, 1.0 - FEW].map(|share| centres[(last as f32 * share) as usize]))
    };
    let [x, y, z] = [along(0)?, along(1)?, along(2)?];
    Some(Aabb { min: Vec3::new(x[0], y[0], z[0]), max: Vec3::new(x[1], y[1], z[1]) })
}

/// The same view of a part of the scene.
fn closer(part: Aabb, outside: &Camera, nearness: f32) -> Option<Camera> {
    let backward = (outside.position.as_dvec3() - outside.target.as_dvec3()).normalize().as_vec3();
    let Projection::Perspective { fov_y } = outside.projection else { return None };
    let distance = 0.5 * part.size().as_dvec3().length() as f32 / (fov_y / 2.0).tan() / nearness;
    let target = (part.min + part.max) / 2.0;
    (distance > 0.0).then_some(Camera { position: target + backward * distance, target, ..*outside })
}

/// The first surface in a direction.
fn look(tracer: &Tracer<'_>, eye: Vec3, direction: Vec3) -> Option<Hit> {
    let up = if direction.y == 0.0 { Vec3::Y } else { Vec3::Z };
    let projection = Projection::Perspective { fov_y: 1.0 };
    let camera = Camera { position: eye, target: eye + direction, up, projection };
    let hits = tracer.primary(&CameraRays::new(&camera, 1, 1).ok()?);
    hits.first().copied().filter(Hit::is_hit)
}

/// Whether a point is within walls that show their front: rooms, as opposed to the inside of an object.
fn is_inside(tracer: &Tracer<'_>, point: Vec3) -> bool {
    let walls = (0..AROUND).filter(|i| {
        let direction = Quat::from_rotation_y(*i as f32 * TAU / AROUND as f32) * Vec3::X;
        look(tracer, point, direction).is_some_and(|hit| {
            let [a, b, c] = tracer.geometry().triangle(hit.triangle as usize);
            (b - a).cross(c - a).as_dvec3().dot(hit.normal) > 0.0
        })
    });
    walls.count() as u32 >= AROUND - 2
}

/// Whether nothing stands right before a camera.
fn is_clear(tracer: &Tracer<'_>, camera: &Camera, distance: f32) -> bool {
    let Ok(rays) = CameraRays::new(camera, PICTURE[0], PICTURE[1]) else { return false };
    let near =
        |hit: &Hit| hit.is_hit() && hit.position.distance(camera.position.as_dvec3()) < f64::from(distance);
    let hits = tracer.primary(&rays);
    20 * hits.iter().filter(|hit| near(hit)).count() <= hits.len()
}

/// Suns all around a camera, the one over its left shoulder at 45° first.
fn suns(camera: &Camera) -> Vec<Light> {
    let forward = camera.target - camera.position;
    let level = Vec3::new(forward.x, 0.0, forward.z).normalize_or(Vec3::NEG_Z);
    let first = (level.cross(Vec3::Y) * 0.8 + level * 0.6).normalize();
    let turned = |i: u32| Quat::from_rotation_y(i as f32 * TAU / AROUND as f32) * first;
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
        let quads = [[0, 4, 5, 1], [0, 1, 3, 2], [4, 6, 7, 5], [0, 2, 6, 4], [1, 5, 7, 3]];
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
            instances: vec![Instance::new(0, Default::default())],
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
            let (camera, light) = choose(&scene, (&geometry, &SharedTree::default()), None, None).unwrap();
            let share = shadow(&geometry, &camera, &light);
            assert!((0.03..0.97).contains(&share), "{}: {share}", entry.name);
        }
    }

    #[test]
    fn buildings_are_seen_from_inside() {
        let scene = courtyard();
        let geometry = scene.flatten();
        let (camera, light) = choose(&scene, (&geometry, &SharedTree::default()), None, None).unwrap();
        let share = shadow(&geometry, &camera, &light);
        assert!((0.1..0.9).contains(&share), "{share}");
        let bounds = geometry.bounds().unwrap();
        assert!(
            camera.position.cmpge(bounds.min).all() && camera.position.cmple(bounds.max).all(),
            "{camera:?}"
        );
        // The same walls wound the other way around are an object.
        let mut turned = scene;
        turned.meshes[0].indices.chunks_exact_mut(3).for_each(|corners| corners.swap(1, 2));
        let (camera, _) = choose(&turned, (&turned.flatten(), &SharedTree::default()), None, None).unwrap();
        assert_eq!(camera, turned.default_camera());
    }

    #[test]
    fn what_is_given_stays() {
        let scene = courtyard();
        let geometry = scene.flatten();
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        let (camera, light) = choose(&scene, (&geometry, &SharedTree::default()), None, Some(sun)).unwrap();
        assert_eq!(light, sun);
        let (again, other) = choose(&scene, (&geometry, &SharedTree::default()), Some(camera), None).unwrap();
        assert_eq!(again, camera);
        assert_ne!(other, sun);
    }
}
