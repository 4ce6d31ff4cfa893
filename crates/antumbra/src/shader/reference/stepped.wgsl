//! needs stored

/// Steps of the stored depth: 2^bits − 1.
const reference_steps: u32 = 65535;

/// As with exact depths, for a map that rounds its depths z to steps of 1/n: d ≤ round(n·z)/n is the
/// same as (ceil(n·d) − ½)/n ≤ z, so the exact depth is compared with that instead.
fn reference_depth(depth: f32, gain: f32) -> f32 {
    let n = f32(reference_steps);
    return stored_depth((ceil((depth + min(gain, 0.0)) * n) - 0.5) / n);
}
