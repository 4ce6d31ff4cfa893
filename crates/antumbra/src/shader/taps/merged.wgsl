//! needs uphill taps_weights tile

/// The sum of n×n bilinear taps in ⌈(n+1)/2⌉² bilinear lookups. The taps cover n + 1 texels along each
/// axis; a lookup between two of them, at the fraction b/(a + b) and with the weight a + b, gives the
/// first the weight a and the second b. Weights of both axes multiply, in a lookup as in the kernel.
fn taps_lit(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let first = uv / texel - 0.5 * f32(taps_width);
    let low = floor(first);
    let fraction = first - low;
    // From the receiver to where the first four texels meet.
    let corner = (low + 1.0) * texel - uv;
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var j = 0u; j < taps_pairs; j += 1u) {
        let y = taps_pair(2.0 * f32(j), fraction.y);
        let down = y.x + y.y;
        let place_y = (low.y + 0.5 + 2.0 * f32(j) + y.y / max(down, 1e-30)) * texel.y;
        for (var i = 0u; i < taps_pairs; i += 1u) { // unrolled
            let x = taps_pair(2.0 * f32(i), fraction.x);
            let across = x.x + x.y;
            let place_x = (low.x + 0.5 + 2.0 * f32(i) + x.y / max(across, 1e-30)) * texel.x;
            let reference = uphill_four(depth, plane, lean, corner + 2.0 * vec2f(f32(i), f32(j)) * texel, texel);
            lit += across * down * textureSampleCompareLevel(casters, compare, tile_uv(view, vec2f(place_x, place_y)), tile_layer(view), reference);
        }
    }
    return lit;
}
