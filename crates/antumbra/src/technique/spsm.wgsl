//! needs coverage packing

/// For each set of shadowed neighbours, bit k for the k-th around a texel (spsm_neighbour): in bits 0
/// to 7 those that hang together with the texel, in 8 to 10 how many tangents there are, and from 11 on,
/// five bits each, the directions away from the shadow, in 32nds of a turn.
const spsm_tangents = array<u32, 1>(0u);
/// Positions along one side of an uncertain pixel at which the silhouette is asked.
const spsm_samples: u32 = 1;
/// Triangles per texel: of those that touch it, the one whose plane is nearest to the light; and the
/// nearest of those that cover its centre.
const spsm_layers: u32 = 1;
/// So many slivers in the nine texels around a receiver leave no silhouette to recover.
const spsm_slivers: u32 = 10;

/// Class of a receiver that its own texel shows to be lit.
const spsm_lit: u32 = 0;
/// Class of a receiver that is behind the triangle of its own texel.
const spsm_shadowed: u32 = 1;
/// Class of a receiver that is behind a triangle that the texels around its own store.
const spsm_around: u32 = 2;
/// Class of a receiver whose texel holds a caster that is not known to cover it: the silhouette tells.
const spsm_uncertain: u32 = 3;

/// The k-th of the eight neighbours of a texel, from the right over the one below, k < 8.
fn spsm_neighbour(k: u32) -> vec2i {
    return vec2i(
        select(select(0, -1, k >= 3u && k <= 5u), 1, k <= 1u || k == 7u),
        select(select(0, -1, k >= 5u), 1, k >= 1u && k <= 3u),
    );
}

