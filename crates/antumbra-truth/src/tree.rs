//! The tree that finds the few triangles near a ray.
//!
//! The tree (`obvhs`, compressed eight-wide nodes) works in f32; the triangles behind it are tested
//! in f64. Its boxes therefore only have to be *conservative*: they may let too much through, never
//! too little. Three measures see to that:
//!
//! - the scene is moved and scaled by a power of two to fill the cube of half side [`HALF`], so that the
//!   rounding of f32 is a known absolute length, however far the scene is from the origin;
//! - rays are clipped to that cube in f64 before they are rounded, so that their start is no larger
//!   than the scene;
//! - boxes are inflated by [`SLACK`]. The box test rounds the ray's start (half an ulp of 1024:
//!   0.3·2⁻¹³), its distance to the box (2⁻¹⁴), two factors and a sum (5·2⁻²⁴ of a length of up to
//!   2048: 6·10⁻⁴), and the direction (2⁻²⁴, or 2⁻²³ where an almost-zero component is lifted to
//!   2⁻²³, along up to 3550: 4·10⁻⁴). Together they stay below 1.2·10⁻³; the slack is 2·10⁻³.

use crate::triangle::{Corners, Meeting, Shear};
use crate::{Ray, TruthError};
use antumbra_scene::Geometry;
use glam::{DVec3, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::cwbvh::CwBvh;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::RayHit;
use rayon::prelude::*;

/// Half the side of the cube that the scene is scaled into.
const HALF: f64 = 1024.0;
/// How far every box reaches beyond its triangle at least, in the cube's unit.
const SLACK: f32 = 2.0e-3;
/// Levels that the traversal stack holds.
const DEPTH_LIMIT: usize = 31;

/// Triangles in tree order.
pub(crate) struct Tree {
    nodes: CwBvh,
    corners: Vec<Corners>,
    /// The geometry's number of each triangle.
    numbers: Vec<u32>,
    center: DVec3,
    scale: f64,
    low: DVec3,
    high: DVec3,
}

/// The part of a ray that counts, as distances from its start.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    pub(crate) near: f64,
    pub(crate) far: f64,
}

impl Tree {
    /// Cost: about a microsecond and 250 bytes per triangle.
    pub(crate) fn new(geometry: &Geometry) -> Result<Self, TruthError> {
        let (low, high) = bounds(geometry)?;
        let center = 0.5 * (low + high);
        let reach = (0.5 * (high - low)).max_element();
        let scale = if reach > 0.0 { (HALF / reach).log2().floor().exp2() } else { 1.0 };
        let count = geometry.triangle_count();
        let boxes: Vec<Aabb> = (0..count)
            .into_par_iter()
            .map(|t| {
                let local = geometry.triangle(t).map(|p| local(p, center, scale));
                let [a, b, c] = local;
                let slack = SLACK * tie_breaker(t);
                Aabb::new(a.min(b).min(c) - slack, a.max(b).max(c) + slack)
            })
            .collect();
        let nodes = build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Default::default());
        let depth = depth(&nodes);
        if depth > DEPTH_LIMIT {
            return Err(TruthError::TooDeep { triangles: count, depth, limit: DEPTH_LIMIT });
        }
        let numbers = nodes.primitive_indices.clone();
        let corners =
            numbers.iter().map(|&t| solid(geometry.triangle(t as usize)).map(|p| p.to_array())).collect();
        Ok(Self { nodes, corners, numbers, center, scale, low, high })
    }

    /// Number of triangles.
    pub(crate) fn triangle_count(&self) -> usize {
        self.numbers.len()
    }

    /// Whether these are its triangles.
    ///
    /// Cost: reads every triangle once.
    pub(crate) fn is_over(&self, geometry: &Geometry) -> Result<bool, TruthError> {
        if self.triangle_count() != geometry.triangle_count() {
            return Ok(false);
        }
        bounds(geometry)?;
        let same = |(&t, corners): (&u32, &Corners)| {
            *corners == solid(geometry.triangle(t as usize)).map(|p| p.to_array())
        };
        Ok(self.numbers.par_iter().zip(&self.corners).all(same))
    }

    /// The nearest triangle that the ray meets within `span` and that `counts`; of several at the
    /// same distance the one with the lowest number.
    #[inline]
    pub(crate) fn nearest(
        &self,
        ray: &Ray,
        span: Span,
        counts: impl Fn(u32, &Meeting) -> bool,
    ) -> Option<(u32, Meeting)> {
        let (boxed, entry) = self.boxed(ray, span)?;
        let shear = Shear::new(ray);
        let mut best: Option<(u32, Meeting)> = None;
        self.nodes.ray_traverse(boxed, &mut RayHit::none(), |_, place| {
            let Some(met) = shear.meet(&self.corners[place]) else { return f32::INFINITY };
            if met.t <= span.near || met.t >= span.far {
                return f32::INFINITY;
            }
            let number = self.numbers[place];
            let closer = best.is_none_or(|(n, b)| met.t < b.t || (met.t == b.t && number < n));
            if closer && counts(number, &met) {
                best = Some((number, met));
                self.boxed_far(met.t, entry)
            } else {
                f32::INFINITY
            }
        });
        best
    }

    /// Whether the ray meets any triangle within `span` that `counts`.
    #[inline]
    pub(crate) fn any(&self, ray: &Ray, span: Span, counts: impl Fn(u32, &Meeting) -> bool) -> bool {
        let Some((boxed, _)) = self.boxed(ray, span) else { return false };
        let shear = Shear::new(ray);
        !self.nodes.ray_traverse_miss(boxed, |_, place| match shear.meet(&self.corners[place]) {
            Some(met) if met.t > span.near && met.t < span.far && counts(self.numbers[place], &met) => 0.0,
            _ => f32::INFINITY,
        })
    }

    /// The ray in the cube, clipped to the scene's box, and where along the ray it starts.
    fn boxed(&self, ray: &Ray, span: Span) -> Option<(obvhs::ray::Ray, f64)> {
        let inverse = ray.direction.recip();
        // Where a component of the direction is zero these are infinities, or NaN for a start on
        // the very face; `min` and `max` of f64 drop the NaN.
        let first = (self.low - ray.origin) * inverse;
        let second = (self.high - ray.origin) * inverse;
        let (mut entry, mut exit) = (span.near, span.far);
        for axis in 0..3 {
            entry = entry.max(first[axis].min(second[axis]));
            exit = exit.min(first[axis].max(second[axis]));
        }
        if entry > exit {
            return None;
        }
        let start = (ray.origin + entry * ray.direction - self.center) * self.scale;
        // The tree reads the sign of the direction and of its inverse, so a component that is
        // almost zero is lifted in both alike.
        let tiny = f32::EPSILON;
        let lift = |x: f32| {
            if x.abs() >= tiny {
                x
            } else if x < 0.0 {
                -tiny
            } else {
                tiny
            }
        };
        let direction = ray.direction.as_vec3a();
        let direction = Vec3A::new(lift(direction.x), lift(direction.y), lift(direction.z));
        let boxed = obvhs::ray::Ray {
            origin: start.as_vec3a(),
            direction,
            inv_direction: direction.recip(),
            tmin: 0.0,
            tmax: self.boxed_far(exit, entry),
        };
        Some((boxed, entry))
    }

    /// A distance along the ray in the cube's unit, rounded up.
    fn boxed_far(&self, far: f64, entry: f64) -> f32 {
        ((far - entry) * self.scale) as f32 * (1.0 + 2.0 * f32::EPSILON) + SLACK
    }
}

