/// A depth as casters store it, to compare with theirs: as it is.
fn stored_depth(depth: f32) -> f32 {
    return depth;
}
