//! needs reference

/// Depth that the texel at `offset` from the receiver, in texture coordinates, is compared with: the receiver's own
/// where its plane falls away from the light, that of the plane where it rises. Both are told at right angles to the
/// light, whose depth in the map leans by `lean`.
fn uphill_depth(depth: f32, plane: vec2f, lean: vec2f, offset: vec2f) -> f32 {
    return reference_depth(depth + dot(lean, offset), dot(plane - lean, offset));
}

/// The same for the four texels around the corner at `offset`: all are compared with one depth, in front of the plane
/// at any of them, and by as much as if depth did not lean.
fn uphill_four(depth: f32, plane: vec2f, lean: vec2f, offset: vec2f, texel: vec2f) -> f32 {
    let level = dot(lean, offset) - 0.5 * dot(abs(lean), texel);
    let highest = dot(plane, offset) - 0.5 * max(dot(abs(plane), texel), dot(abs(plane - lean), texel));
    return reference_depth(depth + level, highest - level);
}
