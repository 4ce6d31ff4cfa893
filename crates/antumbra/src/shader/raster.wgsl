/// Linear depth, [0,1] from near to far, of normalised device coordinates, by the two rows of a view.
fn raster_linear(ndc: vec3f, over: vec4f, under: vec4f) -> f32 {
    return dot(over, vec4f(ndc, 1.0)) / dot(under, vec4f(ndc, 1.0));
}

/// How fast projected depth changes with linear depth, which is `linear` at these coordinates.
fn raster_slope(ndc: vec3f, linear: f32, over: vec4f, under: vec4f) -> f32 {
    return dot(under, vec4f(ndc, 1.0)) / (over.z - under.z * linear);
}

/// A linear depth that may enter a map: what is outside [0,1] or not a number becomes the far plane, so
/// that one bad texel cannot spread through a filter.
fn raster_clean(depth: f32) -> f32 {
    return select(1.0, depth, depth >= 0.0 && depth <= 1.0);
}
