/// Twice the area of the triangle between the receiver and two corners, given relative to it. The same
/// number with the other sign for corners the other way around, so that no ray passes between two
/// triangles with a common edge.
fn ray_area(a: vec3f, b: vec3f) -> f32 {
    return a.x * b.y - a.y * b.x;
}

/// Width over length from which on a triangle is not thin.
const ray_thin: f32 = 0.004;

/// Weights, 0 to 1, sum 1, that the corners of a triangle with some area have at the receiver's ray, or
/// next to it. Corners lie around the ray in x and y.
///
/// They come from areas, which know small weights as exactly as large ones: corners that a spot cut off lie so
/// far before all others that the last bits of their weights count. In long thin triangles areas are small
/// differences of large products and do not know how far along the longest edge the ray is; there that comes
/// from lengths, and only the place across from areas.
fn ray_weights(a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    let areas = vec3f(ray_area(b, c), ray_area(c, a), ray_area(a, b));
    let area = areas.x + areas.y + areas.z;
    let shares = areas / area;
    let squares = vec3f(dot(c.xy - b.xy, c.xy - b.xy), dot(a.xy - c.xy, a.xy - c.xy), dot(b.xy - a.xy, b.xy - a.xy));
    if abs(area) > ray_thin * max(squares.x, max(squares.y, squares.z)) {
        let inside = max(shares, vec3f(0.0));
        return inside / (inside.x + inside.y + inside.z);
    }
    if squares.x >= max(squares.y, squares.z) {
        return ray_along(b.xy, c.xy, a.xy, shares.x, squares.x).zxy;
    }
    if squares.y >= squares.z {
        return ray_along(c.xy, a.xy, b.xy, shares.y, squares.y).yzx;
    }
    return ray_along(a.xy, b.xy, c.xy, shares.z, squares.z);
}

/// Weights of p, q and r, of which that of r is known roughly; `square` is that of the distance from p to q.
///
/// The weights that r can have where the ray is along pq bound it, not the other way around: beside an edge
/// to r the roughly known weight would say how far along that edge the ray is. The slack, two units in the last
/// place of 1, lets r have any weight at an end of pq that it lies beside.
fn ray_along(p: vec2f, q: vec2f, r: vec2f, share: f32, square: f32) -> vec3f {
    let along = (q - p) / square;
    let here = clamp(dot(-p, along), 0.0, 1.0);
    let there = clamp(dot(r - p, along), 0.0, 1.0);
    let slack = 2.4e-7;
    let most = min((here + slack) / (there + slack), (1.0 - here + slack) / (1.0 - there + slack));
    let third = clamp(share, 0.0, min(most, 1.0));
    let second = clamp(here - third * there, 0.0, 1.0 - third);
    return vec3f(1.0 - third - second, second, third);
}

/// Depth at the receiver's ray of a triangle whose corners lie around it in x and y, depths in z; beyond
/// all depths if the ray misses it.
fn ray_depth(a: vec3f, b: vec3f, c: vec3f) -> f32 {
    let areas = vec3f(ray_area(b, c), ray_area(c, a), ray_area(a, b));
    let inside = all(areas >= vec3f(0.0)) || all(areas <= vec3f(0.0));
    if !inside || areas.x + areas.y + areas.z == 0.0 {
        return 1e30;
    }
    return dot(ray_weights(a, b, c), vec3f(a.z, b.z, c.z));
}
