/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// The finest level.
fn lookup_level(size: vec2f, layer: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    return 0.0;
}

/// The texel that contains uv.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let size = vec2i(textureDimensions(map));
    return textureLoad(map, clamp(vec2i(floor(uv * vec2f(size))), vec2i(0), size - 1), layer, 0);
}
