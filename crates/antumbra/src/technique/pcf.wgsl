/// Weights of the columns and of the rows of the grid.
const pcf_weights = array<f32, 3>(0.25, 0.5, 0.25);
/// Taps along one side of the grid.
const pcf_width: u32 = 3;

/// Weighted share of an n×n grid of texels around uv that `depth` is not behind [Reeves et al.
/// 1987]. Taps uphill, where the receiver's plane is nearer to the light, compare the depth of that
/// plane, so that a wide kernel does not shadow a tilted receiver by itself. `compare` may interpolate 2×2
/// comparisons; then the support is (n+1)×(n+1) texels and the result is continuous in uv.
fn pcf_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let texel = 1.0 / vec2f(textureDimensions(casters));
    let first = -0.5 * f32(pcf_width - 1u);
    var lit = 0.0;
    for (var row = 0u; row < pcf_width; row += 1u) {
        for (var column = 0u; column < pcf_width; column += 1u) {
            let offset = (first + vec2f(f32(column), f32(row))) * texel;
            let tap = textureSampleCompareLevel(casters, compare, uv + offset, view, depth + min(dot(plane, offset), 0.0));
            lit += pcf_weights[row] * pcf_weights[column] * tap;
        }
    }
    return lit;
}
