//! Draws a scene with antumbra's shadow maps.
//!
//! | item | what it is |
//! | --- | --- |
//! | [`Gpu`] | device and queue, and what the device refused |
//! | [`GpuScene`] | geometry and materials on the device: draws [`Casters`] for shadow maps, and the [`Surfaces`] that a camera sees |
//! | [`Lighting`] | the visibility of every surface, which a [`Lookup`] asks a shadow map for |
//! | [`Pictures`] | the lit picture that a visibility makes |
//! | [`views`] | views of a scene's light |
//!
//! Nothing here waits for the device or reads back, so that all of it runs in browsers too. Whoever measures adds
//! that (`antumbra-lab`).

mod error;
mod gpu;
mod layout;
mod lighting;
mod scene;
mod shaders;
mod surfaces;
pub mod views;

pub use error::RenderError;
pub use gpu::Gpu;
pub use lighting::{Lighting, Lookup, Pictures};
pub use scene::{Casters, GpuScene, ViewMatrices};
pub use surfaces::Surfaces;
