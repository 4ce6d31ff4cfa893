
/// The bound of the interval that contains the receiver; at its start, over the width of the overlap,
/// mixed with that of the interval before: at most two lookups.
fn lvsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let least = lvsm_least_variance() + lvsm_slope() * chebyshev_slope(plane, tile_size(view));
    let across = depth * f32(lvsm_intervals);
    let i = min(u32(across), lvsm_intervals - 1u);
    var bound = lvsm_pick(map, map_sampler, uv, view, depth, i, ddx, ddy, least);
    let share = (across - f32(i)) / max(lvsm_overlap(), 1e-6);
    if i > 0u && share < 1.0 {
        let before = lvsm_pick(map, map_sampler, uv, view, depth, i - 1u, ddx, ddy, least);
        bound = mix(before, bound, share);
    }
    return chebyshev_reduce(bound, lvsm_reduction());
}