/// A factor in [1, 2) that differs from triangle to triangle. Clustering degenerates into a chain
/// where many boxes are equal, as those of repeated triangles would be.
fn tie_breaker(triangle: usize) -> f32 {
    let scrambled = (triangle as u32).wrapping_mul(0x9e37_79b9).rotate_right(16);
    1.0 + (scrambled >> 16) as f32 / 65536.0
}

/// The corners, collapsed to one point where they span no area: rounding can then give them none.
fn solid(corners: [Vec3; 3]) -> [Vec3; 3] {
    let [a, b, c] = corners.map(Vec3::as_dvec3);
    if (b - a).cross(c - a) == DVec3::ZERO { [corners[0]; 3] } else { corners }
}

/// `point` in the cube.
fn local(point: Vec3, center: DVec3, scale: f64) -> Vec3A {
    ((point.as_dvec3() - center) * scale).as_vec3a()
}

/// The box around all triangles, widened by more than f64 rounds, after checking every corner.
fn bounds(geometry: &Geometry) -> Result<(DVec3, DVec3), TruthError> {
    let indices = geometry.indices.len();
    if indices == 0 {
        return Err(TruthError::Empty);
    }
    let count = geometry.triangle_count();
    if !indices.is_multiple_of(3) || u32::try_from(count).is_ok_and(|n| n == u32::MAX) {
        return Err(TruthError::BadIndices { indices });
    }
    let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    for (triangle, corners) in geometry.indices.chunks_exact(3).enumerate() {
        for &corner in corners {
            match geometry.positions.get(corner as usize) {
                Some(position) if position.is_finite() => {
                    low = low.min(*position);
                    high = high.max(*position);
                }
                _ => return Err(TruthError::BadTriangle { triangle }),
            }
        }
    }
    let (low, high) = (low.as_dvec3(), high.as_dvec3());
    let margin = 1e-9 * low.abs().max(high.abs()).max_element();
    Ok((low - margin, high + margin))
}

/// Levels of the tree.
fn depth(nodes: &CwBvh) -> usize {
    let mut deepest = 0;
    let mut open = vec![(0_usize, 1_usize)];
    while let Some((index, level)) = open.pop() {
        let Some(node) = nodes.nodes.get(index) else { continue };
        deepest = deepest.max(level);
        for child in 0..obvhs::cwbvh::BRANCHING {
            if !node.is_child_empty(child) && !node.is_leaf(child) {
                open.push((node.child_node_index(child) as usize, level + 1));
            }
        }
    }
    deepest
}
