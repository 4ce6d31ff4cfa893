//! From a picture to the triangles that it shows.

use crate::body::Bodies;
use crate::tree::{Span, Tree};
use crate::triangle::Meeting;
use crate::{CameraRays, Ray, TruthError};
use antumbra_scene::{AlphaMode, Geometry};
use glam::DVec3;
use rayon::prelude::*;
use std::sync::{Arc, OnceLock};

/// What a primary ray sees.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The geometry's number of the triangle; [`Hit::NONE`] where the ray meets nothing.
    pub triangle: u32,
    /// World position, computed in f64 from the triangle's f32 corners: on the triangle's plane and
    /// on the ray to some 10⁻¹⁵ of the coordinates involved. Infinite for a miss.
    pub position: DVec3,
    /// Unit geometric normal on the camera's side. Zero for a miss.
    pub normal: DVec3,
    /// Weight of the triangle's second corner, from 0 to 1.
    pub u: f64,
    /// Weight of its third; u + v ≤ 1 up to rounding.
    pub v: f64,
}

impl Hit {
    /// The triangle number of a miss.
    pub const NONE: u32 = u32::MAX;

    /// A ray that met nothing.
    pub const MISS: Self =
        Self { triangle: Self::NONE, position: DVec3::INFINITY, normal: DVec3::ZERO, u: 0.0, v: 0.0 };

    /// Whether the ray met a triangle.
    #[must_use]
    pub fn is_hit(&self) -> bool {
        self.triangle != Self::NONE
    }
}

/// A tree over the triangles of a geometry that several tracers share: the first builds it.
#[derive(Clone, Default)]
pub struct SharedTree(Arc<OnceLock<Arc<Tree>>>);

impl SharedTree {
    /// The tree if it is one over this geometry, else a new one; kept where there was none.
    fn over(&self, geometry: &Geometry) -> Result<Arc<Tree>, TruthError> {
        match self.0.get() {
            Some(tree) if tree.is_over(geometry)? => Ok(Arc::clone(tree)),
            Some(_) => Ok(Arc::new(Tree::new(geometry)?)),
            None => {
                let tree = Arc::new(Tree::new(geometry)?);
                Ok(Arc::clone(self.0.get_or_init(|| tree)))
            }
        }
    }
}

impl std::fmt::Debug for SharedTree {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("SharedTree").field(&self.0.get().map(|tree| tree.triangle_count())).finish()
    }
}

/// Traces rays through a [`Geometry`].
///
/// Every triangle stops rays from both sides; points that [`Geometry::is_cut`] removes let them
/// pass. Answers depend on the input alone: neither on the number of threads nor on chance.
pub struct Tracer<'g> {
    pub(crate) geometry: &'g Geometry,
    pub(crate) tree: Arc<Tree>,
    pub(crate) clearance_ulps: f64,
    /// Triangles from here on may have cut-out points.
    first_masked: u32,
    /// Found when first asked for.
    bodies: OnceLock<Bodies>,
}

impl std::fmt::Debug for Tracer<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Tracer")
            .field("triangles", &self.geometry.triangle_count())
            .field("clearance_ulps", &self.clearance_ulps)
            .finish_non_exhaustive()
    }
}

impl<'g> Tracer<'g> {
    /// Height above a receiver, in ulps of f32, below which nothing shadows it.
    pub const CLEARANCE_ULPS: f64 = 20.0;

    /// Builds the tree over all triangles.
    ///
    /// Cost: about a microsecond and 250 bytes per triangle, on all cores.
    ///
    /// # Errors
    /// [`TruthError::Empty`] without triangles, [`TruthError::BadIndices`] and
    /// [`TruthError::BadTriangle`] for broken ones, [`TruthError::TooDeep`] for sizes that no tree
    /// can sort.
    pub fn new(geometry: &'g Geometry) -> Result<Self, TruthError> {
        Self::sharing(geometry, &SharedTree::default())
    }

    /// The same with a tree that is shared with other tracers of this geometry.
    ///
    /// Cost: that of [`new`](Self::new) for the first of them.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn sharing(geometry: &'g Geometry, tree: &SharedTree) -> Result<Self, TruthError> {
        let first_masked = geometry
            .groups
            .iter()
            .filter(|(material, _)| {
                let material = geometry.materials.get(*material);
                material.is_some_and(|m| matches!(m.alpha, AlphaMode::Mask { .. }))
            })
            .map(|(_, range)| range.start)
            .min();
        Ok(Self {
            geometry,
            tree: tree.over(geometry)?,
            clearance_ulps: Self::CLEARANCE_ULPS,
            first_masked: first_masked.unwrap_or(u32::MAX),
            bodies: OnceLock::new(),
        })
    }

    /// The same tracer with another clearance, in ulps of f32 of the receiver's coordinates; see
    /// the [crate's page](crate#where-a-shadow-ray-starts). For experiments: 0 brings acne, large
    /// values lose contact shadows.
    #[must_use]
    pub fn with_clearance_ulps(self, clearance_ulps: f64) -> Self {
        Self { clearance_ulps, ..self }
    }

    /// The triangles that the tracer traces.
    #[must_use]
    pub fn geometry(&self) -> &'g Geometry {
        self.geometry
    }

    /// The first thing that a camera's `ray` meets at a positive distance. Of triangles at the very same
    /// distance it is the one with the lowest number. Where the geometry is
    /// [single-sided](Geometry::single_sided), triangles that turn their back are not met.
    #[must_use]
    pub fn trace(&self, ray: &Ray) -> Hit {
        let span = Span { near: 0.0, far: f64::INFINITY };
        let is_there = |triangle: u32, met: &Meeting| {
            !self.is_cut(triangle, met) && !self.geometry.is_seen_through(triangle as usize, ray.direction)
        };
        match self.tree.nearest(ray, span, is_there) {
            Some((triangle, met)) => self.hit(ray, triangle, &met),
            None => Hit::MISS,
        }
    }

    /// What the centre of every pixel shows: `rays.pixel_count()` hits, row by row from the top.
    ///
    /// Cost: one ray per pixel.
    #[must_use]
    pub fn primary(&self, rays: &CameraRays) -> Vec<Hit> {
        (0..rays.pixel_count())
            .into_par_iter()
            .with_min_len(256)
            .map(|index| self.trace(&rays.center_ray(index)))
            .collect()
    }

    /// Which triangles hang together.
    pub(crate) fn bodies(&self) -> &Bodies {
        self.bodies.get_or_init(|| Bodies::new(self.geometry))
    }

    /// Whether the point of the triangle is cut out, so that rays pass.
    pub(crate) fn is_cut(&self, triangle: u32, met: &Meeting) -> bool {
        triangle >= self.first_masked && self.geometry.is_cut(triangle as usize, met.u, met.v)
    }

    /// Corners in f64.
    pub(crate) fn corners(&self, triangle: u32) -> [DVec3; 3] {
        self.geometry.triangle(triangle as usize).map(|corner| corner.as_dvec3())
    }

    fn hit(&self, ray: &Ray, triangle: u32, met: &Meeting) -> Hit {
        let [a, b, c] = self.corners(triangle);
        let position = a + met.u * (b - a) + met.v * (c - a);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let normal = if normal.dot(ray.direction) > 0.0 { -normal } else { normal };
        Hit { triangle, position, normal, u: met.u, v: met.v }
    }
}
