//! needs tile

/// The four texels around uv at mip level `level`, with bilinear weights: for formats that the
/// device cannot filter. Texels come through the (nearest) sampler: some drivers give all lanes of
/// a textureLoad the level of the first.
fn level_bilinear(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    let size = tile_level_size(view, level);
    let p = uv * size - 0.5;
    let corner = floor(p);
    let weight = p - corner;
    let low = tile_place(view, clamp(corner, vec2f(0.0), size - 1.0) + 0.5, level);
    let high = tile_place(view, clamp(corner + 1.0, vec2f(0.0), size - 1.0) + 0.5, level);
    let top = mix(
        textureSampleLevel(map, map_sampler, low, layer, level),
        textureSampleLevel(map, map_sampler, vec2f(high.x, low.y), layer, level),
        weight.x,
    );
    let bottom = mix(
        textureSampleLevel(map, map_sampler, vec2f(low.x, high.y), layer, level),
        textureSampleLevel(map, map_sampler, high, layer, level),
        weight.x,
    );
    return mix(top, bottom, weight.y);
}

/// One bilinear lookup at a whole mip level, or between two, in the shader.
fn level_filtered(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    let l = clamp(level, 0.0, tile_coarsest(view, textureNumLevels(map)));
    let fine = level_bilinear(map, map_sampler, uv, view, layer, floor(l));
    let coarse = level_bilinear(map, map_sampler, uv, view, layer, ceil(l));
    return mix(fine, coarse, fract(l));
}
