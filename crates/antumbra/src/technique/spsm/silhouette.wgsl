
/// Slopes of lines that corners are on or below: the gentle ones.
const spsm_gentle: vec4f = vec4f(-0.4, -0.1, 0.1, 0.4);
/// The steep ones.
const spsm_steep: vec4f = vec4f(-3.0, -1.0, 1.0, 3.0);
/// Height of a silhouette of which nothing is known.
const spsm_nowhere: f32 = -1e9;
/// Corners of a triangle.
const spsm_corners: u32 = 3;

/// What a set of shadowed neighbours, bit k for spsm_neighbour(k), says about the shadow's border [Lecocq
/// et al. 2014, §4.2, figures 7 and 8]. Bits 0 to 7: those that hang together with the texel over common
/// sides; the others do not count. Each run of lit ones around the ring is one border, and its middle the
/// direction away from the shadow; a run that reaches more than halfway around is two borders. Bits 8 to
/// 10: how many; from 11 on, five bits each, their directions in 32nds of a turn, from right over down.
///
/// Reckoned, not looked up: software drivers fill an array of constants anew for every invocation.
fn spsm_tangents(pattern: u32) -> u32 {
    let sides = pattern & 0x55u;
    let beside = (sides << 1u) | (sides >> 1u) | (sides >> 7u) | (sides << 7u);
    let kept = sides | (pattern & beside & 0xaau);
    let lit = ~kept & 0xffu;
    var starts = select(lit & ((kept << 1u) | (kept >> 7u)), 1u, kept == 0u);
    var count = 0u;
    var directions = 0u;
    while starts != 0u {
        let start = firstTrailingBit(starts);
        starts &= starts - 1u;
        let run = ((lit >> start) | (lit << (8u - start))) & 0xffu;
        let length = firstTrailingBit(~run);
        let pieces = select(1u, 2u, length > 5u);
        let first = 4u * start + 30u + 2u * length / pieces;
        directions |= (first & 31u) << (5u * count);
        directions |= select(0u, ((first + 2u * length) & 31u) << (5u * count + 5u), pieces == 2u);
        count += pieces;
    }
    return kept | (count << 8u) | (directions << 11u);
}

/// What a receiver's own texel says of it: spsm_shadowed behind its triangle, spsm_lit where that triangle is on
/// or behind the receiver, since of all in the texel it is the nearest to the light [Lecocq et al. 2014, §4.1]; else
/// spsm_uncertain.
fn spsm_own(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f) -> u32 {
    let size = tile_size(view);
    let centre = floor(point) + 0.5;
    let at = point - centre;
    let words = spsm_load(map, vec2i(floor(point)), view, 0u);
    // No triangle touches this texel, or none comes before the receiver.
    if !packing_holds(words) || !spsm_nearer(words, at, depth, size) {
        return spsm_lit;
    }
    return select(spsm_uncertain, spsm_shadowed, spsm_covers(packing_lines(words, centre, size), at));
}

/// Those of the nine texels around a receiver that hold an occluder, bit e for spsm_step(e). `receiver` is
/// the receiver's plane as gain per texel and depth at the centre.
fn spsm_casters(map: texture_2d_array<u32>, texel: vec2i, view: u32, receiver: vec3f, size: vec2f) -> u32 {
    var found = 0u;
    for (var entry = 0u; entry < 9u; entry += 1u) {
        let step = spsm_step(entry);
        let words = spsm_load(map, texel + step, view, 0u);
        let lines = packing_lines(words, vec2f(texel + step) + 0.5, size);
        let there = receiver + vec3f(0.0, 0.0, dot(receiver.xy, vec2f(step)));
        found |= select(0u, 1u << entry, spsm_occludes(words, lines, there, size));
    }
    return found;
}

