//! needs level

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// The finest level.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    return 0.0;
}

/// Four texels of the finest level.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    return level_filtered(map, map_sampler, uv, view, layer, 0.0);
}
