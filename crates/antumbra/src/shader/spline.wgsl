/// Quadratic B-spline: weight of a texel's centre in the mean around a point, `away` texels from it. Those
/// of all texels are 1 in sum, and zero from one and a half texels on.
fn spline_weight(away: vec2f) -> f32 {
    let x = abs(away);
    let outer = max(vec2f(1.5) - x, vec2f(0.0));
    let along = select(0.5 * outer * outer, vec2f(0.75) - x * x, x < vec2f(0.5));
    return along.x * along.y;
}
