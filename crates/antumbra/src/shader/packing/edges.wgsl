/// Edges farther than this inside a texel's centre, in texels, are out of reach of its neighbours.
const packing_reach: f32 = 2.0;
/// Edges of triangles that touch a texel are no farther outside its centre: half a texel, and rounding.
const packing_beyond: f32 = 0.6;

/// Nearest of 2^bits − 1 levels from low to high; the middle is one of them.
fn packing_quantize(value: f32, low: f32, high: f32, bits: u32) -> u32 {
    let last = f32((1u << bits) - 2u);
    return u32(clamp((value - low) / (high - low), 0.0, 1.0) * last + 0.5);
}

/// Value of a level.
fn packing_value(level: u32, low: f32, high: f32, bits: u32) -> f32 {
    return low + (high - low) * f32(level) / f32((1u << bits) - 2u);
}

/// A direction as a place on the square around the origin whose corners are on the axes, 0 to 4, on which
/// the normals of lines lie. Spares sine, cosine and roots.
fn packing_turn(direction: vec2f) -> f32 {
    let x = direction.x / max(abs(direction.x) + abs(direction.y), 1e-30);
    return select(3.0 + x, 1.0 - x, direction.y >= 0.0);
}

/// The vector of a place on that square.
fn packing_direction(turn: f32) -> vec2f {
    let x = select(turn - 3.0, 1.0 - turn, turn < 2.0);
    let y = 1.0 - abs(x);
    return vec2f(x, select(-y, y, turn < 2.0));
}

/// What all texels of a triangle share. Per edge, in x, y and z: the direction of its normal in the
/// upper 13 bits. In the lower 6 bits of all four words: both depth slopes s as s / (1 + |s|), 12 bits
/// each; `slope` is the depth gained over the width and over the height of the map.
fn packing_triangle(corners: mat3x3f, slope: vec2f) -> vec4u {
    let words = vec4u(
        packing_edge(corners[1].xy, corners[2].xy),
        packing_edge(corners[2].xy, corners[0].xy),
        packing_edge(corners[0].xy, corners[1].xy),
        0u,
    );
    let bent = slope / (1.0 + abs(slope));
    let x = packing_quantize(bent.x, -1.0, 1.0, 12u);
    let y = packing_quantize(bent.y, -1.0, 1.0, 12u);
    return words | vec4u(x >> 6u, x & 63u, y >> 6u, y & 63u);
}

/// Direction of the normal of the edge from a to b, in the upper 13 bits.
fn packing_edge(a: vec2f, b: vec2f) -> u32 {
    let along = b - a;
    return (u32(packing_turn(vec2f(along.y, -along.x)) * 2048.0 + 0.5) & 8191u) << 19u;
}

/// Slope, as decoded, of what `packing_triangle` or `packing_texel` made: depth over the width and over
/// the height of the map, at most 1024.
fn packing_slope(words: vec4u) -> vec2f {
    let low = words & vec4u(63u);
    let bent = vec2f(packing_value((low.x << 6u) | low.y, -1.0, 1.0, 12u), packing_value((low.z << 6u) | low.w, -1.0, 1.0, 12u));
    return bent / max(1.0 - abs(bent), vec2f(1.0 / 1024.0));
}

/// How far the decoded slope and depth may be from what was stored: half a level, and for depth as much
/// again twice, since 32-bit floats hardly resolve its levels.
fn packing_slack(words: vec4u) -> vec3f {
    let steep = 1.0 + abs(packing_slope(words));
    return vec3f(steep * steep / 4094.0, 1.5e-6);
}

/// Adds what differs from texel to texel: the distance of each edge from the texel's centre (13 bits),
/// and the depth at the centre (24 bits) that puts the plane of the stored slope, here per texel,
/// through `anchor`: x and y from the centre, depth. Bit 7 of w says that there is a triangle, bit 6
/// that it is known in this texel alone.
fn packing_texel(shared_words: vec4u, corners: mat3x3f, distances: vec3f, centre: vec2f, size: vec2f, anchor: vec3f, slope: vec2f, alone: bool) -> vec4u {
    var words = shared_words;
    words.x |= packing_quantize(distances.x, -packing_reach, packing_beyond, 13u) << 6u;
    words.y |= packing_quantize(distances.y, -packing_reach, packing_beyond, 13u) << 6u;
    words.z |= packing_quantize(distances.z, -packing_reach, packing_beyond, 13u) << 6u;
    // In front of the near plane depth only has to stay there, wherever the neighbours look.
    let depth = max(anchor.z, min(0.0, -2.5 * (abs(slope.x) + abs(slope.y)))) - dot(slope, anchor.xy);
    words.w |= (packing_quantize(depth, -6.0, 3.0, 24u) << 8u) | select(128u, 192u, alone);
    return words;
}

/// Whether a texel holds a triangle.
fn packing_holds(words: vec4u) -> bool {
    return (words.w & 128u) != 0u;
}

/// Whether neighbouring texels must not look at this one: a cut-out's triangle says nothing of them.
fn packing_alone(words: vec4u, centre: vec2f, size: vec2f) -> bool {
    return (words.w & 64u) != 0u;
}

/// Edges of the stored triangle around the texel's centre, which lies at `centre` in the map: distances
/// n·x + o are positive outside.
fn packing_lines(words: vec4u, centre: vec2f, size: vec2f) -> mat3x3f {
    return mat3x3f(packing_line(words.x), packing_line(words.y), packing_line(words.z));
}

/// The edge in one of the first three words.
fn packing_line(word: u32) -> vec3f {
    let distance = packing_value((word >> 6u) & 8191u, -packing_reach, packing_beyond, 13u);
    return vec3f(packing_direction(f32(word >> 19u) / 2048.0), distance);
}

/// Corner opposite edge k around the texel's centre in xy; z is 1 if it is known, which corners out of
/// reach are not.
fn packing_corner(words: vec4u, lines: mat3x3f, k: u32, centre: vec2f, size: vec2f) -> vec3f {
    let p = lines[(k + 1u) % 3u];
    let q = lines[(k + 2u) % 3u];
    let sine = p.x * q.y - p.y * q.x;
    let corner = vec2f(q.z * p.y - p.z * q.y, p.z * q.x - q.z * p.x) / sine;
    let known = abs(sine) > 1e-3 && all(abs(corner) <= vec2f(packing_reach)) && min(p.z, q.z) > 0.001 - packing_reach;
    return vec3f(corner, select(0.0, 1.0, known));
}

/// Depth of the stored plane at the texel's centre.
fn packing_depth(words: vec4u) -> f32 {
    return packing_value(words.w >> 8u, -6.0, 3.0, 24u);
}
