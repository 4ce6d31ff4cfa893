//! What shaders need of a light: one map's worth of it.

use super::{Bounds, Size};
use crate::{camera::Sight, error::LightError};
use glam::{DVec3, DVec4, Mat4, Vec2, Vec3, Vec4};

/// One map's worth of a light: matrices and units, all that shaders need.
///
/// [`Light::view`](crate::Light::view) fits one; [`of_matrix`](Self::of_matrix) takes the matrix of a renderer
/// that has a projection of its own.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World to clip space: x, y in `[−1,1]` (y up), z in `[0,1]` from near to far, or from far to near.
    pub clip_from_world: Mat4,
    /// Linear depth in `[0,1]` of a world point p is `dot(depth_plane, (p, 1))`. Under parallel light planes of equal
    /// depth may lean: only along the light does depth have to grow evenly.
    pub depth_plane: Vec4,
    /// Rows a and b that make depth linear: a point with clip coordinates c = (x, y, z, 1), divided by w, has
    /// linear depth `dot(a, c) / dot(b, c)`. They hold for any projection, reversed, infinite or warped.
    pub linear_from_clip: [Vec4; 2],
    /// Unit vector towards a directional light with w = 0, or position of a spot with w = 1.
    pub to_light: Vec4,
    /// World size of a texel where the clip coordinate w is 1; elsewhere that times w, which is 1 everywhere
    /// under parallel light.
    pub texel_world: f32,
    /// World length of the depth range `[0,1]` along the light, or along a spot's axis.
    pub depth_world: f32,
}

