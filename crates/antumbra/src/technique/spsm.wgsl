//! needs coverage packing samples spline tile

/// Positions along one side of a pixel at which shadows are asked.
const spsm_samples: u32 = 1;
/// Triangles per texel: of those that touch it, the one whose plane is nearest to the light; and the
/// nearest of those that cover its centre.
const spsm_layers: u32 = 1;
/// With two layers, receivers that no stored triangle covers are lit where this share of the light around
/// them is: less than half, since the triangles that were kept cover most of a shadow.
const spsm_open: f32 = 0.28;

/// Class of a receiver that its own texel shows to be lit.
const spsm_lit: u32 = 0;
/// Class of a receiver that is behind the triangle of its own texel.
const spsm_shadowed: u32 = 1;
/// Class of a receiver that is behind a triangle that the texels around its own store.
const spsm_around: u32 = 2;
/// Class of a receiver that may be behind a triangle which was not kept: the silhouette tells, or the
/// centres of the texels around it.
const spsm_uncertain: u32 = 3;

/// The k-th of the eight neighbours of a texel, from the right over the one below, k < 8.
fn spsm_neighbour(k: u32) -> vec2i {
    return vec2i(
        select(select(0, -1, k >= 3u && k <= 5u), 1, k <= 1u || k == 7u),
        select(select(0, -1, k >= 5u), 1, k >= 1u && k <= 3u),
    );
}

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

/// The words that a texel stores in a layer; none, as an empty texel, beside the map.
fn spsm_load(map: texture_2d_array<u32>, texel: vec2i, view: u32, layer: u32) -> vec4u {
    let inside = all(texel >= vec2i(0)) && all(texel < vec2i(tile_size(view)));
    return select(vec4u(0u), textureLoad(map, tile_texel(view, texel), tile_layer(view) * spsm_layers + layer, 0), inside);
}

/// Whether a point, relative to the texel's centre like the lines, is inside all three.
fn spsm_covers(lines: mat3x3f, point: vec2f) -> bool {
    let p = vec3f(point, 1.0);
    return max(dot(lines[0], p), max(dot(lines[1], p), dot(lines[2], p))) <= 0.0;
}

/// Depth of the stored plane at a point relative to the texel's centre [Lecocq et al. 2014, Eq. 1].
fn spsm_plane(words: vec4u, point: vec2f, size: vec2f) -> f32 {
    return packing_depth(words) + dot(packing_slope(words) / size, point);
}

/// Whether a texel holds a triangle whose plane is nearer to the light than the receiver at `at`, relative
/// to the texel's centre.
fn spsm_nearer(words: vec4u, at: vec2f, depth: f32, size: vec2f) -> bool {
    let slack = packing_slack(words);
    return packing_holds(words) && spsm_plane(words, at, size) + slack.z + dot(slack.xy / size, abs(at)) < depth;
}

/// Whether the triangle stored by the texel around `centre` is between the light and the receiver at
/// `point` [Lecocq et al. 2014, Algorithm 1]: nearer, which is asked first, and covering it.
fn spsm_intersects(words: vec4u, centre: vec2f, point: vec2f, depth: f32, size: vec2f) -> bool {
    let at = point - centre;
    if !spsm_nearer(words, at, depth, size) {
        return false;
    }
    return spsm_covers(packing_lines(words, centre, size), at);
}

/// Least of `gain`·(x, 1) over the part of a triangle that is in its texel, x relative to the centre: the
/// consistent minimum depth [Lecocq et al. 2014, §4.2]. It is in the corner of the texel to which `gain`
/// falls, if the triangle covers that, else where an edge enters or leaves the texel or another edge.
/// 1e30 where the triangle leaves no part.
fn spsm_least(lines: mat3x3f, gain: vec3f) -> f32 {
    let corner = select(vec2f(-0.5), vec2f(0.5), gain.xy < vec2f(0.0));
    if spsm_covers(lines, corner) {
        return dot(gain, vec3f(corner, 1.0));
    }
    return min(
        spsm_least_on(lines[0], lines[1], lines[2], gain),
        min(spsm_least_on(lines[1], lines[2], lines[0], gain), spsm_least_on(lines[2], lines[0], lines[1], gain)),
    );
}

/// The least along the part of an edge that is in the texel and that two other edges leave, 1e30 if there
/// is none.
fn spsm_least_on(line: vec3f, before: vec3f, behind: vec3f, gain: vec3f) -> f32 {
    // The edge's line is foot + s·along; the texel and the other edges cut it.
    let foot = -line.z / dot(line.xy, line.xy) * line.xy;
    let along = vec2f(-line.y, line.x);
    let safe = select(along, vec2f(1e-9), abs(along) < vec2f(1e-9));
    let left = (vec2f(-0.5) - foot) / safe;
    let right = (vec2f(0.5) - foot) / safe;
    let enter = min(left, right);
    let leave = max(left, right);
    let rise = vec2f(dot(before.xy, along), dot(behind.xy, along));
    let at = -(vec2f(dot(before.xy, foot), dot(behind.xy, foot)) + vec2f(before.z, behind.z)) / select(rise, vec2f(1e-9), abs(rise) < vec2f(1e-9));
    let first = max(max(enter.x, enter.y), max(select(-1e30, at.x, rise.x < 0.0), select(-1e30, at.y, rise.y < 0.0)));
    let last = min(min(leave.x, leave.y), min(select(1e30, at.x, rise.x >= 0.0), select(1e30, at.y, rise.y >= 0.0)));
    let start = dot(gain, vec3f(foot, 1.0));
    let slope = dot(gain.xy, along);
    return select(1e30, min(start + slope * first, start + slope * last), first <= last + 1e-3);
}

