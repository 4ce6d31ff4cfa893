//! Cascades: several views of one directional light, each for a range of the camera's distance.

use super::{Bounds, Fit, Size};
use crate::{camera::Sight, error::LightError};
use glam::Mat4;

/// How the camera's range is divided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cascades {
    /// Number of views, 1 to 8.
    pub count: u32,
    /// 0 to 1: 0 divides the range evenly, 1 logarithmically; 0.7 suits most scenes
    /// (Zhang et al. 2006, "Parallel-split shadow maps").
    pub blend: f32,
}

impl Cascades {
    /// `count` cascades with the usual blend.
    #[must_use]
    pub const fn new(count: u32) -> Self {
        Self { count, blend: 0.7 }
    }

    /// # Errors
    /// [`LightError::Cascades`], [`LightError::Blend`].
    pub(super) fn check(&self) -> Result<(), LightError> {
        const MAX: u32 = 8;
        if !(1..=MAX).contains(&self.count) {
            return Err(LightError::Cascades { count: self.count, max: MAX });
        }
        if !(0.0..=1.0).contains(&self.blend) {
            return Err(LightError::Blend { blend: self.blend });
        }
        Ok(())
    }

    /// Ends of the ranges: `count + 1` distances from `near` to `far`, both positive.
    #[must_use]
    pub fn splits(&self, near: f32, far: f32) -> Vec<f32> {
        (0..=self.count)
            .map(|i| {
                let t = i as f32 / self.count as f32;
                let even = near + (far - near) * t;
                let logarithmic = near * (far / near).powf(t);
                even + (logarithmic - even) * self.blend
            })
            .collect()
    }
}

/// A camera and a scene that a light's views are fitted to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraFit {
    /// The camera: world to clip space, z in `[0,1]`. It may be perspective or orthographic, off-centre, its
    /// depth reversed or infinite. Shadows reach as far as it sees: give it a finite far plane for a distance.
    pub camera: Mat4,
    /// Everything in the scene: casters and receivers.
    pub scene: Bounds,
    /// Size of the map.
    pub size: Size,
    /// See [`Fit::margin_texels`].
    pub margin_texels: f32,
    /// See [`Fit::lean`].
    pub lean: bool,
}