impl View {
    /// The view through a matrix that a renderer brings: perspective or orthographic, its depth reversed or its far
    /// plane infinite as it likes.
    ///
    /// Linear depth runs over what the matrix sees of the scene (casters and receivers), so that the scene's box
    /// bounds an infinite range. `size` is the map's in texels. (Which end of an orthographic matrix is the nearer
    /// is told by a world that is right-handed.)
    ///
    /// # Errors
    /// [`LightError::Bounds`], [`LightError::Camera`] if the matrix is not finite or has no inverse, and
    /// [`LightError::NothingVisible`] if no point of the scene's box lies between its near and far planes.
    pub fn of_matrix(clip_from_world: Mat4, scene: &Bounds, size: Size) -> Result<Self, LightError> {
        scene.check("scene")?;
        let sight = Sight::new(clip_from_world, scene)?;
        let world_from_clip = clip_from_world.as_dmat4().inverse();
        let distance = |p: DVec3| sight.plane().dot(p.extend(1.0));
        let ends = [0.0, 1.0].map(|z| {
            let p = world_from_clip * DVec4::new(0.0, 0.0, z, 1.0);
            // A plane at infinity, on either side of it by rounding, is no end.
            let d = distance(p.truncate() / p.w);
            if d > 0.0 || sight.orthographic && d.is_finite() { d } else { f64::INFINITY }
        });
        let corners = scene.corners().map(|p| distance(p.as_dvec3()));
        let (low, high) =
            corners.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)));
        let slack = 1e-3 * (high - low).max(1e-6 * high.abs());
        let near = ends[0].min(ends[1]).max(low - slack);
        let far = ends[0].max(ends[1]).min(high + slack);
        if near >= far {
            return Err(LightError::NothingVisible { at: String::new() });
        }
        let depth = (sight.plane() - DVec4::W * near) / (far - near);
        let (over, under) = (world_from_clip.transpose() * depth, world_from_clip.row(3));
        // Both by the same number, which shaders divide out.
        let scale = 1.0 / over.abs().max_element().max(under.abs().max_element());
        let to_light = if sight.orthographic {
            -sight.plane().truncate().extend(0.0)
        } else {
            let eye = world_from_clip * DVec4::Z;
            (eye.truncate() / eye.w).extend(1.0)
        };
        let side = |axis: usize, texels: u32| {
            2.0 * world_from_clip.col(axis).truncate().length() / f64::from(texels)
        };
        Ok(Self {
            clip_from_world,
            depth_plane: depth.as_vec4(),
            linear_from_clip: [over, under].map(|row| straightened((row * scale).as_vec4())),
            to_light: to_light.as_vec4(),
            texel_world: side(0, size.width).max(side(1, size.height)) as f32,
            depth_world: (far - near) as f32,
        })
    }

    /// Linear depth of a point in clip space, divided by w; beyond `[0,1]` outside the depth range.
    #[must_use]
    pub fn linear_depth(&self, ndc: Vec3) -> f32 {
        let [over, under] = self.linear_from_clip;
        over.dot(ndc.extend(1.0)) / under.dot(ndc.extend(1.0))
    }

    /// Near over far distance where the projection is not warped, 1 under parallel light: what orders ids.
    pub(crate) fn near_over_far(&self) -> f32 {
        let [over, under] = self.linear_from_clip;
        over.z / under.w
    }

    /// Whether rays meet in a point.
    #[must_use]
    pub fn is_perspective(&self) -> bool {
        self.to_light.w != 0.0
    }

    /// Whether linear depth depends on the place in the picture and not on the depth as rasterised alone.
    #[must_use]
    pub fn is_warped(&self) -> bool {
        self.linear_from_clip.iter().any(|row| row.x != 0.0 || row.y != 0.0)
    }

    /// What linear depth gains per unit of texture coordinate on a plane at right angles to parallel light; 0 under
    /// other light.
    pub(crate) fn lean(&self) -> Vec2 {
        if self.is_perspective() {
            return Vec2::ZERO;
        }
        let (x, y) = (self.clip_from_world.row(0).truncate(), self.clip_from_world.row(1).truncate());
        let gain = |row: Vec3| 2.0 * self.depth_plane.truncate().dot(row) / row.length_squared();
        Vec2::new(gain(x), -gain(y))
    }

    /// Whether depth as rasterised falls with the distance from the light.
    #[must_use]
    pub fn is_reversed(&self) -> bool {
        let [over, under] = self.linear_from_clip;
        let middle = Vec4::new(0.0, 0.0, 0.5, 1.0);
        over.z * under.dot(middle) < under.z * over.dot(middle)
    }

    /// The same view with depth that grows with the distance.
    #[must_use]
    pub(crate) fn forward(&self) -> Self {
        if !self.is_reversed() {
            return *self;
        }
        let mut clip = self.clip_from_world.transpose();
        clip.z_axis = clip.w_axis - clip.z_axis;
        let flipped = |row: Vec4| Vec4::new(row.x, row.y, -row.z, row.w + row.z);
        Self {
            clip_from_world: clip.transpose(),
            linear_from_clip: self.linear_from_clip.map(flipped),
            ..*self
        }
    }

    /// The same view with the image plane shifted, so that texel centres lie `offset` texels further on,
    /// y down.
    #[must_use]
    pub fn jittered(&self, size: Size, offset: Vec2) -> Self {
        let shift = Vec3::new(-2.0 * offset.x / size.width as f32, 2.0 * offset.y / size.height as f32, 0.0);
        let shift = Mat4::from_translation(shift);
        // Points of the shifted picture come from where they were.
        let back = shift.inverse().transpose();
        Self {
            clip_from_world: shift * self.clip_from_world,
            linear_from_clip: self.linear_from_clip.map(|row| back * row),
            ..*self
        }
    }
}

