
/// Whether the product exceeds 1 + ε: then a caster behind the receiver was in the kernel [section
/// 3.3]. Misses some; free of charge.
fn esm_failed(ratio: f32) -> bool {
    return ratio > 1.0 + esm_epsilon();
}

/// One filtered lookup, clamped to [0,1]; custom filtering where it failed.
fn esm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let ratio = esm_ratio(depth, lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x);
    if esm_failed(ratio) {
        return esm_custom(map, uv, view, depth);
    }
    return min(ratio, 1.0);
}

/// 1 where the assumption behind the method is violated.
fn esm_class(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> u32 {
    let ratio = esm_ratio(depth, lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x);
    return select(0u, 1u, esm_failed(ratio));
}