/// Whether a texel holds a triangle, with these edges, that somewhere in it is nearer to the light than
/// the receiver's plane, given as depth at the texel's centre and gain per texel.
fn spsm_occludes(words: vec4u, lines: mat3x3f, receiver: vec3f, size: vec2f) -> bool {
    let slack = packing_slack(words);
    let sure = vec3f(0.0, 0.0, slack.z + dot(slack.xy, 0.5 / size));
    let gain = vec3f(packing_slope(words) / size, packing_depth(words)) + sure - receiver;
    // Mostly the whole texel lies on one side, and which part the triangle covers does not matter.
    let rise = 0.5 * (abs(gain.x) + abs(gain.y));
    if !packing_holds(words) || gain.z - rise >= 0.0 {
        return false;
    }
    return gain.z + rise < 0.0 || spsm_least(lines, gain) < 0.0;
}

/// Where the e-th of nine texels is: the eight around a texel, then it itself.
fn spsm_step(entry: u32) -> vec2i {
    return select(spsm_neighbour(entry), vec2i(0), entry == 8u);
}

/// What a receiver's own texel says of it: spsm_lit or spsm_shadowed where that is certain, spsm_around
/// where the texels around may know of a triangle in between, spsm_uncertain where also one that was not
/// kept may be.
///
/// Where the texel shows the receiver to be lit, a triangle that it does not store may still be in
/// between: one that the other layer stores there, or one of the three texels next to the receiver.
/// With one layer nothing else could tell of it.
fn spsm_own(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f) -> u32 {
    let size = tile_size(view);
    let texel = vec2i(floor(point));
    let centre = floor(point) + 0.5;
    let at = point - centre;
    let words = spsm_load(map, texel, view, 0u);
    // No triangle touches this texel.
    if !packing_holds(words) {
        return spsm_lit;
    }
    let lines = packing_lines(words, centre, size);
    let covered = spsm_covers(lines, at);
    if covered && spsm_nearer(words, at, depth, size) {
        return spsm_shadowed;
    }
    // On the stored triangle, or nothing in this texel is nearer to the light than the receiver.
    let receiver = vec3f(gain, depth - dot(gain, at));
    let lit = covered || !spsm_occludes(words, lines, receiver, size);
    let side = select(vec2i(-1), vec2i(1), at >= vec2f(0.0));
    var clear = lit;
    for (var k = 1u; clear && k < 3u + spsm_layers; k += 1u) {
        let step = vec2i(vec2u(k & 1u, (k >> 1u) & 1u)) * side;
        let words = spsm_load(map, texel + step, view, k >> 2u);
        clear = !spsm_nearer(words, at - vec2f(step), depth, size);
    }
    if clear {
        return spsm_lit;
    }
    return select(spsm_uncertain, spsm_around, covered || (lit && spsm_layers == 1u));
}

/// Whether a triangle that one of the nine texels around a receiver stores is between it and the light.
fn spsm_met(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, size: vec2f) -> bool {
    let texel = vec2i(floor(point));
    var met = false;
    for (var entry = 0u; !met && entry < 9u * spsm_layers; entry += 1u) {
        let step = spsm_step(entry % 9u);
        let there = vec2f(texel + step) + 0.5;
        let words = spsm_load(map, texel + step, view, entry / 9u);
        let own = entry % 9u == 8u;
        met = spsm_intersects(words, there, point, depth, size) && (own || !packing_alone(words, there, size));
    }
    return met;
}

