//! needs chebyshev lookup tile

/// Depth intervals, two per texel.
const lvsm_intervals: u32 = 4;

/// Linear depth, moved so that interval `i` (grown by lvsm_overlap of its length at both ends) is
/// [0,1], and clamped.
fn lvsm_warp(depth: f32, i: u32) -> f32 {
    let overlap = lvsm_overlap();
    let across = f32(lvsm_intervals) * depth - f32(i);
    return clamp((across + overlap) / (1.0 + 2.0 * overlap), 0.0, 1.0);
}

/// Warped depth and its square for intervals 2·layer and 2·layer + 1 [Lauritzen & McCool 2008]. With
/// an odd number the last is beyond all depths, so that it stores zeros.
fn lvsm_encode(depth: f32, layer: u32) -> vec4f {
    let a = lvsm_warp(depth, 2u * layer);
    let b = lvsm_warp(depth, 2u * layer + 1u);
    return vec4f(a, a * a, b, b * b);
}

/// Upper bound of the lit share, in [0,1], from the filtered moments of interval `i`;
/// `least_variance` is of linear depth. Beyond the interval it stays what it was at the end (before
/// the overlap), where a lit surface has no casters that are clamped.
fn lvsm_one(depth: f32, moments: vec2f, i: u32, least_variance: f32) -> f32 {
    let slope = f32(lvsm_intervals) / (1.0 + 2.0 * lvsm_overlap());
    let end = f32(i + 1u) / f32(lvsm_intervals);
    return chebyshev_bound(lvsm_warp(min(depth, end), i), moments, slope * slope * least_variance);
}
