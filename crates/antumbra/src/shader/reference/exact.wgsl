//! needs stored

/// Depth that some texels are compared with: the receiver's own where its plane falls away from the
/// light, that of the plane where it rises, so that no tilted plane shadows itself. `gain` is the depth
/// that the plane gains from the receiver to the texel, or to the highest of a group.
fn reference_depth(depth: f32, gain: f32) -> f32 {
    return stored_depth(depth + min(gain, 0.0));
}