impl CameraFit {
    /// What each cascade that sees any receiver is fitted to, nearest first.
    ///
    /// # Errors
    /// As [`Light::views`](super::Light::views).
    pub(super) fn divided(&self, cascades: Cascades) -> Result<Vec<Fit>, LightError> {
        self.scene.check("scene")?;
        let sight = Sight::new(self.camera, &self.scene)?;
        let everything = sight.hull(&self.scene, 0.0..=f32::INFINITY);
        if everything.is_empty() {
            return Err(LightError::NothingVisible { at: String::new() });
        }
        let fit = |receivers| Fit {
            casters: self.scene,
            receivers,
            size: self.size,
            margin_texels: self.margin_texels,
            lean: self.lean,
        };
        if cascades.count == 1 {
            return Ok(vec![fit(everything)]);
        }
        let far = everything.iter().map(|p| sight.distance(*p)).fold(0.0, f32::max);
        let near = everything.iter().map(|p| sight.distance(*p)).fold(far, f32::min).max(far * 1e-3);
        // No part of an orthographic picture needs finer texels than another.
        let blend = if sight.orthographic { 0.0 } else { cascades.blend };
        let splits = Cascades { blend, ..cascades }.splits(near, far * 1.0001);
        let seen = splits.windows(2).map(|pair| {
            // The first range reaches back to the eye.
            let start = if pair[0] == splits[0] { 0.0 } else { pair[0] };
            sight.hull(&self.scene, start..=pair[1])
        });
        Ok(seen.filter(|seen| !seen.is_empty()).map(fit).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::light::{Light, View};
    use glam::{Vec3, camera::rh};

    fn fit() -> CameraFit {
        let look = rh::view::look_at_mat4(Vec3::new(0.0, 2.0, 50.0), Vec3::ZERO, Vec3::Y);
        CameraFit {
            camera: rh::proj::directx::perspective(1.0, 1.3, 0.1, 500.0) * look,
            scene: Bounds { min: Vec3::new(-50.0, 0.0, -50.0), max: Vec3::new(50.0, 10.0, 50.0) },
            size: Size::square(1024),
            margin_texels: 3.0,
            lean: true,
        }
    }

    #[test]
    fn splits_run_from_near_to_far_and_widen() {
        let splits = Cascades::new(4).splits(0.1, 100.0);
        assert!((splits[0] - 0.1).abs() < 1e-6 && (splits[4] - 100.0).abs() < 1e-3);
        assert!(splits.windows(3).all(|s| s[2] - s[1] > s[1] - s[0]));
        let even = Cascades { count: 4, blend: 0.0 }.splits(1.0, 101.0);
        assert!((even[1] - 26.0).abs() < 1e-4);
    }

    #[test]
    fn nearer_cascades_have_finer_texels() {
        let sun = Light::Directional { direction: Vec3::new(0.3, -1.0, 0.1) };
        let views = sun.views(&fit(), Cascades::new(4)).unwrap();
        assert_eq!(views.len(), 4);
        assert!(views.windows(2).all(|v| v[0].texel_world <= v[1].texel_world));
        assert!(views[0].texel_world < 0.5 * views[3].texel_world);
        let one = sun.views(&fit(), Cascades::new(1)).unwrap();
        assert!(one[0].texel_world >= views[3].texel_world);
    }

    #[test]
    fn no_cascades_and_nothing_in_sight_are_refused() {
        let sun = Light::Directional { direction: Vec3::NEG_Y };
        assert!(matches!(sun.views(&fit(), Cascades::new(0)), Err(LightError::Cascades { .. })));
        let above = Bounds { min: Vec3::new(0.0, 0.0, 60.0), max: Vec3::new(1.0, 1.0, 61.0) };
        let blind = CameraFit { scene: above, ..fit() };
        assert!(matches!(sun.views(&blind, Cascades::new(2)), Err(LightError::NothingVisible { .. })));
    }

    #[test]
    fn an_orthographic_camera_is_divided_along_its_line_of_sight() {
        let sun = Light::Directional { direction: Vec3::new(0.4, -1.0, 0.3) };
        let look = rh::view::look_at_mat4(Vec3::new(60.0, 60.0, 60.0), Vec3::ZERO, Vec3::Y);
        // Standard and reversed depth.
        for (near, far) in [(0.1, 500.0), (500.0, 0.1)] {
            let lens = rh::proj::directx::orthographic(-40.0, 40.0, -30.0, 30.0, near, far);
            let fit = CameraFit { camera: lens * look, ..fit() };
            let one = sun.views(&fit, Cascades::new(1)).unwrap();
            let views = sun.views(&fit, Cascades::new(4)).unwrap();
            assert_eq!(views.len(), 4);
            // Nearest first: the point where each view is centred goes away from the camera.
            let distance = |view: &View| {
                let middle = view.clip_from_world.inverse().project_point3(Vec3::new(0.0, 0.0, 0.5));
                -look.transform_point3(middle).z
            };
            assert!(views.windows(2).all(|v| distance(&v[0]) + 1.0 < distance(&v[1])));
            // Negative control: without a division all would be as coarse as the only one.
            assert!(views.iter().all(|v| v.texel_world < 0.8 * one[0].texel_world), "{views:?} {one:?}");
        }
    }

    #[test]
    fn a_scaled_matrix_is_the_same_camera() {
        let sun = Light::Directional { direction: Vec3::new(0.3, -1.0, 0.1) };
        let scaled = CameraFit { camera: fit().camera * 1000.0, ..fit() };
        let [plain, scaled] = [fit(), scaled].map(|s| sun.views(&s, Cascades::new(4)).unwrap());
        assert_eq!(plain.len(), scaled.len());
        assert!(plain.iter().zip(&scaled).all(|(a, b)| a.texel_world == b.texel_world));
    }

    #[test]
    fn cameras_and_scenes_that_are_none_are_refused_by_name() {
        let sun = Light::Directional { direction: Vec3::new(0.3, -1.0, 0.1) };
        let spot = Light::Spot { position: Vec3::Y * 9.0, direction: Vec3::NEG_Y, outer_angle: 0.6 };
        assert!(sun.views(&fit(), Cascades::new(4)).is_ok(), "negative control");
        for light in [sun, spot] {
            for camera in [Mat4::NAN, Mat4::ZERO, Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0))] {
                for count in [1, 4] {
                    let error =
                        light.views(&CameraFit { camera, ..fit() }, Cascades::new(count)).unwrap_err();
                    assert!(matches!(error, LightError::Camera { .. }), "{error}");
                }
            }
            let scene = Bounds { min: Vec3::NAN, max: Vec3::ONE };
            let error = light.views(&CameraFit { scene, ..fit() }, Cascades::new(2)).unwrap_err();
            assert!(matches!(error, LightError::Bounds { what: "scene", .. }), "{error}");
            for blend in [f32::NAN, -0.1, 1.5] {
                let error = light.views(&fit(), Cascades { count: 2, blend }).unwrap_err();
                assert!(matches!(error, LightError::Blend { .. }), "{error}");
            }
        }
    }
}
