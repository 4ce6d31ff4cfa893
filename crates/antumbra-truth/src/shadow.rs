//! Shadow rays, and the two truths that need nothing else.

use crate::tree::Span;
use crate::{CameraRays, Hit, Ray, Tracer};
use antumbra_scene::Light;
use glam::DVec3;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// A picture of visibility.
#[derive(Debug, Clone, PartialEq)]
pub struct Visibility {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Share of the light that arrives, from 0 to 1, linear; `width · height` values, row by row from
    /// the top. 1 where the pixel is not shadowable.
    pub values: Vec<f32>,
    /// Whether the pixel can be scored: it sees geometry whose side towards the camera also faces
    /// the light, inside the cone of a spot. One per value.
    pub shadowable: Vec<bool>,
}

impl Visibility {
    /// From one visibility per pixel, `None` where it is not shadowable.
    pub(crate) fn collect(rays: &CameraRays, pixels: &[Option<f32>]) -> Self {
        Self {
            width: rays.width(),
            height: rays.height(),
            values: pixels.iter().map(|v| v.unwrap_or(1.0)).collect(),
            shadowable: pixels.iter().map(Option::is_some).collect(),
        }
    }
}

/// Counts finished rows and says so.
pub(crate) struct Progress<'a> {
    report: &'a (dyn Fn(f32) + Sync),
    done: AtomicUsize,
    total: usize,
}

impl<'a> Progress<'a> {
    pub(crate) fn new(report: &'a (dyn Fn(f32) + Sync), total: usize) -> Self {
        Self { report, done: AtomicUsize::new(0), total }
    }

    pub(crate) fn step(&self) {
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        (self.report)(done as f32 / self.total as f32);
    }
}

/// Unit vector from `point` to the light, and how far the light is.
pub(crate) fn to_light(light: &Light, point: DVec3) -> (DVec3, f64) {
    match *light {
        Light::Directional { direction } => (-direction.as_dvec3().normalize_or_zero(), f64::INFINITY),
        Light::Spot { position, .. } => {
            let arm = position.as_dvec3() - point;
            (arm.normalize_or_zero(), arm.length())
        }
    }
}

/// Whether a hit faces the light and is inside its cone.
pub(crate) fn is_shadowable(light: &Light, hit: &Hit) -> bool {
    if !hit.is_hit() {
        return false;
    }
    let (toward, _) = to_light(light, hit.position);
    let inside = match *light {
        Light::Directional { .. } => true,
        Light::Spot { direction, outer_angle, .. } => {
            let axis = direction.as_dvec3().normalize_or_zero();
            (-toward).dot(axis) >= f64::from(outer_angle).cos()
        }
    };
    inside && hit.normal.dot(toward) > 0.0
}

