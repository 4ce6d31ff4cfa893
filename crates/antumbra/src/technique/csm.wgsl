//! needs lookup tile

/// Terms of the series, M.
const csm_terms: u32 = 16;
/// 2 · attenuation of term k ÷ c_k, for k = 1..M; a zero follows if M is odd.
const csm_weights = array<f32, 2>(0.6, 0.2);

/// (sin, cos) of the sum of two angles.
fn csm_add(a: vec2f, b: vec2f) -> vec2f {
    return vec2f(a.x * b.y + a.y * b.x, a.y * b.y - a.x * b.x);
}

/// (sin πx, cos πx) for x in [−1,1], to within 2e-7: minimax polynomials of a quarter of the angle,
/// doubled twice. WGSL only promises 2^−11 for sin and cos, which doubling would magnify, and most
/// software drivers take three times as long for them.
fn csm_half_turns(x: f32) -> vec2f {
    let u = x * x;
    let sine = x * (0.78539818 + u * (-0.080745435 + u * (0.0024900071 + u * -0.000035954508)));
    let cosine = 1.0 + u * (-0.30842514 + u * (0.015854325 + u * (-0.00032593861 + u * 0.0000035298113)));
    let quarter = vec2f(sine, cosine);
    let half = csm_add(quarter, quarter);
    return csm_add(half, half);
}

/// (sin c_k z, cos c_k z) for k = 2·layer + 1 and 2·layer + 2, with c_k = π(2k − 1) and
/// |z| ≤ 1: one sine and cosine of πz, then angles are doubled and added. `layer` is a literal where depth is encoded, so
/// that all layers share the doubling.
fn csm_basis(z: f32, layer: u32) -> vec4f {
    var first = csm_half_turns(z);
    let two = csm_add(first, first);
    let four = csm_add(two, two);
    let eight = csm_add(four, four);
    let sixteen = csm_add(eight, eight);
    if (layer & 1u) != 0u {
        first = csm_add(first, four);
    }
    if (layer & 2u) != 0u {
        first = csm_add(first, eight);
    }
    if (layer & 4u) != 0u {
        first = csm_add(first, sixteen);
    }
    if (layer & 8u) != 0u {
        first = csm_add(first, csm_add(sixteen, sixteen));
    }
    return vec4f(first, csm_add(first, two));
}

/// Terms 2·layer + 1 and 2·layer + 2 of the basis of Eq. 14, moved from [−1,1] to [0,1].
fn csm_encode(depth: f32, layer: u32) -> vec4f {
    return 0.5 + 0.5 * csm_basis(csm_span() * depth, layer);
}

/// What the terms of one layer add to the sum of Eq. 13, from the basis at the receiver's depth and
/// the stored, filtered one.
fn csm_layer(basis: vec4f, filtered: vec4f, layer: u32) -> f32 {
    let b = 2.0 * filtered - 1.0;
    return csm_weights[2u * layer] * (basis.y * b.x - basis.x * b.y)
        + csm_weights[2u * layer + 1u] * (basis.w * b.z - basis.z * b.w);
}

/// Eq. 13 over all layers: one filtered lookup each. csm_span shrinks depths so that the series'
/// second step, one half period away, stays out of reach; csm_offset, in shrunk depths, lifts lit
/// surfaces from one half to one; csm_scale steepens the step instead, or too.
fn csm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    let layers = (csm_terms + 1u) / 2u;
    let d = csm_span() * depth - csm_offset();
    let one = csm_half_turns(d);
    let two = csm_add(one, one);
    let four = csm_add(two, two);
    var basis = vec4f(one, csm_add(one, two));
    var sum = 0.5;
    for (var layer = 0u; layer < layers; layer += 1u) {
        let filtered = lookup_filtered(map, map_sampler, uv, view, tile_layer(view) * layers + layer, ddx, ddy);
        sum += csm_layer(basis, filtered, layer);
        basis = vec4f(csm_add(basis.xy, four), csm_add(basis.zw, four));
    }
    return clamp(csm_scale() * sum, 0.0, 1.0);
}
