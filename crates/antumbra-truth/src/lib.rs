//! Ray-traced shadow visibility: the truth that shadow maps are measured against.
//!
//! Everything starts from the list of world-space triangles that the rasteriser draws, bit for bit
//! ([`antumbra_scene::Geometry`]). A [`Tracer`] holds the tree over them; [`CameraRays`] is the
//! picture to be judged.
//!
//! - [`Tracer::primary`]: what each pixel centre sees.
//! - [`Tracer::hard`]: the truth of one shadow ray per pixel centre.
//! - [`Tracer::supersampled`]: the screen-space ideal, the truth for anti-aliasing.
//! - [`Tracer::light_space_ideal`]: the filtered truth, for maps that are blurred.
//! - [`Tracer::hard_at`], [`Tracer::supersampled_at`], [`Tracer::light_space_ideal_at`]: the same for
//!   chosen points or pixels, for moving pictures.
//! - [`Tracer::coverage`]: whether the rasteriser sees the same triangles, and if not, why.
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
//! # The light-space ideal
//!
//! s_f(x) = Σ_q w(q) f(d, z(p − q)) (Annen et al. 2007, Eq. 4) with z from rays: the share of the
//! kernel's offsets q whose light path reaches the receiver. The receiver's depth is d(x), or that of
//! its *tangent plane* at p − q where that is nearer to the light: with d(x) alone half of every
//! tilted lit plane would be in its own shadow. For the same reason the receiver's own surface does
//! not count where it rises above that plane by less than the sample's distance from x.
//!
//! Beyond a depth change of 64 per lateral unit (light at less than 0.9° to the plane), or where the
//! plane of a spot's receiver would leave the range from ⅔ to 2 times the receiver's depth, the
//! kernel is compressed along the slope to that limit, so that all its points stay finite.
//!
//! # Precision
//!
//! Triangles are tested in f64 with edge functions that agree on shared edges to the last bit, so no
//! ray slips between two triangles, and neither side of a triangle is special. The tree's boxes are
//! conservative. Results do not depend on the number of threads.
//!
//! # Cost
//!
//! For 364,000 triangles and 1024 × 768 pixels on two cores: 0.3 s for the tree, 0.3 s for the hard
//! truth, 4 s for 4 × 4 samples per pixel, 20 s for the light-space ideal of 5 to 9 taps. The example
//! `time_truth` measures it.

mod body;
mod camera;
mod coverage;
mod error;
mod ideal;
mod kernel;
mod shadow;
mod tracer;
mod tree;
mod triangle;

pub use camera::{CameraRays, Ray};
pub use coverage::{Coverage, CoverageTolerance, Difference};
pub use error::TruthError;
pub use kernel::{Kernel, MapTexels, TexelAxes};
pub use shadow::Visibility;
pub use tracer::{Hit, SharedTree, Tracer};
