//! Where a scene lies in its file's coordinates.

use crate::Scene;
use crate::bulk::Bulk;
use glam::{DMat3, DMat4, DVec3, Vec3};

/// The axis of a file that points upwards.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(missing_docs, reason = "an axis says what it is")]
pub enum Up {
    X,
    #[default]
    Y,
    Z,
    NegativeX,
    NegativeY,
    NegativeZ,
}

impl Up {
    /// The rotation that makes it +Y: a quarter turn or half a turn about one axis.
    fn rotation(self) -> DMat3 {
        let (x, y, z) = (DVec3::X, DVec3::Y, DVec3::Z);
        match self {
            Self::X => DMat3::from_cols(y, -x, z),
            Self::NegativeX => DMat3::from_cols(-y, x, z),
            Self::Y => DMat3::IDENTITY,
            Self::NegativeY => DMat3::from_cols(x, -y, -z),
            Self::Z => DMat3::from_cols(x, -z, y),
            Self::NegativeZ => DMat3::from_cols(x, z, -y),
        }
    }
}

/// Where a scene lies in its file's coordinates.
///
/// Single precision has 24 bits: five kilometres from the origin it knows half millimetres, at the
/// coordinates of a map half metres. So a scene that is far from its file's origin gets one of its own, and
/// what comes from outside, such as a camera on a command line, goes through [`point`](Self::point) and
/// [`direction`](Self::direction).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Placement {
    /// The point of the file that lies at (0, 0, 0) in the scene.
    pub origin: DVec3,
    /// The axis of the file that is the scene's +Y.
    pub up: Up,
}

impl Placement {
    /// Where a point of the file is in the scene.
    #[must_use]
    pub fn point(&self, file: DVec3) -> Vec3 {
        (self.up.rotation() * (file - self.origin)).as_vec3()
    }

    /// A direction of the file in the scene.
    #[must_use]
    pub fn direction(&self, file: DVec3) -> DVec3 {
        self.up.rotation() * file
    }

    /// Where a point of the scene is in the file.
    #[must_use]
    pub fn in_file(&self, point: Vec3) -> DVec3 {
        self.up.rotation().transpose() * point.as_dvec3() + self.origin
    }

    /// A direction of the scene in the file.
    #[must_use]
    pub fn direction_in_file(&self, direction: Vec3) -> DVec3 {
        self.up.rotation().transpose() * direction.as_dvec3()
    }

    /// The same as a matrix.
    #[must_use]
    pub fn scene_from_file(&self) -> DMat4 {
        DMat4::from_mat3(self.up.rotation()) * DMat4::from_translation(-self.origin)
    }
}

/// Vertices of a file that come in steps of more than this share of the scene's reach are told about: a
/// thousandth of a pixel in a picture of the whole.
const COARSE: f64 = 1e-5;

impl Scene {
    /// Says where the scene lies if it is far from the file's origin, and where the file's own numbers are
    /// too coarse for its size.
    pub(crate) fn note_placement(&mut self) {
        let DVec3 { x, y, z } = self.placement.origin;
        if self.placement.origin != DVec3::ZERO {
            self.notes.push(format!(
                "the scene lies around {x},{y},{z} in its file; results give coordinates relative to that point, \
                 while --camera and --light take the file's"
            ));
        }
        self.note_coarse();
    }

