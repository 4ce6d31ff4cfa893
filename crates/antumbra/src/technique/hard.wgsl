//! needs uphill tile

/// One comparison with the texel that contains uv: 1 where depth ≤ the caster's, else 0
/// [Williams 1978]. `depth` is projected depth; the receiver's plane is compared at the texel's centre.
fn hard_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    let centre = (floor(uv * size) + 0.5) / size;
    let reference = uphill_depth(depth, plane, uphill_lean(view), centre - uv);
    return textureSampleCompareLevel(casters, compare, tile_uv(view, centre), tile_layer(view), reference);
}
