//! needs blur level tile

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// The level at which blur, texels and interpolation together spread as far as the pixel's footprint, by
/// area. A square footprint of side s has the variance s²/12 along each axis; level l, a box and a tent of
/// 2^l texels, has 4^l/4 − 1/12 beside the blur's.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let x = ddx * size;
    let y = ddy * size;
    let area = abs(x.x * y.y - x.y * y.x);
    return 0.5 * log2(max((area + 1.0) / 3.0 - 4.0 * blur_variance(view), 1.0));
}

/// Two mip levels around that one. Along a stretched footprint this filters too little, across it too
/// much: where either alone is right, shadows are lost or flicker.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let level = lookup_level(tile_size(view), view, ddx, ddy);
    return level_filtered(map, map_sampler, uv, view, layer, level);
}
