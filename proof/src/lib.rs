//! Techniques from outside of the library, written against its public interface alone: [`Exponential`] of the
//! basis family, and [`Plane`], which looks up what a store of its own, [`First`], keeps of casters.
//!
//! `tests/laws.rs` proves them.

mod exponential;
mod first;
mod plane;

pub use exponential::Exponential;
pub use first::First;
pub use plane::Plane;