/// The words that a texel stores in a layer; none, as an empty texel, beside the map.
fn spsm_load(map: texture_2d_array<u32>, texel: vec2i, view: u32, layer: u32) -> vec4u {
    let inside = all(texel >= vec2i(0)) && all(texel < vec2i(textureDimensions(map)));
    return select(vec4u(0u), textureLoad(map, texel, view * spsm_layers + layer, 0), inside);
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

/// Whether the triangle stored by the texel around `centre` is between the light and the receiver at
/// `point` [Lecocq et al. 2014, Algorithm 1]: nearer, which is asked first, and covering it.
fn spsm_intersects(words: vec4u, centre: vec2f, point: vec2f, depth: f32, size: vec2f) -> bool {
    let at = point - centre;
    let slack = packing_slack(words);
    if !packing_holds(words) || spsm_plane(words, at, size) + slack.z + dot(slack.xy / size, abs(at)) >= depth {
        return false;
    }
    return spsm_covers(packing_lines(words, centre, size), point - centre);
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
    var least = 1e30;
    for (var k = 0u; k < 3u; k += 1u) {
        // The edge's line is foot + s·along; the texel and the other edges cut it.
        let line = lines[k];
        let foot = -line.z * line.xy;
        let along = vec2f(-line.y, line.x);
        let safe = select(along, vec2f(1e-9), abs(along) < vec2f(1e-9));
        let left = (vec2f(-0.5) - foot) / safe;
        let right = (vec2f(0.5) - foot) / safe;
        let enter = min(left, right);
        let leave = max(left, right);
        var first = max(enter.x, enter.y);
        var last = min(leave.x, leave.y);
        for (var other = 1u; other < 3u; other += 1u) {
            let cut = lines[(k + other) % 3u];
            let rise = dot(cut.xy, along);
            let at = -(dot(cut.xy, foot) + cut.z) / select(rise, 1e-9, abs(rise) < 1e-9);
            if rise < 0.0 {
                first = max(first, at);
            } else {
                last = min(last, at);
            }
        }
        if first <= last + 1e-3 {
            let start = dot(gain, vec3f(foot, 1.0));
            let slope = dot(gain.xy, along);
            least = min(least, min(start + slope * first, start + slope * last));
        }
    }
    return least;
}

/// Whether a texel holds a triangle that somewhere in it is nearer to the light than the receiver's
/// plane, given as depth at the texel's centre and gain per texel.
fn spsm_occludes(words: vec4u, centre: vec2f, receiver: vec3f, size: vec2f) -> bool {
    if !packing_holds(words) {
        return false;
    }
    let slack = packing_slack(words);
    let sure = vec3f(0.0, 0.0, slack.z + dot(slack.xy, 0.5 / size));
    let gain = vec3f(packing_slope(words) / size, packing_depth(words)) + sure - receiver;
    return spsm_least(packing_lines(words, centre, size), gain) < 0.0;
}

/// One of the classes above [Lecocq et al. 2014, §4.1]. Bindings and arguments as spsm_visibility.
fn spsm_class(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> u32 {
    let size = vec2f(textureDimensions(map));
    let point = uv * size;
    let texel = vec2i(floor(point));
    let centre = floor(point) + 0.5;
    let words = spsm_load(map, texel, view, 0u);
    // No triangle touches this texel.
    if !packing_holds(words) {
        return spsm_lit;
    }
    if spsm_intersects(words, centre, point, depth, size) {
        return spsm_shadowed;
    }
    for (var layer = 0u; layer < spsm_layers; layer += 1u) {
        for (var k = 0u; k < 9u; k += 1u) {
            let step = select(spsm_neighbour(k), vec2i(0), k == 8u);
            let there = centre + vec2f(step);
            let words = spsm_load(map, texel + step, view, layer);
            if spsm_intersects(words, there, point, depth, size) && (k == 8u || !packing_alone(words, there, size)) {
                return spsm_around;
            }
        }
    }
    // On the stored triangle, or nothing in this texel is nearer to the light than the receiver.
    let gain = plane / size;
    let receiver = vec3f(gain, depth + dot(gain, centre - point));
    let own = spsm_covers(packing_lines(words, centre, size), point - centre);
    return select(spsm_uncertain, spsm_lit, own || !spsm_occludes(words, centre, receiver, size));
}

/// The neighbours of a texel that hold an occluder, bit k for spsm_neighbour(k). `receiver` is the
/// receiver's plane as gain per texel and depth at the centre.
fn spsm_pattern(map: texture_2d_array<u32>, texel: vec2i, view: u32, receiver: vec3f, size: vec2f) -> u32 {
    var pattern = 0u;
    for (var k = 0u; k < 8u; k += 1u) {
        let step = spsm_neighbour(k);
        let words = spsm_load(map, texel + step, view, 0u);
        let there = receiver + vec3f(0.0, 0.0, dot(receiver.xy, vec2f(step)));
        let occludes = spsm_occludes(words, vec2f(texel + step) + 0.5, there, size);
        pattern |= select(0u, 1u << k, occludes);
    }
    return pattern;
}

/// Whether a texel holds a triangle that is less than half a texel across there: two of its edges face
/// away from each other so closely.
fn spsm_sliver(words: vec4u, centre: vec2f, size: vec2f) -> bool {
    let lines = packing_lines(words, centre, size);
    var sliver = !packing_holds(words);
    for (var k = 0u; k < 3u; k += 1u) {
        let a = lines[k];
        let b = lines[(k + 1u) % 3u];
        sliver = sliver || (dot(a.xy, b.xy) < -0.7 && -a.z - b.z < 0.5);
    }
    return sliver;
}

/// Whether the casters around a texel are too fine for their silhouette to be recovered: `kept` are the
/// neighbours that count.
fn spsm_unresolved(map: texture_2d_array<u32>, texel: vec2i, view: u32, kept: u32, size: vec2f) -> bool {
    var slivers = 0u;
    for (var k = 0u; k < 9u; k += 1u) {
        if ((kept | 256u) >> k & 1u) == 1u {
            let there = texel + select(spsm_neighbour(k), vec2i(0), k == 8u);
            let words = spsm_load(map, there, view, 0u);
            slivers += select(0u, 1u, spsm_sliver(words, vec2f(there) + 0.5, size));
        }
    }
    return slivers >= spsm_slivers;
}

/// Share of the four nearest texels, with bilinear weights, whose centres are lit: what an ordinary
/// shadow map knows.
fn spsm_ordinary(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f, size: vec2f) -> f32 {
    let corner = floor(point - 0.5);
    let weight = point - 0.5 - corner;
    var lit = 0.0;
    for (var k = 0u; k < 4u; k += 1u) {
        let step = vec2f(f32(k & 1u), f32(k >> 1u));
        let centre = corner + step + 0.5;
        let words = spsm_load(map, vec2i(corner + step), view, spsm_layers - 1u);
        let occluded = packing_holds(words) && packing_depth(words) < depth + dot(gain, centre - point);
        let share = select(1.0 - weight, weight, step > vec2f(0.5));
        lit += select(share.x * share.y, 0.0, occluded);
    }
    return lit;
}

/// The silhouette on both sides of a point, from the corners whose outward normals point along `normal`,
/// which leads away from the shadow [Lecocq et al. 2014, §4.2, figure 10]: place along the tangent and
/// height along the normal of the nearest corner before the point, in xy, and behind it, in zw, relative
/// to the point. Places beyond ±1e8 mean that there is none. `receiver` and `kept` as in spsm_pattern.
fn spsm_silhouette(map: texture_2d_array<u32>, point: vec2f, view: u32, receiver: vec3f, kept: u32, normal: vec2f, size: vec2f) -> vec4f {
    let texel = vec2i(floor(point));
    var nearest = vec4f(-1e9, 0.0, 1e9, 0.0);
    for (var entry = 0u; entry < 9u * spsm_layers; entry += 1u) {
        let k = entry % 9u;
        let step = select(spsm_neighbour(k), vec2i(0), k == 8u);
        if ((kept | 256u) >> k & 1u) == 0u {
            continue;
        }
        let there = vec2f(texel + step) + 0.5;
        let words = spsm_load(map, texel + step, view, entry / 9u);
        let plane = receiver + vec3f(0.0, 0.0, dot(receiver.xy, vec2f(step)));
        if packing_alone(words, there, size) || !spsm_occludes(words, there, plane, size) {
            continue;
        }
        let lines = packing_lines(words, there, size);
        for (var c = 0u; c < 3u; c += 1u) {
            let corner = packing_corner(words, lines, c, there, size);
            let outward = lines[(c + 1u) % 3u].xy + lines[(c + 2u) % 3u].xy;
            if corner.z == 0.0 || dot(outward, normal) <= 0.0 {
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

/// Share of an uncertain receiver's samples that are lit. `ddx` and `ddy` span the pixel in texels. Along
/// each tangent the silhouette is the line between the corners next to the receiver, found once for all
/// samples [Lecocq et al. 2014, §5]; a sample is shadowed if it is behind all of them.
fn spsm_recover(map: texture_2d_array<u32>, point: vec2f, view: u32, depth: f32, gain: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = vec2f(textureDimensions(map));
    let texel = vec2i(floor(point));
    let receiver = vec3f(gain, depth + dot(gain, floor(point) + 0.5 - point));
    let entry = spsm_tangents[spsm_pattern(map, texel, view, receiver, size)];
    let kept = entry & 255u;
    let count = entry >> 8u & 7u;
    if spsm_layers > 1u && (count == 0u || spsm_unresolved(map, texel, view, kept, size)) {
        return select(0.0, 1.0, spsm_ordinary(map, point, view, depth, gain, size) >= 0.5);
    }
    let every = (1u << (spsm_samples * spsm_samples)) - 1u;
    var shadowed = every;
    for (var i = 0u; i < count; i += 1u) {
        let angle = f32(entry >> (11u + 5u * i) & 31u) * (6.283185307179586 / 32.0);
        let normal = vec2f(cos(angle), sin(angle));
        let nearest = spsm_silhouette(map, point, view, receiver, kept, normal, size);
        if nearest.x < -1e8 || nearest.z > 1e8 {
            return 1.0;
        }
        for (var k = 0u; k < spsm_samples * spsm_samples; k += 1u) {
            let at = (vec2f(f32(k % spsm_samples), f32(k / spsm_samples)) + 0.5) / f32(spsm_samples) - 0.5;
            let sample = at.x * ddx + at.y * ddy;
            let along = normal.x * sample.y - normal.y * sample.x;
            let height = mix(nearest.y, nearest.w, (along - nearest.x) / (nearest.z - nearest.x));
            shadowed &= select(every, ~(1u << k), height < dot(sample, normal));
        }
    }
    return 1.0 - f32(countOneBits(shadowed)) / f32(countOneBits(every));
}

/// 0 or 1 for the class where that is certain, else what the recovered silhouette says [Lecocq et al.
/// 2014]. `depth` and `plane` are of projected depth, in which triangles are planes under any light.
fn spsm_visibility(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let found = spsm_class(map, uv, view, depth, plane, ddx, ddy);
    if found != spsm_uncertain {
        return select(0.0, 1.0, found == spsm_lit);
    }
    let size = vec2f(textureDimensions(map));
    return spsm_recover(map, uv * size, view, depth, plane / size, ddx * size, ddy * size);
}
