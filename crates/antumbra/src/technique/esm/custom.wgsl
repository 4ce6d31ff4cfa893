
/// The four texels around uv, each clamped before they are interpolated: a small PCF filter on the
/// map as it is [section 3.3].
fn esm_custom(map: LookupMap, uv: vec2f, view: u32, depth: f32) -> f32 {
    let size = tile_size(view);
    let p = uv * size - 0.5;
    let corner = floor(p);
    let weight = p - corner;
    var lit = 0.0;
    for (var i = 0u; i < 4u; i += 1u) {
        let far = vec2f(f32(i & 1u), f32(i >> 1u));
        let texel = tile_texel(view, vec2i(corner + far));
        let share = mix(1.0 - weight, weight, far);
        lit += share.x * share.y * min(esm_ratio(depth, textureLoad(map, texel, tile_layer(view), 0).x), 1.0);
    }
    // Floats that sum to one may exceed it by some roundings.
    return min(lit, 1.0);
}
