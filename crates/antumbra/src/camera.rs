//! What a camera sees, from its matrix alone: perspective, orthographic, off-centre, reversed, infinite.

use crate::{aabb::Bounds, error::LightError};
use glam::{DMat4, DVec3, DVec4, Mat4, Vec3};
use std::ops::RangeInclusive;

/// Smallest extent of a scene, in its own unit, that is told from nothing.
pub(crate) const TINY: f64 = 1e-25;
/// Least volume of a camera's rows, each of length 1 where the scene is: the noise of products of `f64`
/// lies a hundred times below, the rows of a lens of 10⁻⁷ of a scene's size a million times above.
const FLAT: f64 = 1e-14;

/// A camera's matrix that can be inverted, and how far along its line of sight points are.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Sight {
    clip_from_world: DMat4,
    /// Distance along the line of sight of a point p is `dot(distance, (p, 1))`: from the eye or, if the
    /// camera is orthographic, from its near plane.
    distance: DVec4,
    /// Whether rays are parallel, so that pixels are equally large at any distance.
    pub(crate) orthographic: bool,
}

impl Sight {
    /// # Errors
    /// [`LightError::Camera`] for numbers that are not finite and matrices that have no inverse, judged
    /// where the scene is.
    pub(crate) fn new(clip_from_world: Mat4, scene: &Bounds) -> Result<Self, LightError> {
        let refused = |fault| LightError::Camera { fault, matrix: clip_from_world };
        if !clip_from_world.is_finite() {
            return Err(refused("holds a number that is not finite"));
        }
        let m = clip_from_world.as_dmat4();
        let (low, high) = (scene.min.as_dvec3(), scene.max.as_dvec3());
        let middle = 0.5 * (low + high);
        let radius = (0.5 * (high - low).length()).max(TINY);
        // In units of the scene, so that neither its place nor its size matters.
        let there = m * DMat4::from_translation(middle) * DMat4::from_scale(DVec3::splat(radius));
        let unit = |i: usize| there.row(i).normalize_or_zero();
        let rows = DMat4::from_cols(unit(0), unit(1), unit(2), unit(3));
        if rows.determinant().abs() <= FLAT {
            return Err(refused("cannot be inverted"));
        }
        let w = m.row(3);
        let slope = w.truncate().length();
        // What w changes by across the scene, against w.
        let orthographic = slope * radius <= 1e-6 * w.dot(middle.extend(1.0)).abs();
        let distance = if orthographic { from_near_plane(&m) } else { w / slope };
        if !distance.is_finite() {
            return Err(refused("cannot be inverted"));
        }
        Ok(Self { clip_from_world: m, distance, orthographic })
    }

    /// Coefficients q of the distance along the line of sight, `dot(q, (p, 1))`, in world units: from the eye or, if
    /// the camera is orthographic, from its near plane.
    pub(crate) fn plane(&self) -> DVec4 {
        self.distance
    }

    pub(crate) fn distance(&self, p: Vec3) -> f32 {
        self.distance.dot(p.as_dvec3().extend(1.0)) as f32
    }

    /// See [`visible_hull`].
    pub(crate) fn hull(&self, bounds: &Bounds, distance: RangeInclusive<f32>) -> Vec<Vec3> {
        let m = &self.clip_from_world;
        let [x, y, z, w] = [m.row(0), m.row(1), m.row(2), m.row(3)];
        let (low, high) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let mut planes = vec![w + x, w - x, w + y, w - y, z, w - z];
        planes.push(self.distance - DVec4::W * f64::from(*distance.start()));
        if distance.end().is_finite() {
            planes.push(DVec4::W * f64::from(*distance.end()) - self.distance);
        }
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            planes.push(axis.extend(-low.dot(axis)));
            planes.push((-axis).extend(high.dot(axis)));
        }
        // A plane at infinity bounds nothing.
        let planes: Vec<DVec4> = planes
            .into_iter()
            .filter(|p| p.truncate().length() > 1e-12)
            .map(|p| p / p.truncate().length())
            .collect();
        let slack = 1e-6 * low.abs().max(high.abs()).max_element().max(TINY);
        let inside = |p: DVec3| planes.iter().all(|q| q.dot(p.extend(1.0)) >= -slack);
        let mut hull = Vec::new();
        for i in 0..planes.len() {
            for j in 0..i {
                for k in 0..j {
                    hull.extend(
                        meet(planes[i], planes[j], planes[k]).filter(|p| inside(*p)).map(|p| p.as_vec3()),
                    );
                }
            }
        }
        hull
    }
}

