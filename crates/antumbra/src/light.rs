//! Where a light looks from: pure functions from lights and bounds to [`View`]s.

use crate::{camera::TINY, error::LightError};
use glam::{DMat4, DVec3, DVec4, Mat4, Vec2, Vec3, Vec4};

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

/// A light that casts shadows, in world space. Directions point the way the light travels.
#[derive(Debug, Clone, Copy, PartialEq)]
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
}

/// One map's worth of a light: matrices and units, all that shaders need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct View {
    /// World to clip space: x, y in `[−1,1]` (y up), z in `[0,1]` from near to far.
    pub clip_from_world: Mat4,
    /// Linear depth in `[0,1]` of a world point p is `dot(depth_plane, (p, 1))`.
    pub depth_plane: Vec4,
    /// Unit vector towards a directional light with w = 0, or position of a spot with w = 1.
    pub to_light: Vec4,
    /// World size of a texel: everywhere (directional), or at unit distance along the axis (spot).
    pub texel_world: f32,
    /// Near over far distance of a spot, 1 for parallel light: linearises projected depth.
    pub near_over_far: f32,
    /// World length of the depth range `[0,1]`.
    pub depth_world: f32,
}

impl View {
    /// The same view with the image plane shifted, so that texel centres lie `offset` texels further on,
    /// y down.
    #[must_use]
    pub fn jittered(&self, size: Size, offset: Vec2) -> Self {
        let shift = Vec3::new(-2.0 * offset.x / size.width as f32, 2.0 * offset.y / size.height as f32, 0.0);
        Self { clip_from_world: Mat4::from_translation(shift) * self.clip_from_world, ..*self }
    }
}

/// Rows of a light's own space: right, down... as used here right, up and the way it looks.
#[derive(Debug, Clone, Copy)]
struct Axes {
    right: DVec3,
    up: DVec3,
    along: DVec3,
}

impl Axes {
    /// Depends on the direction alone, so that views do not turn when the camera moves.
    fn new(direction: Vec3) -> Result<Self, LightError> {
        let along = direction.as_dvec3().try_normalize().ok_or(LightError::Direction { direction })?;
        let helper = if along.y.abs() > 0.99 { DVec3::Z } else { DVec3::Y };
        let right = along.cross(helper).normalize();
        Ok(Self { right, up: right.cross(along), along })
    }

    fn of(&self, p: DVec3) -> DVec3 {
        DVec3::new(self.right.dot(p), self.up.dot(p), self.along.dot(p))
    }

    /// Row `scale · axis · p + offset` as coefficients of (p, 1).
    fn row(axis: DVec3, scale: f64, offset: f64) -> DVec4 {
        (axis * scale).extend(offset)
    }
}

fn from_rows(x: DVec4, y: DVec4, z: DVec4, w: DVec4) -> Mat4 {
    DMat4::from_cols(x, y, z, w).transpose().as_mat4()
}

fn extent(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)))
}

impl Light {
    /// Widest half angle of a spot, radians (84.8°): near 90° one picture holds no cone any more, since
    /// its sides lie at tan 90°.
    pub const MAX_OUTER_ANGLE: f32 = 1.48;

    /// The light's only view: tightly around what both casts and is seen.
    ///
    /// A directional light covers, across, the overlap of casters and receivers with a margin for
    /// penumbrae, and in depth the receivers and, if casters are there, a tenth more towards the
    /// light: casters still nearer to it are to be clamped or pancaked onto the near plane. Texels
    /// are square; their world size comes in steps of 2^(1/16) and the map moves in whole texels, so
    /// that a moving camera does not make edges crawl. A spot's view is its cone; near and far are
    /// fitted to casters and receivers.
    ///
    /// # Errors
    /// [`LightError`] for unusable directions, angles, bounds or margins.
    pub fn view(&self, fit: &Fit) -> Result<View, LightError> {
        fit.casters.check("casters")?;
        // Least and largest would pass over a NaN.
        if let Some(point) = fit.receivers.iter().find(|p| !p.is_finite()) {
            return Err(LightError::Bounds { what: "receivers", min: *point, max: *point });
        }
        let (low, high) = extent(fit.receivers.iter().map(|p| p.as_dvec3()));
        Bounds { min: low.as_vec3(), max: high.as_vec3() }.check("receivers")?;
        let side = fit.size.width.min(fit.size.height);
        if !(fit.margin_texels >= 0.0 && 2.0 * fit.margin_texels + 2.0 <= side as f32) {
            return Err(LightError::Margin { size: side, margin: fit.margin_texels });
        }
        match *self {
            Self::Directional { direction } => directional(Axes::new(direction)?, fit),
            Self::Spot { position, direction, outer_angle } => {
                if !position.is_finite() {
                    return Err(LightError::Position { position });
                }
                if !(outer_angle > 0.0 && outer_angle <= Self::MAX_OUTER_ANGLE) {
                    return Err(LightError::Angle { radians: outer_angle });
                }
                spot(position.as_dvec3(), Axes::new(direction)?, outer_angle, fit)
            }
        }
    }
}

