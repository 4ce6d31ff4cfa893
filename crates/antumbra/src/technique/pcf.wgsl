//! needs taps

/// Weighted share of an n×n grid of texels around uv that the receiver is not behind [Reeves et al.
/// 1987]. Texels uphill, where the receiver's plane is nearer to the light, are compared with that
/// plane, so that a wide kernel does not shadow a tilted receiver by itself.
fn pcf_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    // Floats that sum to one may exceed it by some roundings.
    return min(taps_lit(casters, compare, uv, view, depth, plane), 1.0);
}
