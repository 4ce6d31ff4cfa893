/// What 1 becomes in the higher word of two.
const words_top: f32 = 65536.0;

/// Values in [0,1] as whole numbers of two words, the lower first: channels 0 and 1 (`part` 0) or 2
/// and 3 (`part` 1).
fn words_split(t: vec4f, part: u32) -> vec4u {
    let scaled = select(t.xy, t.zw, part == 1u) * words_top;
    let high = floor(scaled);
    // The fraction of a 32-bit float times 2³² is whole.
    let low = (scaled - high) * 4294967296.0;
    return vec4u(u32(low.x), u32(high.x), u32(low.y), u32(high.y));
}

/// The inverse, of sums: up to rounding to 32-bit floats. `a` holds channels 0 and 1, `b` 2 and 3.
fn words_value(a: vec4u, b: vec4u) -> vec4f {
    let low = vec4f(vec4u(a.xz, b.xz)) / 4294967296.0;
    return (vec4f(vec4u(a.yw, b.yw)) + low) / words_top;
}

/// a + b, wrapping.
fn words_add(a: vec4u, b: vec4u) -> vec4u {
    let low = a.xz + b.xz;
    let high = a.yw + b.yw + select(vec2u(0u), vec2u(1u), low < a.xz);
    return vec4u(low.x, high.x, low.y, high.y);
}

/// a − b, wrapping.
fn words_subtract(a: vec4u, b: vec4u) -> vec4u {
    let low = a.xz - b.xz;
    let high = a.yw - b.yw - select(vec2u(0u), vec2u(1u), a.xz < b.xz);
    return vec4u(low.x, high.x, low.y, high.y);
}
