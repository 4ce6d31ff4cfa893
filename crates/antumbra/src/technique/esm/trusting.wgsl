
/// One filtered lookup, clamped to [0,1].
fn esm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f, c: f32, epsilon: f32, offset: f32, half_kernel: f32) -> f32 {
    return min(esm_ratio(depth, lookup_filtered(map, map_sampler, uv, view, ddx, ddy).x, c), 1.0);
}
