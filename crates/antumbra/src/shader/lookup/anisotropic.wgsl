//! needs level tile

/// What receivers read.
alias LookupMap = texture_2d_array<f32>;

/// Most lookups along the footprint.
const lookup_most_taps: u32 = 16;

/// Longer side of the pixel's footprint in texels, and lookups along it.
fn lookup_taps(size: vec2f, ddx: vec2f, ddy: vec2f) -> vec2f {
    let x = length(ddx * size);
    let y = length(ddy * size);
    let longest = max(max(x, y), 1.0);
    let shortest = max(min(x, y), 1.0);
    return vec2f(longest, clamp(ceil(longest / shortest), 1.0, f32(lookup_most_taps)));
}

/// The level at which the four texels around a point hold all that is read: in each direction half the way between the
/// outermost lookups and one and a half texels of their coarser level; of a single lookup, the texels around it.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let taps = lookup_taps(size, ddx, ddy);
    let level = log2(max(taps.x / taps.y, 1.0));
    let reach = taps.x * (1.0 - 1.0 / taps.y) + 3.0 * exp2(ceil(level));
    return select(log2(reach), level, taps.y == 1.0);
}

/// Trilinear lookups in a row along the longer side of the pixel's footprint, at the level of its
/// shorter side. An explicit loop: bounded, and the same on every driver.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let size = tile_size(view);
    let counted = lookup_taps(size, ddx, ddy);
    let level = log2(max(counted.x / counted.y, 1.0));
    let along = select(ddy, ddx, length(ddx * size) > length(ddy * size));
    let taps = u32(counted.y);
    var sum = vec4f(0.0);
    for (var i = 0u; i < taps; i += 1u) {
        let t = (f32(i) + 0.5) / counted.y - 0.5;
        sum += level_filtered(map, map_sampler, uv + along * t, view, layer, level);
    }
    return sum / counted.y;
}
