//! needs coverage packing samples spline tile

/// Positions along one side of a pixel at which shadows are asked.
const spsm_samples: u32 = 1;
/// Triangles per texel: of those that touch it the nearest to the light; and the nearest of those that cover
/// its centre.
const spsm_layers: u32 = 1;
/// Texels along one side of the square whose triangles may shadow a receiver.
const spsm_neighbours: u32 = 3;
/// 1 where receivers for which nothing is certain are looked at more closely, 0 where they are lit.
const spsm_recovers: u32 = 1;

/// Class of a receiver that its own texel shows to be lit.
const spsm_lit: u32 = 0;
/// Class of a receiver that is behind the triangle of its own texel.
const spsm_shadowed: u32 = 1;
/// Class of a receiver that is behind a triangle that the texels around its own store.
const spsm_around: u32 = 2;
/// Class of a receiver that may be behind a triangle which was not kept.
const spsm_uncertain: u32 = 3;

/// The k-th of the eight neighbours of a texel, from the right over the one below, k < 8.
fn spsm_neighbour(k: u32) -> vec2i {
    return vec2i(
        select(select(0, -1, k >= 3u && k <= 5u), 1, k <= 1u || k == 7u),
        select(select(0, -1, k >= 5u), 1, k >= 1u && k <= 3u),
    );
}

/// Where the e-th of nine texels is: the eight around a texel, then it itself.
fn spsm_step(entry: u32) -> vec2i {
    return select(spsm_neighbour(entry), vec2i(0), entry == 8u);
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

/// Whether a triangle that one of the texels around a receiver stores is between it and the light.
fn spsm_met(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, size: vec2f) -> bool {
    let texel = vec2i(floor(point));
    let side = spsm_neighbours;
    var met = false;
    for (var entry = 0u; !met && entry < side * side * spsm_layers; entry += 1u) {
        let place = entry % (side * side);
        let step = vec2i(vec2u(place % side, place / side)) - i32(side / 2u);
        let there = vec2f(texel + step) + 0.5;
        let words = spsm_load(map, texel + step, view, entry / (side * side));
        let own = all(step == vec2i(0));
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
