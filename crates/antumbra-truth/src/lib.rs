//! Ray-traced shadow visibility: the truth that shadow maps are measured against.
//!
//! Everything starts from the list of world-space triangles that the rasteriser draws, bit for bit
//! ([`antumbra_scene::Geometry`]). A [`Tracer`] holds the tree over them; [`CameraRays`] is the
//! picture to be judged.
//!
//! - [`Tracer::primary`]: what each pixel centre sees.
//! - [`Tracer::hard`]: the truth of one shadow ray per pixel centre.
//! - [`Tracer::supersampled`]: the screen-space ideal, the truth for anti-aliasing.
//!
//! # Where a shadow ray starts
//!
//! The start decides more pixels than the tracer does. A pixel's point is computed in f64 on the
//! plane of its triangle, with an error far below anything that the f32 corners can express, and the
//! shadow ray starts *there*, not beside it: a start pushed along the normal would displace the
//! edge of every shadow by the push times the tangent of the light's angle.
//!
//! What has to be forgiven is not the tracer's rounding but the mesh's: corners that were meant to
//! lie on one plane lie up to an ulp of f32 beside it, so a neighbour of the receiver can stand a
//! few ulps proud and shadow it at grazing light. So a blocker counts only where the ray meets it
//! higher than a *clearance* above the receiver's plane: [`Tracer::CLEARANCE_ULPS`] = 20 ulps of the
//! largest coordinate of the receiving triangle. For coordinates around 10 m that is 0.02 mm. The
//! receiving triangle itself never counts.
//!
//! # Precision
//!
//! Triangles are tested in f64 with edge functions that agree on shared edges to the last bit, so no
//! ray slips between two triangles, and neither side of a triangle is special. The tree's boxes are
//! conservative. Results do not depend on the number of threads.

mod camera;
mod error;
mod shadow;
mod tracer;
mod tree;
mod triangle;

pub use camera::{CameraRays, Ray};
pub use error::TruthError;
pub use shadow::Visibility;
pub use tracer::{Hit, Tracer};
