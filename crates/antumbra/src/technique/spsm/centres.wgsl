
/// Receivers that no stored triangle covers are lit where this share of the light around them is: less than half,
/// since the triangles that were kept cover most of a shadow.
const spsm_open: f32 = 0.26;

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

/// Whether a receiver is lit: what its class says where that is certain, else the centres around it. Arguments
/// as spsm_visibility.
///
/// The centres are asked first: it takes no triangle to tell that most receivers in shadow are.
fn spsm_lights(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f) -> bool {
    let size = tile_size(view);
    let point = uv * size;
    let found = spsm_own(map, point, view, depth, plane / size);
    if found < spsm_around {
        return found == spsm_lit;
    }
    let open = spsm_recovers == 0u || found == spsm_around || spsm_share(map, point, view, depth, plane / size) >= spsm_open;
    return open && !spsm_met(map, point, view, depth, size);
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
