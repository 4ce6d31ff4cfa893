//! Scenes for shadow experiments: plain data, no GPU.
//!
//! A [`Scene`] is what a file or a generator describes: meshes that instances place in the world.
//! It comes from [`import::load`] (glTF, OBJ) or from [`procedural::by_name`] (the papers' pictures,
//! rebuilt by formula), and [`export::glb`] writes it as a file. [`Scene::flatten`] turns it into
//! [`Geometry`], one list of world-space triangles. Raster and rays both start from that list, bit
//! for bit, so that they can be compared; [`Geometry::is_cut`] decides for both which points of a
//! cut-out surface are there.
//!
//! ```
//! use antumbra_scene::procedural;
//!
//! let contact = procedural::by_name("contact").ok_or("no such scene")?;
//! let scene = contact.scene(procedural::Procedural::DEFAULT_SEED);
//! scene.validate()?;
//! let geometry = scene.flatten();
//! assert_eq!(geometry.triangle_count(), contact.triangles);
//! let (camera, light) = (scene.main_camera(), scene.main_light());
//! # let _ = (camera, light);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod alpha;
mod bulk;
pub mod export;
mod framing;
mod geometry;
pub mod import;
mod leave_out;
mod numbers;
mod placement;
pub mod procedural;
mod scene;
mod validate;

pub use geometry::{Aabb, Geometry};
pub use leave_out::UnknownName;
pub use numbers::Numbered;
pub use placement::{Placement, Up};
pub use scene::{AlphaMode, Camera, Image, Instance, Light, Material, Mesh, Node, Projection, Scene};
pub use validate::SceneError;
