//! The light-space ideal: what a filtered map of infinite resolution would answer.
//!
//! s_f(x) = Σ_q w(q) f(d(x), z(p − q)) (Annen et al. 2007, Eq. 4), with z from rays: for every offset
//! q of the kernel, is the light's path at p − q blocked before it reaches the receiver?
//!
//! **Which receiver depth?** Eq. 4 keeps d(x) for all q, which would put half of every tilted lit
//! plane into its own shadow: the half of the kernel that lies uphill, nearer to the light. Eq. 3
//! compares with d(y), y being the surface's point that projects to p − q. Here uphill samples are
//! lifted onto the receiver's *tangent plane*, through x with the geometric normal, and downhill
//! ones keep d(x): the smaller of the two depths. Following the plane downhill too would let it dive
//! under whatever it meets, and so darken a lit wall along the floor.
//!
//! **The receiver's own surface.** Uphill of x a concave surface, and every tessellated bump of one,
//! stands above the tangent plane. It is what x would be compared with if d(y) were known, so it is
//! no blocker: triangles of the receiver's own body (joined to it by shared corners) do not count
//! where they rise above the plane by less than the sample's distance from x, a slope of 45°. Other
//! bodies always count, however near: contact shadows stay.
//!
//! **Grazing light.** The farther the plane tilts from the light, the farther apart lie the points
//! that neighbouring texels see. Beyond a depth change of [`STEEPEST`] per lateral unit (light at
//! less than 0.9° to the plane), or where the plane of a spot's receiver would leave the range from
//! ⅔ to 2 times the receiver's depth, the kernel is compressed along the slope just so far that the
//! limit holds. So every sample stays finite and on or above the plane, and no lit plane shadows
//! itself.

use crate::body::Bodies;
use crate::kernel::scramble;
use crate::shadow::{Progress, is_shadowable, to_light};
use crate::{CameraRays, Hit, Kernel, MapTexels, TexelAxes, Tracer, Visibility};
use antumbra_scene::Light;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Largest change of depth along the light per lateral distance, at which the kernel keeps its
/// shape.
const STEEPEST: f64 = 64.0;
/// Samples of every pixel.
const FEW: u32 = 64;
/// Samples of a pixel in or beside a penumbra.
const MANY: u32 = 256;

/// The point that an offset in the map compares with: on the receiver's tangent plane, or at its
/// depth where the plane is deeper.
#[derive(Debug, Clone, Copy)]
enum Footprint {
    /// position + a·right + b·down + max(rise·(a, b), 0)·toward.
    Parallel { position: DVec3, right: DVec3, down: DVec3, rise: DVec2, toward: DVec3 },
    /// apex + depth/(1 + max(slope·(a, b), 0)) · (axis + a·right + b·down).
    Central { apex: DVec3, depth: f64, axis: DVec3, right: DVec3, down: DVec3, slope: DVec2 },
}

impl Footprint {
    fn new(light: &Light, axes: &TexelAxes, reach: f64, hit: &Hit) -> Self {
        let TexelAxes { right_per_texel: right, down_per_texel: down } = *axes;
        let lengths = DVec2::new(right.length(), down.length());
        let across = DVec2::new(hit.normal.dot(right), hit.normal.dot(down));
        match *light {
            Light::Directional { .. } => {
                let (toward, _) = to_light(light, hit.position);
                // Sliding along the light brings an offset back onto the plane.
                let slide = -across / hit.normal.dot(toward);
                let [(a, a_slide), (b, b_slide)] = compress(slide, lengths, STEEPEST);
                let place = |(x, y): (f64, f64)| x * right + y * down;
                let rise = DVec2::new(a_slide, b_slide);
                Self::Parallel { position: hit.position, right: place(a), down: place(b), rise, toward }
            }
            Light::Spot { position, direction, .. } => {
                let apex = position.as_dvec3();
                let depth = (hit.position - apex).dot(direction.as_dvec3().normalize_or_zero());
                let axis = (hit.position - apex) / depth;
                let slope = across / hit.normal.dot(axis);
                let farthest = std::f64::consts::SQRT_2 * reach * lengths.max_element();
                let steepest = STEEPEST.min(0.5 * axis.length() / farthest);
                let [(a, a_slope), (b, b_slope)] = compress(slope * axis.length(), lengths, steepest);
                let place = |(x, y): (f64, f64)| x * right + y * down;
                let slope = DVec2::new(a_slope, b_slope) / axis.length();
                Self::Central { apex, depth, axis, right: place(a), down: place(b), slope }
            }
        }
    }

    fn point(&self, offset: DVec2) -> DVec3 {
        match *self {
            Self::Parallel { position, right, down, rise, toward } => {
                position + offset.x * right + offset.y * down + rise.dot(offset).max(0.0) * toward
            }
            Self::Central { apex, depth, axis, right, down, slope } => {
                let depth = depth / (1.0 + slope.dot(offset).max(0.0));
                apex + depth * (axis + offset.x * right + offset.y * down)
            }
        }
    }
}

/// Where the two unit steps of the map go, (a, b) each, and the depth change of each, when the
/// kernel is compressed along the slope to be no steeper than `steepest`.
///
/// `change` is the depth change per texel step, `lengths` the length of the steps.
fn compress(change: DVec2, lengths: DVec2, steepest: f64) -> [((f64, f64), f64); 2] {
    let gradient = change / lengths;
    let steepness = gradient.length();
    let excess = (1.0 - steepest / steepness).max(0.0);
    let uphill = if excess > 0.0 { gradient / steepness } else { DVec2::ZERO };
    let step = |unit: DVec2| {
        let kept = unit * lengths - excess * uphill * uphill.dot(unit * lengths);
        let (a, b) = (kept / lengths).into();
        ((a, b), change.dot(DVec2::new(a, b)))
    };
    [step(DVec2::X), step(DVec2::Y)]
}

