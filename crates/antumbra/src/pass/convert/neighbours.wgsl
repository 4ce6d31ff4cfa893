
fn convert_source(p: vec2i) -> mat3x3f {
    return mat3x3f(
        convert_depth(p + vec2i(-1, -1)), convert_depth(p + vec2i(-1, 0)), convert_depth(p + vec2i(-1, 1)),
        convert_depth(p + vec2i(0, -1)), convert_depth(p), convert_depth(p + vec2i(0, 1)),
        convert_depth(p + vec2i(1, -1)), convert_depth(p + vec2i(1, 0)), convert_depth(p + vec2i(1, 1)),
    );
}
