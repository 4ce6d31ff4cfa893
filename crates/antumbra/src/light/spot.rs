//! A cone of light: the pyramid around it, near and far fitted to casters and receivers.

use super::{
    Fit, Light, View,
    axes::{Axes, from_rows},
    fit::extent,
};
use crate::error::LightError;
use glam::{DVec3, DVec4, Vec3, Vec4};

/// The view of a spot.
///
/// # Errors
/// [`LightError::Position`], [`LightError::Angle`], [`LightError::Direction`].
pub(super) fn view(position: Vec3, direction: Vec3, outer_angle: f32, fit: &Fit) -> Result<View, LightError> {
    if !position.is_finite() {
        return Err(LightError::Position { position });
    }
    if !(outer_angle > 0.0 && outer_angle <= Light::MAX_OUTER_ANGLE) {
        return Err(LightError::Angle { radians: outer_angle, max: Light::MAX_OUTER_ANGLE });
    }
    let (position, axes) = (position.as_dvec3(), Axes::new(direction)?);
    let relative = |p: Vec3| axes.of(p.as_dvec3() - position);
    let (_, high) = extent(fit.receivers.iter().map(|p| relative(*p)));
    let (caster_low, _) = extent(fit.casters.corners().map(relative));
    // A spot that no receiver is in front of still gets a valid, empty view.
    let reach = (fit.casters.max - fit.casters.min).length().max(1e-3);
    let far = if high.z > 0.0 { high.z * 1.001 } else { f64::from(reach) };
    // Much nearer casters would cost the far ones their depth precision.
    let near = (caster_low.z * 0.999).max(far / 1000.0).min(far * 0.999);
    let side = f64::from(fit.size.width.min(fit.size.height));
    let tangent = f64::from(outer_angle).tan() * side / (side - 2.0 * f64::from(fit.margin_texels));
    let scale = |texels: u32| side / f64::from(texels) / tangent;
    let from_apex = |axis: DVec3, s: f64| Axes::row(axis, s, -axis.dot(position) * s);
    let w = from_apex(axes.along, 1.0);
    // z/w = far/(far − near) · (1 − near/w)
    let a = far / (far - near);
    let z = DVec4::new(w.x * a, w.y * a, w.z * a, w.w * a - near * a);
    let depth = (w - DVec4::W * near) / (far - near);
    let ratio = (near / far) as f32;
    Ok(View {
        clip_from_world: from_rows(
            from_apex(axes.right, scale(fit.size.width)),
            from_apex(axes.up, scale(fit.size.height)),
            z,
            w,
        ),
        depth_plane: depth.as_vec4(),
        to_light: position.as_vec3().extend(1.0),
        texel_world: (2.0 * tangent / side) as f32,
        linear_from_clip: [Vec4::new(0.0, 0.0, ratio, 0.0), Vec4::new(0.0, 0.0, ratio - 1.0, 1.0)],
        depth_world: (far - near) as f32,
    })
}
