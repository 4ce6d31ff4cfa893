
/// Bound of interval `i` alone, from one lookup.
fn lvsm_pick(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, i: u32, ddx: vec2f, ddy: vec2f, least_variance: f32) -> f32 {
    let layers = (lvsm_intervals + 1u) / 2u;
    let moments = lookup_filtered(map, map_sampler, uv, view, tile_layer(view) * layers + i / 2u, ddx, ddy);
    return lvsm_one(depth, select(moments.xy, moments.zw, i % 2u == 1u), i, least_variance);
}
