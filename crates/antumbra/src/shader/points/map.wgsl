/// A corner in 2 × 16 bits, over the map and half of it on each side: a sixteenth of a texel apart for
/// 2048 texels, and the same in all texels [Lecocq et al. 2014, §3.3].
fn points_pack(corner: vec2f, centre: vec2f, size: vec2f) -> u32 {
    return pack2x16unorm(0.5 * corner / size + 0.25);
}

/// The corner, around the texel's centre, which lies at `centre` in the map.
fn points_unpack(word: u32, centre: vec2f, size: vec2f) -> vec2f {
    return (2.0 * unpack2x16unorm(word) - 0.5) * size - centre;
}
