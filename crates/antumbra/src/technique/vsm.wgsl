//! needs chebyshev lookup

/// Depth and its square; the square gains a quarter of the squared slope, the variance of a plane
/// within one texel, times `slope`. Squares are of linear depth.
fn vsm_encode(depths: mat3x3f, layer: u32, least_variance: f32, reduction: f32, slope: f32) -> vec4f {
    let z = depths[1][1];
    // The smaller of the two one-sided differences: a silhouette is not a slope.
    let x = min(abs(depths[2][1] - z), abs(z - depths[0][1]));
    let y = min(abs(depths[1][2] - z), abs(z - depths[1][0]));
    return vec4f(z, z * z + slope * 0.25 * (x * x + y * y), 0.0, 0.0);
}

/// Upper bound of the lit share, in [0,1], of filtered moments at a linear depth.
fn vsm_bound(depth: f32, moments: vec2f, least_variance: f32, reduction: f32) -> f32 {
    return chebyshev_reduce(chebyshev_bound(depth, moments, least_variance), reduction);
}

/// One filtered lookup [Donnelly & Lauritzen 2006].
fn vsm_visibility(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f, least_variance: f32, reduction: f32, slope: f32) -> f32 {
    let moments = lookup_filtered(map, map_sampler, uv, view, ddx, ddy).xy;
    return vsm_bound(depth, moments, least_variance, reduction);
}
