//! needs uphill tile

/// Weights of the four texels along one axis, the second of which lies `f` texels before the receiver:
/// the uniform cubic B-spline.
fn bicubic_weights(f: f32) -> vec4f {
    let g = 1.0 - f;
    let inner = vec2f(4.0 - 6.0 * f * f + 3.0 * f * f * f, 4.0 - 6.0 * g * g + 3.0 * g * g * g);
    return vec4f(g * g * g, inner, f * f * f) / 6.0;
}

/// The comparisons with 4×4 texels around uv, convolved with the cubic B-spline, in four bilinear
/// lookups [Sigg & Hadwiger 2005]: one between two texels, at the fraction b/(a + b) and with the weight
/// a + b, gives the first the weight a and the second b.
fn bicubic_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    let place = uv * size - 0.5;
    let x = bicubic_weights(fract(place.x));
    let y = bicubic_weights(fract(place.y));
    // Centres of the first texels of both pairs, and the weights and fractions of the pairs.
    let first = floor(place) - 0.5;
    let weight_x = x.xz + x.yw;
    let weight_y = y.xz + y.yw;
    let at_x = x.yw / weight_x;
    let at_y = y.yw / weight_y;
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var row = 0u; row < 2u; row += 1u) {
        for (var column = 0u; column < 2u; column += 1u) {
            let low = first + 2.0 * vec2f(f32(column), f32(row));
            let point = (low + vec2f(at_x[column], at_y[row])) / size;
            let reference = uphill_four(depth, plane, lean, (low + 0.5) / size - uv, 1.0 / size);
            lit += weight_x[column] * weight_y[row] * textureSampleCompareLevel(casters, compare, tile_uv(view, point), tile_layer(view), reference);
        }
    }
    // Floats that sum to one may exceed it by some roundings.
    return min(lit, 1.0);
}
