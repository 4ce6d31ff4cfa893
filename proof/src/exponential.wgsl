//! needs lookup tile

fn exponential_encode(depth: f32, layer: u32) -> vec4f {
    return vec4f(exp(exponential_c() * depth), 0.0, 0.0, 0.0);
}

fn exponential_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let filtered = lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x;
    return min(exp(-exponential_c() * depth) * filtered, 1.0);
}
