//! needs chebyshev lookup tile

/// Warps that are kept: 2, or the positive one alone.
const evsm_warps: u32 = 2;

/// e^(c₊ z') and −e^(−c₋ z') with z' = 2 · linear depth − 1: both rise with depth.
fn evsm_warp(depth: f32) -> vec2f {
    let z = 2.0 * depth - 1.0;
    return vec2f(exp(evsm_positive() * z), -exp(-evsm_negative() * z));
}

/// Both warps of linear depth, each with its square [Lauritzen & McCool 2008].
fn evsm_encode(depth: f32, layer: u32) -> vec4f {
    let w = evsm_warp(depth);
    return vec4f(w.x, w.x * w.x, w.y, w.y * w.y);
}

/// Upper bound of the lit share from one warp's filtered moments, at a warped depth.
/// `least_variance`, of linear depth, becomes one of warped depth by the square of the warp's slope
/// 2 · c · |w|, taken where the warp is flatter: at the mean or at the receiver. evsm_rounding and
/// evsm_denormal are what storage leaves of it, relatively and absolutely.
fn evsm_one(warped: f32, moments: vec2f, c: f32, least_variance: f32) -> f32 {
    let w = min(abs(warped), abs(moments.x));
    let least = w * w * max(4.0 * c * c * least_variance, evsm_rounding()) + evsm_denormal();
    return chebyshev_bound(warped, moments, least);
}

/// Upper bound of the lit share, in [0,1], of filtered moments at a linear depth: the lesser of the
/// bounds of both warps.
fn evsm_bound(depth: f32, moments: vec4f, least_variance: f32) -> f32 {
    let w = evsm_warp(depth);
    var bound = evsm_one(w.x, moments.xy, evsm_positive(), least_variance);
    if evsm_warps == 2u {
        bound = min(bound, evsm_one(w.y, moments.zw, evsm_negative(), least_variance));
    }
    return chebyshev_reduce(bound, evsm_reduction());
}

/// One filtered lookup; the receiver's own slope widens the least variance by the chain rule.
fn evsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let least = evsm_least_variance() + evsm_slope() * chebyshev_slope(plane, tile_size(view));
    let moments = lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy);
    return evsm_bound(depth, moments, least);
}
