//! Rays through pixels.

use crate::TruthError;
use antumbra_scene::{Camera, Projection};
use glam::{DVec2, DVec3};

/// A half-line in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ray {
    /// Start.
    pub origin: DVec3,
    /// Unit vector.
    pub direction: DVec3,
}

/// A picture: a camera in f64 and the number of its pixels.
///
/// Picture coordinates count pixels from the top left, y down: the centre of pixel (x, y) is
/// (x + ½, y + ½). The camera is right-handed and looks from its position at its target. Rays of an
/// orthographic camera begin on the plane through its position, and what lies behind that plane is not seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraRays {
    width: u32,
    height: u32,
    eye: DVec3,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// Half the picture's width and height, at distance 1 where rays meet in the eye.
    half: DVec2,
    is_parallel: bool,
}

impl CameraRays {
    /// The picture that `camera` takes with `width` × `height` square pixels.
    ///
    /// # Errors
    /// [`TruthError::BadCamera`] when the camera is not finite, looks along `up`, or has a field of
    /// view outside (0, π) or a height that is not above 0, or when a size is 0.
    pub fn new(camera: &Camera, width: u32, height: u32) -> Result<Self, TruthError> {
        let error = TruthError::BadCamera {
            position: camera.position,
            target: camera.target,
            projection: camera.projection,
            width,
            height,
        };
        let eye = camera.position.as_dvec3();
        let axes = || {
            let forward = (camera.target.as_dvec3() - eye).try_normalize()?;
            let right = forward.cross(camera.up.as_dvec3()).try_normalize()?;
            Some((forward, right))
        };
        let (Some((forward, right)), true) = (axes(), eye.is_finite() && width.min(height) > 0) else {
            return Err(error);
        };
        if !camera.projection.is_usable() {
            return Err(error);
        }
        let (half, is_parallel) = match camera.projection {
            Projection::Perspective { fov_y } => ((0.5 * f64::from(fov_y)).tan(), false),
            Projection::Orthographic { height } => (0.5 * f64::from(height), true),
        };
        let half = DVec2::new(half * f64::from(width) / f64::from(height), half);
        Ok(Self { width, height, eye, forward, right, up: right.cross(forward), half, is_parallel })
    }

    /// Pixels across.
    #[must_use]
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Pixels down.
    #[must_use]
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Number of pixels.
    #[must_use]
    pub fn pixel_count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// World position of the eye.
    #[must_use]
    pub fn eye(&self) -> DVec3 {
        self.eye
    }

    /// The ray through a point of the picture, in pixels from the top left, y down.
    #[must_use]
    pub fn ray(&self, x: f64, y: f64) -> Ray {
        let ndc_x = 2.0 * x / f64::from(self.width) - 1.0;
        let ndc_y = 1.0 - 2.0 * y / f64::from(self.height);
        let aside = self.right * (ndc_x * self.half.x) + self.up * (ndc_y * self.half.y);
        if self.is_parallel {
            Ray { origin: self.eye + aside, direction: self.forward }
        } else {
            Ray { origin: self.eye, direction: (self.forward + aside).normalize() }
        }
    }

    /// The ray through the centre of pixel number `index`, counted row by row from the top left.
    #[must_use]
    pub fn center_ray(&self, index: usize) -> Ray {
        let (x, y) = self.pixel(index);
        self.ray(f64::from(x) + 0.5, f64::from(y) + 0.5)
    }

    /// Column and row of pixel number `index`.
    #[must_use]
    pub fn pixel(&self, index: usize) -> (u32, u32) {
        let width = self.width as usize;
        ((index % width) as u32, (index / width) as u32)
    }

    /// `point` in the camera's frame: right, up, and distance along the line of sight.
    #[must_use]
    pub fn camera_from_world(&self, point: DVec3) -> DVec3 {
        let arm = point - self.eye;
        DVec3::new(arm.dot(self.right), arm.dot(self.up), arm.dot(self.forward))
    }

