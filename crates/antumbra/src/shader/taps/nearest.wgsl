//! needs uphill taps_weights tile

/// Weighted share of n×n texels around uv that the receiver is not behind; each is compared with the
/// receiver's plane at its own centre.
fn taps_lit(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let first = (floor(uv / texel - 0.5 * f32(taps_width - 1u)) + 0.5) * texel;
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var row = 0u; row < taps_width; row += 1u) {
        for (var column = 0u; column < taps_width; column += 1u) { // unrolled
            let centre = first + vec2f(f32(column), f32(row)) * texel;
            let reference = uphill_depth(depth, plane, lean, centre - uv);
            let tap = textureSampleCompareLevel(casters, compare, tile_uv(view, centre), tile_layer(view), reference);
            lit += taps_weight(f32(row)) * taps_weight(f32(column)) * tap;
        }
    }
    return lit;
}
