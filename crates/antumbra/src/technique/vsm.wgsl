//! needs chebyshev lookup tile

/// 1 if the receiver's own slope widens the least variance, 0 if the casters' is in the square.
const vsm_slope_of_receiver: u32 = 1;

/// Depth and its square of a neighbourhood; the square gains a quarter of the squared slope, the
/// variance of a plane within one texel, times vsm_slope.
fn vsm_encode_sloped(depths: mat3x3f, layer: u32) -> vec4f {
    let z = depths[1][1];
    // The smaller of the two one-sided differences: a silhouette is not a slope.
    let x = min(abs(depths[2][1] - z), abs(z - depths[0][1]));
    let y = min(abs(depths[1][2] - z), abs(z - depths[1][0]));
    return vec4f(z, z * z + vsm_slope() * 0.25 * (x * x + y * y), 0.0, 0.0);
}

/// Depth and its square.
fn vsm_encode(depth: f32, layer: u32) -> vec4f {
    return vec4f(depth, depth * depth, 0.0, 0.0);
}

/// Upper bound of the lit share, in [0,1], of filtered moments at a linear depth. `least_variance`
/// bounds the variance below; so does vsm_rounding (what storage leaves of squares) times the square.
fn vsm_bound(depth: f32, moments: vec2f, least_variance: f32) -> f32 {
    let least = max(least_variance, vsm_rounding() * moments.y);
    return chebyshev_reduce(chebyshev_bound(depth, moments, least), vsm_reduction());
}

/// One filtered lookup [Donnelly & Lauritzen 2006].
fn vsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let moments = lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).xy;
    var least = vsm_least_variance();
    if vsm_slope_of_receiver == 1u {
        least += vsm_slope() * chebyshev_slope(plane, tile_size(view));
    }
    return vsm_bound(depth, moments, least);
}
