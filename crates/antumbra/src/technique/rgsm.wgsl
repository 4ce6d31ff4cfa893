//! needs coverage packing tile

/// Texels along one side of the square whose triangles the receiver's ray is intersected with.
const rgsm_neighbours: u32 = 3;
/// Whether a ray that meets no triangle is answered as by an ordinary shadow map; else it is lit.
const rgsm_compares: u32 = 1;

/// The words that a texel stores; none, as an empty texel, beside the map.
fn rgsm_load(map: texture_2d_array<u32>, texel: vec2i, view: u32) -> vec4u {
    let inside = all(texel >= vec2i(0)) && all(texel < vec2i(tile_size(view)));
    return select(vec4u(0u), textureLoad(map, tile_texel(view, texel), tile_layer(view), 0), inside);
}

/// Whether the receiver's ray passes through the triangle stored by the texel whose centre it passes at
/// the distance `at`.
fn rgsm_meets(words: vec4u, centre: vec2f, at: vec2f, size: vec2f) -> bool {
    let lines = packing_lines(words, centre, size);
    let p = vec3f(at, 1.0);
    return max(dot(lines[0], p), max(dot(lines[1], p), dot(lines[2], p))) <= 0.0;
}

/// Whether the plane of that triangle is certainly nearer to the light than the receiver's `depth`.
fn rgsm_before(words: vec4u, at: vec2f, depth: f32, size: vec2f) -> bool {
    let slack = packing_slack(words);
    let plane = packing_depth(words) + dot(packing_slope(words) / size, at);
    return plane + slack.z + dot(slack.xy / size, abs(at)) < depth;
}

/// 0 behind a triangle that a texel of the square around the receiver stores, 1 on or before one, else
/// what an ordinary map answers. `depth` and `plane` are of projected depth, in which triangles are
/// planes under any light.
fn rgsm_visibility(map: texture_2d_array<u32>, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let size = tile_size(view);
    let point = uv * size;
    let reach = i32(rgsm_neighbours / 2u);
    var met = false;
    for (var y = -reach; y <= reach; y += 1) {
        for (var x = -reach; x <= reach; x += 1) {
            let step = vec2i(x, y);
            let centre = floor(point) + 0.5 + vec2f(step);
            let words = rgsm_load(map, vec2i(floor(point)) + step, view);
            let tells = packing_holds(words) && (all(step == vec2i(0)) || !packing_alone(words, centre, size));
            if tells && rgsm_meets(words, centre, point - centre, size) {
                met = true;
                if rgsm_before(words, point - centre, depth, size) {
                    return 0.0;
                }
            }
        }
    }
    let centre = floor(point) + 0.5;
    let words = rgsm_load(map, vec2i(floor(point)), view);
    if met || rgsm_compares == 0u || !packing_holds(words) {
        return 1.0;
    }
    // At the texel's centre, where its triangle was seen, uphill along the receiver's plane.
    let there = depth + min(dot(plane / size, centre - point), 0.0);
    return select(1.0, 0.0, rgsm_before(words, vec2f(0.0), there, size));
}
