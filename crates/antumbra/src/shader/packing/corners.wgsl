//! needs quantizer coverage points

/// What all texels of a triangle share: both slopes, of 8 bits each, in the lower half of w; `slope` is
/// the depth gained over the width and over the height of the map.
fn packing_triangle(corners: mat3x3f, slope: vec2f) -> vec4u {
    let level = quantizer_encode(slope);
    return vec4u(0u, 0u, 0u, (level.x << 8u) | level.y);
}

/// Slope, as decoded, of what `packing_triangle` or `packing_texel` made: depth over the width and over
/// the height of the map.
fn packing_slope(words: vec4u) -> vec2f {
    return quantizer_decode(vec2f(vec2u((words.w >> 8u) & 255u, words.w & 255u)));
}

/// How far the decoded slope and depth may be from what was stored: half a level.
fn packing_slack(words: vec4u) -> vec3f {
    let level = vec2f(vec2u((words.w >> 8u) & 255u, words.w & 255u));
    let slope = quantizer_decode(level);
    let steps = max(quantizer_decode(level + 0.5) - slope, slope - quantizer_decode(level - 0.5));
    return vec3f(steps, 0.5 / 65535.0);
}

/// Adds what differs from texel to texel [Lecocq et al. 2014, §3.3]: corners in x, y and z, and in the
/// upper half of w the depth at the centre, 16 bits, that puts the plane of the stored slope, here per
/// texel, through `anchor`: x and y from the centre, depth. Corners in the other order say that the
/// triangle is known in this texel alone.
fn packing_texel(shared_words: vec4u, corners: mat3x3f, distances: vec3f, centre: vec2f, size: vec2f, anchor: vec3f, slope: vec2f, alone: bool) -> vec4u {
    let points = vec3u(
        points_pack(corners[0].xy, centre, size),
        points_pack(corners[1].xy, centre, size),
        points_pack(corners[2].xy, centre, size),
    );
    let depth = pack2x16unorm(vec2f(0.0, anchor.z - dot(slope, anchor.xy)));
    return vec4u(select(points, points.xzy, alone), shared_words.w | depth);
}

/// Whether a texel holds a triangle. No triangle has two slopes of level 0.
fn packing_holds(words: vec4u) -> bool {
    return words.w != 0u;
}

/// Corners of the stored triangle around the texel's centre, which lies at `centre` in the map.
fn packing_corners(words: vec4u, centre: vec2f, size: vec2f) -> mat3x3f {
    return mat3x3f(
        vec3f(points_unpack(words.x, centre, size), 0.0),
        vec3f(points_unpack(words.y, centre, size), 0.0),
        vec3f(points_unpack(words.z, centre, size), 0.0),
    );
}

/// Whether neighbouring texels must not look at this one: a cut-out's triangle says nothing of them.
fn packing_alone(words: vec4u, centre: vec2f, size: vec2f) -> bool {
    return coverage_area(packing_corners(words, centre, size)) < 0.0;
}

/// Edges of the stored triangle around the texel's centre, which lies at `centre` in the map: distances
/// n·x + o are positive outside.
fn packing_lines(words: vec4u, centre: vec2f, size: vec2f) -> mat3x3f {
    let corners = packing_corners(words, centre, size);
    return coverage_lines(corners) * select(1.0, -1.0, coverage_area(corners) < 0.0);
}

/// Corner opposite edge k around the texel's centre in xy; z is 1: it is known.
fn packing_corner(words: vec4u, lines: mat3x3f, k: u32, centre: vec2f, size: vec2f) -> vec3f {
    return vec3f(points_unpack(words[k], centre, size), 1.0);
}

/// Depth of the stored plane at the texel's centre.
fn packing_depth(words: vec4u) -> f32 {
    return unpack2x16unorm(words.w).y;
}