/// One of the classes above [Lecocq et al. 2014, §4.1]. Bindings and arguments as spsm_visibility.
fn spsm_class(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> u32 {
    let size = tile_size(view);
    let found = spsm_own(map, uv * size, view, depth, plane / size);
    if found < spsm_around {
        return found;
    }
    if spsm_met(map, uv * size, view, depth, size) {
        return spsm_around;
    }
    return select(spsm_uncertain, spsm_lit, found == spsm_around);
}

/// Share of the light around a point, smoothed over the nine texels around it, by their centres: what an
/// ordinary shadow map knows.
fn spsm_share(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f) -> f32 {
    let texel = vec2i(floor(point));
    var share = 0.0;
    for (var entry = 0u; entry < 9u; entry += 1u) {
        let there = texel + spsm_step(entry);
        let away = vec2f(there) + 0.5 - point;
        let words = spsm_load(map, there, view, spsm_layers - 1u);
        let occluded = packing_holds(words) && packing_depth(words) < depth + dot(gain, away);
        share += select(spline_weight(away), 0.0, occluded);
    }
    return share;
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

/// The silhouette on both sides of a point, from the corners whose outward normals point along `normal`,
/// which leads away from the shadow [Lecocq et al. 2014, §4.2, figure 10]: place along the tangent and
/// height along the normal of the nearest corner before the point, in xy, and behind it, in zw, relative
/// to the point. Places beyond ±1e8 mean that there is none. `entries` as spsm_casters finds them.
fn spsm_silhouette(map: texture_2d_array<u32>, point: vec2f, view: u32, entries: u32, normal: vec2f, size: vec2f) -> vec4f {
    let texel = vec2i(floor(point));
    var nearest = vec4f(-1e9, 0.0, 1e9, 0.0);
    for (var left = entries; left != 0u; left &= left - 1u) {
        let entry = firstTrailingBit(left);
        let step = spsm_step(entry);
        let there = vec2f(texel + step) + 0.5;
        let words = spsm_load(map, texel + step, view, 0u);
        let lines = packing_lines(words, there, size);
        let alone = packing_alone(words, there, size);
        for (var c = 0u; c < 3u; c += 1u) {
            let corner = packing_corner(words, lines, c, there, size);
            let outward = normalize(lines[(c + 1u) % 3u].xy) + normalize(lines[(c + 2u) % 3u].xy);
            if alone || corner.z == 0.0 || dot(outward, normal) <= 0.0 {
                continue;
            }
            let away = corner.xy + there - point;
            let at = vec2f(normal.x * away.y - normal.y * away.x, dot(away, normal));
            if at.x <= 0.0 && at.x > nearest.x {
                nearest = vec4f(at, nearest.zw);
            }
            if at.x > 0.0 && at.x < nearest.z {
                nearest = vec4f(nearest.xy, at);
            }
        }
    }
    return nearest;
}

/// Whether an uncertain receiver is lit, by the silhouette [Lecocq et al. 2014, §4.2]: along each tangent
/// the line between the corners next to the receiver, which is shadowed if it is behind all of them.
fn spsm_recover(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f) -> bool {
    let size = tile_size(view);
    let texel = vec2i(floor(point));
    let receiver = vec3f(gain, depth + dot(gain, floor(point) + 0.5 - point));
    let casters = spsm_casters(map, texel, view, receiver, size);
    let tangents = spsm_tangents(casters & 255u);
    let kept = (tangents & 255u) | 256u;
    let count = (tangents >> 8u) & 7u;
    var lit = false;
    for (var i = 0u; !lit && i < count; i += 1u) {
        let angle = f32((tangents >> (11u + 5u * i)) & 31u) * (6.283185307179586 / 32.0);
        let normal = vec2f(cos(angle), sin(angle));
        let nearest = spsm_silhouette(map, point, view, casters & kept, normal, size);
        let alone = nearest.x < -1e8 || nearest.z > 1e8;
        let height = mix(nearest.y, nearest.w, -nearest.x / (nearest.z - nearest.x));
        lit = alone || height < 0.0;
    }
    return lit;
}

/// Whether a receiver is lit: what its class says where that is certain, else the centres around it, or
/// with one layer the silhouette. Arguments as spsm_visibility.
///
/// The centres are asked first: it takes no triangle to tell that most receivers in shadow are.
fn spsm_lights(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> bool {
    let size = tile_size(view);
    let point = uv * size;
    let found = spsm_own(map, point, view, depth, plane / size);
    if found < spsm_around {
        return found == spsm_lit;
    }
    let uncertain = found == spsm_uncertain;
    if spsm_layers > 1u && uncertain && spsm_share(map, point, view, depth, plane / size) < spsm_open {
        return false;
    }
    if spsm_met(map, point, view, depth, size) {
        return false;
    }
    return spsm_layers > 1u || !uncertain || spsm_recover(map, point, view, depth, plane / size);
}

/// Share of a pixel that is lit [Lecocq et al. 2014]. `depth` and `plane` are of projected depth, in which
/// triangles are planes under any light.
///
/// Of several samples those in the pixel's corners come first, and the others only where these differ:
/// unlike the silhouette alone [§5], this smooths also the edges of triangles that were kept.
fn spsm_visibility(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    if spsm_samples == 1u {
        return select(0.0, 1.0, spsm_lights(map, uv, view, depth, plane));
    }
    let size = tile_size(view);
    let reach = 0.5 * (abs(ddx) + abs(ddy)) * size;
    if max(reach.x, reach.y) < 0.5 && spsm_own(map, uv * size, view, depth, plane / size) == spsm_lit {
        return 1.0;
    }
    let side = spsm_samples;
    var lit = 0u;
    var count = 4u;
    for (var i = 0u; i < count; i += 1u) {
        let at = samples_place(i, side);
        let step = at.x * ddx + at.y * ddy;
        lit += select(0u, 1u, spsm_lights(map, uv + step, view, depth + dot(plane, step), plane));
        if i == 3u && lit % 4u != 0u {
            count = side * side;
        }
    }
    // Some divisions round n / n up.
    return min(f32(lit) / f32(count), 1.0);
}
