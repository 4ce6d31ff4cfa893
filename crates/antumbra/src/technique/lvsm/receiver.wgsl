
/// The bound of the interval that contains the receiver: one lookup.
fn lvsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let least = lvsm_least_variance() + lvsm_slope() * chebyshev_slope(plane, tile_size(view));
    let i = min(u32(depth * f32(lvsm_intervals)), lvsm_intervals - 1u);
    return chebyshev_reduce(lvsm_pick(map, map_sampler, uv, view, depth, i, ddx, ddy, least), lvsm_reduction());
}
