
fn convert_source(p: vec2i) -> f32 {
    return convert_depth(p);
}
