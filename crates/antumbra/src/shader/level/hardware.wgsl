/// One bilinear lookup at a whole mip level, or between two, by the sampler.
fn level_filtered(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, level: f32) -> vec4f {
    return textureSampleLevel(map, map_sampler, uv, layer, level);
}
