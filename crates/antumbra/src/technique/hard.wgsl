/// One comparison with the texel that contains uv: 1 where depth ≤ the caster's, else 0
/// [Williams 1978]. `depth` is projected depth.
fn hard_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    return textureSampleCompareLevel(casters, compare, uv, view, depth);
}
