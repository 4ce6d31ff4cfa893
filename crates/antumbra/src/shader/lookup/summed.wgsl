//! needs tile words

/// What receivers read.
alias LookupMap = texture_2d_array<u32>;

/// Layers of the table per layer of values.
const lookup_parts: u32 = 1;
/// What zero stands for, in each channel.
const lookup_low = array<f32, 4>(0.0, 0.0, 0.0, 0.0);
/// Distance from there to the other end of each channel's range.
const lookup_range = array<f32, 4>(1.0, 1.0, 1.0, 1.0);
/// Width of the kernel in texels.
const lookup_kernel: f32 = 3.0;
/// Longest side of a box in texels.
const lookup_longest: f32 = 255.0;

/// Sum over all texels left of x and above y.
fn lookup_corner(map: LookupMap, x: i32, y: i32, view: u32, layer: u32) -> vec4u {
    let sum = textureLoad(map, tile_texel(view, vec2i(x, y) - 1), layer, 0);
    return select(vec4u(0u), sum, x > 0 && y > 0);
}

/// Sums over the texels above y, from each of four columns to the next.
fn lookup_row(map: LookupMap, x: vec4i, y: i32, view: u32, layer: u32) -> array<vec4u, 3> {
    let a = lookup_corner(map, x.x, y, view, layer);
    let b = lookup_corner(map, x.y, y, view, layer);
    let c = lookup_corner(map, x.z, y, view, layer);
    let d = lookup_corner(map, x.w, y, view, layer);
    return array(words_subtract(b, a), words_subtract(c, b), words_subtract(d, c));
}

/// Where a side of a box from `low` to `high` cuts texels: the border texel at the low end, whole
/// texels, the border texel at the high end; four borders between columns.
fn lookup_borders(low: f32, high: f32) -> vec4i {
    let first = i32(floor(low));
    let last = max(i32(floor(high)), first + 1);
    return vec4i(first, first + 1, last, last + 1);
}

/// How much of each of these three the side covers.
fn lookup_cover(low: f32, high: f32) -> vec3f {
    let first = floor(low);
    let last = floor(high);
    return vec3f(min(high, first + 1.0) - low, 1.0, select(0.0, high - last, last > first));
}

/// The level at which a texel covers the longer side of the pixel's footprint, and so all that is read.
fn lookup_level(size: vec2f, view: u32, ddx: vec2f, ddy: vec2f) -> f32 {
    let x = ddx * size;
    let y = ddy * size;
    return 0.5 * log2(max(max(dot(x, x), dot(y, y)), 1.0));
}

/// Mean over a box around uv, exact for the map as a function that is constant on each texel: as wide
/// as the kernel or, where that is more, as the pixel's footprint; at most `lookup_longest` texels,
/// clipped to the map. Sixteen loads, whatever the size.
fn lookup_filtered(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, layer: u32, ddx: vec2f, ddy: vec2f) -> vec4f {
    let size = tile_size(view);
    let side = clamp((abs(ddx) + abs(ddy)) * size, vec2f(lookup_kernel), vec2f(lookup_longest));
    let low = clamp(uv * size - 0.5 * side, vec2f(0.0), size - 0.5);
    let high = clamp(uv * size + 0.5 * side, low + 0.5, size);
    let x = lookup_borders(low.x, high.x);
    let y = lookup_borders(low.y, high.y);
    // A column beyond the map has no cover: reading the last one instead makes its sum zero.
    let columns = min(x, vec4i(i32(size.x)));
    let rows = min(y, vec4i(i32(size.y)));
    let cover_x = lookup_cover(low.x, high.x);
    let cover_y = lookup_cover(low.y, high.y);
    let first = layer * lookup_parts;
    let second = first + lookup_parts - 1u;
    var above_a = lookup_row(map, columns, rows.x, view, first);
    var above_b = lookup_row(map, columns, rows.x, view, second);
    var sum = vec4f(0.0);
    for (var j = 0u; j < 3u; j += 1u) {
        let below_a = lookup_row(map, columns, rows[j + 1u], view, first);
        var below_b = below_a;
        if lookup_parts == 2u {
            below_b = lookup_row(map, columns, rows[j + 1u], view, second);
        }
        for (var i = 0u; i < 3u; i += 1u) {
            let a = words_subtract(below_a[i], above_a[i]);
            let b = words_subtract(below_b[i], above_b[i]);
            sum += cover_x[i] * cover_y[j] * words_value(a, b);
        }
        above_a = below_a;
        above_b = below_b;
    }
    let area = (high.x - low.x) * (high.y - low.y);
    return vec4f(lookup_low[0], lookup_low[1], lookup_low[2], lookup_low[3])
        + vec4f(lookup_range[0], lookup_range[1], lookup_range[2], lookup_range[3]) * sum / area;
}
