
/// One filtered lookup [Donnelly & Lauritzen 2006]; the receiver's own slope widens the least variance.
fn vsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f, least_variance: f32, rounding: f32, reduction: f32, slope: f32) -> f32 {
    let moments = lookup_filtered(map, map_sampler, uv, view, ddx, ddy).xy;
    let least = least_variance + slope * chebyshev_slope(plane, vec2f(textureDimensions(map)));
    return vsm_bound(depth, moments, least, rounding, reduction);
}
