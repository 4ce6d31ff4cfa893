//! What can go wrong with casters.

use thiserror::Error;

/// Why casters leave no shadow in a map.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum CasterError {
    /// The closure of [`ShadowMap::encode`](crate::ShadowMap::encode) used its pass, but drew no
    /// [`CasterMesh`](crate::CasterMesh).
    #[error(
        "{technique} keeps triangles, and the closure of encode drew no CasterMesh: what other pipelines draw there leaves no shadow; call CasterPass::draw_mesh, or take a technique that keeps depth"
    )]
    OwnPipelines {
        /// Name of the technique.
        technique: String,
    },
    /// The map reads depth that the caller renders.
    #[error(
        "this shadow map of {technique} reads depth that its caller renders; call encode_filter instead of encode"
    )]
    Brought {
        /// Name of the technique.
        technique: String,
    },
    /// The closure drew a [`CasterMesh`](crate::CasterMesh).
    #[error(
        "{technique} keeps depth, and the closure of encode drew a CasterMesh, which leaves no shadow there; draw casters with pipelines of your own that write depth"
    )]
    Mesh {
        /// Name of the technique.
        technique: String,
    },
}

/// Why buffers are no [`CasterMesh`](crate::CasterMesh).
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// Shaders read storage buffers, and graphics cards indices.
    #[error("the buffer of {what} has usage {found}; needed: {needed}")]
    Usage {
        /// positions or indices.
        what: &'static str,
        /// Its usage.
        found: String,
        /// What it must have at least.
        needed: String,
    },
    /// More than one binding may hold.
    #[error("{what} take {bytes} bytes; a binding holds {max} on this device: see CasterMesh::in_parts")]
    Bytes {
        /// positions or indices.
        what: &'static str,
        /// Bytes of all, or of those of a part.
        bytes: u64,
        /// Largest size.
        max: u64,
    },
    /// A range that is empty or not within the positions.
    #[error("vertices {start}..{end} are none, or not within the {count} that the positions hold")]
    Vertices {
        /// First vertex.
        start: u32,
        /// Behind the last.
        end: u32,
        /// Vertices that there are.
        count: u32,
    },
    /// A range that is not within the indices.
    #[error("triangles {start}..{end} are not within the {count} that the indices hold or that can be drawn")]
    Triangles {
        /// First triangle.
        start: u32,
        /// Behind the last.
        end: u32,
        /// Triangles that there are.
        count: u32,
    },
}
