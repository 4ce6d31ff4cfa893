
fn convert_source(p: vec2f, which: u32) -> f32 {
    return convert_depth(p, which);
}
