//! Do raster and rays see the same geometry?
//!
//! Shadow techniques are judged pixel by pixel against rays, so first both must see the same triangle
//! in every pixel. They cannot quite: a rasteriser snaps corners to 1/256 pixel and its depth buffer
//! cannot tell surfaces that touch. Each disagreement either has such a reason or it is a bug in the
//! camera, the geometry or the tracer.

use crate::triangle::{Meeting, meet_plane};
use crate::{CameraRays, Hit, Ray, Tracer};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// What raster and rays may differ by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoverageTolerance {
    /// Distance from a triangle's projected edge within which the rasteriser's answer may be either,
    /// pixels. The default 0.01 is the diagonal of 1/256 pixel, rounded up.
    pub edge_pixels: f64,
    /// Difference of depth, over depth, within which either triangle may win. The default 10⁻⁵ suits
    /// a 32-bit depth buffer with reversed z, or with near and far planes that are no more than some
    /// 1 : 100 apart.
    pub depth_relative: f64,
}

impl Default for CoverageTolerance {
    fn default() -> Self {
        Self { edge_pixels: 0.01, depth_relative: 1e-5 }
    }
}

/// Why a pixel shows one triangle to raster and another to rays.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Difference {
    /// Both triangles cover the pixel's centre, uncut, in one plane: the two sides of a folded leaf, say.
    /// Whichever is seen, it is the same surface in the same place.
    Twin,
    /// An edge of either triangle passes through the centre of the pixel, within the tolerance.
    Edge,
    /// Both triangles lie at this pixel at the same depth, within the tolerance.
    DepthTie,
    /// The border of a cut-out passes through the centre of the pixel.
    Cutout,
    /// None of these.
    Unexplained,
}

/// How well raster and rays agree, in pixels.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Coverage {
    /// Pixels compared.
    pub pixels: usize,
    /// Same triangle, or background for both, or [`twins`](Self::twins).
    pub agree: usize,
    /// Explained by [`Difference::Twin`]: pixels that show the same surface all the same.
    pub twins: usize,
    /// Explained by [`Difference::Edge`].
    pub edge: usize,
    /// Explained by [`Difference::DepthTie`].
    pub depth_tie: usize,
    /// Explained by [`Difference::Cutout`].
    pub cutout: usize,
    /// The rest.
    pub unexplained: usize,
    /// Column and row of the first unexplained pixels, [`Coverage::SHOWN`] at most.
    pub first_unexplained: Vec<(u32, u32)>,
}

impl Coverage {
    /// How many unexplained pixels are listed.
    pub const SHOWN: usize = 16;

    /// Share of pixels with the same triangle, from 0 to 1; 1 for an empty picture.
    #[must_use]
    pub fn agreement(&self) -> f64 {
        if self.pixels == 0 { 1.0 } else { self.agree as f64 / self.pixels as f64 }
    }
}

