//! needs chebyshev lookup tile

/// 1 if moments are stored by the transform for 16 bits, 0 if as they are.
const msm_transformed: u32 = 1;

/// Moments (z, z², z³, z⁴) of z in [−1,1], filtered or not, as combinations that each fill [0,1].
fn msm_transform(b: vec4f) -> vec4f {
    return vec4f(
        0.5 + 1.5 * b.x - 2.0 * b.z,
        4.0 * (b.y - b.w),
        0.5 + 0.8660254037844386 * b.x - 0.3849001794597505 * b.z,
        0.5 * (b.y + b.w),
    );
}

/// The inverse.
fn msm_restore(t: vec4f) -> vec4f {
    let odd = t.xz - 0.5;
    return vec4f(
        1.7320508075688772 * odd.y - 0.3333333333333333 * odd.x,
        t.w + 0.125 * t.y,
        1.299038105676658 * odd.y - 0.75 * odd.x,
        t.w - 0.125 * t.y,
    );
}

/// Moments of linear depth, as stored.
fn msm_encode(depth: f32, layer: u32) -> vec4f {
    let z = 2.0 * depth - 1.0;
    let square = z * z;
    let b = vec4f(z, square, square * z, square * square);
    if msm_transformed == 1u {
        return msm_transform(b);
    }
    return b;
}

/// Greatest share that a distribution can have at x: 1/(xᵀ H⁻¹ x) of x = (1, x, x²), from the
/// factors H = L D Lᵀ: below the diagonal of L first moments `b` and `l`, on that of D 1 and `d`.
fn msm_share(x: f32, b: vec2f, l: f32, d: vec2f) -> f32 {
    let first = x - b.x;
    let second = x * x - b.y - l * first;
    return 1.0 / (1.0 + first * first / d.x + second * second / d.y);
}

/// Upper bound of the lit share, in [0,1], of filtered moments at a linear depth: what lies at or
/// beyond it in the distribution of three depths that has these moments and the receiver's depth
/// among the three [Peters & Klein 2015, section 3].
fn msm_bound(depth: f32, moments: vec4f) -> f32 {
    let moment_bias = msm_moment_bias();
    let x = 2.0 * depth - 1.0;
    let b = mix(moments, vec4f(0.0, 0.4, 0.0, 0.4), moment_bias);
    // H = L D Lᵀ. The bias alone has eigenvalues of at least a fifth, so no pivot is below its share.
    let least = 0.2 * moment_bias;
    let d1 = max(b.y - b.x * b.x, least);
    let l = (b.z - b.x * b.y) / d1;
    let d = vec2f(d1, max(b.w - b.y * b.y - l * l * d1, least));
    // H c = (1, x, x²): c holds the coefficients of the polynomial whose roots are the other depths.
    let y = x - b.x;
    var c2 = (x * x - b.y - l * y) / d.y;
    let c1 = y / d.x - l * c2;
    let c0 = 1.0 - b.x * c1 - b.y * c2;
    c2 = select(c2, 1e-20, abs(c2) < 1e-20);
    // Roots without cancellation; one that has run off to infinity has no share.
    let root = sqrt(max(c1 * c1 - 4.0 * c0 * c2, 0.0));
    let q = -0.5 * (c1 + select(root, -root, c1 < 0.0));
    let one = q / c2;
    let other = c0 / select(q, 1e-20, abs(q) < 1e-20);
    let near = min(one, other);
    let far = max(one, other);
    var lit = msm_share(x, b.xy, l, d);
    if x <= near {
        lit = 1.0;
    } else if x <= far {
        lit += msm_share(far, b.xy, l, d);
    }
    return chebyshev_reduce(min(lit, 1.0), msm_reduction());
}

/// One filtered lookup.
fn msm_visibility(map: LookupMap, map_sampler: sampler, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
    var moments = lookup_filtered(map, map_sampler, uv, view, tile_layer(view), ddx, ddy);
    if msm_transformed == 1u {
        moments = msm_restore(moments);
    }
    return msm_bound(depth, moments);
}
