/// A corner relative to the texel's centre as two 16-bit floats: finer the nearer it is, 2⁻¹¹ of its
/// distance, so that edges keep their direction.
fn points_pack(corner: vec2f, centre: vec2f, size: vec2f) -> u32 {
    return pack2x16float(clamp(corner - centre, vec2f(-60000.0), vec2f(60000.0)));
}

/// The corner, around the texel's centre.
fn points_unpack(word: u32, centre: vec2f, size: vec2f) -> vec2f {
    return unpack2x16float(word);
}