/// What the kernel's samples found.
#[derive(Debug, Clone, Copy)]
struct Tally {
    lit: u32,
    of: u32,
}

impl Tally {
    fn is_mixed(self) -> bool {
        self.lit != 0 && self.lit != self.of
    }
}

/// One light seen through one filter.
struct Ideal<'a> {
    tracer: &'a Tracer<'a>,
    light: &'a Light,
    kernel: &'a Kernel,
    texels: &'a dyn MapTexels,
    bodies: &'a Bodies,
}

impl Ideal<'_> {
    /// Samples `range` of the kernel around a hit, one of many by its `number`; `None` where it is not
    /// shadowable.
    fn sample(&self, number: usize, hit: &Hit, range: std::ops::Range<u32>) -> Option<Tally> {
        if !is_shadowable(self.light, hit) {
            return None;
        }
        let footprint = Footprint::new(self.light, &self.texels.axes(hit.position), self.kernel.reach(), hit);
        let scramble = scramble(number);
        let of = range.end - range.start;
        let lit = range
            .filter(|&index| {
                let point = footprint.point(self.kernel.sample(index, scramble));
                let reach = point.distance(hit.position);
                self.tracer.is_lit_but_for(self.light, hit, point, |triangle, height| {
                    height < reach && self.bodies.same(triangle, hit.triangle)
                })
            })
            .count();
        Some(Tally { lit: lit as u32, of })
    }
}

/// Whether a pixel or one of its eight neighbours is mixed, or they differ.
fn is_near_penumbra(rays: &CameraRays, tallies: &[Option<Tally>], pixel: usize) -> bool {
    let (x, y) = rays.pixel(pixel);
    let Some(Tally { lit, .. }) = tallies[pixel] else { return false };
    let columns = x.saturating_sub(1)..=(x + 1).min(rays.width() - 1);
    let rows = y.saturating_sub(1)..=(y + 1).min(rays.height() - 1);
    rows.flat_map(|row| columns.clone().map(move |column| (column, row)))
        .filter_map(|(column, row)| tallies[row as usize * rays.width() as usize + column as usize])
        .any(|near| near.is_mixed() || near.lit != lit)
}

/// Share of the light over all samples that were taken, `None` without any.
fn mean(tallies: [Option<Tally>; 2]) -> Option<f32> {
    let sum = |pick: fn(Tally) -> u32| tallies.into_iter().flatten().map(pick).sum::<u32>();
    let (lit, of) = (sum(|t| t.lit), sum(|t| t.of));
    (of > 0).then(|| lit as f32 / of as f32)
}

impl Tracer<'_> {
    /// The light-space ideal of a filter: visibility averaged over `kernel`, laid out in the map as
    /// `texels` says where the pixel's point is, with the caster depth from rays; see the [crate's
    /// page](crate#the-light-space-ideal).
    ///
    /// Every pixel gets 64 rays, spread evenly over the kernel; one whose rays disagree, or that has
    /// such a neighbour, gets 256. In penumbrae the root mean square error is then about 0.005 (measured
    /// on straight edges, for kernels of 1 to 8 taps). Where 64 rays agree, a caster that covers less than
    /// some 1/64 of the kernel can have been missed. `progress` hears shares in (0,1], from any thread, not
    /// always in order.
    ///
    /// Cost: 66 to 258 rays per pixel.
    #[must_use]
    pub fn light_space_ideal(
        &self,
        rays: &CameraRays,
        light: &Light,
        kernel: &Kernel,
        texels: &dyn MapTexels,
        progress: &(dyn Fn(f32) + Sync),
    ) -> Visibility {
        let ideal = Ideal { tracer: self, light, kernel, texels, bodies: self.bodies() };
        let hit = |pixel| self.trace(&rays.center_ray(pixel));
        let width = rays.width() as usize;
        let rows = Progress::new(progress, 2 * rays.height() as usize);
        let mut few = vec![None; rays.pixel_count()];
        few.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, tally) in row.iter_mut().enumerate() {
                let pixel = y * width + x;
                *tally = ideal.sample(pixel, &hit(pixel), 0..FEW);
            }
            rows.step();
        });
        let mut pixels = vec![None; rays.pixel_count()];
        pixels.par_chunks_mut(width).enumerate().for_each(|(y, row)| {
            for (x, value) in row.iter_mut().enumerate() {
                let pixel = y * width + x;
                let near = is_near_penumbra(rays, &few, pixel);
                let more = near.then(|| ideal.sample(pixel, &hit(pixel), FEW..MANY)).flatten();
                *value = mean([few[pixel], more]);
            }
            rows.step();
        });
        Visibility::collect(rays, &pixels)
    }
    /// The same at points of one's own choice: hits of this tracer, under any light. `None` where a hit
    /// is not shadowable. A point takes 64 rays, and 256 if those disagree; equal numbers in the list
    /// have equal samples, so that their noise cancels where two lists are compared.
    ///
    /// Cost: 64 to 256 rays per point.
    #[must_use]
    pub fn light_space_ideal_at(
        &self,
        hits: &[Hit],
        light: &Light,
        kernel: &Kernel,
        texels: &dyn MapTexels,
    ) -> Vec<Option<f32>> {
        let ideal = Ideal { tracer: self, light, kernel, texels, bodies: self.bodies() };
        hits.par_iter()
            .enumerate()
            .with_min_len(64)
            .map(|(number, hit)| {
                let few = ideal.sample(number, hit, 0..FEW);
                let mixed = few.is_some_and(Tally::is_mixed);
                mean([few, mixed.then(|| ideal.sample(number, hit, FEW..MANY)).flatten()])
            })
            .collect()
    }
}