impl Tracer<'_> {
    /// Compares the triangle numbers that a rasteriser wrote with what primary rays see.
    ///
    /// `hits` is [`Tracer::primary`] of the same `rays`; `raster` has one number per pixel, row by
    /// row from the top, [`Hit::NONE`] for background. Surplus pixels of either are not compared, so
    /// check [`Coverage::pixels`].
    ///
    /// Cost: next to nothing for pixels that agree.
    #[must_use]
    pub fn coverage(
        &self,
        rays: &CameraRays,
        hits: &[Hit],
        raster: &[u32],
        tolerance: CoverageTolerance,
    ) -> Coverage {
        let pixels = hits.len().min(raster.len()).min(rays.pixel_count());
        let differences: Vec<(usize, Difference)> = (0..pixels)
            .into_par_iter()
            .with_min_len(1024)
            .filter(|&pixel| hits[pixel].triangle != raster[pixel])
            .map(|pixel| {
                (pixel, self.difference(rays, pixel, hits[pixel].triangle, raster[pixel], tolerance))
            })
            .collect();
        let mut coverage = Coverage { pixels, agree: pixels - differences.len(), ..Coverage::default() };
        for (pixel, difference) in differences {
            match difference {
                Difference::Twin => {
                    coverage.twins += 1;
                    coverage.agree += 1;
                }
                Difference::Edge => coverage.edge += 1,
                Difference::DepthTie => coverage.depth_tie += 1,
                Difference::Cutout => coverage.cutout += 1,
                Difference::Unexplained => {
                    coverage.unexplained += 1;
                    if coverage.first_unexplained.len() < Coverage::SHOWN {
                        coverage.first_unexplained.push(rays.pixel(pixel));
                    }
                }
            }
        }
        coverage
    }

    /// Why pixel number `pixel` shows `traced` to rays and `drawn` to the rasteriser, which differ.
    #[must_use]
    pub fn difference(
        &self,
        rays: &CameraRays,
        pixel: usize,
        traced: u32,
        drawn: u32,
        tolerance: CoverageTolerance,
    ) -> Difference {
        let count = self.geometry().triangle_count();
        let known: Vec<u32> = [traced, drawn].into_iter().filter(|&t| (t as usize) < count).collect();
        let (x, y) = rays.pixel(pixel);
        let center = DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
        let edge = |&t: &u32| edge_distance(rays, self.corners(t), center) <= tolerance.edge_pixels;
        let cutout = |&t: &u32| self.has_border(rays, t, center, tolerance.edge_pixels);
        if known.iter().any(edge) {
            Difference::Edge
        } else if known.len() == 2 && self.are_twins(&rays.center_ray(pixel), [traced, drawn]) {
            Difference::Twin
        } else if known.len() == 2 && self.is_tie(rays, pixel, [traced, drawn], tolerance) {
            Difference::DepthTie
        } else if known.iter().any(cutout) {
            Difference::Cutout
        } else {
            Difference::Unexplained
        }
    }

    /// Whether both triangles stop the ray, and lie in one plane up to the rounding of their corners: a
    /// corner, and the plane that it should lie on, are each known to √3/2 ulps of the largest coordinate.
    fn are_twins(&self, ray: &Ray, pair: [u32; 2]) -> bool {
        let stops = |&t: &u32| {
            meet_plane(ray, self.corners(t))
                .is_some_and(|met| met.t > 0.0 && covers(&met) && !self.is_cut(t, &met))
        };
        let on_plane = |t: u32, plane: u32| {
            let [a, b, c] = self.corners(plane);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let tolerance = 2.0 * self.ulp(plane).max(self.ulp(t));
            self.corners(t).iter().all(|corner| normal.dot(*corner - a).abs() <= tolerance)
        };
        pair.iter().all(stops) && (on_plane(pair[0], pair[1]) || on_plane(pair[1], pair[0]))
    }

    /// Whether both triangles cover the pixel's centre, uncut, at the same depth.
    fn is_tie(&self, rays: &CameraRays, pixel: usize, pair: [u32; 2], tolerance: CoverageTolerance) -> bool {
        let ray = rays.center_ray(pixel);
        let met = |t: u32| {
            meet_plane(&ray, self.corners(t)).filter(|met| met.t > 0.0 && covers(met) && !self.is_cut(t, met))
        };
        match pair.map(met) {
            [Some(a), Some(b)] => (a.t - b.t).abs() <= tolerance.depth_relative * a.t.max(b.t),
            _ => false,
        }
    }

    /// Whether a triangle is cut out in one of nine points around `center`, and there in another.
    fn has_border(&self, rays: &CameraRays, triangle: u32, center: DVec2, reach: f64) -> bool {
        let corners = self.corners(triangle);
        let steps = [-reach, 0.0, reach];
        let points = steps.iter().flat_map(|&x| steps.map(|y| center + DVec2::new(x, y)));
        let mut cut = points
            .filter_map(|point| meet_plane(&rays.ray(point.x, point.y), corners))
            .map(|met| self.is_cut(triangle, &met));
        let first = cut.next();
        cut.any(|other| Some(other) != first)
    }
}

/// Inside a triangle, up to rounding.
fn covers(met: &Meeting) -> bool {
    const ROUNDING: f64 = 1e-9;
    met.u >= -ROUNDING && met.v >= -ROUNDING && met.u + met.v <= 1.0 + ROUNDING
}

/// Distance, in pixels, from `center` to the nearest projected edge of a triangle; infinite when the
/// triangle is behind the camera.
fn edge_distance(rays: &CameraRays, corners: [DVec3; 3], center: DVec2) -> f64 {
    let [a, b, c] = corners.map(|corner| rays.camera_from_world(corner));
    [(a, b), (b, c), (c, a)]
        .into_iter()
        .filter_map(|(from, to)| in_front(from, to))
        .map(|ends| {
            let [from, to] = ends.map(|end| rays.picture_from_camera(end));
            let (arm, edge) = (center - from, to - from);
            let place = (arm.dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
            // NaN where the edge is seen as a point.
            (arm - if place >= 0.0 { place * edge } else { DVec2::ZERO }).length()
        })
        .fold(f64::INFINITY, f64::min)
}

/// The part of an edge, in the camera's frame, that lies before the camera by at least 10⁻⁶ of the
/// edge's farther end.
fn in_front(from: DVec3, to: DVec3) -> Option<[DVec3; 2]> {
    let near = 1e-6 * from.z.max(to.z);
    if near <= 0.0 {
        return None;
    }
    let clip = |end: DVec3, other: DVec3| {
        if end.z >= near { end } else { end + (other - end) * ((near - end.z) / (other.z - end.z)) }
    };
    Some([clip(from, to), clip(to, from)])
}
