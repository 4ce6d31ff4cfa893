//! needs uphill taps_weights tile

/// The sum of n×n bilinear taps from ⌈(n+1)/2⌉² gathers of four comparisons each, weighted here: the
/// weights are floats, where samplers of GPUs round them to 8 bits.
fn taps_lit(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let first = uv / texel - 0.5 * f32(taps_width);
    let low = floor(first);
    let fraction = first - low;
    // Where the first four texels meet.
    let corner = (low + 1.0) * texel;
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var j = 0u; j < taps_pairs; j += 1u) {
        let y = taps_pair(2.0 * f32(j), fraction.y);
        for (var i = 0u; i < taps_pairs; i += 1u) { // unrolled
            let x = taps_pair(2.0 * f32(i), fraction.x);
            let step = 2.0 * vec2f(f32(i), f32(j)) * texel;
            let reference = uphill_four(depth, plane, lean, corner - uv + step, texel);
            let four = textureGatherCompare(casters, compare, tile_corner(view, corner + step), tile_layer(view), reference);
            lit += y.y * dot(x, four.xy) + y.x * dot(x, four.wz);
        }
    }
    return lit;
}
