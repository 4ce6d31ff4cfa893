
fn convert_source(p: vec2f, caster_pass: u32) -> f32 {
    return convert_depth(p, caster_pass);
}
