//! needs lookup tile

fn filtered_depth_encode(depth: f32, layer: u32) -> vec4f {
    return vec4f(depth, 0.0, 0.0, 0.0);
}

fn filtered_depth_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let filtered = lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy).x;
    return select(0.0, 1.0, depth <= filtered);
}
