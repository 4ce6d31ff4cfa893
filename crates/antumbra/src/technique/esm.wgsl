//! needs lookup tile

/// 0 if the map holds powers e^(c z), 1 if it holds z, filtered as if it held powers.
const esm_logarithms: u32 = 0;

/// What is stored of linear depth: e^(c z) [Annen et al. 2008, Eq. 3], or its logarithm over c.
fn esm_encode(depth: f32, layer: u32) -> vec4f {
    if esm_logarithms == 1u {
        return vec4f(depth, 0.0, 0.0, 0.0);
    }
    return vec4f(exp(esm_c() * depth), 0.0, 0.0, 0.0);
}

/// e^(−c d) times the filtered e^(c z) [Eq. 4]: above 1 where the kernel reaches beyond the receiver.
fn esm_ratio(depth: f32, filtered: f32) -> f32 {
    if esm_logarithms == 1u {
        return exp(min(esm_c() * (filtered - depth), 80.0));
    }
    return exp(-esm_c() * depth) * filtered;
}
