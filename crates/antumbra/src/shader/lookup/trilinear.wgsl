//! needs level tile

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// The level at which a texel covers the longer side of the pixel's footprint. It is computed here and
/// not by the sampler: the same on every driver, legal in any control flow.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let x = ddx * size;
    let y = ddy * size;
    return 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0));
}

/// Two mip levels around that one.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let level = lookup_level(tile_size(view), view, ddx, ddy);
    return level_filtered(map, map_sampler, uv, view, layer, level);
}