    /// Picture coordinates, in pixels, of a point in the camera's frame with positive z.
    #[must_use]
    pub fn picture_from_camera(&self, point: DVec3) -> DVec2 {
        let ndc = point.truncate() / if self.is_parallel { self.half } else { self.half * point.z };
        DVec2::new(0.5 * (1.0 + ndc.x) * f64::from(self.width), 0.5 * (1.0 - ndc.y) * f64::from(self.height))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn camera() -> Camera {
        Camera {
            position: Vec3::new(1.0, 2.0, 3.0),
            target: Vec3::new(-4.0, 1.0, 0.5),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 1.1 },
        }
    }

    #[test]
    fn projection_undoes_the_ray() {
        let parallel = Camera { projection: Projection::Orthographic { height: 3.0 }, ..camera() };
        for camera in [camera(), parallel] {
            let rays = CameraRays::new(&camera, 640, 360).unwrap();
            for (x, y) in [(0.0, 0.0), (17.3, 300.1), (640.0, 360.0)] {
                let ray = rays.ray(x, y);
                let point = rays.camera_from_world(ray.origin + 7.0 * ray.direction);
                let back = rays.picture_from_camera(point);
                assert!((back - DVec2::new(x, y)).length() < 1e-9, "{back}");
            }
        }
    }

    #[test]
    fn parallel_rays_begin_on_a_plane() {
        let camera = Camera { projection: Projection::Orthographic { height: 3.0 }, ..camera() };
        let rays = CameraRays::new(&camera, 640, 360).unwrap();
        let (top, bottom) = (rays.ray(320.0, 0.0), rays.ray(320.0, 360.0));
        assert_eq!(top.direction, bottom.direction);
        assert!((top.origin.distance(bottom.origin) - 3.0).abs() < 1e-12);
        let (left, right) = (rays.ray(0.0, 180.0), rays.ray(640.0, 180.0));
        assert!((left.origin.distance(right.origin) - 3.0 * 640.0 / 360.0).abs() < 1e-12);
        assert!((left.origin - right.origin).dot(top.direction).abs() < 1e-12);
    }

    #[test]
    fn a_turned_up_rolls_the_picture() {
        let upright = Camera { position: Vec3::Z, target: Vec3::ZERO, up: Vec3::Y, ..camera() };
        let rolled = Camera { up: Vec3::NEG_X, ..upright };
        let [upright, rolled] = [upright, rolled].map(|c| CameraRays::new(&c, 100, 100).unwrap());
        // What was above the middle is now to its right.
        let difference = upright.ray(50.0, 10.0).direction - rolled.ray(90.0, 50.0).direction;
        assert!(difference.length() < 1e-12, "{difference}");
    }

    #[test]
    fn x_goes_right_and_y_goes_down() {
        let camera = Camera { position: Vec3::ZERO, target: Vec3::NEG_Z, up: Vec3::Y, ..camera() };
        let camera = Camera { projection: Projection::Perspective { fov_y: 1.0 }, ..camera };
        let rays = CameraRays::new(&camera, 4, 2).unwrap();
        let corner = rays.ray(0.0, 0.0).direction;
        assert!(corner.x < 0.0 && corner.y > 0.0 && corner.z < 0.0);
        assert!((rays.ray(2.0, 1.0).direction - DVec3::NEG_Z).length() < 1e-15);
        let top = rays.ray(2.0, 0.0).direction;
        assert!((top.y.atan2(-top.z) - 0.5).abs() < 1e-12, "half of fov_y");
    }

    #[test]
    fn refuses_cameras_without_a_picture() {
        let good = camera();
        for bad in [
            Camera { target: good.position, ..good },
            Camera { up: good.target - good.position, ..good },
            Camera { position: Vec3::NAN, ..good },
            Camera { projection: Projection::Perspective { fov_y: 0.0 }, ..good },
            Camera { projection: Projection::Perspective { fov_y: 3.2 }, ..good },
            Camera { projection: Projection::Orthographic { height: 0.0 }, ..good },
            Camera { projection: Projection::Orthographic { height: f32::INFINITY }, ..good },
        ] {
            assert!(CameraRays::new(&bad, 4, 4).is_err(), "{bad:?}");
        }
        assert!(CameraRays::new(&good, 0, 4).is_err());
    }
}
