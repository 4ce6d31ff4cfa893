/// What 1 becomes.
const words_top: f32 = 65536.0;

/// Values in [0,1] as whole numbers: one word for each of four channels.
fn words_split(t: vec4f, part: u32) -> vec4u {
    return vec4u(t * words_top + 0.5);
}

/// The inverse, of sums: up to rounding to 32-bit floats.
fn words_value(low: vec4u, high: vec4u) -> vec4f {
    return vec4f(low) / words_top;
}

/// a + b, wrapping.
fn words_add(a: vec4u, b: vec4u) -> vec4u {
    return a + b;
}

/// a − b, wrapping.
fn words_subtract(a: vec4u, b: vec4u) -> vec4u {
    return a - b;
}
