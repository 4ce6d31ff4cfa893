/// Packs a triangle of a texel into 32 bits; of two keys the greater is that of the triangle to keep, and 0 is
/// none. From the highest bit: whether its near side is seen; its linear depth; its number of `bits` bits; all inverted.
fn key_of(near: bool, depth: f32, number: u32, bits: u32) -> u32 {
    return ~(select(0u, key_near, near) | (key_step(depth, bits) << bits) | number);
}

/// Linear depth 0 to 1 in whole steps, rounded down; what lies outside is moved there.
fn key_step(depth: f32, bits: u32) -> u32 {
    let most = (1u << (31u - bits)) - 2u;
    // Few bits of numbers leave more steps than a float counts.
    return min(u32(clamp(depth, 0.0, 1.0) * f32(most)), most);
}

/// Number of the triangle.
fn key_number(key: u32, bits: u32) -> u32 {
    return ~key & ((1u << bits) - 1u);
}

/// Whether the triangle lies behind all that is in that step.
fn key_deeper(key: u32, step: u32, bits: u32) -> bool {
    return ((~key & ~key_near) >> bits) > step;
}

/// Whether its near side is seen.
fn key_is_near(key: u32) -> bool {
    return (key & key_near) == 0u;
}

/// The bit that says so, before it is inverted.
const key_near: u32 = 0x80000000u;

/// What keys take for the linear depth of a projected one. It orders triangles alike for all that use the same number.
fn key_linear(depth: f32, near_over_far: f32) -> f32 {
    let z = clamp(depth, 0.0, 1.0);
    return near_over_far * z / (1.0 - (1.0 - near_over_far) * z);
}
