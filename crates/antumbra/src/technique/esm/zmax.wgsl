
/// Level of the map of farthest depths whose four texels around uv hold all that a lookup reads.
fn esm_level(farthest: texture_2d_array<f32>, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let wanted = ceil(lookup_level(tile_size(view), view, ddx, ddy));
    return min(wanted, tile_coarsest(view, textureNumLevels(farthest)));
}

/// Greatest depth of the four texels around uv of a level.
fn esm_deepest(farthest: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, level: f32) -> f32 {
    let size = tile_level_size(view, level);
    let corner = floor(uv * size - 0.5) + 0.5;
    var deepest = 0.0;
    for (var i = 0u; i < 4u; i += 1u) {
        let texel = clamp(corner + vec2f(f32(i & 1u), f32(i >> 1u)), vec2f(0.5), size - 0.5);
        deepest = max(deepest, textureSampleLevel(farthest, map_sampler, tile_place(view, texel, level), tile_layer(view), level).x);
    }
    return deepest;
}

/// Whether any caster in the kernel lies behind the receiver by more than esm_offset [section 3.3]. No product exceeds
/// that of the farthest: with an offset of ln(1 + ε) / c none above 1 + ε is missed.
fn esm_failed(farthest: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, ddx: vec2f, ddy: vec2f) -> bool {
    let level = esm_level(farthest, view, ddx, ddy);
    return depth + esm_offset() < esm_deepest(farthest, map_sampler, uv, view, level);
}

/// One filtered lookup, clamped to [0,1]; custom filtering where it may have failed.
fn esm_visibility(map: LookupMap, map_sampler: sampler, farthest: texture_2d_array<f32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    if esm_failed(farthest, map_sampler, uv, view, depth, ddx, ddy) {
        return esm_custom(map, uv, view, depth);
    }
    return min(esm_ratio(depth, lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x), 1.0);
}

/// 1 where the assumption behind the method may be violated.
fn esm_class(map: LookupMap, map_sampler: sampler, farthest: texture_2d_array<f32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> u32 {
    return select(0u, 1u, esm_failed(farthest, map_sampler, uv, view, depth, ddx, ddy));
}

/// Linear depth as it is, for the map of farthest depths.
fn esm_depth(depth: f32, layer: u32) -> vec4f {
    return vec4f(depth, 0.0, 0.0, 0.0);
}