    fn note_coarse(&mut self) {
        let Some(Bulk { reach, .. }) = self.bulk() else { return };
        let largest: Vec<f32> = self
            .meshes
            .iter()
            .map(|m| m.positions.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max))
            .collect();
        let mut coarse: Vec<Option<f64>> = vec![None; largest.len()];
        for instance in &self.instances {
            let Some(&max) = largest.get(instance.mesh) else { continue };
            let matrix = DMat3::from_mat4(instance.world_from_mesh);
            let scale = [matrix.x_axis, matrix.y_axis, matrix.z_axis].map(DVec3::length);
            let step = f64::from(max.next_up() - max) * scale.into_iter().fold(0.0, f64::max);
            let worst = &mut coarse[instance.mesh];
            if step > COARSE * reach && worst.is_none_or(|w| step > w) {
                *worst = Some(step);
            }
        }
        let steps: Vec<f64> = coarse.into_iter().flatten().collect();
        if let Some(worst) = steps.iter().copied().reduce(f64::max) {
            self.notes.push(format!(
                "{} meshes have vertices so far from their own origin that the file's 32-bit numbers come in \
                 steps of up to {worst} units there: finer shapes are lost in the file. Export it with an origin \
                 near the scene, and the offset as the translation of a node",
                steps.len()
            ));
        }
    }

    /// Turns everything so that this axis of the file points upwards.
    pub fn stand(&mut self, up: Up) {
        let turn = up.rotation() * self.placement.up.rotation().transpose();
        self.placement.up = up;
        let matrix = DMat4::from_mat3(turn);
        self.instances.iter_mut().for_each(|i| i.world_from_mesh = matrix * i.world_from_mesh);
        let turned = |v: Vec3| (turn * v.as_dvec3()).as_vec3();
        for camera in &mut self.cameras {
            for v in [&mut camera.position, &mut camera.target, &mut camera.up] {
                *v = turned(*v);
            }
        }
        for light in &mut self.lights {
            light.turn(turned);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Camera, Instance, Light, Mesh, Projection};

    #[test]
    fn every_axis_can_point_upwards() {
        let file = |up| match up {
            Up::X => DVec3::X,
            Up::Y => DVec3::Y,
            Up::Z => DVec3::Z,
            Up::NegativeX => DVec3::NEG_X,
            Up::NegativeY => DVec3::NEG_Y,
            Up::NegativeZ => DVec3::NEG_Z,
        };
        for up in [Up::X, Up::Y, Up::Z, Up::NegativeX, Up::NegativeY, Up::NegativeZ] {
            let placement = Placement { origin: DVec3::new(5e6, 3.0, -2e5), up };
            assert_eq!(placement.direction(file(up)), DVec3::Y, "{up:?}");
            assert_eq!(up.rotation().determinant(), 1.0, "{up:?} mirrors");
            let point = placement.origin + DVec3::new(1.0, 2.0, 3.0);
            assert_eq!(placement.in_file(placement.point(point)), point);
            assert_eq!(placement.direction_in_file(Vec3::Y), file(up));
            let matrix = placement.scene_from_file();
            assert_eq!(matrix.transform_point3(point).as_vec3(), placement.point(point));
        }
    }

    #[test]
    fn a_scene_stands_up_with_its_views() {
        let mut scene = Scene {
            cameras: vec![Camera {
                position: Vec3::new(1.0, 2.0, 3.0),
                target: Vec3::ZERO,
                up: Vec3::Z,
                projection: Projection::Perspective { fov_y: 1.0 },
            }],
            lights: vec![Light::Directional { direction: Vec3::NEG_Z }],
            ..Scene::default()
        };
        scene.stand(Up::Z);
        assert_eq!((scene.cameras[0].position, scene.cameras[0].up), (Vec3::new(1.0, 3.0, -2.0), Vec3::Y));
        assert_eq!(scene.lights, [Light::Directional { direction: Vec3::NEG_Y }]);
        scene.stand(Up::Y);
        assert_eq!((scene.cameras[0].position, scene.cameras[0].up), (Vec3::new(1.0, 2.0, 3.0), Vec3::Z));
    }

    #[test]
    fn coarse_numbers_are_told_about() {
        let mesh = |at: f32| Mesh {
            positions: [0.0, 1.0, 2.0].map(|k| Vec3::new(at + k, k * k, 0.0)).to_vec(),
            ..Mesh::default()
        };
        let notes = |at: f32| {
            let world = DMat4::from_translation(DVec3::X * -f64::from(at));
            let mut scene = Scene { meshes: vec![mesh(at)], ..Scene::default() };
            scene.instances.push(Instance::new(0, world));
            scene.note_coarse();
            scene.notes
        };
        assert_eq!(notes(10.0), [""; 0]);
        let far = notes(4_000_000.0);
        assert!(far.len() == 1 && far[0].starts_with("1 meshes") && far[0].contains("0.25 units"), "{far:?}");
    }
}
