
fn convert_source(p: vec2f) -> f32 {
    return convert_depth(p);
}
