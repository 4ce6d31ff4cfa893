//! Boxes along the axes of the world.

use crate::error::LightError;
use glam::Vec3;

/// An axis-aligned box in world space.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Smallest corner.
    pub min: Vec3,
    /// Largest corner.
    pub max: Vec3,
}

impl Bounds {
    /// The eight corners.
    pub fn corners(&self) -> impl Iterator<Item = Vec3> {
        let ends = [self.min, self.max];
        (0..8).map(move |i| Vec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2 & 1].z))
    }

    pub(crate) fn check(&self, what: &'static str) -> Result<(), LightError> {
        let good = self.min.is_finite() && self.max.is_finite() && self.min.cmple(self.max).all();
        if good { Ok(()) } else { Err(LightError::Bounds { what, min: self.min, max: self.max }) }
    }
}
