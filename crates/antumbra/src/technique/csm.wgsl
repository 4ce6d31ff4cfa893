//! needs lookup

/// Terms of the series, M.
const csm_terms: u32 = 16;
/// 2 · attenuation of term k ÷ c_k, for k = 1..M; a zero follows if M is odd.
const csm_weights = array<f32, 2>(0.6, 0.2);

/// (sin c_k z, cos c_k z) with c_k = π(2k − 1). Whole turns are taken off before sin and cos: WGSL
/// only promises their accuracy within ±π.
fn csm_basis(k: u32, z: f32) -> vec2f {
    let turns = (f32(k) - 0.5) * z;
    let angle = 6.283185307179586 * (turns - round(turns));
    return vec2f(sin(angle), cos(angle));
}

/// Terms 2·layer + 1 and 2·layer + 2 of the basis of Eq. 14, moved from [−1,1] to [0,1].
fn csm_encode(depths: mat3x3f, layer: u32, span: f32, offset: f32, scale: f32) -> vec4f {
    let z = span * depths[1][1];
    return 0.5 + 0.5 * vec4f(csm_basis(2u * layer + 1u, z), csm_basis(2u * layer + 2u, z));
}

/// What the terms of one layer add to the sum of Eq. 13, from their stored, filtered basis.
fn csm_layer(depth: f32, filtered: vec4f, layer: u32) -> f32 {
    let b = 2.0 * filtered - 1.0;
    let first = csm_basis(2u * layer + 1u, depth);
    let second = csm_basis(2u * layer + 2u, depth);
    return csm_weights[2u * layer] * (first.y * b.x - first.x * b.y)
        + csm_weights[2u * layer + 1u] * (second.y * b.z - second.x * b.w);
}

/// Eq. 13 over all layers: one filtered lookup each. `span` shrinks depths so that the series'
/// second step, one half period away, stays out of reach; `offset`, in shrunk depths, lifts lit
/// surfaces from one half to one; `scale` steepens the step instead, or too.
fn csm_visibility(map: texture_2d_array<f32>, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f, span: f32, offset: f32, scale: f32) -> f32 {
    let layers = (csm_terms + 1u) / 2u;
    var sum = 0.5;
    for (var layer = 0u; layer < layers; layer += 1u) {
        let filtered = lookup_filtered(map, map_sampler, uv, view * layers + layer, ddx, ddy);
        sum += csm_layer(span * depth - offset, filtered, layer);
    }
    return clamp(scale * sum, 0.0, 1.0);
}