impl Tracer<'_> {
    /// Whether the light reaches the hit itself.
    fn is_lit(&self, light: &Light, receiver: &Hit) -> bool {
        self.is_lit_but_for(light, receiver, receiver.position, |_, _| false)
    }

    /// Whether the light reaches `point`, on or above the tangent plane of `receiver`. Triangles
    /// that are `forgiven`, given their number and the height above that plane at which the ray
    /// meets them, do not stop it.
    pub(crate) fn is_lit_but_for(
        &self,
        light: &Light,
        receiver: &Hit,
        point: DVec3,
        forgiven: impl Fn(u32, f64) -> bool,
    ) -> bool {
        let (direction, distance) = to_light(light, point);
        let clearance = self.clearance(receiver.triangle);
        let rise = receiver.normal.dot(direction);
        if rise <= 0.0 {
            return false;
        }
        // A blocker counts from the clearance above the plane up: that is where the span begins.
        let span = Span { near: clearance / rise, far: distance };
        let ray = Ray { origin: point, direction };
        let start = receiver.normal.dot(point - receiver.position);
        !self.tree.any(&ray, span, |triangle, met| {
            triangle != receiver.triangle
                && !self.is_cut(triangle, met)
                && !forgiven(triangle, start + met.t * rise)
        })
    }

    /// Height above the plane of `triangle` in which nothing shadows it, world units.
    fn clearance(&self, triangle: u32) -> f64 {
        self.clearance_ulps * self.ulp(triangle)
    }

    /// Ulp of f32 of the largest coordinate of `triangle`, world units.
    pub(crate) fn ulp(&self, triangle: u32) -> f64 {
        let corners = self.geometry.triangle(triangle as usize);
        let largest = corners.map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f32::max);
        f64::from(largest.next_up() - largest)
    }

    /// Whether the light reaches what a primary ray sees: 1 or 0, `None` where the hit is not
    /// shadowable.
    #[must_use]
    pub fn visibility(&self, light: &Light, hit: &Hit) -> Option<f32> {
        is_shadowable(light, hit).then(|| if self.is_lit(light, hit) { 1.0 } else { 0.0 })
    }

    /// The hard truth: one primary ray per pixel centre and one shadow ray. Values are 0 or 1.
    ///
    /// Cost: two rays per pixel.
    #[must_use]
    pub fn hard(&self, rays: &CameraRays, light: &Light) -> Visibility {
        let pixels: Vec<_> = (0..rays.pixel_count())
            .into_par_iter()
            .with_min_len(256)
            .map(|index| self.visibility(light, &self.trace(&rays.center_ray(index))))
            .collect();
        Visibility::collect(rays, &pixels)
    }

    /// The hard truth at points of one's own choice: hits of this tracer, under any light. Values are 0
    /// or 1, `None` where a hit is not shadowable.
    ///
    /// Cost: one ray per point.
    #[must_use]
    pub fn hard_at(&self, hits: &[Hit], light: &Light) -> Vec<Option<f32>> {
        hits.par_iter().with_min_len(256).map(|hit| self.visibility(light, hit)).collect()
    }

    /// The screen-space ideal: the hard truth of `grid` × `grid` points per pixel, on a regular grid
    /// ((i + ½)/grid), averaged over the shadowable ones. A pixel is shadowable when one of its
    /// points is. `grid` 0 counts as 1.
    ///
    /// Every pixel gets every ray: anything adaptive can miss a wire thinner than a pixel.
    /// `progress` hears shares in (0,1], from any thread, not always in order.
    ///
    /// Cost: 2 `grid`² rays per pixel.
    #[must_use]
    pub fn supersampled(
        &self,
        rays: &CameraRays,
        light: &Light,
        grid: u32,
        progress: &(dyn Fn(f32) + Sync),
    ) -> Visibility {
        let grid = grid.max(1);
        let rows = Progress::new(progress, rays.height() as usize);
        let mut pixels = vec![None; rays.pixel_count()];
        pixels.par_chunks_mut(rays.width() as usize).enumerate().for_each(|(y, row)| {
            for (x, pixel) in row.iter_mut().enumerate() {
                *pixel = self.pixel_mean(rays, light, grid, [x as f64, y as f64]);
            }
            rows.step();
        });
        Visibility::collect(rays, &pixels)
    }

    /// The same for some pixels only, by number.
    ///
    /// Cost: 2 `grid`² rays per pixel.
    #[must_use]
    pub fn supersampled_at(
        &self,
        rays: &CameraRays,
        pixels: &[usize],
        light: &Light,
        grid: u32,
    ) -> Vec<Option<f32>> {
        let mean = |&pixel: &usize| {
            let (x, y) = rays.pixel(pixel);
            self.pixel_mean(rays, light, grid.max(1), [f64::from(x), f64::from(y)])
        };
        pixels.par_iter().with_min_len(16).map(mean).collect()
    }

    fn pixel_mean(&self, rays: &CameraRays, light: &Light, grid: u32, corner: [f64; 2]) -> Option<f32> {
        let at = |i: u32| (f64::from(i) + 0.5) / f64::from(grid);
        let (mut sum, mut count) = (0.0, 0.0);
        for (i, j) in (0..grid).flat_map(|j| (0..grid).map(move |i| (i, j))) {
            let ray = rays.ray(corner[0] + at(i), corner[1] + at(j));
            if let Some(lit) = self.visibility(light, &self.trace(&ray)) {
                sum += lit;
                count += 1.0;
            }
        }
        (count > 0.0).then(|| sum / count)
    }
}
