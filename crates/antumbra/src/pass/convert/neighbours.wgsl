
fn convert_source(p: vec2f, caster_pass: u32) -> mat3x3f {
    return mat3x3f(
        convert_depth(p + vec2f(-1.0, -1.0), caster_pass), convert_depth(p + vec2f(-1.0, 0.0), caster_pass), convert_depth(p + vec2f(-1.0, 1.0), caster_pass),
        convert_depth(p + vec2f(0.0, -1.0), caster_pass), convert_depth(p, caster_pass), convert_depth(p + vec2f(0.0, 1.0), caster_pass),
        convert_depth(p + vec2f(1.0, -1.0), caster_pass), convert_depth(p + vec2f(1.0, 0.0), caster_pass), convert_depth(p + vec2f(1.0, 1.0), caster_pass),
    );
}
