
fn convert_source(p: vec2f, cast: u32) -> f32 {
    return convert_depth(p, cast);
}
