//! needs tile

/// Texels t are filtered as e^(steepness · t).
const level_steepness: f32 = 80.0;

/// log of the weighted sum of two powers, each given by its logarithm.
fn level_mix(a: f32, b: f32, weight: f32) -> f32 {
    let top = max(a, b);
    let sum = (1.0 - weight) * exp(level_steepness * (a - top)) + weight * exp(level_steepness * (b - top));
    return top + log(sum) / level_steepness;
}

/// The four texels around uv at mip level `level`, with bilinear weights of their powers. They come
/// through the sampler, at their centres: see `level_manual`.
fn level_bilinear(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> f32 {
    let size = tile_level_size(view, level);
    let p = uv * size - 0.5;
    let corner = floor(p);
    let weight = p - corner;
    let low = tile_place(view, clamp(corner, vec2f(0.0), size - 1.0) + 0.5, level);
    let high = tile_place(view, clamp(corner + 1.0, vec2f(0.0), size - 1.0) + 0.5, level);
    let top = level_mix(
        textureSampleLevel(map, map_sampler, low, layer, level).x,
        textureSampleLevel(map, map_sampler, vec2f(high.x, low.y), layer, level).x,
        weight.x,
    );
    let bottom = level_mix(
        textureSampleLevel(map, map_sampler, vec2f(low.x, high.y), layer, level).x,
        textureSampleLevel(map, map_sampler, high, layer, level).x,
        weight.x,
    );
    return level_mix(top, bottom, weight.y);
}

/// One bilinear lookup at a whole mip level, or between two: the logarithm of what would be
/// interpolated if the map held powers. Never overflows, whatever the steepness.
fn level_filtered(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    let l = clamp(level, 0.0, tile_coarsest(view, textureNumLevels(map)));
    let fine = level_bilinear(map, map_sampler, uv, view, layer, floor(l));
    let coarse = level_bilinear(map, map_sampler, uv, view, layer, ceil(l));
    return vec4f(level_mix(fine, coarse, fract(l)), 0.0, 0.0, 0.0);
}
