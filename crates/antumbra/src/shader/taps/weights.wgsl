/// Taps along one side of the grid.
const taps_width: u32 = 3;
/// Pairs of the texels along one side that bilinear taps cover, one more than taps.
const taps_pairs: u32 = 2;
/// Weight in the middle of the grid along one axis, and how fast the binary logarithm of the weights
/// falls with the squared distance in texels: 0 for a box.
const taps_bell = array<f32, 2>(0.5, 1.0);

/// Weight of tap j along one axis, 0 outside of the grid. A formula and not a table: what a loop that is
/// not written out reads from a table is slow on some drivers.
fn taps_weight(j: f32) -> f32 {
    let x = j - 0.5 * f32(taps_width - 1u);
    return select(0.0, taps_bell[0] * exp2(-taps_bell[1] * x * x), abs(x) < 0.5 * f32(taps_width));
}

/// Weights of texels j and j + 1 of the n + 1 that n bilinear taps cover along one axis: tap i,
/// `fraction` beyond texel i, gives texel i the share 1 − fraction and texel i + 1 the rest.
fn taps_pair(j: f32, fraction: f32) -> vec2f {
    let middle = taps_weight(j);
    return vec2f(mix(middle, taps_weight(j - 1.0), fraction), mix(taps_weight(j + 1.0), middle, fraction));
}