/// Distance of points from an orthographic camera's near plane. Which of its two planes is the near one
/// depends on whether depth is reversed; that the world is right-handed tells.
fn from_near_plane(m: &DMat4) -> DVec4 {
    let row = |i: usize| m.row(i).truncate();
    // From the right and up of the picture.
    let along = -(row(0).cross(row(1)) * m.row(3).w).normalize();
    let near = if along.dot(row(2)) * m.row(3).w > 0.0 { 0.0 } else { 1.0 };
    along.extend(-along.dot(m.inverse().project_point3(DVec3::new(0.0, 0.0, near))))
}

/// Corners of the part of a box that a camera sees, for [`Fit::receivers`](crate::Fit::receivers).
///
/// `clip_from_world` is the camera's matrix with z in `[0,1]`; orthographic and off-centre ones, reversed
/// and infinite depth ranges are fine. `distance` restricts the view to a range of distances along the line
/// of sight in your unit, from the eye or, if the camera is orthographic, from its near plane. Empty if
/// nothing is visible, if the box has corners that are not finite, and if the matrix is no camera's: not
/// finite or without inverse. ([`Light::views`](crate::Light::views) tells these apart.)
#[must_use]
pub fn visible_hull(clip_from_world: Mat4, bounds: &Bounds, distance: RangeInclusive<f32>) -> Vec<Vec3> {
    Sight::new(clip_from_world, bounds).map(|sight| sight.hull(bounds, distance)).unwrap_or_default()
}