/// The row without what rounding leaves of a dependence on the place in the picture.
fn straightened(row: Vec4) -> Vec4 {
    let place = if row.truncate().truncate().abs().max_element() < 1e-6 { 0.0 } else { 1.0 };
    Vec4::new(row.x * place, row.y * place, row.z, row.w)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::camera::rh;

    const BOX: Bounds = Bounds { min: Vec3::new(-10.0, 0.0, -10.0), max: Vec3::new(10.0, 5.0, 10.0) };
    const SIZE: Size = Size { width: 256, height: 192 };

    fn lenses() -> [(Mat4, bool); 7] {
        use rh::proj::directx::{
            frustum, orthographic, perspective, perspective_infinite, perspective_infinite_reverse,
        };
        [
            (perspective(0.8, 1.3, 5.0, 100.0), false),
            (perspective(0.8, 1.3, 100.0, 5.0), true),
            (perspective_infinite(0.8, 1.3, 5.0), false),
            (perspective_infinite_reverse(0.8, 1.3, 5.0) * 7.0, true),
            (frustum(-0.3, 0.1, -0.2, 0.25, 0.5, 100.0), false),
            (orthographic(-8.0, 8.0, -6.0, 6.0, 0.5, 100.0), false),
            (orthographic(-8.0, 8.0, -6.0, 6.0, 100.0, 0.5), true),
        ]
    }

    #[test]
    fn two_rows_make_the_depth_of_any_projection_linear() {
        let eye = Vec3::new(3.0, 20.0, 30.0);
        let look = rh::view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
        for (lens, reversed) in lenses() {
            // The picture leans on depth, or depth on the picture.
            let shear = Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.2, -0.1, 1.0, 0.0), Vec4::W);
            let lean =
                Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.1, -0.05, 0.8, 0.0), Vec4::W).transpose();
            for (warp, warped) in [(Mat4::IDENTITY, false), (shear, false), (lean, true)] {
                let view = View::of_matrix(warp * lens * look, &BOX, SIZE).unwrap();
                assert_eq!(view.is_reversed(), reversed, "{lens}");
                // Oblique parallel rays do not meet their near plane at right angles.
                let oblique = warp == shear && !view.is_perspective();
                assert_eq!(view.is_warped(), warped || oblique, "{lens}");
                for p in BOX.corners().chain([Vec3::new(1.0, 2.0, 3.0)]) {
                    let expected = view.depth_plane.dot(p.extend(1.0));
                    assert!((-1e-3..=1.001).contains(&expected), "{expected}");
                    for view in [view, view.jittered(SIZE, Vec2::new(0.3, -0.2)), view.forward()] {
                        let ndc = view.clip_from_world.project_point3(p);
                        assert!((view.linear_depth(ndc) - expected).abs() < 2e-5, "{lens} {p}");
                    }
                }
                assert!(!view.forward().is_reversed());
            }
        }
    }

    #[test]
    fn texels_and_lights_are_where_the_matrix_has_them() {
        let eye = Vec3::new(3.0, 20.0, 30.0);
        let look = rh::view::look_at_mat4(eye, Vec3::ZERO, Vec3::Y);
        for (lens, _) in lenses() {
            let view = View::of_matrix(lens * look, &BOX, SIZE).unwrap();
            let w = (view.clip_from_world * Vec4::W).w;
            let step = Vec3::new(0.01, 0.0, 0.0);
            let right = look.inverse().transform_vector3(step);
            let moved =
                view.clip_from_world.project_point3(right) - view.clip_from_world.project_point3(Vec3::ZERO);
            let across = step.x / (moved.x * 0.5 * SIZE.width as f32);
            assert!(view.texel_world * w >= across * 0.999 && view.texel_world * w < across * 2.0, "{lens}");
            let to_light = if view.is_perspective() {
                view.to_light.truncate() / eye.length()
            } else {
                view.to_light.truncate()
            };
            assert!((to_light - eye.normalize()).length() < 1e-3, "{lens}: {to_light}");
        }
    }

    #[test]
    fn fitted_views_have_the_rows_of_their_matrix() {
        let suns = crate::Light::Directional { direction: Vec3::new(0.3, -1.0, 0.2) };
        let spot = crate::Light::Spot { position: Vec3::Y * 20.0, direction: Vec3::NEG_Y, outer_angle: 0.6 };
        for light in [suns, spot] {
            let fit = super::super::Fit {
                casters: BOX,
                receivers: BOX.corners().collect(),
                size: SIZE,
                margin_texels: 2.0,
                lean: true,
            };
            let view = light.view(&fit).unwrap();
            assert!(!view.is_reversed());
            assert_eq!(view.is_perspective(), matches!(light, crate::Light::Spot { .. }));
            for p in BOX.corners() {
                let (expected, ndc) =
                    (view.depth_plane.dot(p.extend(1.0)), view.clip_from_world.project_point3(p));
                assert!((view.linear_depth(ndc) - expected).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn scenes_behind_the_light_are_refused() {
        let away = rh::view::look_at_mat4(Vec3::Z * 30.0, Vec3::Z * 31.0, Vec3::Y);
        let lens = rh::proj::directx::perspective(0.8, 1.0, 0.5, 100.0);
        let error = View::of_matrix(lens * away, &BOX, SIZE).unwrap_err();
        assert!(matches!(error, LightError::NothingVisible { .. }), "{error}");
        assert!(View::of_matrix(Mat4::NAN, &BOX, SIZE).is_err());
    }
}
