/// A depth as casters store it, to compare with theirs: theirs falls with the distance, the receiver's grows.
fn stored_depth(depth: f32) -> f32 {
    return 1.0 - depth;
}
