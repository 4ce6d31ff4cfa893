/// The line through a and b as (n, o): n·x + o is the distance of x, negative where (b−a)×(x−a) is
/// positive. Distances are those of squares: |n.x| + |n.y| is 1, so that a square touches the line if
/// its centre is no farther than half its side. Zero for two equal points.
fn coverage_line(a: vec2f, b: vec2f) -> vec3f {
    let along = b - a;
    let length = abs(along.x) + abs(along.y);
    let n = select(vec2f(along.y, -along.x) / length, vec2f(0.0), length == 0.0);
    return vec3f(n, -dot(n, a));
}

/// The three edges of a triangle as such lines, with distances that are positive outside; `corners` hold x
/// and y in columns, in the order that gives a positive area.
fn coverage_lines(corners: mat3x3f) -> mat3x3f {
    return mat3x3f(
        coverage_line(corners[1].xy, corners[2].xy),
        coverage_line(corners[2].xy, corners[0].xy),
        coverage_line(corners[0].xy, corners[1].xy),
    );
}

/// Twice the area of a triangle, negative if its corners are in the other order.
fn coverage_area(corners: mat3x3f) -> f32 {
    let b = corners[1].xy - corners[0].xy;
    let c = corners[2].xy - corners[0].xy;
    return b.x * c.y - b.y * c.x;
}

/// Corner k of a triangle that holds the centres of all texels that a triangle covers, both from corner
/// 0: its edges moved outward by what a texel of that `reach` extends across them [Hasselgren et al. 2005],
/// and a hundredth for the rasteriser's grid. Where that reaches far beyond an acute corner, the right
/// triangle around a rectangle along the longest edge is smaller.
fn coverage_corner(corners: mat3x3f, lines: mat3x3f, k: u32, reach: f32) -> vec2f {
    let b = corners[1].xy;
    let c = corners[2].xy;
    let margin = reach + 0.01;
    let p = select(select(lines[0], lines[2], k == 1u), lines[1], k == 0u);
    let q = select(select(lines[1], lines[0], k == 1u), lines[2], k == 0u);
    let o = vec2f(p.z, q.z) - margin;
    let expanded = vec2f(o.y * p.y - o.x * q.y, o.x * q.x - o.y * p.x) / (p.x * q.y - p.y * q.x);
    // Rectangle along the longest edge.
    var along = select(b, c - b, dot(c - b, c - b) > dot(b, b));
    along = select(along, c, dot(c, c) > dot(along, along));
    let u = normalize(along);
    let v = vec2f(-u.y, u.x);
    let across = vec2f(dot(b, u), dot(c, u));
    let down = vec2f(dot(b, v), dot(c, v));
    let edge = margin * (abs(u.x) + abs(u.y));
    let low = min(vec2f(0.0), vec2f(min(across.x, across.y), min(down.x, down.y))) - edge;
    let high = max(vec2f(0.0), vec2f(max(across.x, across.y), max(down.x, down.y))) + edge;
    let at = low + select(vec2f(0.0), 2.0 * (high - low), vec2<bool>(k == 1u, k == 2u));
    // Twice the areas; all edges moved by as much would keep the triangle's shape.
    let area = abs(b.x * c.y - b.y * c.x);
    let grown = area + edge * (length(b) + length(c) + length(c - b));
    let sides = high - low;
    return select(at.x * u + at.y * v, expanded, grown * grown < 4.0 * sides.x * sides.y * area);
}

/// Whether a texel is covered: its square, `reach` texels to each side of its centre (one half for all
/// of it, zero for the centre alone), is not beyond one of the triangle's edges (`distances` of
/// its centre from the `lines`), nor beside the box around it (`bounds`: smallest x and y, largest x
/// and y). These are all separating axes of a square and a triangle. The slack, half a thousandth of
/// a texel, is more than rounding moves a corner, on maps of up to 4096 texels.
fn coverage_touches(lines: mat3x3f, distances: vec3f, bounds: vec4f, centre: vec2f, reach: f32) -> bool {
    return all(distances <= vec3f(reach + 5e-4))
        && all(centre >= bounds.xy - reach - 5e-4)
        && all(centre <= bounds.zw + reach + 5e-4);
}

/// The point of a triangle that lies next to the centre of a covered texel, nearly: the centre where
/// it is inside, else moved onto the edge that it is farthest beyond.
fn coverage_nearest(lines: mat3x3f, distances: vec3f, bounds: vec4f, centre: vec2f) -> vec2f {
    var line = lines[0].xy;
    var beyond = distances.x;
    if distances.y > beyond {
        line = lines[1].xy;
        beyond = distances.y;
    }
    if distances.z > beyond {
        line = lines[2].xy;
        beyond = distances.z;
    }
    return clamp(centre - max(beyond, 0.0) / max(dot(line, line), 1e-30) * line, bounds.xy, bounds.zw);
}

/// Depth that a triangle's plane gains per texel along x and y; depths are the third coordinates of
/// the corners. Zero for a triangle without area.
///
/// Gained along the longest edge, and then across it: the area of a long thin triangle, a small difference of
/// large products, says nothing of what it gains along its length.
fn coverage_slope(corners: mat3x3f) -> vec2f {
    let sides = mat3x3f(corners[2] - corners[1], corners[0] - corners[2], corners[1] - corners[0]);
    let squares = vec3f(dot(sides[0].xy, sides[0].xy), dot(sides[1].xy, sides[1].xy), dot(sides[2].xy, sides[2].xy));
    if squares.x >= max(squares.y, squares.z) {
        return coverage_gain(sides[0], sides[1], squares.x);
    }
    if squares.y >= squares.z {
        return coverage_gain(sides[1], sides[2], squares.y);
    }
    return coverage_gain(sides[2], sides[0], squares.z);
}

/// Depth gained per texel of a plane that rises along two sides of a triangle, of the first of which
/// `square` is the squared length. Zero where they are parallel.
fn coverage_gain(side: vec3f, next: vec3f, square: f32) -> vec2f {
    let across = vec2f(-side.y, side.x);
    let area = dot(across, next.xy);
    let rest = next.z - dot(next.xy, side.xy) / square * side.z;
    return select(side.z / square * side.xy + rest / area * across, vec2f(0.0), area == 0.0);
}
