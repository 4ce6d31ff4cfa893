//! What can go wrong before the first ray.

/// Why there is no truth to be had. Once a [`Tracer`](crate::Tracer) and a picture exist, tracing
/// itself cannot fail.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TruthError {
    /// There is nothing to trace.
    #[error("the geometry has no triangles; a shadow needs at least one")]
    Empty,
    /// A triangle that cannot be traced.
    #[error(
        "triangle {triangle} has a corner that is NaN, infinite or out of range; clean the mesh \
         before tracing it"
    )]
    BadTriangle {
        /// Index of the triangle in the geometry.
        triangle: usize,
    },
    /// The indices are not whole triangles, or there are more than `u32` can number.
    #[error("{indices} indices do not make between 1 and 2³² − 2 whole triangles")]
    BadIndices {
        /// Length of `Geometry::indices`.
        indices: usize,
    },
    /// The tree is deeper than the traversal stack.
    #[error(
        "the tree over {triangles} triangles is {depth} levels deep and {limit} is the limit; \
         triangle sizes differ by too many orders of magnitude: split the largest"
    )]
    TooDeep {
        /// Number of triangles.
        triangles: usize,
        /// Levels of the tree.
        depth: usize,
        /// Deepest tree that can be traversed.
        limit: usize,
    },
    /// A camera that sees nothing definite.
    #[error(
        "the camera at {position} looking at {target} ({width}×{height} pixels, {projection:?}) spans no \
         picture; position, target and up must be finite and not in line, the field of view in (0, π) rad \
         or the height finite and above 0, and both sizes at least 1"
    )]
    BadCamera {
        /// Eye.
        position: glam::Vec3,
        /// Point looked at.
        target: glam::Vec3,
        /// Field of view or height.
        projection: antumbra_scene::Projection,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A kernel that is no weighted mean.
    #[error(
        "the kernel's {taps} weights sum to {sum}; a kernel has at least one weight, none of them \
         negative or NaN, and a positive sum"
    )]
    BadKernel {
        /// How many weights were given.
        taps: usize,
        /// Their sum.
        sum: f64,
    },
}
