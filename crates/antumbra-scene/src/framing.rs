//! A camera and a sun for scenes that bring none.

use crate::{Aabb, Camera, Light, Projection, Scene};
use glam::{Vec2, Vec3, Vec3Swizzles};

/// From where the default camera looks: 35° to the right of +Z, about 30° above the horizon.
const EYE: Vec3 = Vec3::new(0.52, 0.52, 0.74);
/// Vertical field of view of the default camera, radians.
const FOV_Y: f32 = 0.7;

impl Scene {
    /// Box around every placed vertex that a triangle uses; `None` for a scene without triangles.
    ///
    /// Cost: reads every index of every instance.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        Aabb::around(self.placed_points())
    }

    /// Every corner of every triangle.
    pub(crate) fn placed_points(&self) -> impl Iterator<Item = Vec3> {
        let placed = self.instances.iter().filter_map(|i| Some((self.meshes.get(i.mesh)?, i)));
        placed.flat_map(|(mesh, instance)| {
            let matrix = instance.world_from_mesh;
            mesh.indices.iter().filter_map(move |&i| {
                let p = mesh.positions.get(i as usize)?;
                Some(matrix.transform_point3(p.as_dvec3()).as_vec3())
            })
        })
    }

    /// A three-quarter view from the front, right and above that sees the whole scene but for
    /// [strays](Self::strays) in a picture of 4:3 or wider. Scenes without triangles get a view of the unit
    /// cube.
    #[must_use]
    pub fn default_camera(&self) -> Camera {
        let unit = Aabb { min: Vec3::splat(-0.5), max: Vec3::splat(0.5) };
        let bounds = self.main_bounds().unwrap_or(unit);
        let backward = EYE.normalize();
        let right = Vec3::Y.cross(backward).normalize();
        let up = backward.cross(right);
        let slope = (FOV_Y * 0.5).tan() * 0.92; // 8 % of margin
        let center = bounds.center();
        // A corner at offset (x, y, z) in camera axes is inside when ¾|x|, |y| ≤ (distance − z)·slope.
        let distance = bounds
            .corners()
            .map(|corner| {
                let offset = corner - center;
                let side = (offset.dot(right).abs() * 0.75).max(offset.dot(up).abs());
                offset.dot(backward) + side / slope
            })
            .into_iter()
            .fold(0.0, f32::max);
        let distance = if distance > 0.0 { distance } else { 1.0 };
        let projection = Projection::Perspective { fov_y: FOV_Y };
        Camera { position: center + backward * distance, target: center, up: Vec3::Y, projection }
    }

    /// A sun from the upper left behind the first camera (or the default one), 45° above the
    /// horizon: shadows fall to the right and away, where the camera sees them.
    #[must_use]
    pub fn default_light(&self) -> Light {
        let camera = self.main_camera();
        let forward = (camera.target - camera.position).xz().normalize_or(Vec2::NEG_Y);
        let forward = Vec3::new(forward.x, 0.0, forward.y);
        let right = forward.cross(Vec3::Y);
        let level = (right * 0.8 + forward * 0.6).normalize();
        Light::Directional { direction: (level - Vec3::Y).normalize() }
    }

    /// The scene's first camera, else [`Scene::default_camera`].
    #[must_use]
    pub fn main_camera(&self) -> Camera {
        self.cameras.first().copied().unwrap_or_else(|| self.default_camera())
    }

    /// The scene's first light, else [`Scene::default_light`].
    #[must_use]
    pub fn main_light(&self) -> Light {
        self.lights.first().copied().unwrap_or_else(|| self.default_light())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural;

    #[test]
    fn the_default_camera_sees_everything() {
        for entry in procedural::all() {
            let mut scene = entry.scene(1);
            scene.cameras.clear();
            let camera = scene.main_camera();
            let forward = (camera.target - camera.position).normalize();
            let right = forward.cross(camera.up).normalize();
            let up = right.cross(forward);
            let slope = (FOV_Y * 0.5).tan();
            for p in scene.flatten().positions {
                let offset = p - camera.position;
                let depth = offset.dot(forward);
                assert!(depth > 0.0);
                assert!(offset.dot(up).abs() <= depth * slope);
                assert!(offset.dot(right).abs() <= depth * slope * 4.0 / 3.0);
            }
        }
    }

    #[test]
    fn the_largest_scene_can_be_framed() {
        let mut scene = procedural::all()[0].scene(1);
        scene.cameras.clear();
        scene.lights.clear();
        let bounds = scene.bounds().unwrap();
        let max = bounds.min.abs().max(bounds.max.abs()).max_element();
        let scaled = |factor: f64| {
            let mut scene = scene.clone();
            for instance in &mut scene.instances {
                instance.world_from_mesh =
                    glam::DMat4::from_scale(glam::DVec3::splat(factor)) * instance.world_from_mesh;
            }
            scene
        };
        let limit = f64::from(Scene::MAX_COORDINATE) / f64::from(max);
        let largest = scaled(limit * 0.999);
        let (camera, light) = (largest.default_camera(), largest.default_light());
        assert_eq!(Scene { cameras: vec![camera], lights: vec![light], ..largest }.validate(), Ok(()));
        assert!(scaled(limit * 1.001).validate().unwrap_err().to_string().contains("within 1e36"));
    }

    #[test]
    fn the_default_sun_shines_from_behind_the_left_shoulder() {
        let scene = Scene::default();
        let camera = scene.main_camera();
        let forward = camera.target - camera.position;
        let Light::Directional { direction } = scene.main_light() else { panic!("not a sun") };
        assert!(direction.is_normalized());
        assert!(direction.dot(forward) > 0.0 && direction.y < 0.0);
        assert!(direction.dot(forward.cross(Vec3::Y)) > 0.0, "it travels to the right");
    }
}
