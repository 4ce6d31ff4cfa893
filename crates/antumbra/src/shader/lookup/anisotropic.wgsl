//! needs level tile

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// Most lookups along the footprint.
const lookup_most_taps: u32 = 16;

/// The level at which a texel covers the longer side of the pixel's footprint, and so all that is read.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let x = ddx * size;
    let y = ddy * size;
    return 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0));
}

/// Trilinear lookups in a row along the longer side of the pixel's footprint, at the level of its
/// shorter side. An explicit loop: bounded, and the same on every driver.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let size = tile_size(view);
    let x = length(ddx * size);
    let y = length(ddy * size);
    let longest = max(max(x, y), 1.0);
    let shortest = max(min(x, y), 1.0);
    let taps = clamp(u32(ceil(longest / shortest)), 1u, lookup_most_taps);
    let level = log2(max(longest / f32(taps), 1.0));
    let along = select(ddy, ddx, x > y);
    var sum = vec4f(0.0);
    for (var i = 0u; i < taps; i += 1u) {
        let t = (f32(i) + 0.5) / f32(taps) - 0.5;
        sum += level_filtered(map, map_sampler, uv + along * t, view, layer, level);
    }
    return sum / f32(taps);
}
