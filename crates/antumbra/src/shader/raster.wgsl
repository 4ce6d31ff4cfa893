/// Linear depth in [0,1] of a projected depth in [0,1]; `near_over_far` is 1 for parallel light,
/// where both are the same.
fn raster_linear(depth: f32, near_over_far: f32) -> f32 {
    return near_over_far * depth / (1.0 - (1.0 - near_over_far) * depth);
}

/// How fast projected depth changes with linear depth, at the linear depth `linear`.
fn raster_slope(linear: f32, near_over_far: f32) -> f32 {
    let scale = near_over_far + linear * (1.0 - near_over_far);
    return near_over_far / (scale * scale);
}

/// A depth that may enter a map: what is outside [0,1] or not a number becomes the far plane, so
/// that one bad texel cannot spread through a filter.
fn raster_clean(depth: f32) -> f32 {
    return select(1.0, depth, depth >= 0.0 && depth <= 1.0);
}
