/// Cosine and sine of the angle by which a disk is turned: none.
fn spin_rotation(uv: vec2f, ddx: vec2f, ddy: vec2f) -> vec2f {
    return vec2f(1.0, 0.0);
}
