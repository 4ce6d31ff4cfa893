//! needs level

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// Two mip levels, chosen so that a texel covers the longer side of the pixel's footprint. The
/// level is computed here and not by the sampler: the same on every driver, legal in any control
/// flow.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let size = vec2f(textureDimensions(map));
    let x = ddx * size;
    let y = ddy * size;
    let longest_squared = max(max(dot(x, x), dot(y, y)), 1.0);
    return level_filtered(map, map_sampler, uv, layer, 0.5 * log2(longest_squared));
}
