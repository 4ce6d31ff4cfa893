//! needs tile

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// The finest level.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    return 0.0;
}

/// The texel that contains uv.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    return textureLoad(map, tile_texel(view, vec2i(floor(uv * tile_size(view)))), layer, 0);
}
