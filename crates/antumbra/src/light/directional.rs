//! Parallel light: a box around what both casts and is seen.
//!
//! Across, a view covers the overlap of casters and receivers with a margin for penumbrae; in depth the receivers
//! and, if casters are there, a tenth more towards the light: casters still nearer to it are to be clamped or
//! pancaked onto the near plane. Planes of equal depth may lean so that the range is
//! the least. Texels are square; their world size comes in steps of 2^(1/16) and the map moves in
//! whole texels, so that a moving camera does not make edges crawl.

use super::{
    Fit, View,
    axes::{Axes, from_rows},
    fit::extent,
    slab,
};
use crate::{camera::TINY, error::LightError};
use glam::{DVec3, DVec4, Vec3, Vec4};

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

/// The same in texels, more than biases take off receivers' depth: where the range is that of a flat floor, they
/// would bring it in front of what casts onto it. Steep receivers take 4 texels, and those that follow their plane 1.5
/// more for each texel of a kernel.
fn apart_texels(margin: f64) -> f64 {
    4.0 + 1.5 * margin
}

/// The view of a sun.
///
/// # Errors
/// [`LightError::Direction`].
pub(super) fn view(direction: Vec3, fit: &Fit) -> Result<View, LightError> {
    let axes = Axes::new(direction)?;
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
    let lean = match fit.lean {
        true => slab::lean(fit.receivers.iter().map(|p| axes.of(p.as_dvec3()))).extend(1.0),
        false => DVec3::Z,
    };
    let ends = |points: &mut dyn Iterator<Item = Vec3>| {
        points.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], p| {
            let depth = axes.of(p.as_dvec3()).dot(lean);
            [low.min(depth), high.max(depth)]
        })
    };
    let [caster_low, _] = ends(&mut fit.casters.corners());
    let [low, high] = ends(&mut fit.receivers.iter().copied());
    let range = (high - low).max(span);
    let apart = (APART * range).max(apart_texels(margin) * texel);
    let near = caster_low.max(low - apart).min(low) - 1e-3 * range;
    let far = high + 1e-3 * range;
    let (sx, sy, sz) = (2.0 / (texel * across), 2.0 / (texel * down), 1.0 / (far - near));
    let leaning: DVec3 = lean.x * axes.right + lean.y * axes.up + axes.along;
    let depth = Axes::row(leaning, sz, -near * sz);
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
        linear_from_clip: [Vec4::Z, Vec4::W],
        depth_world: (far - near) as f32,
    })
}
