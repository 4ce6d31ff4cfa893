//! needs tile

/// One bilinear lookup at a whole mip level, by the sampler, at least half of that level's texel inside the view:
/// beyond lie texels of others.
fn level_bilinear(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    let size = tile_level_size(view, level);
    let place = clamp(uv * size, vec2f(0.5), size - 0.5);
    return textureSampleLevel(map, map_sampler, tile_place(view, place, level), layer, level);
}

/// One bilinear lookup at a whole mip level, or between two: the sampler would look both up at one place.
fn level_filtered(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    let l = clamp(level, 0.0, tile_coarsest(view, textureNumLevels(map)));
    let fine = level_bilinear(map, map_sampler, uv, view, layer, floor(l));
    if fract(l) == 0.0 {
        return fine;
    }
    return mix(fine, level_bilinear(map, map_sampler, uv, view, layer, ceil(l)), fract(l));
}
