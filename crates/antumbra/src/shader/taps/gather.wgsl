//! needs reference taps_weights

/// The sum of n×n bilinear taps from ⌈(n+1)/2⌉² gathers of four comparisons each, weighted here: the
/// weights are floats, where samplers of GPUs round them to 8 bits.
fn taps_lit(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> f32 {
    let texel = 1.0 / vec2f(textureDimensions(casters));
    let first = uv / texel - 0.5 * f32(taps_width);
    let low = floor(first);
    let fraction = first - low;
    // Where the first four texels meet, and the gain to the highest of them.
    let corner = (low + 1.0) * texel;
    let gain = dot(plane, corner - uv) - 0.5 * dot(abs(plane), texel);
    var lit = 0.0;
    for (var j = 0.0; j <= f32(taps_width); j += 2.0) {
        let y = taps_pair(j, fraction.y);
        for (var i = 0.0; i <= f32(taps_width); i += 2.0) {
            let x = taps_pair(i, fraction.x);
            let step = vec2f(i, j) * texel;
            let reference = reference_depth(depth, gain + dot(plane, step));
            let four = textureGatherCompare(casters, compare, corner + step, view, reference);
            lit += y.y * dot(x, four.xy) + y.x * dot(x, four.wz);
        }
    }
    return lit;
}
