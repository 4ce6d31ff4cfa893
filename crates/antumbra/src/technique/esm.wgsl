//! needs lookup

/// e^(c z) of linear depth [Annen et al. 2008, Eq. 3].
fn esm_encode(depths: mat3x3f, layer: u32, c: f32) -> vec4f {
    return vec4f(exp(c * depths[1][1]), 0.0, 0.0, 0.0);
}

/// e^(−c d) times the filtered e^(c z), clamped to [0,1] [Annen et al. 2008, Eq. 4].
fn esm_bound(depth: f32, filtered: f32, c: f32) -> f32 {
    return clamp(exp(-c * depth) * filtered, 0.0, 1.0);
}

/// One filtered lookup.
fn esm_visibility(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f, c: f32) -> f32 {
    let filtered = lookup_filtered(map, map_sampler, uv, view, ddx, ddy).x;
    return esm_bound(depth, filtered, c);
}
