/// Upper bound of the share of a distribution that lies at or beyond `depth`, from its mean and
/// mean square [Donnelly & Lauritzen 2006]: one-sided Chebyshev inequality with the variance kept
/// at or above `least_variance`. 1 in front of the mean.
fn chebyshev_bound(depth: f32, moments: vec2f, least_variance: f32) -> f32 {
    let variance = max(moments.y - moments.x * moments.x, least_variance);
    let behind = max(depth - moments.x, 0.0);
    return variance / (variance + behind * behind);
}

/// Cuts the lowest `reduction` of a bound off and stretches the rest back to [0,1]: less light
/// bleeding, narrower penumbrae [Lauritzen 2007].
fn chebyshev_reduce(bound: f32, reduction: f32) -> f32 {
    return clamp((bound - reduction) / (1.0 - reduction), 0.0, 1.0);
}

/// Variance of a plane's depth within one texel: a quarter of the squared gain over a texel in x plus
/// that in y. `plane` is the gain per unit of texture coordinate, `size` the map's size in texels.
fn chebyshev_slope(plane: vec2f, size: vec2f) -> f32 {
    let gain = plane / size;
    return 0.25 * dot(gain, gain);
}
