//! needs key ray samples spline tile

/// Triangles per texel.
const dpm_keeps: u32 = 4;
/// Positions along one side of a pixel at which shadows are asked.
const dpm_samples: u32 = 1;
/// Receivers that may be behind a triangle which was not kept are lit where this share of the light around
/// them is: less than half, since the triangles that were kept cover most of a shadow.
const dpm_open: f32 = 0.28;

/// Class of a receiver that is behind no triangle.
const dpm_lit: u32 = 0;
/// Class of a receiver that is behind a triangle of its texel.
const dpm_shadowed: u32 = 1;
/// Class of a receiver that may be behind a triangle which was not kept.
const dpm_uncertain: u32 = 2;

/// Whether the caster at a texel's centre is nearer than a receiver at `point`. `gain` is the receiver's
/// plane per texel.
fn dpm_occluded(casters: texture_depth_2d_array, texel: vec2i, point: vec2f, view: u32, depth: f32, gain: vec2f) -> bool {
    return textureLoad(casters, tile_texel(view, texel), tile_layer(view), 0) < depth + dot(gain, vec2f(texel) + 0.5 - point);
}

/// Class of a receiver.
///
/// Full texels may lack triangles: those that are less worth keeping than the last one. The far sides of
/// closed casters alone make their whole shadow, so that a receiver which lies before a far side that was
/// kept is lit; so is one that lies on a far side that was kept, as leaves do whose triangles have twins with the
/// other winding. Unless some single sheet is missing, which the texel's centre is asked for. There the receiver's
/// own surface must not count: it gets as much room as it rises within a texel.
fn dpm_class_at(casters: texture_depth_2d_array, point: vec2f, view: u32, depth: f32, gain: vec2f) -> u32 {
    let texel = min(vec2u(max(point, vec2f(0.0))), vec2u(tile_size(view)) - 1u);
    let start = tile_index(view, texel) * dpm_keeps;
    let bits = shadow_key_bits();
    let step = key_step(key_linear(depth, shadow_near_over_far(view)), bits);
    let ray = vec3f(point, 0.0);
    var key = 0u;
    // Whether the receiver's own triangle, or its twin, is kept: it is met behind, by what biases are.
    var own = false;
    for (var i = start; i < start + dpm_keeps; i += 1u) {
        key = shadow_key(i);
        if key == 0u {
            return dpm_lit;
        }
        if key_deeper(key, step, bits) {
            // Behind a near side are only near sides that lie deeper.
            if key_is_near(key) {
                return dpm_lit;
            }
            continue;
        }
        let n = key_number(key, bits);
        let a = shadow_corner(view, n, 0u) - ray;
        let b = shadow_corner(view, n, 1u) - ray;
        let c = shadow_corner(view, n, 2u) - ray;
        let met = ray_depth(a, b, c);
        if met < depth {
            if shadow_stops(view, n, a, b, c) {
                return dpm_shadowed;
            }
            continue;
        }
        own = own || met - depth < 2e-5 + 0.05 * dot(abs(gain), vec2f(1.0));
    }
    let before = depth - dot(abs(gain), vec2f(1.0));
    let last = own || key_is_near(key) || key_deeper(key, step, bits);
    let complete = last && !dpm_occluded(casters, vec2i(texel), point, view, before, gain);
    return select(dpm_uncertain, dpm_lit, complete);
}

/// Share of the light around a receiver, by the centres of the nine texels there.
fn dpm_share(casters: texture_depth_2d_array, point: vec2f, view: u32, depth: f32, gain: vec2f) -> f32 {
    let texel = vec2i(floor(point));
    var share = 0.0;
    for (var i = 0; i < 9; i += 1) {
        let there = texel + vec2i(i % 3, i / 3) - 1;
        let weight = spline_weight(vec2f(there) + 0.5 - point);
        share += select(weight, 0.0, dpm_occluded(casters, there, point, view, depth, gain));
    }
    return share;
}

/// Whether a receiver is lit: what its class says, or the centres around it.
fn dpm_lights(casters: texture_depth_2d_array, point: vec2f, view: u32, depth: f32, gain: vec2f) -> bool {
    let found = dpm_class_at(casters, point, view, depth, gain);
    if found != dpm_uncertain {
        return found == dpm_lit;
    }
    return dpm_share(casters, point, view, depth, gain) >= dpm_open;
}

/// Share of a pixel that is lit. `depth` and `plane` are of projected depth, in which triangles are planes
/// under any light. Of several samples those in the pixel's corners come first, and the others only where
/// these differ.
fn dpm_visibility(casters: texture_depth_2d_array, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    if dpm_samples == 1u {
        return select(0.0, 1.0, dpm_lights(casters, uv * size, view, depth, plane / size));
    }
    var lit = 0u;
    var count = 4u;
    for (var i = 0u; i < count; i += 1u) {
        let at = samples_place(i, dpm_samples);
        let step = at.x * ddx + at.y * ddy;
        let there = depth + dot(plane, step);
        lit += select(0u, 1u, dpm_lights(casters, (uv + step) * size, view, there, plane / size));
        if i == 3u && lit % 4u != 0u {
            count = dpm_samples * dpm_samples;
        }
    }
    // Some divisions round n / n up.
    return min(f32(lit) / f32(count), 1.0);
}

/// Class of a receiver at a pixel's centre. Arguments as dpm_visibility.
fn dpm_class(casters: texture_depth_2d_array, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> u32 {
    let size = tile_size(view);
    return dpm_class_at(casters, uv * size, view, depth, plane / size);
}
