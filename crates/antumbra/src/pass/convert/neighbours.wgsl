
fn convert_source(p: vec2f, which: u32) -> mat3x3f {
    return mat3x3f(
        convert_depth(p + vec2f(-1.0, -1.0), which), convert_depth(p + vec2f(-1.0, 0.0), which), convert_depth(p + vec2f(-1.0, 1.0), which),
        convert_depth(p + vec2f(0.0, -1.0), which), convert_depth(p, which), convert_depth(p + vec2f(0.0, 1.0), which),
        convert_depth(p + vec2f(1.0, -1.0), which), convert_depth(p + vec2f(1.0, 0.0), which), convert_depth(p + vec2f(1.0, 1.0), which),
    );
}