/// The next world size of a texel, in steps of 2^(1/16), that is not smaller.
fn stepped(texel: f64) -> f64 {
    ((texel.log2() * 16.0).ceil() / 16.0).exp2()
}

/// The part of the receivers' range that casters can shade, all of it if there is none, and 1 for
/// each end at which the casters stop before the receivers do.
fn overlap(receivers: [f64; 2], casters: [f64; 2]) -> ([f64; 2], [f64; 2]) {
    let both = [receivers[0].max(casters[0]), receivers[1].min(casters[1])];
    if both[0] > both[1] {
        return (receivers, [0.0; 2]);
    }
    let cut = |end: usize| if both[end] == receivers[end] { 0.0 } else { 1.0 };
    (both, [cut(0), cut(1)])
}

/// How far in front of the nearest receiver casters are kept apart, in depth ranges of the receivers.
const APART: f64 = 0.1;

fn directional(axes: Axes, fit: &Fit) -> Result<View, LightError> {
    let (caster_low, caster_high) = extent(fit.casters.corners().map(|p| axes.of(p.as_dvec3())));
    let (low, high) = extent(fit.receivers.iter().map(|p| axes.of(p.as_dvec3())));
    // Across: where both are. Where nothing casts, everything is lit without a map.
    let (x, cut_x) = overlap([low.x, high.x], [caster_low.x, caster_high.x]);
    let (y, cut_y) = overlap([low.y, high.y], [caster_low.y, caster_high.y]);
    let span = f64::from(f32::EPSILON) * 64.0 * low.abs().max(high.abs()).max_element().max(TINY);
    // One texel of slack for snapping; where the casters end, receivers up to a kernel further on
    // are still in their penumbra.
    let margin = f64::from(fit.margin_texels);
    let usable = |texels: f64, cut: [f64; 2]| (texels - 1.0 - margin * (2.0 + cut[0] + cut[1])).max(1.0);
    let (across, down) = (f64::from(fit.size.width), f64::from(fit.size.height));
    let texel = stepped(
        ((x[1] - x[0]).max(span) / usable(across, cut_x)).max((y[1] - y[0]).max(span) / usable(down, cut_y)),
    );
    let snap = |ends: [f64; 2], cut: [f64; 2], texels: f64| {
        let centre = 0.5 * ((ends[0] + ends[1]) / texel + margin * (cut[1] - cut[0]));
        ((centre - texels / 2.0).round() + texels / 2.0) * texel
    };
    let (cx, cy) = (snap(x, cut_x, across), snap(y, cut_y, down));
    // In depth: the receivers, with a little room for rounding. Casters farther out lose their depth
    // on the near plane; kept at a distance there, they stay well apart from the nearest receivers
    // for techniques that fall off gradually behind a caster.
    let range = (high.z - low.z).max(span);
    let near = caster_low.z.max(low.z - APART * range).min(low.z) - 1e-3 * range;
    let far = high.z + 1e-3 * range;
    let (sx, sy, sz) = (2.0 / (texel * across), 2.0 / (texel * down), 1.0 / (far - near));
    let depth = Axes::row(axes.along, sz, -near * sz);
    Ok(View {
        clip_from_world: from_rows(
            Axes::row(axes.right, sx, -cx * sx),
            Axes::row(axes.up, sy, -cy * sy),
            depth,
            DVec4::W,
        ),
        depth_plane: depth.as_vec4(),
        to_light: (-axes.along).as_vec3().extend(0.0),
        texel_world: texel as f32,
        near_over_far: 1.0,
        depth_world: (far - near) as f32,
    })
}

fn spot(position: DVec3, axes: Axes, outer_angle: f32, fit: &Fit) -> Result<View, LightError> {
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
        near_over_far: (near / far) as f32,
        depth_world: (far - near) as f32,
    })
}

#[cfg(test)]
mod tests;
