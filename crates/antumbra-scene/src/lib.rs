//! Scenes for shadow experiments: plain data, no GPU.
//!
//! A [`Scene`] is what a file or a generator describes: meshes that instances place in the world.
//! [`Scene::flatten`] turns it into [`Geometry`], one list of world-space triangles. Raster and
//! rays both start from that list, bit for bit, so that they can be compared.

mod alpha;
mod framing;
mod geometry;
pub mod import;
pub mod procedural;
mod scene;
mod validate;

pub use geometry::{Aabb, Geometry};
pub use scene::{AlphaMode, Camera, Image, Instance, Light, Material, Mesh, Scene};
pub use validate::SceneError;
