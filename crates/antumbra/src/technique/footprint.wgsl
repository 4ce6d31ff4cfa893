//! needs uphill tile

/// Most lookups.
const footprint_budget: u32 = 16;

/// Lookups along both sides of a footprint of `texels`: one per texel, or evenly fewer where these would
/// be more than the budget.
fn footprint_counts(texels: vec2f) -> vec2f {
    let budget = f32(footprint_budget);
    let wanted = max(ceil(texels), vec2f(1.0));
    let excess = sqrt(max(wanted.x * wanted.y / budget, 1.0));
    let fair = max(floor(wanted / excess), vec2f(1.0));
    let across = min(fair.x, budget);
    return vec2f(across, min(fair.y, floor(budget / across)));
}

/// Mean of bilinear comparisons over the parallelogram that the pixel covers in the map [Reeves et al.
/// 1987].
fn footprint_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    let counts = footprint_counts(vec2f(length(ddx * size), length(ddy * size)));
    let lean = uphill_lean(view);
    var lit = 0.0;
    for (var j = 0.5; j < counts.y; j += 1.0) {
        for (var i = 0.5; i < counts.x; i += 1.0) {
            let place = uv + (i / counts.x - 0.5) * ddx + (j / counts.y - 0.5) * ddy;
            // Where the four texels of the lookup meet.
            let corner = (floor(place * size - 0.5) + 1.0) / size;
            let reference = uphill_four(depth, plane, lean, corner - uv, 1.0 / size);
            lit += textureSampleCompareLevel(casters, compare, tile_uv(view, place), tile_layer(view), reference);
        }
    }
    // Some divisions round n / n up.
    return min(lit / (counts.x * counts.y), 1.0);
}
