//! A light's own space.

use crate::error::LightError;
use glam::{DMat4, DVec3, DVec4, Mat4, Vec3};

/// The axes of a light's own space: right, up, and along the direction that it shines in.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    pub(super) right: DVec3,
    pub(super) up: DVec3,
    pub(super) along: DVec3,
}

impl Axes {
    /// The axes depend on the direction alone, so that views do not turn when the camera moves.
    pub(super) fn new(direction: Vec3) -> Result<Self, LightError> {
        let along = direction.as_dvec3().try_normalize().ok_or(LightError::Direction { direction })?;
        let helper = if along.y.abs() > 0.99 { DVec3::Z } else { DVec3::Y };
        let right = along.cross(helper).normalize();
        Ok(Self { right, up: right.cross(along), along })
    }

    /// A point's coordinates in this space.
    pub(super) fn of(&self, p: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(p), self.up.dot(p), self.along.dot(p))
    }

    /// The row `scale · axis · p + offset` as coefficients of (p, 1).
    pub(super) fn row(axis: DVec3, scale: f64, offset: f64) -> DVec4 {
        (axis * scale).extend(offset)
    }
}

/// The matrix with these rows.
pub(super) fn from_rows(x: DVec4, y: DVec4, z: DVec4, w: DVec4) -> Mat4 {
    DMat4::from_cols(x, y, z, w).transpose().as_mat4()
}
