//! needs uphill spin tile

/// Number of lookups.
const poisson_points: u32 = 16;
/// Mean of the points of the spiral in the unit disk.
const poisson_centre = array<f32, 2>(0.0, 0.0);
/// Cosine and sine of the golden angle, π(3 − √5).
const poisson_golden = vec2f(-0.73736887807832, 0.67549029426152);

/// Mean of bilinear comparisons at the points of a disk poisson_diameter texels wide around uv. Point i of n lies
/// at the radius √((i + ½)/n), turned by the golden angle from the one before [Vogel 1979].
fn poisson_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let texel = 1.0 / tile_size(view);
    let turn = 0.5 * poisson_diameter(view) * spin_rotation(uv, ddx, ddy);
    let centre = vec2f(poisson_centre[0], poisson_centre[1]);
    let origin = uv / texel - vec2f(turn.x * centre.x - turn.y * centre.y, turn.y * centre.x + turn.x * centre.y);
    let lean = uphill_lean(view);
    var direction = turn;
    var lit = 0.0;
    for (var i = 0u; i < poisson_points; i += 1u) {
        let place = origin + sqrt((f32(i) + 0.5) / f32(poisson_points)) * direction;
        // Where the four texels of the lookup meet.
        let corner = (floor(place - 0.5) + 1.0) * texel;
        let reference = uphill_four(depth, plane, lean, corner - uv, texel);
        lit += textureSampleCompareLevel(casters, compare, tile_uv(view, place * texel), tile_layer(view), reference);
        direction = mat2x2f(poisson_golden, vec2f(-poisson_golden.y, poisson_golden.x)) * direction;
    }
    // Some divisions round n / n up.
    return min(lit / f32(poisson_points), 1.0);
}
