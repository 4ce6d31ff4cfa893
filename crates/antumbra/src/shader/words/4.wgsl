/// What 1 becomes in the highest word of four.
const words_top: f32 = 65536.0;

/// The first channel, in [0,1], as a whole number of four words, the lowest first.
fn words_split(t: vec4f, part: u32) -> vec4u {
    var words = vec4u(0u);
    var rest = t.x * words_top;
    for (var i = 4u; i > 0u; i -= 1u) {
        let whole = floor(rest);
        words[i - 1u] = u32(whole);
        rest = (rest - whole) * 4294967296.0;
    }
    return words;
}

/// The inverse, of sums: up to rounding to 32-bit floats.
fn words_value(a: vec4u, b: vec4u) -> vec4f {
    let v = vec4f(a);
    let sum = ((v.x / 4294967296.0 + v.y) / 4294967296.0 + v.z) / 4294967296.0 + v.w;
    return vec4f(sum / words_top, 0.0, 0.0, 0.0);
}

/// a + b, wrapping.
fn words_add(a: vec4u, b: vec4u) -> vec4u {
    var sum = a + b;
    let over = select(vec4u(0u), vec4u(1u), sum < a);
    // A carry overflows the next word only where that is all ones.
    sum.y += over.x;
    let carry_y = over.y + select(0u, 1u, sum.y < over.x);
    sum.z += carry_y;
    let carry_z = over.z + select(0u, 1u, sum.z < carry_y);
    sum.w += carry_z;
    return sum;
}

/// a − b, wrapping.
fn words_subtract(a: vec4u, b: vec4u) -> vec4u {
    // a − b = a + ¬b + 1.
    return words_add(words_add(a, ~b), vec4u(1u, 0u, 0u, 0u));
}
