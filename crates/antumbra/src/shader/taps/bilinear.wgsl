//! needs uphill taps_weights tile

/// n×n bilinear lookups one texel apart, weighted. Each compares its 2×2 texels with one depth, that
/// of the receiver's plane over the highest of them.
fn taps_lit(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let first = uv / texel - 0.5 * f32(taps_width - 1u);
    // Where the four texels of the first tap meet.
    let corner = (floor(first - 0.5) + 1.0) * texel;
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var row = 0u; row < taps_width; row += 1u) {
        for (var column = 0u; column < taps_width; column += 1u) { // unrolled
            let step = vec2f(f32(column), f32(row)) * texel;
            let reference = uphill_four(depth, plane, lean, corner - uv + step, texel);
            let tap = textureSampleCompareLevel(casters, compare, tile_uv(view, first * texel + step), tile_layer(view), reference);
            lit += taps_weight(f32(row)) * taps_weight(f32(column)) * tap;
        }
    }
    return lit;
}
