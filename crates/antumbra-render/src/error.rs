//! What can go wrong while a scene is drawn.

use antumbra::{LightError, MeshError, Unsupported};

/// Why a scene cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RenderError {
    /// No driver was found.
    #[error(
        "no graphics adapter found (Vulkan, Metal or DX12). A software one will do: on Debian or Ubuntu run \
         `apt-get install mesa-vulkan-drivers`"
    )]
    NoAdapter(#[source] wgpu::RequestAdapterError),
    /// The adapter writes too little in one pass.
    #[error("{adapter} writes at most {max} bytes per pixel in one pass; the renderer needs {needed}")]
    Targets {
        /// Name of the adapter.
        adapter: String,
        /// Bytes that it allows.
        max: u32,
        /// Bytes that the renderer's targets need.
        needed: u32,
    },
    /// The adapter has no device.
    #[error("{adapter} gave no device")]
    NoDevice {
        /// Name of the adapter.
        adapter: String,
        /// What it said.
        source: wgpu::RequestDeviceError,
    },
    /// The device has no memory left.
    #[error("{adapter} is out of memory: try a smaller map or a lower resolution")]
    OutOfMemory {
        /// Name of the adapter.
        adapter: String,
    },
    /// The device refused something.
    #[error("{adapter} refused: {reason}")]
    Refused {
        /// Name of the adapter.
        adapter: String,
        /// What it said.
        reason: String,
    },
    /// A picture without pixels or with too many.
    #[error("resolution {width}x{height} is not possible; each side must be 1 to {max}")]
    Resolution {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels that the device allows along a side.
        max: u32,
    },
    /// Nothing to draw.
    #[error("the scene has no triangles")]
    NoTriangles,
    /// More geometry than a buffer may hold.
    #[error("{count} {what} need a buffer of {bytes} bytes; {adapter} allows {max}")]
    Buffer {
        /// What the buffer is to hold.
        what: &'static str,
        /// Number of things in it.
        count: usize,
        /// Its size.
        bytes: u64,
        /// Name of the adapter.
        adapter: String,
        /// Bytes that the adapter allows.
        max: u64,
    },
    /// An image that no texture can hold.
    #[error("image '{name}' of {width}x{height} pixels is larger than the device's {max}")]
    Image {
        /// Name of the image.
        name: String,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Pixels that the device allows along a side.
        max: u32,
    },
    /// A light cannot be seen from.
    #[error("the light has no view")]
    Light(#[from] LightError),
    /// No shadow map to fit views for.
    #[error("the light's views are fitted for shadow maps, and none is given")]
    NoMap,
    /// Casters cannot be drawn as triangles.
    #[error(transparent)]
    Mesh(#[from] MeshError),
    /// Cut-outs cannot be drawn as triangles.
    #[error(transparent)]
    Unsupported(#[from] Unsupported),
}
