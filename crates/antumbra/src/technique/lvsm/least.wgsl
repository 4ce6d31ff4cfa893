
/// The least of all intervals' bounds: one filtered lookup for two of them. Intervals beyond the
/// receiver bound nothing and are not read.
fn lvsm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let least = lvsm_least_variance() + lvsm_slope() * chebyshev_slope(plane, tile_size(view));
    let layers = (lvsm_intervals + 1u) / 2u;
    var bound = 1.0;
    for (var layer = 0u; layer < layers; layer += 1u) {
        if lvsm_warp(depth, 2u * layer) == 0.0 {
            break;
        }
        let moments = lookup_filtered(map, map_sampler, uv, view, tile_layer(view) * layers + layer, ddx, ddy);
        bound = min(bound, lvsm_one(depth, moments.xy, 2u * layer, least));
        bound = min(bound, lvsm_one(depth, moments.zw, 2u * layer + 1u, least));
    }
    return chebyshev_reduce(bound, lvsm_reduction());
}
