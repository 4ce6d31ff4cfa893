/// Place of sample `i` of side × side in a pixel, in pixels from its centre, each at the middle of its
/// part: those in the corners first, then row by row without them.
fn samples_place(i: u32, side: u32) -> vec2f {
    var k = i - 3u;
    k += select(0u, 1u, k >= side - 1u);
    k += select(0u, 1u, k >= side * side - side);
    k = select(k, (i & 1u) * (side - 1u) + (i >> 1u) * (side * side - side), i < 4u);
    return (vec2f(f32(k % side), f32(k / side)) + 0.5) / f32(side) - 0.5;
}