/// The point on three planes, unless two are parallel.
fn meet(a: DVec4, b: DVec4, c: DVec4) -> Option<DVec3> {
    let (na, nb, nc) = (a.truncate(), b.truncate(), c.truncate());
    let volume = na.dot(nb.cross(nc));
    (volume.abs() > 1e-9)
        .then(|| -(nb.cross(nc) * a.w + nc.cross(na) * b.w + na.cross(nb) * c.w) / volume)
        .filter(|p| p.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::camera::{lh, rh};

    const BOX: Bounds = Bounds { min: Vec3::new(-10.0, 0.0, -10.0), max: Vec3::new(10.0, 5.0, 10.0) };
    const EYE: Vec3 = Vec3::new(3.0, 2.0, 30.0);

    fn extent(hull: &[Vec3]) -> (Vec3, Vec3) {
        let start = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        hull.iter().fold(start, |(low, high), p| (low.min(*p), high.max(*p)))
    }

    /// Each kind of lens, whether it is orthographic, and where its distances begin before the eye.
    fn lenses() -> Vec<(Mat4, bool, f32)> {
        use rh::proj::directx::{
            frustum, orthographic, perspective, perspective_infinite, perspective_infinite_reverse,
        };
        vec![
            (perspective(0.8, 1.0, 0.5, 100.0), false, 0.0),
            // Swapped ends reverse depth.
            (perspective(0.8, 1.0, 100.0, 0.5), false, 0.0),
            (perspective_infinite(0.8, 1.0, 0.5), false, 0.0),
            (perspective_infinite_reverse(0.8, 1.0, 0.5), false, 0.0),
            (frustum(-0.3, 0.1, -0.2, 0.25, 0.5, 100.0), false, 0.0),
            (perspective(0.8, 1.0, 0.5, 100.0) * 7.0, false, 0.0),
            (orthographic(-8.0, 8.0, -6.0, 6.0, 0.5, 100.0), true, 0.5),
            (orthographic(-8.0, 8.0, -6.0, 6.0, 100.0, 0.5), true, 0.5),
            (orthographic(-2.0, 8.0, -1.0, 6.0, 0.5, 100.0), true, 0.5),
            (orthographic(-8.0, 8.0, -6.0, 6.0, 0.5, 100.0) * 3.0, true, 0.5),
        ]
    }

    #[test]
    fn distances_run_along_the_line_of_sight_of_any_lens() {
        let look = rh::view::look_at_mat4(EYE, Vec3::new(3.0, 2.0, 0.0), Vec3::Y);
        let roll = Mat4::from_rotation_z(0.7);
        for (lens, orthographic, start) in lenses() {
            for turn in [Mat4::IDENTITY, roll] {
                let sight = Sight::new(lens * turn * look, &BOX).unwrap();
                assert_eq!(sight.orthographic, orthographic, "{lens}");
                for z in [-9.0, 0.0, 20.0] {
                    let distance = sight.distance(Vec3::new(1.0, 4.0, z));
                    assert!((distance - (30.0 - z - start)).abs() < 1e-3, "{lens}: {distance} at {z}");
                }
                let slice = sight.hull(&BOX, 25.0..=30.0);
                let (low, high) = extent(&slice);
                assert!((low.z + start).abs() < 1e-3 && (high.z - 5.0 + start).abs() < 1e-3, "{low} {high}");
            }
        }
    }

    #[test]
    fn perspective_cameras_of_left_handed_worlds_look_the_same_way() {
        let look = lh::view::look_at_mat4(-EYE, Vec3::ZERO, Vec3::Y);
        let sight = Sight::new(lh::proj::directx::perspective(0.8, 1.0, 0.5, 100.0) * look, &BOX).unwrap();
        assert!((sight.distance(Vec3::ZERO) - EYE.length()).abs() < 1e-3);
    }

    #[test]
    fn cameras_far_from_the_origin_and_of_any_size_have_an_inverse() {
        for scale in [1e-6, 1.0, 1e6] {
            let place = Vec3::new(3e3, 0.0, -2e3) * scale;
            let bounds = Bounds { min: place + BOX.min * scale, max: place + BOX.max * scale };
            let look = rh::view::look_at_mat4(place + EYE * scale, place, Vec3::Y);
            for near in [1e-3, 0.5] {
                let lens = rh::proj::directx::perspective_infinite_reverse(0.8, 1.0, near * scale);
                assert!(Sight::new(lens * look, &bounds).is_ok(), "{scale} {near}");
            }
        }
    }

    #[test]
    fn matrices_that_are_no_cameras_are_refused_by_name() {
        let look = rh::view::look_at_mat4(EYE, Vec3::ZERO, Vec3::Y);
        let good = rh::proj::directx::perspective(0.8, 1.0, 0.5, 100.0) * look;
        assert!(Sight::new(good, &BOX).is_ok(), "negative control");
        let rows = |f: fn(usize) -> usize| {
            Mat4::from_cols(good.row(f(0)), good.row(f(1)), good.row(f(2)), good.row(f(3))).transpose()
        };
        let mut one_nan = good;
        one_nan.z_axis.y = f32::NAN;
        let flat = Mat4::from_scale(Vec3::new(1.0, 0.0, 1.0)) * good;
        let cases = [
            (Mat4::NAN, "finite"),
            (Mat4::ZERO, "inverted"),
            (one_nan, "finite"),
            (flat, "inverted"),
            (good * Mat4::from_scale(Vec3::new(1.0, 1.0, 0.0)), "inverted"),
            (rows(|i| if i == 2 { 3 } else { i }), "inverted"),
            (rows(|i| if i == 1 { 0 } else { i }), "inverted"),
            (Mat4::from_cols_array(&[1.0; 16]), "inverted"),
            (Mat4::from_scale(Vec3::splat(f32::INFINITY)), "finite"),
        ];
        for (matrix, word) in cases {
            let error = Sight::new(matrix, &BOX).unwrap_err().to_string();
            assert!(error.contains("camera") && error.contains(word), "{error}");
            assert!(error.contains(&matrix.to_string()), "{error}");
            assert!(visible_hull(matrix, &BOX, 0.0..=f32::INFINITY).is_empty());
        }
    }

    #[test]
    fn the_visible_hull_is_the_box_cut_by_the_frustum() {
        let eye = Vec3::new(0.0, 2.0, 30.0);
        let look = rh::view::look_at_mat4(eye, Vec3::new(0.0, 2.0, 0.0), Vec3::Y);
        for far in [100.0, f32::INFINITY] {
            let lens = if far.is_finite() {
                rh::proj::directx::perspective(0.2, 1.0, 0.1, far)
            } else {
                rh::proj::directx::perspective_infinite(0.2, 1.0, 0.1)
            };
            let hull = visible_hull(lens * look, &BOX, 0.0..=f32::INFINITY);
            let (low, high) = extent(&hull);
            // At z = −10 the frustum is 40 · tan 0.1 wide on each side.
            assert!((high.x - 40.0 * 0.1f32.tan()).abs() < 1e-3, "{high}");
            assert!((low.z + 10.0).abs() < 1e-3 && (high.z - 10.0).abs() < 1e-3);
            let (low, high) = extent(&visible_hull(lens * look, &BOX, 25.0..=30.0));
            assert!((low.z - 0.0).abs() < 1e-3 && (high.z - 5.0).abs() < 1e-3, "{low} {high}");
        }
        let away = rh::view::look_at_mat4(eye, eye + Vec3::Z, Vec3::Y);
        let lens = rh::proj::directx::perspective(0.2, 1.0, 0.1, 100.0);
        assert!(visible_hull(lens * away, &BOX, 0.0..=f32::INFINITY).is_empty());
    }
}