/// Height along `normal`, which leads away from the shadow, of the silhouette at four places along the tangent,
/// all from `point` [Lecocq et al. 2014, §4.2, figure 10]: of the triangles that texels store, and of lines over
/// the corners that are on the silhouette, those whose outward normals point along `normal`. What lies
/// behind either does not count, nor do corners that are farther than a texel from the centre. `entries` as spsm_casters finds them.
fn spsm_silhouette(map: texture_2d_array<u32>, point: vec2f, view: u32, entries: u32, normal: vec2f, size: vec2f, places: vec4f) -> vec4f {
    let texel = vec2i(floor(point));
    let tangent = vec2f(-normal.y, normal.x);
    var heights = vec4f(spsm_nowhere);
    var gentle = vec4f(spsm_nowhere);
    var steep = vec4f(spsm_nowhere);
    var ends = vec2f(1e9, -1e9);
    for (var left = entries; left != 0u; left &= left - 1u) {
        let step = spsm_step(firstTrailingBit(left));
        let there = vec2f(texel + step) + 0.5;
        let words = spsm_load(map, texel + step, view, 0u);
        if any(step != vec2i(0)) && packing_alone(words, there, size) {
            continue;
        }
        let lines = packing_lines(words, there, size);
        var top = vec4f(1e9);
        var bottom = vec4f(-1e9);
        for (var c = 0u; c < spsm_corners; c += 1u) { // unrolled
            let line = lines[c];
            let rise = dot(line.xy, normal);
            let cut = -(dot(line, vec3f(point - there, 1.0)) + dot(line.xy, tangent) * places) / select(rise, 1e-9, abs(rise) < 1e-9);
            top = min(top, select(vec4f(1e9), cut, rise > 0.0));
            bottom = max(bottom, select(vec4f(-1e9), cut, rise <= 0.0));
            let outward = normalize(lines[(c + 1u) % 3u].xy) + normalize(lines[(c + 2u) % 3u].xy);
            let corner = packing_corner(words, lines, c, there, size);
            if corner.z != 0.0 && dot(outward, normal) > 0.0 && all(abs(corner.xy + vec2f(step)) <= vec2f(1.0)) {
                let away = corner.xy + there - point;
                let at = vec2f(dot(away, tangent), dot(away, normal));
                gentle = max(gentle, at.y - spsm_gentle * at.x);
                steep = max(steep, at.y - spsm_steep * at.x);
                ends = vec2f(min(ends.x, at.x), max(ends.y, at.x));
            }
        }
        heights = max(heights, select(vec4f(spsm_nowhere), top, top >= bottom));
    }
    let over = vec4f(
        spsm_over(gentle, steep, places.x),
        spsm_over(gentle, steep, places.y),
        spsm_over(gentle, steep, places.z),
        spsm_over(gentle, steep, places.w),
    );
    return max(heights, select(vec4f(spsm_nowhere), over, (places >= vec4f(ends.x)) & (places <= vec4f(ends.y))));
}

/// Height at a place of the lines of both kinds of slopes.
fn spsm_over(gentle: vec4f, steep: vec4f, place: f32) -> f32 {
    let low = min(gentle + spsm_gentle * place, steep + spsm_steep * place);
    return min(min(low.x, low.y), min(low.z, low.w));
}

/// Which samples of an uncertain receiver's pixel are lit, a bit for each, by the silhouette [Lecocq et al. 2014,
/// §4.2]: those that are above it along any tangent. It is found once for each tangent, as a line through four
/// places across the pixel, with which all samples are compared [§5]. `across` and `down` are texels to the next pixel.
fn spsm_recover(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f, across: vec2f, down: vec2f) -> u32 {
    let size = tile_size(view);
    let texel = vec2i(floor(point));
    let receiver = vec3f(gain, depth + dot(gain, floor(point) + 0.5 - point));
    let casters = spsm_casters(map, texel, view, receiver, size);
    let tangents = spsm_tangents(casters & 255u);
    let kept = (tangents & 255u) | 256u;
    let count = (tangents >> 8u) & 7u;
    let whole = (1u << (spsm_samples * spsm_samples)) - 1u;
    var lit = 0u;
    for (var i = 0u; lit != whole && i < count; i += 1u) {
        let angle = f32((tangents >> (11u + 5u * i)) & 31u) * (6.283185307179586 / 32.0);
        let normal = vec2f(cos(angle), sin(angle));
        let tangent = vec2f(-normal.y, normal.x);
        let reach = max(0.5 * (abs(dot(across, tangent)) + abs(dot(down, tangent))), 1e-6);
        let places = reach * vec4f(-1.0, -1.0 / 3.0, 1.0 / 3.0, 1.0);
        let heights = spsm_silhouette(map, point, view, casters & kept, normal, size, places);
        for (var k = 0u; k < spsm_samples * spsm_samples; k += 1u) {
            let at = samples_place(k, spsm_samples);
            let away = at.x * across + at.y * down;
            let between = 1.5 * dot(away, tangent) / reach + 1.5;
            let weights = max(1.0 - abs(between - vec4f(0.0, 1.0, 2.0, 3.0)), vec4f(0.0));
            lit |= select(0u, 1u << k, dot(weights, heights) < dot(away, normal));
        }
    }
    return lit;
}

/// Share of a pixel that is lit [Lecocq et al. 2014]. `depth` and `plane` are of projected depth, in which
/// triangles are planes under any light.
///
/// Several samples are compared with the silhouette alone [§5], also where the pixel's centre is certainly
/// shadowed: the triangles that do that are a part of it.
fn spsm_visibility(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    let point = uv * size;
    let found = spsm_own(map, point, view, depth, plane / size);
    if found == spsm_lit || (found == spsm_shadowed && spsm_samples == 1u) {
        return select(0.0, 1.0, found == spsm_lit);
    }
    if (spsm_samples == 1u || spsm_recovers == 0u) && spsm_met(map, point, view, depth, size) {
        return 0.0;
    }
    if spsm_recovers == 0u {
        return select(1.0, 0.0, found == spsm_shadowed);
    }
    let lit = countOneBits(spsm_recover(map, point, view, depth, plane / size, ddx * size, ddy * size));
    return f32(lit) / f32(spsm_samples * spsm_samples);
}
