//! What a view is fitted to.

use crate::{aabb::Bounds, error::LightError};
use glam::{DVec3, Vec3};

/// Texels of a map.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Size {
    /// Texels across.
    pub width: u32,
    /// Texels down.
    pub height: u32,
}

impl Size {
    /// As many texels down as across.
    #[must_use]
    pub const fn square(side: u32) -> Self {
        Self { width: side, height: side }
    }
}

/// What a view must hold.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Everything that casts shadows.
    pub casters: Bounds,
    /// Points whose convex hull contains every receiver that will be shaded: corners of a box, or
    /// [`visible_hull`](crate::visible_hull) for what a camera sees. Not empty.
    pub receivers: Vec<Vec3>,
    /// Size of the map.
    pub size: Size,
    /// Free texels on each side, at least the technique's reach
    /// ([`ShadowMap::margin_texels`](crate::ShadowMap::margin_texels)).
    pub margin_texels: f32,
    /// Whether planes of equal depth may lean, so that the range of depth under parallel light is the least: what falls
    /// off gradually behind a caster then does so sooner, and few bits have finer steps
    /// ([`ShadowMap::leans`](crate::ShadowMap::leans)).
    pub lean: bool,
}

impl Fit {
    /// # Errors
    /// [`LightError::Bounds`] for boxes and points that are none, [`LightError::Margin`] for margins that leave the
    /// map no texel.
    pub(super) fn check(&self) -> Result<(), LightError> {
        self.casters.check("casters")?;
        // Least and largest would pass over a NaN.
        if let Some(point) = self.receivers.iter().find(|p| !p.is_finite()) {
            return Err(LightError::Bounds { what: "receivers", min: *point, max: *point });
        }
        let (low, high) = extent(self.receivers.iter().map(|p| p.as_dvec3()));
        Bounds { min: low.as_vec3(), max: high.as_vec3() }.check("receivers")?;
        let side = self.size.width.min(self.size.height);
        if !(self.margin_texels >= 0.0 && 2.0 * self.margin_texels + 2.0 <= side as f32) {
            return Err(LightError::Margin { size: side, margin: self.margin_texels });
        }
        Ok(())
    }
}

/// Least and greatest coordinates of points; of none, an empty box.
pub(super) fn extent(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}
