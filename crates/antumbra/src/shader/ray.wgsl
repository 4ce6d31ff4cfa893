/// Twice the area of the triangle between the receiver and two corners, given relative to it. The same
/// number with the other sign for corners the other way around, so that no ray passes between two
/// triangles with a common edge.
fn ray_area(a: vec3f, b: vec3f) -> f32 {
    return a.x * b.y - a.y * b.x;
}

/// Depth at the receiver's ray of a triangle whose corners lie around it in x and y, depths in z; beyond
/// all depths if the ray misses it.
fn ray_depth(a: vec3f, b: vec3f, c: vec3f) -> f32 {
    let weights = vec3f(ray_area(b, c), ray_area(c, a), ray_area(a, b));
    let sum = weights.x + weights.y + weights.z;
    let inside = all(weights >= vec3f(0.0)) || all(weights <= vec3f(0.0));
    return select(1e30, dot(weights, vec3f(a.z, b.z, c.z)) / sum, inside && sum != 0.0);
}
