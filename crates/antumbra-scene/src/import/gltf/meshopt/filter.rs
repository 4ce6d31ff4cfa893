//! What decoded vertices are turned into: directions, rotations, floats and colours.

/// Octahedral directions of 8-bit numbers: x and y, and what 1 is in place of z.
pub(super) fn octahedral_8(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(4) {
        let [x, y, z] = octahedral([0, 1, 2].map(|k| f32::from(element[k] as i8)), f32::from(i8::MAX));
        [x, y, z].into_iter().enumerate().for_each(|(k, value)| element[k] = value as i8 as u8);
    }
}

/// Octahedral directions of 16-bit numbers.
pub(super) fn octahedral_16(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(8) {
        let direction = octahedral([0, 1, 2].map(|k| f32::from(word(element, k))), f32::from(i16::MAX));
        direction.into_iter().enumerate().for_each(|(k, value)| put(element, k, value as i16));
    }
}

fn octahedral([x, y, one]: [f32; 3], max: f32) -> [i32; 3] {
    let z = one - x.abs() - y.abs();
    // The lower half is folded outwards.
    let fold = z.min(0.0);
    let x = x + if x >= 0.0 { fold } else { -fold };
    let y = y + if y >= 0.0 { fold } else { -fold };
    let scale = max / (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|value| rounded(value * scale))
}

/// Rotations: three components, and in the fourth what 1 is and, in its lowest two bits, which
/// component is missing.
pub(super) fn quaternion(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(8) {
        let [x, y, z, last] = [0, 1, 2, 3].map(|k| word(element, k));
        let one = f32::from(last | 3);
        let [x, y, z] = [x, y, z].map(f32::from);
        let w = (one * one * 2.0 - x * x - y * y - z * z).max(0.0).sqrt();
        let scale = f32::from(i16::MAX) / std::f32::consts::SQRT_2 / one;
        let missing = (last & 3) as usize;
        for (k, value) in [w, x, y, z].into_iter().enumerate() {
            put(element, (missing + k) % 4, rounded(value * scale) as i16);
        }
    }
}

/// Floats of 24 bits of mantissa and 8 of exponent.
pub(super) fn exponential(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(4) {
        let value = i32::from_le_bytes([element[0], element[1], element[2], element[3]]);
        let (mantissa, exponent) = (value << 8 >> 8, value >> 24);
        let power = f32::from_bits(((exponent + 127) as u32) << 23);
        element.copy_from_slice(&(power * mantissa as f32).to_le_bytes());
    }
}

/// Colours of 8-bit numbers: luma and two differences, alpha with what 1 is in its highest bit.
pub(super) fn color_8(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(4) {
        let [luma, co, cg, alpha] = [0, 1, 2, 3].map(|k| element[k]);
        let differences = [co, cg].map(|d| i32::from(d as i8));
        let color = color(i32::from(luma), differences, i32::from(alpha), f32::from(u8::MAX));
        color.into_iter().enumerate().for_each(|(k, value)| element[k] = value as u8);
    }
}

/// Colours of 16-bit numbers.
pub(super) fn color_16(bytes: &mut [u8]) {
    for element in bytes.chunks_exact_mut(8) {
        let [luma, co, cg, alpha] = [0, 1, 2, 3].map(|k| word(element, k));
        let unsigned = |value: i16| i32::from(value as u16);
        let differences = [co, cg].map(i32::from);
        let color = color(unsigned(luma), differences, unsigned(alpha), f32::from(u16::MAX));
        color.into_iter().enumerate().for_each(|(k, value)| put(element, k, value as i16));
    }
}

fn color(luma: i32, [co, cg]: [i32; 2], alpha: i32, max: f32) -> [i32; 4] {
    // All bits up to the highest that is set.
    let one = [1, 2, 4, 8].into_iter().fold(alpha, |bits, shift| bits | bits >> shift);
    let full = alpha << 1 & one | alpha & 1;
    let scale = max / one as f32;
    [luma + co - cg, luma + cg, luma - co - cg, full].map(|value| (value as f32 * scale + 0.5) as i32)
}

/// To the nearest whole number, halves away from zero; 0 for what is no number.
fn rounded(value: f32) -> i32 {
    (value + if value >= 0.0 { 0.5 } else { -0.5 }) as i32
}

fn word(element: &[u8], k: usize) -> i16 {
    i16::from_le_bytes([element[2 * k], element[2 * k + 1]])
}

fn put(element: &mut [u8], k: usize, value: i16) {
    element[2 * k..2 * k + 2].copy_from_slice(&value.to_le_bytes());
}
