/// n: 5 as published, 1 for levels that are equally far apart.
const quantizer_exponent: f32 = 5.0;

/// 127 (1 + (2/π · atan s)ⁿ), rounded: fine levels for steep slopes, coarse ones for gentle slopes, as 8
/// bits each [Lecocq et al. 2014, Eq. 3].
fn quantizer_encode(slope: vec2f) -> vec2u {
    let angle = atan(slope) * 0.6366197723675814;
    return vec2u(127.0 * (1.0 + sign(angle) * pow(abs(angle), vec2f(quantizer_exponent))) + 0.5);
}

/// The slope of a level: the signed n-th root inside the tangent [Lecocq et al. 2014, Eq. 4]. The
/// vertical, levels 0 and 254, is a quarter of a level less steep, so that it stays finite.
fn quantizer_decode(level: vec2f) -> vec2f {
    let power = clamp(level / 127.0 - 1.0, vec2f(-0.998), vec2f(0.998));
    return tan(1.5707963267948966 * sign(power) * pow(abs(power), vec2f(1.0 / quantizer_exponent)));
}
