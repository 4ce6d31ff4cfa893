//! Lights: pure functions to [`View`]s, one file for each kind.

use crate::error::LightError;
use glam::Vec3;

mod axes;
mod cascade;
mod directional;
mod fit;
mod slab;
mod spot;
mod view;

pub use crate::aabb::Bounds;
pub use cascade::{CameraFit, Cascades};
pub use fit::{Fit, Size};
pub use view::View;

/// A light that casts shadows, in world space. Directions point the way the light travels.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Light {
    /// Parallel rays, like the sun's.
    Directional {
        /// Any length but zero.
        direction: Vec3,
    },
    /// A cone. Six with an outer angle of 45° along ±x, ±y and ±z make a point light: six views of one map.
    Spot {
        /// Apex.
        position: Vec3,
        /// Axis, any length but zero.
        direction: Vec3,
        /// Half angle of the cone in radians, more than 0, at most [`Light::MAX_OUTER_ANGLE`].
        outer_angle: f32,
    },
}

impl Light {
    /// Widest half angle of a spot, radians (84.8°): near 90° one picture holds no cone any more, since
    /// its sides lie at tan 90°.
    pub const MAX_OUTER_ANGLE: f32 = 1.48;

    /// The light's only view, tightly around what both casts and is seen. A spot's view is its cone.
    ///
    /// # Errors
    /// [`LightError`] for unusable directions, angles, bounds or margins.
    pub fn view(&self, fit: &Fit) -> Result<View, LightError> {
        fit.check()?;
        match *self {
            Self::Directional { direction } => directional::view(direction, fit),
            Self::Spot { position, direction, outer_angle } => {
                spot::view(position, direction, outer_angle, fit)
            }
        }
    }

    /// One view per cascade that sees any receiver, nearest first, each fitted to the part of the
    /// scene that the camera sees in its range. Spots ignore the cascades and have one view.
    ///
    /// Ranges run along the camera's line of sight. Those of an orthographic camera are even, whatever the
    /// blend: its pixels are equally large at any distance. (Which of its ends is the nearer is told by a
    /// world that is right-handed.)
    ///
    /// # Errors
    /// [`LightError`], among them [`LightError::NothingVisible`] if the camera sees nothing and
    /// [`LightError::Camera`] if its matrix is not finite or has no inverse.
    pub fn views(&self, fit: &CameraFit, cascades: Cascades) -> Result<Vec<View>, LightError> {
        cascades.check()?;
        let count = match self {
            Self::Directional { .. } => cascades.count,
            Self::Spot { .. } => 1,
        };
        fit.divided(Cascades { count, ..cascades })?.iter().map(|fit| self.view(fit)).collect()
    }
}

#[cfg(test)]
mod tests;
