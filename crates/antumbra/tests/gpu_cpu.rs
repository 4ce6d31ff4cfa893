//! The WGSL against the same formulas in f64, on thousands of random inputs.
//!
//! Every comparison is repeated with a reference that is slightly wrong, and must then fail.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capabilities, Light, Precision, Size, Technique, technique, technique::csm, technique::esm,
    technique::evsm, technique::lvsm, technique::msm, technique::pcf::Taps, technique::poisson::Spin,
    technique::vsm,
};
use antumbra_testing::{Gpu, Trials};
use common::{Random, compute, depth_layers, depth_texture, shadow_map, texels};
use glam::{DMat4, DVec3, Vec3};

const SIZE: Size = Size::square(64);
const ROWS: usize = 4096;
/// Floats of input per invocation.
const INPUTS: usize = 16;
type Row = [f32; INPUTS];

/// Encode functions that a trial below compares.
const ENCODE_FUNCTIONS: [&str; 8] = [
    "vsm_encode",
    "csm_encode",
    "esm_encode",
    "evsm_encode",
    "msm_encode",
    "lvsm_encode",
    "packed_encode",
    "stratified_encode",
];

/// WGSL allows sin and cos this absolute error within ±π: 2^−11.
const SINE: f64 = 4.9e-4;

fn rows(seed: u64, make: impl Fn(&mut Random) -> Row) -> Vec<Row> {
    let mut random = Random::new(seed);
    (0..ROWS).map(|_| make(&mut random)).collect()
}

/// A row that begins with these values.
fn row<const N: usize>(values: [f32; N]) -> Row {
    std::array::from_fn(|i| values.get(i).copied().unwrap_or(0.0))
}

fn shadows(gpu: &Gpu, technique: &dyn Technique, seed: u64) -> antumbra::ShadowMap {
    shadow_map(gpu, technique, &depth_texture(gpu, SIZE, noise(seed)), SIZE.into())
}

fn noise(seed: u64) -> impl Fn(u32, u32) -> f32 {
    let mut random = Random::new(seed);
    let depths: Vec<f32> = (0..SIZE.width * SIZE.height).map(|_| random.unit()).collect();
    move |x, y| depths[(y * SIZE.width + x) as usize]
}

/// Runs `body`, which reads `take(i)` and writes `put(i, value)` for i < N, on every row.
fn run<const N: usize>(gpu: &Gpu, shadows: &antumbra::ShadowMap, body: &str, rows: &[Row]) -> Vec<[f32; N]> {
    let user = format!(
        "
        @group(1) @binding(0) var<storage, read> rows: array<f32>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        var<private> me: u32;
        fn take(i: u32) -> f32 {{ return rows[me * {INPUTS}u + i]; }}
        fn take2(i: u32) -> vec2f {{ return vec2f(take(i), take(i + 1u)); }}
        fn take3(i: u32) -> vec3f {{ return vec3f(take(i), take(i + 1u), take(i + 2u)); }}
        fn put(i: u32, value: f32) {{ results[me * {N}u + i] = value; }}
        fn put2(i: u32, value: vec2f) {{ put(i, value.x); put(i + 1u, value.y); }}
        fn put3(i: u32, value: vec3f) {{ put2(i, value.xy); put(i + 2u, value.z); }}
        fn put4(i: u32, value: vec4f) {{ put2(i, value.xy); put2(i + 2u, value.zw); }}
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
            if id.x * {INPUTS}u >= arrayLength(&rows) {{ return; }}
            me = id.x;
            {body}
        }}"
    );
    let input = bytemuck::cast_slice(rows.as_flattened());
    let flat = compute(gpu, shadows, &user, input, rows.len() * N, rows.len());
    flat.chunks_exact(N).map(|c| std::array::from_fn(|i| c[i])).collect()
}

/// `expected` gives values and the tolerance of each.
fn compare<const N: usize, const M: usize>(
    rows: &[Row],
    found: &[[f32; N]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> Result<(), String> {
    compare_from::<N, M>(0, rows, found, expected)
}

/// The same for the results from number `first` on.
fn compare_from<const N: usize, const M: usize>(
    first: usize,
    rows: &[Row],
    found: &[[f32; N]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> Result<(), String> {
    for (row, found) in rows.iter().zip(found) {
        let (values, tolerance) = expected(&row.map(f64::from));
        for (i, (f, e)) in found[first..].iter().zip(values).enumerate() {
            let difference = (f64::from(*f) - e).abs();
            if difference.is_nan() || difference > tolerance {
                return Err(format!("result {i}: {f} instead of {e} ± {tolerance:e} for {row:?}"));
            }
        }
    }
    Ok(())
}

/// exp: (3 + 2|x|) ulp are allowed, and c·z is rounded: 87 · (2 · 1.2e-7 + 6e-8) with some room.
fn esm_encodes_and_bounds(gpu: &Gpu) {
    const EXP: f64 = 3e-5;
    let shadows = shadows(gpu, &esm::Esm::default(), 1);
    let rows = rows(2, |r| {
        let (z, d, c) = (r.unit(), r.unit(), r.range(1.0, 87.0));
        row([z, d, c, (c * z).exp()])
    });
    let body = "
        let depths = mat3x3f(vec3f(0.0), vec3f(0.0, take(0u), 0.0), vec3f(0.0));
        put(0u, esm_encode(depths, 0u, take(2u)).x);
        put(1u, esm_bound(take(1u), take(3u), take(2u)));";
    let found = run::<2>(gpu, &shadows, body, &rows);
    let encode = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let e = esm::reference::encode(r[0], factor * r[2]);
            ([e], e * EXP)
        }
    };
    compare(&rows, &found, encode(1.0)).unwrap();
    compare(&rows, &found, encode(1.001)).unwrap_err();
    let bound = |sign: f64| move |r: &[f64; INPUTS]| ([esm::reference::bound(sign * r[1], r[3], r[2])], EXP);
    compare_from(1, &rows, &found, bound(1.0)).unwrap();
    compare_from(1, &rows, &found, bound(-1.0)).unwrap_err();
}

/// Products of numbers below one: a few roundings of 6e-8.
fn vsm_encodes(gpu: &Gpu) {
    let shadows = shadows(gpu, &vsm::Vsm::default(), 1);
    let rows = rows(3, |r| std::array::from_fn(|i| if i == 9 { r.range(0.0, 4.0) } else { r.unit() }));
    let body = "
        let depths = mat3x3f(take3(0u), take3(3u), take3(6u));
        put2(0u, vsm_encode(depths, 0u, 0.0, 0.0, take(9u)).xy);";
    let found = run::<2>(gpu, &shadows, body, &rows);
    let moments = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let depths = std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j]));
            (vsm::reference::encode(depths, factor * r[9]), 1e-6)
        }
    };
    compare(&rows, &found, moments(1.0)).unwrap();
    compare(&rows, &found, moments(1.001)).unwrap_err();
}

/// The variance is a difference of numbers up to one, rounded by 1.2e-7 altogether; the bound
/// changes with it by at most 1/(4σ²), which the reduction stretches by 1/(1 − r).
fn vsm_and_chebyshev_bound(gpu: &Gpu) {
    let shadows = shadows(gpu, &vsm::Vsm::default(), 1);
    let rows = rows(4, |r| {
        let (mean, variance) = (r.unit(), 10f32.powf(r.range(-6.0, -1.0)));
        let least = 10f32.powf(r.range(-5.0, -2.0));
        row([r.unit(), mean, mean * mean + variance, least, r.range(0.0, 0.9)])
    });
    let body = "
        put(0u, vsm_bound(take(0u), take2(1u), take(3u), take(4u)));
        put(1u, chebyshev_bound(take(0u), take2(1u), take(3u)));
        put(2u, chebyshev_reduce(take(0u), take(4u)));";
    let found = run::<3>(gpu, &shadows, body, &rows);
    let bound = |least: f64, reduction: f64| {
        move |r: &[f64; INPUTS]| {
            let v = vsm::reference::bound(r[0], [r[1], r[2]], least * r[3], reduction * r[4]);
            let rounding = 1.2e-7 / (4.0 * r[3].max(r[2] - r[1] * r[1]));
            ([v], (rounding + 1e-6) / (1.0 - reduction * r[4]))
        }
    };
    compare(&rows, &found, bound(1.0, 1.0)).unwrap();
    compare(&rows, &found, bound(1.1, 1.0)).unwrap_err();
    compare(&rows, &found, bound(1.0, 1.01)).unwrap_err();
    compare_from(1, &rows, &found, bound(1.0, 0.0)).unwrap();
    compare_from(1, &rows, &found, bound(1.1, 0.0)).unwrap_err();
    let reduce = |r: &[f64; INPUTS]| ([((r[0] - r[4]) / (1.0 - r[4])).clamp(0.0, 1.0)], 1e-5);
    compare_from(2, &rows, &found, reduce).unwrap();
}

/// exp: as for esm, with exponents up to 42. The bound's variance is a difference of squares that
/// are that uncertain, over its floor; so is the distance to the mean, over its standard deviation.
fn evsm_encodes_and_bounds(gpu: &Gpu) {
    const EXP: f64 = 2e-5;
    let plain = evsm::Evsm { negative: 40.0, ..evsm::Evsm::default() };
    for (evsm, warps) in [
        (plain, 2),
        (evsm::Evsm { moments: evsm::Moments::Two, ..plain }, 1),
        (evsm::Evsm { format: evsm::Format::Float16, negative: 0.0, reduction: 0.2, ..plain }, 2),
    ] {
        let spec = technique::spec(&evsm);
        let shadows = shadows(gpu, &evsm, 1);
        let c = evsm.exponents().map(f64::from);
        // Two casters, mixed: some close together and close to the receiver.
        let rows = rows(13, |r| {
            let (far, share) = (r.unit(), f64::from(r.unit()));
            let near = far * r.unit().sqrt();
            let depth = (far + 0.2 * r.range(-1.0, 1.0)).clamp(0.0, 1.0);
            let [a, b] = [near, far].map(|z| evsm::reference::encode(z.into(), c));
            let m: [f64; 4] = std::array::from_fn(|i| a[i] + share * (b[i] - a[i]));
            row([depth, m[0] as f32, m[1] as f32, m[2] as f32, m[3] as f32])
        });
        let body = "
            let depths = mat3x3f(vec3f(0.0), vec3f(0.0, take(0u), 0.0), vec3f(0.0));
            let c = vec2f(shadow.setting_positive, shadow.setting_negative);
            let least = vec3f(shadow.setting_least_variance, shadow.setting_rounding, shadow.setting_denormal);
            let reduction = shadow.setting_reduction;
            put4(0u, evsm_encode(depths, 0u, c.x, c.y, least.x, least.y, least.z, reduction));
            let moments = vec4f(take2(1u), take2(3u));
            put(4u, evsm_bound(take(0u), moments, c.x, c.y, least.x, least.y, least.z, reduction));";
        let found = run::<5>(gpu, &shadows, body, &rows);
        for (i, moment) in ["e", "e²", "−e", "e²"].iter().enumerate() {
            let encode = |factor: f64| {
                move |r: &[f64; INPUTS]| {
                    let e = evsm::reference::encode(r[0], c.map(|c| c * factor))[i];
                    ([e], e.abs() * 2.0 * EXP)
                }
            };
            let one: Vec<[f32; 1]> = found.iter().map(|f| [f[i]]).collect();
            compare(&rows, &one, encode(1.0)).unwrap_or_else(|e| panic!("{spec} {moment}: {e}"));
            compare(&rows, &one, encode(1.001)).unwrap_err();
        }
        let bound = |offset: f64| {
            move |r: &[f64; INPUTS]| {
                let bounds = evsm::reference::bounds(&evsm, r[0] + offset, [r[1], r[2], r[3], r[4]]);
                let reduction = f64::from(evsm.reduction);
                let v = bounds[..warps].iter().fold(1.0, |a: f64, b| a.min(*b));
                // Least relative variance of both formats' floors: 5.8e-3.
                let error = 2.0 * EXP / 5e-3 + 2.0 * EXP / 5e-3f64.sqrt();
                ([((v - reduction) / (1.0 - reduction)).max(0.0)], error / (1.0 - reduction))
            }
        };
        compare_from(4, &rows, &found, bound(0.0)).unwrap_or_else(|e| panic!("{spec}: {e}"));
        compare_from(4, &rows, &found, bound(0.003)).unwrap_err();
    }
}

/// The bound is as uncertain as rounding of the moments makes it, which is found by trying.
fn msm_encodes_and_bounds(gpu: &Gpu) {
    use msm::reference;
    const BIAS: f64 = 1e-3;
    let shadows = shadows(gpu, &msm::Msm::default(), 1);
    // Three casters, mixed.
    let rows = rows(14, |r| {
        let z = [r.unit(), r.unit(), r.unit()].map(|z| reference::moments(z.into()));
        let (a, b) = (f64::from(r.unit()), f64::from(r.unit()));
        let m: [f64; 4] =
            std::array::from_fn(|i| a * z[0][i] + (1.0 - a) * (b * z[1][i] + (1.0 - b) * z[2][i]));
        row([r.unit(), m[0] as f32, m[1] as f32, m[2] as f32, m[3] as f32, r.range(0.0, 0.5)])
    });
    let body = "
        let depths = mat3x3f(vec3f(0.0), vec3f(0.0, take(0u), 0.0), vec3f(0.0));
        let moments = vec4f(take2(1u), take2(3u));
        put4(0u, msm_encode(depths, 0u, 0.0, 0.0));
        put4(4u, msm_restore(msm_transform(moments)));
        put(8u, msm_bound(take(0u), moments, 1e-3, take(5u)));";
    let found = run::<9>(gpu, &shadows, body, &rows);
    let encode = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let t = reference::apply(reference::transform(), reference::moments(factor * r[0]));
            (std::array::from_fn(|i| t[i] + reference::SHIFT[i]), 2e-6)
        }
    };
    compare::<9, 4>(&rows, &found, encode(1.0)).unwrap();
    compare::<9, 4>(&rows, &found, encode(1.001)).unwrap_err();
    let restored = |sign: f64| move |r: &[f64; INPUTS]| ([r[1], r[2], sign * r[3], r[4]], 2e-6);
    compare_from(4, &rows, &found, restored(1.0)).unwrap();
    compare_from(4, &rows, &found, restored(1.001)).unwrap_err();
    let bound = |offset: f64| {
        move |r: &[f64; INPUTS]| {
            let m = [r[1], r[2], r[3], r[4]];
            let at = |d: f64, m| {
                let v = reference::bound(d, m, BIAS).clamp(0.0, 1.0);
                ((v - r[5]) / (1.0 - r[5])).max(0.0)
            };
            let v = at(r[0] + offset, m);
            let moved = |i: usize| {
                let shift = |s: f64| std::array::from_fn(|j| m[j] + if i == j { s } else { 0.0 });
                (at(r[0], shift(3e-7)) - at(r[0], m)).abs().max((at(r[0], shift(-3e-7)) - at(r[0], m)).abs())
            };
            ([v], 1e-5 + (0..4).map(moved).sum::<f64>())
        }
    };
    compare_from(8, &rows, &found, bound(0.0)).unwrap();
    compare_from(8, &rows, &found, bound(0.001)).unwrap_err();
}

/// As for vsm, with depth stretched by up to 7 and rounded as much more.
fn lvsm_encodes_and_bounds(gpu: &Gpu) {
    let lvsm = lvsm::Lvsm { intervals: 7, overlap: 0.25, least_variance: 1e-4, ..lvsm::Lvsm::default() };
    let shadows = shadows(gpu, &lvsm, 1);
    let rows = rows(15, |r| {
        let (mean, variance) = (r.unit(), 10f32.powf(r.range(-6.0, -1.0)));
        row([r.unit(), mean, mean * mean + variance, (r.unit() * 8.0).floor()])
    });
    let body = "
        let depths = mat3x3f(vec3f(0.0), vec3f(0.0, take(0u), 0.0), vec3f(0.0));
        let i = u32(take(3u));
        let pair = lvsm_encode(depths, i / 2u, 0.25, 1e-4, 0.0);
        put2(0u, select(pair.xy, pair.zw, i % 2u == 1u));
        put(2u, lvsm_one(take(0u), take2(1u), i, 0.25, 1e-4));";
    let found = run::<3>(gpu, &shadows, body, &rows);
    let encode = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let w = lvsm::reference::warp(&lvsm, factor * r[0], r[3] as u32);
            ([w, w * w], 5e-6)
        }
    };
    compare::<3, 2>(&rows, &found, encode(1.0)).unwrap();
    compare::<3, 2>(&rows, &found, encode(1.001)).unwrap_err();
    let bound = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            ([lvsm::reference::bound(&lvsm, factor * r[0], [r[1], r[2]], r[3] as u32)], 2e-4)
        }
    };
    compare_from(2, &rows, &found, bound(1.0)).unwrap();
    compare_from(2, &rows, &found, bound(1.005)).unwrap_err();
}

/// Every layer's sum, from the stored form, is the series. Each term errs by two products of sines; the weights of 16 terms sum to 1.5.
fn csm_sums_its_series(gpu: &Gpu) {
    let settings = [
        csm::Csm::default(),
        csm::Csm { terms: 5, attenuation: 0.0, ..csm::Csm::default() },
        csm::Csm { terms: 1, ..csm::Csm::default() },
    ];
    for csm in settings {
        let shadows = shadows(gpu, &csm, 1);
        let rows = rows(5, |r| row([r.unit(), r.unit(), 1.0 + (r.unit() * 16.0).floor()]));
        let body = "
            let depths = mat3x3f(vec3f(0.0), vec3f(0.0, take(0u), 0.0), vec3f(0.0));
            put2(0u, csm_basis(u32(take(2u)), take(0u)));
            var sum = 0.5;
            for (var layer = 0u; layer < (csm_terms + 1u) / 2u; layer += 1u) {
                let stored = csm_encode(depths, layer, 1.0, 0.0, 1.0);
                sum += csm_layer(take(1u), stored, layer);
            }
            put(2u, sum);";
        let found = run::<3>(gpu, &shadows, body, &rows);
        let basis = |factor: f64| {
            move |r: &[f64; INPUTS]| (csm::reference::basis(r[2] as u32, factor * r[0]), SINE + 1e-5)
        };
        compare(&rows, &found, basis(1.0)).unwrap();
        compare(&rows, &found, basis(1.001)).unwrap_err();
        let series = |sign: f64| {
            move |r: &[f64; INPUTS]| {
                let v = csm::reference::series(&csm, r[1], r[0]) - 0.5;
                ([0.5 + sign * v], 4.0 * SINE)
            }
        };
        compare_from(2, &rows, &found, series(1.0)).unwrap();
        // Eq. 11 of the paper, whose sign is reversed.
        compare_from(2, &rows, &found, series(-1.0)).unwrap_err();
        compare_from(2, &rows, &found, series(1.01)).unwrap_err();
    }
}

/// A depth z is rounded by 6e-8, which the curve of a perspective depth magnifies by 1/(1 − (1 − r)z).
fn raster_depth_is_linearised(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    // r = near/far; z projected depth; l linear depth.
    let rows = rows(6, |r| row([r.unit(), 10f32.powf(r.range(-3.0, 0.0)), r.unit()]));
    let body = "
        put(0u, raster_linear(take(0u), take(1u)));
        put(1u, raster_slope(take(2u), take(1u)));";
    let found = run::<2>(gpu, &shadows, body, &rows);
    // From distances: with far = 1, z = (1 − r/w)/(1 − r), linear depth (w − r)/(1 − r).
    let linear = |factor: f64| {
        move |row: &[f64; INPUTS]| {
            let (z, r) = (row[0], row[1] * factor);
            let w = r / (1.0 - z * (1.0 - r));
            let l = (w - r) / (1.0 - r).max(1e-12);
            ([l], 1e-6 + 3e-7 * l / (1.0 - (1.0 - r) * z))
        }
    };
    compare(&rows, &found, linear(1.0)).unwrap();
    compare(&rows, &found, linear(1.001)).unwrap_err();
    let projected = |l: f64, r: f64| l / (r + l * (1.0 - r));
    let slope = |factor: f64| {
        move |row: &[f64; INPUTS]| {
            let (h, l, r) = (1e-7, row[2], row[1] * factor);
            let s = (projected(l + h, r) - projected(l - h, r)) / (2.0 * h);
            ([s], 1e-5 * s)
        }
    };
    compare_from(1, &rows, &found, slope(1.0)).unwrap();
    compare_from(1, &rows, &found, slope(1.001)).unwrap_err();
}

/// Not a number, infinities and depths out of range become the far plane; the rest stays, exactly.
fn raster_depth_is_cleaned(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, -1e-6, -3.0, 1.000_001, 7.0];
    let good = [0.0, 1.0, 0.5, 1e-30, 0.999_999];
    let rows: Vec<Row> = odd.iter().chain(&good).map(|z| row([*z])).collect();
    let found = run::<1>(gpu, &shadows, "put(0u, raster_clean(take(0u)));", &rows);
    let expected: Vec<[f32; 1]> = odd.iter().map(|_| [1.0]).chain(good.map(|z| [z])).collect();
    assert_eq!(found, expected);
}

/// Positions up to 4, distances of 8 to 16: a few roundings, none magnified.
fn receivers_are_projected(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let bounds = antumbra::Bounds { min: Vec3::splat(-4.0), max: Vec3::splat(4.0) };
    let spot = Light::Spot {
        position: Vec3::new(1.0, 12.0, 2.0),
        direction: Vec3::new(0.1, -1.0, 0.2),
        outer_angle: 0.6,
    };
    let fit = antumbra::Fit {
        casters: bounds,
        receivers: bounds.corners().collect(),
        size: SIZE,
        margin_texels: 2.0,
    };
    let matrix = spot.view(&fit).unwrap().clip_from_world;
    let m: Vec<String> = matrix.to_cols_array().iter().map(|v| format!("{v:?}")).collect();
    let rows = rows(7, |r| {
        let n = Vec3::new(r.range(-1.0, 1.0), r.range(-1.0, 1.0), r.range(-1.0, 1.0)).normalize();
        let p = Vec3::new(r.range(-4.0, 4.0), r.range(-4.0, 4.0), r.range(-4.0, 4.0));
        row([p.x, p.y, p.z, n.x, n.y, n.z])
    });
    let body = format!(
        "
        let matrix = mat4x4f({});
        let ndc = receiver_project(matrix, take3(0u));
        put4(0u, ndc);
        put3(4u, receiver_gradient(matrix, ndc, take3(3u)));
        put2(7u, receiver_uv(ndc.xy));
        put3(9u, receiver_tangent(take3(3u)));",
        m.join(", ")
    );
    let found = run::<12>(gpu, &shadows, &body, &rows);
    let matrix = matrix.as_dmat4();
    let project = |matrix: DMat4, p: DVec3| {
        let c = matrix * p.extend(1.0);
        (c.truncate() / c.w).extend(c.w)
    };
    let point = |r: &[f64; INPUTS]| (DVec3::new(r[0], r[1], r[2]), DVec3::new(r[3], r[4], r[5]));
    let ndc = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            (project(matrix * DMat4::from_scale(DVec3::splat(factor)), point(r).0).to_array(), 5e-6)
        }
    };
    compare(&rows, &found, ndc(1.0)).unwrap();
    compare(&rows, &found, ndc(1.001)).unwrap_err();
    let gradient = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let ((p, n), h) = (point(r), 1e-5);
            let change = (project(matrix, p + n * h) - project(matrix, p - n * h)) / (2.0 * h);
            ((change.truncate() * factor).to_array(), 2e-6)
        }
    };
    compare_from(4, &rows, &found, gradient(1.0)).unwrap();
    compare_from(4, &rows, &found, gradient(1.001)).unwrap_err();
    let uv = |r: &[f64; INPUTS]| {
        let ndc = project(matrix, point(r).0);
        ([0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y], 5e-6)
    };
    compare_from(7, &rows, &found, uv).unwrap();
    for (r, f) in rows.iter().zip(&found) {
        let (n, t) = (Vec3::new(r[3], r[4], r[5]), Vec3::new(f[9], f[10], f[11]));
        assert!((t.length() - 1.0).abs() < 1e-5 && n.dot(t).abs() < 1e-5, "tangent {t} of {n}");
    }
}

/// The gradient g of depth solves g·duv = ddepth along both tangents; a plane seen edge-on has none,
/// but its components stay finite and within the bound.
fn receiver_planes_are_solved(gpu: &Gpu) {
    const STEEPEST: f32 = 20.0;
    let shadows = shadows(gpu, &technique::Hard::default(), 1);
    let mut rows = rows(8, |r| {
        let mut values = row([0.0; 1]);
        values[..6].fill_with(|| r.range(-1.0, 1.0));
        values
    });
    // Edge-on: both tangents along one line, one of no length, both.
    let edge_on = rows.len();
    rows.push(row([0.3, 0.2, 0.6, 0.4, 0.5, 0.1]));
    rows.push(row([0.3, 0.2, 0.0, 0.0, 0.5, 0.1]));
    rows.push(row([0.0, 0.0, 0.0, 0.0, 0.5, -0.1]));
    rows.push(row([0.0; 1]));
    rows.push(row([1e-20, 0.0, 0.0, 1e-20, 1.0, 1.0]));
    let body = format!(
        "put2(0u, receiver_plane(take2(0u), take2(2u), take2(4u), vec2f({STEEPEST:?}, {STEEPEST:?})));"
    );
    let found = run::<2>(gpu, &shadows, &body, &rows);
    assert!(found.as_flattened().iter().all(|g| g.abs() <= STEEPEST), "a plane without bound");
    let solve = |factor: f64| {
        move |r: &[f64; INPUTS]| {
            let area = r[0] * r[3] - r[1] * r[2];
            let g = [(r[4] * r[3] - r[5] * r[1]) / area, (r[5] * r[0] - r[4] * r[2]) / area];
            let s = f64::from(STEEPEST);
            // Rounding of the products, divided by the area.
            (g.map(|g| (factor * g).clamp(-s, s)), 1e-6 + 2e-6 * (1.0 + s) / area.abs())
        }
    };
    compare(&rows[..edge_on], &found[..edge_on], solve(1.0)).unwrap();
    compare(&rows[..edge_on], &found[..edge_on], solve(1.01)).unwrap_err();
    let residual = |r: &Row, g: &[f32; 2]| {
        let along = |i: usize| g[0] * r[2 * i] + g[1] * r[2 * i + 1] - r[4 + i];
        along(0).abs().max(along(1).abs())
    };
    let within = |g: &[f32; 2]| g.iter().all(|g| g.abs() < STEEPEST);
    for (r, g) in rows[..edge_on].iter().zip(&found).filter(|(_, g)| within(g)) {
        assert!(residual(r, g) < 1e-3, "{g:?} for {r:?}");
    }
}

/// Weights of GPUs' samplers have 8 bits; software drivers' are floats.
fn sampler_error(gpu: &Gpu) -> f64 {
    if gpu.info.device_type == wgpu::DeviceType::Cpu { 1e-5 } else { 4e-3 }
}

/// Texel (x, y) of an image, edges repeated.
fn clamped(x: f64, y: f64, side: usize) -> usize {
    let index = |v: f64| v.clamp(0.0, side as f64 - 1.0) as usize;
    index(y) * side + index(x)
}

/// Bilinear interpolation of `image(index)` over a square of `side` texels.
fn bilinear(u: f64, v: f64, side: usize, image: impl Fn(usize) -> f64) -> f64 {
    let (x, y) = (u * side as f64 - 0.5, v * side as f64 - 0.5);
    let (fx, fy) = (x - x.floor(), y - y.floor());
    let at = |dx: f64, dy: f64| image(clamped(x.floor() + dx, y.floor() + dy, side));
    let top = at(0.0, 0.0) * (1.0 - fx) + at(1.0, 0.0) * fx;
    let bottom = at(0.0, 1.0) * (1.0 - fx) + at(1.0, 1.0) * fx;
    top * (1.0 - fy) + bottom * fy
}

/// The share of rows that differ: a depth within rounding of a texel's may fall on either side.
fn strays<const M: usize>(
    rows: &[Row],
    found: &[[f32; M]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> usize {
    let differs = |i: &usize| compare(&rows[*i..=*i], &found[*i..=*i], &expected).is_err();
    (0..rows.len()).filter(differs).count()
}

/// Places of a receiver, its depth, its plane, and its footprint, which is up to a few texels.
fn tilted_receivers(seed: u64) -> Vec<Row> {
    rows(seed, |r| {
        let mut side = || r.range(-3.0, 3.0) / 64.0;
        let footprint: [f32; 4] = std::array::from_fn(|_| side());
        let [a, b, c, d] = footprint;
        row([r.unit(), r.unit(), r.unit(), r.range(-2.0, 2.0), r.range(-2.0, 2.0), a, b, c, d])
    })
}

/// Asks a technique's function alone, without the glue.
fn ask(gpu: &Gpu, technique: &dyn Technique, uniforms: &str, rows: &[Row]) -> Vec<[f32; 1]> {
    let name = technique.page().name;
    let body = format!(
        "put(0u, {name}_visibility(shadow_binding_0, shadow_binding_1, take2(0u), 0u, take(2u), take2(3u), take2(5u), take2(7u){uniforms}));"
    );
    run::<1>(gpu, &shadows(gpu, technique, 9), &body, rows)
}

/// A comparison technique in f64, over the depth texels of [`shadows`] with seed 9. Wrong on purpose
/// where a share is not 1, or downhill not 0.
struct Comparisons {
    depths: Vec<f64>,
    /// Share of the plane that is followed uphill.
    uphill: f64,
    /// The same downhill.
    downhill: f64,
    /// Steps of the stored depth.
    steps: Option<f64>,
}

impl Comparisons {
    fn new() -> Self {
        let depth = noise(9);
        let texels = (0..64).flat_map(|y| (0..64).map(move |x| (x, y)));
        let depths = texels.map(|(x, y)| f64::from(depth(x, y))).collect();
        Self { depths, uphill: 1.0, downhill: 0.0, steps: None }
    }

    /// The receiver's depth for texels around `place` (uv), whose highest is `spread` texels away.
    fn reference(&self, r: &[f64; INPUTS], place: [f64; 2], spread: f64) -> f64 {
        let rise = r[3] * (place[0] - r[0]) + r[4] * (place[1] - r[1]);
        let rise = rise - spread / 64.0 * (r[3].abs() + r[4].abs());
        r[2] + self.uphill * rise.min(0.0) + self.downhill * rise.max(0.0)
    }

    fn test(&self, reference: f64, texel: usize) -> f64 {
        let z = self.steps.map_or(self.depths[texel], |n| (self.depths[texel] * n).round() / n);
        if reference <= z { 1.0 } else { 0.0 }
    }

    /// The texel that contains a place, compared at its centre.
    fn nearest(&self, r: &[f64; INPUTS], place: [f64; 2]) -> f64 {
        let texel = place.map(|p| (p * 64.0).floor());
        let reference = self.reference(r, texel.map(|t| (t + 0.5) / 64.0), 0.0);
        self.test(reference, clamped(texel[0], texel[1], 64))
    }

    /// The four texels around a place, all compared with the plane over the highest.
    fn bilinear(&self, r: &[f64; INPUTS], place: [f64; 2]) -> f64 {
        let corner = place.map(|p| ((p * 64.0 - 0.5).floor() + 1.0) / 64.0);
        let reference = self.reference(r, corner, 0.5);
        bilinear(place[0], place[1], 64, |texel| self.test(reference, texel))
    }

    /// Weighted lookups at places in texels from the receiver.
    fn sum(
        &self,
        r: &[f64; INPUTS],
        taps: impl Iterator<Item = ([f64; 2], f64)>,
        lookup: impl Fn(&Self, &[f64; INPUTS], [f64; 2]) -> f64,
    ) -> f64 {
        taps.map(|([x, y], w)| w * lookup(self, r, [r[0] + x / 64.0, r[1] + y / 64.0])).sum()
    }
}

/// Taps of a grid, a texel apart.
fn grid(weights: &[f64]) -> impl Iterator<Item = ([f64; 2], f64)> {
    let middle = (weights.len() as f64 - 1.0) / 2.0;
    let axis = move |i: usize| i as f64 - middle;
    let pairs = (0..weights.len()).flat_map(move |j| (0..weights.len()).map(move |i| (i, j)));
    pairs.map(move |(i, j)| ([axis(i), axis(j)], weights[i] * weights[j]))
}

/// What is right is right but for a handful of rows; what is wrong differs in many.
fn holds<const M: usize, F: Fn(&[f64; INPUTS]) -> ([f64; M], f64)>(
    what: &str,
    rows: &[Row],
    found: &[[f32; M]],
    right: F,
    wrong: &[(&str, F)],
) {
    let count = strays(rows, found, &right);
    assert!(count <= 6, "{what}: {count} rows differ");
    for (why, wrong) in wrong {
        let count = strays(rows, found, wrong);
        assert!(count > 50, "{what}: {why} went unnoticed but in {count} rows");
    }
}

type Sum = Box<dyn Fn(&[f64; INPUTS]) -> ([f64; 1], f64)>;

/// The whole kernel on a tilted receiver, as a sum over the depth texels.
fn pcf_is_a_weighted_sum(gpu: &Gpu) {
    let rows = tilted_receivers(10);
    let error = sampler_error(gpu);
    for (kernel, taps) in [(4, Taps::Bilinear), (5, Taps::Bilinear), (4, Taps::Nearest), (5, Taps::Nearest)] {
        let pcf = technique::Pcf { kernel, taps, ..technique::Pcf::default() };
        let found = ask(gpu, &pcf, "", &rows);
        let weights: Vec<f64> =
            antumbra::Kernel::new(pcf.weights, kernel, 0.0).taps.iter().map(|w| f64::from(*w)).collect();
        let sum = |comparisons: Comparisons, weights: Vec<f64>, shift: f64| -> Sum {
            Box::new(move |r| {
                let taps = grid(&weights).map(|([x, y], w)| ([x + shift, y], w));
                let lookup = if taps_are_nearest(pcf) { Comparisons::nearest } else { Comparisons::bilinear };
                ([comparisons.sum(r, taps, lookup)], error)
            })
        };
        let dropped = [&[0.0], &weights[1..]].concat();
        let brighter = weights.iter().map(|w| w * 1.02).collect();
        let plain = || weights.clone();
        let wrong = [
            ("a flatter plane", sum(Comparisons { uphill: 0.8, ..Comparisons::new() }, plain(), 0.0)),
            (
                "a plane followed downhill",
                sum(Comparisons { downhill: 1.0, ..Comparisons::new() }, plain(), 0.0),
            ),
            ("half a texel aside", sum(Comparisons::new(), plain(), 0.5)),
            ("a row and a column of taps dropped", sum(Comparisons::new(), dropped, 0.0)),
            ("weights that do not sum to one", sum(Comparisons::new(), brighter, 0.0)),
        ];
        holds(&technique::spec(&pcf), &rows, &found, sum(Comparisons::new(), plain(), 0.0), &wrong);
    }
}

fn taps_are_nearest(pcf: technique::Pcf) -> bool {
    pcf.taps == Taps::Nearest
}

/// Merged and gathered taps give what bilinear ones give, for any number of them: to rounding where the
/// receiver faces the light, else each texel is compared with one group's plane instead of four taps'.
fn taps_agree(gpu: &Gpu) {
    let facing: Vec<Row> = tilted_receivers(16).iter().map(|r| row([r[0], r[1], r[2], 0.0, 0.0])).collect();
    for kernel in [1, 2, 3, 6, 7, 16] {
        for weights in [antumbra::Weights::Gaussian, antumbra::Weights::Box] {
            let with =
                |taps, sigma| technique::Pcf { kernel, weights, taps, sigma, ..technique::Pcf::default() };
            let one_by_one = ask(gpu, &with(Taps::Bilinear, 0.0), "", &facing);
            for taps in [Taps::Merged, Taps::Gather] {
                let found = ask(gpu, &with(taps, 0.0), "", &facing);
                let differ = |a: &[[f32; 1]], b: &[[f32; 1]]| {
                    let error = sampler_error(gpu) as f32;
                    std::iter::zip(a, b).filter(|(a, b)| (a[0] - b[0]).abs() > error).count()
                };
                let count = differ(&found, &one_by_one);
                assert!(count <= 6, "{count} rows differ for {:?}", with(taps, 0.0));
                if kernel > 2 && weights == antumbra::Weights::Gaussian {
                    let count = differ(&ask(gpu, &with(taps, 3.0), "", &facing), &one_by_one);
                    assert!(count > 1000, "another kernel differs in {count} rows only");
                }
            }
        }
    }
}

/// On tilted receivers too, each group of 2×2 texels compares the plane over the highest of them.
fn merged_taps_follow_the_plane(gpu: &Gpu) {
    let rows = tilted_receivers(17);
    let error = sampler_error(gpu);
    for (kernel, taps) in [(5_u32, Taps::Merged), (5, Taps::Gather), (4, Taps::Gather)] {
        let pcf = technique::Pcf { kernel, taps, ..technique::Pcf::default() };
        let found = ask(gpu, &pcf, "", &rows);
        let weights: Vec<f64> =
            antumbra::Kernel::new(pcf.weights, kernel, 0.0).taps.iter().map(|w| f64::from(*w)).collect();
        let sum = |comparisons: Comparisons| -> Sum {
            let weights = weights.clone();
            Box::new(move |r| {
                let first = [0, 1].map(|axis| (r[axis] * 64.0 - weights.len() as f64 / 2.0).floor());
                let share = |axis: usize, j: usize| {
                    let f = r[axis] * 64.0 - weights.len() as f64 / 2.0 - first[axis];
                    let tap = |j: Option<usize>| j.and_then(|j| weights.get(j)).copied().unwrap_or(0.0);
                    tap(Some(j)) * (1.0 - f) + tap(j.checked_sub(1)) * f
                };
                let texels = 0..=weights.len();
                let lit = texels.clone().flat_map(|j| texels.clone().map(move |i| (i, j))).map(|(i, j)| {
                    let corner =
                        [(0, i), (1, j)].map(|(axis, i)| (first[axis] + (i - i % 2) as f64 + 1.0) / 64.0);
                    let reference = comparisons.reference(r, corner, 0.5);
                    let texel = clamped(first[0] + i as f64, first[1] + j as f64, 64);
                    share(0, i) * share(1, j) * comparisons.test(reference, texel)
                });
                ([lit.sum()], error)
            })
        };
        let wrong = [
            ("a flatter plane", sum(Comparisons { uphill: 0.8, ..Comparisons::new() })),
            ("a plane followed downhill", sum(Comparisons { downhill: 1.0, ..Comparisons::new() })),
        ];
        holds(&technique::spec(&pcf), &rows, &found, sum(Comparisons::new()), &wrong);
    }
}

/// The four lookups are the convolution of 16 comparisons with the B-spline.
fn bicubic_is_a_convolution(gpu: &Gpu) {
    let rows = tilted_receivers(18);
    let bicubic = technique::Bicubic::default();
    let found = ask(gpu, &bicubic, "", &rows);
    let error = sampler_error(gpu);
    let sum = |scale: f64, shift: f64| -> Sum {
        let comparisons = Comparisons::new();
        Box::new(move |r| {
            let low = [0, 1].map(|axis| (r[axis] * 64.0 - 0.5).floor() - 1.0);
            let texels = (0..4).flat_map(|j| (0..4).map(move |i| [i, j]));
            let lit = texels.map(|offset: [u32; 2]| {
                let texel = [0, 1].map(|axis| low[axis] + f64::from(offset[axis]));
                let away = [0, 1].map(|axis| texel[axis] + 0.5 + shift - r[axis] * 64.0);
                let corner = [0, 1].map(|axis| (texel[axis] - f64::from(offset[axis] % 2) + 1.0) / 64.0);
                let weight = away.map(|x| technique::bicubic::reference::spline(x / scale) / scale);
                let reference = comparisons.reference(r, corner, 0.5);
                weight[0] * weight[1] * comparisons.test(reference, clamped(texel[0], texel[1], 64))
            });
            ([lit.sum()], error)
        })
    };
    let wrong = [("half a texel aside", sum(1.0, 0.5)), ("a wider spline", sum(1.02, 0.0))];
    holds("bicubic", &rows, &found, sum(1.0, 0.0), &wrong);
}

/// The mean over the disk, turned or not.
fn poisson_is_the_mean_of_its_disk(gpu: &Gpu) {
    let rows = tilted_receivers(19);
    let error = sampler_error(gpu);
    for spin in [Spin::Fixed, Spin::Noise] {
        let poisson = technique::Poisson { points: 11, spin, ..technique::Poisson::default() };
        let found = ask(gpu, &poisson, ", 2.5", &rows);
        let disk = technique::poisson::reference::disk(11);
        let sum = |count: usize, radius: f64, turned: bool| -> Sum {
            let (comparisons, disk) = (Comparisons::new(), disk.clone());
            Box::new(move |r| {
                let turn = if turned {
                    technique::poisson::reference::turn([r[0], r[1]], [r[5], r[6]], [r[7], r[8]])
                } else {
                    0.0
                };
                let turn = glam::DVec2::from_angle(std::f64::consts::TAU * turn) * radius;
                let taps = disk[..count].iter().map(|p| (turn.rotate(*p).to_array(), 1.0 / count as f64));
                (
                    [comparisons.sum(r, taps, Comparisons::bilinear)],
                    error.max(if turned { 2e-3 } else { 0.0 }),
                )
            })
        };
        let turned = spin == Spin::Noise;
        let wrong = [
            ("a point dropped", sum(10, 2.5, turned)),
            ("another radius", sum(11, 2.6, turned)),
            ("the other spin", sum(11, 2.5, !turned)),
        ];
        let right = sum(11, 2.5, turned);
        if !turned {
            holds("a fixed disk", &rows, &found, right, &wrong);
            continue;
        }
        // The noise magnifies rounding of the pixel's place by some 50: most pixels agree.
        let count = strays(&rows, &found, &right);
        assert!(count < rows.len() / 5, "a turned disk: {count} rows differ");
        for (why, wrong) in &wrong {
            let count = strays(&rows, &found, wrong);
            assert!(count > rows.len() / 2, "{why} went unnoticed but in {count} rows");
        }
    }
}

/// The mean over the parallelogram, with as many lookups as texels or as the budget allows.
fn footprint_is_the_mean_of_its_pixel(gpu: &Gpu) {
    let rows: Vec<Row> = tilted_receivers(20)
        .into_iter()
        // The number of lookups jumps where a side is a whole number of texels.
        .filter(|r| {
            let clear = |x: f32, y: f32| {
                let texels = 64.0 * x.hypot(y);
                (texels - texels.round()).abs() > 1e-3
            };
            clear(r[5], r[6]) && clear(r[7], r[8])
        })
        .collect();
    let error = sampler_error(gpu);
    for budget in [256_u32, 5] {
        let footprint = technique::Footprint { budget, ..technique::Footprint::default() };
        let found = ask(gpu, &footprint, "", &rows);
        let sum = |budget: u32, size: f64| -> Sum {
            let comparisons = Comparisons::new();
            Box::new(move |r| {
                let sides = [[r[5], r[6]], [r[7], r[8]]].map(|side| side.map(|s| 64.0 * s));
                let lengths = sides.map(|s| s[0].hypot(s[1]));
                let [across, down] = technique::footprint::reference::counts(lengths, budget);
                let at = |i: u32, count: u32| size * ((f64::from(i) + 0.5) / f64::from(count) - 0.5);
                let places = (0..down).flat_map(|j| (0..across).map(move |i| (at(i, across), at(j, down))));
                let [a, b] = sides;
                let taps = places.map(|(s, t)| {
                    ([s * a[0] + t * b[0], s * a[1] + t * b[1]], 1.0 / f64::from(across * down))
                });
                ([comparisons.sum(r, taps, Comparisons::bilinear)], error)
            })
        };
        let other = if budget == 5 { 6 } else { 5 };
        let wrong = [("a larger pixel", sum(budget, 1.05)), ("another budget", sum(other, 1.0))];
        holds(&technique::spec(&footprint), &rows, &found, sum(budget, 1.0), &wrong);
    }
}

/// Four neighbours each, exactly.
fn packed_encodes(gpu: &Gpu) {
    let shadows = shadows(gpu, &technique::Packed::default(), 1);
    let rows = rows(22, |r| std::array::from_fn(|_| r.unit()));
    let body = "put4(0u, packed_encode(mat3x3f(take3(0u), take3(3u), take3(6u)), 0u));";
    let found = run::<4>(gpu, &shadows, body, &rows);
    // Column 1 + dx, row 1 + dy: lower left, below, left, the texel itself.
    let texels = |lower: usize| move |r: &[f64; INPUTS]| ([r[lower], r[3 + lower], r[1], r[4]], 0.0);
    compare(&rows, &found, texels(2)).unwrap();
    compare(&rows, &found, texels(0)).unwrap_err();
}

/// The mean of the 2×2 or 4×4 texels around the corner nearest to the receiver.
fn packed_is_the_mean_around_a_corner(gpu: &Gpu) {
    use technique::packed::Grid;
    let rows = tilted_receivers(23);
    for (grid, side) in [(Grid::Two, 2.0), (Grid::Four, 4.0)] {
        let packed = technique::Packed { grid, ..technique::Packed::default() };
        let body = "put(0u, packed_visibility(shadow_binding_0, take2(0u), 0u, take(2u), take2(3u), vec2f(0.0), vec2f(0.0)));";
        let shadows = shadows(gpu, &packed, 9);
        // Beyond the border the paper's packing repeats texels, and so does this one.
        let inside = |r: &Row| r[..2].iter().all(|uv| (3.0 / 64.0..61.0 / 64.0).contains(uv));
        let rows: Vec<Row> = rows.iter().copied().filter(inside).collect();
        let found = run::<1>(gpu, &shadows, body, &rows);
        let mean = |comparisons: Comparisons, shift: f64, side: f64| -> Sum {
            Box::new(move |r| {
                let corner = [r[0] * 64.0 + shift, r[1] * 64.0 + shift].map(f64::round);
                let half = side / 2.0;
                let around = (0..side as u32).map(|i| f64::from(i) + 0.5 - half);
                let pairs = around.clone().flat_map(|y| around.clone().map(move |x| [x, y]));
                let lit = pairs
                    .map(|[x, y]| comparisons.nearest(r, [(corner[0] + x) / 64.0, (corner[1] + y) / 64.0]));
                ([lit.sum::<f64>() / (side * side)], 1e-6)
            })
        };
        let plain = Comparisons::new;
        let wrong = [
            ("half a texel aside", mean(plain(), 0.5, side)),
            ("a row and a column dropped", mean(plain(), 0.0, side - 1.0)),
            ("no plane", mean(Comparisons { uphill: 0.0, ..plain() }, 0.0, side)),
        ];
        holds(&technique::spec(&packed), &rows, &found, mean(plain(), 0.0, side), &wrong);
    }
}

/// Each sample is compared where it was taken.
fn stratified_is_the_mean_of_its_samples(gpu: &Gpu) {
    let rows = tilted_receivers(24);
    for grid in [2_u32, 3, 4] {
        let stratified = technique::Stratified { grid, ..technique::Stratified::default() };
        let samples = grid * grid;
        let maps: Vec<_> = (0..samples).map(|k| noise(30 + u64::from(k))).collect();
        let depth = depth_layers(gpu, SIZE, samples, |k, x, y| maps[k as usize](x, y));
        let shadows = shadow_map(gpu, &stratified, &depth, SIZE.into());
        let body = "put(0u, stratified_visibility(shadow_binding_0, take2(0u), 0u, take(2u), take2(3u), vec2f(0.0), vec2f(0.0)));";
        let found = run::<1>(gpu, &shadows, body, &rows);
        let mean = |shift: f64, swapped: bool, dropped: usize| -> Sum {
            let offsets = stratified.jitter();
            let depths: Vec<Vec<f64>> = (0..64 * 64)
                .map(|i| maps.iter().map(|map| f64::from(map(i % 64, i / 64))).collect())
                .collect();
            Box::new(move |r| {
                let texel = [r[0], r[1]].map(|p| (p * 64.0).floor());
                let lit = offsets.iter().enumerate().skip(dropped).filter(|(k, offset)| {
                    let [dx, dy] = if swapped { [offset.y, offset.x] } else { offset.to_array() };
                    let away = [
                        (texel[0] + 0.5 + f64::from(dx) + shift) / 64.0 - r[0],
                        (texel[1] + 0.5 + f64::from(dy) + shift) / 64.0 - r[1],
                    ];
                    r[2] + (r[3] * away[0] + r[4] * away[1]).min(0.0)
                        <= depths[clamped(texel[0], texel[1], 64)][*k]
                });
                ([lit.count() as f64 / (offsets.len() - dropped) as f64], 1e-6)
            })
        };
        let wrong = [
            ("half a texel aside", mean(0.5, false, 0)),
            ("columns for rows", mean(0.0, true, 0)),
            ("a sample dropped", mean(0.0, false, 1)),
        ];
        // Columns and rows are told apart by the plane alone: few receivers lie so close to a sample.
        let right = mean(0.0, false, 0);
        let count = strays(&rows, &found, &right);
        assert!(count <= 6, "{grid}×{grid}: {count} rows differ");
        for (why, wrong) in &wrong {
            let count = strays(&rows, &found, wrong);
            assert!(count > 20, "{grid}×{grid}: {why} went unnoticed but in {count} rows");
        }
    }
}

/// A comparison with rounded depths, for receivers within two steps of their texel's depth.
fn precision_rounds_the_map(gpu: &Gpu) {
    let depth = noise(9);
    for (precision, steps) in
        [(Precision::Bits8, 255.0), (Precision::Bits12, 4095.0), (Precision::Bits16, 65535.0)]
    {
        let rows = rows(21, |r| {
            let (u, v) = (r.unit(), r.unit());
            let near = depth((u * 64.0) as u32, (v * 64.0) as u32) + r.range(-2.0, 2.0) / steps as f32;
            row([u, v, near])
        });
        let found = ask(gpu, &technique::Hard { precision }, "", &rows);
        let sum = |steps: Option<f64>| -> Sum {
            let comparisons = Comparisons { steps, ..Comparisons::new() };
            Box::new(move |r| ([comparisons.nearest(r, [r[0], r[1]])], 0.0))
        };
        // Floats round a step of 16 bits by up to 1/256 of it.
        let few = if precision == Precision::Bits16 { 30 } else { 6 };
        let count = strays(&rows, &found, sum(Some(steps)));
        assert!(count <= few, "{precision:?}: {count} rows differ");
        for (what, wrong) in [("no rounding", None), ("a step fewer", Some(steps - 1.0))] {
            let count = strays(&rows, &found, sum(wrong));
            assert!(count > 3 * few, "{precision:?}: {what} went unnoticed but in {count} rows");
        }
    }
}

/// f64 image pyramid of channel 0 of a map.
fn pyramid(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<Vec<f64>> {
    (0..texture.mip_level_count())
        .map(|mip| texels(gpu, texture, 0, mip).iter().map(|t| t[0]).collect())
        .collect()
}

fn trilinear(levels: &[Vec<f64>], u: f64, v: f64, level: f64) -> f64 {
    let level = level.clamp(0.0, levels.len() as f64 - 1.0);
    let at = |l: f64| bilinear(u, v, 64 >> l as usize, |i| levels[l as usize][i]);
    let (fine, coarse) = (at(level.floor()), at(level.ceil()));
    fine + (coarse - fine) * level.fract()
}

/// What each sampling setting should read: footprint in uv.
fn looked_up(sampling: &str, levels: &[Vec<f64>], r: &[f64; INPUTS], most: f64) -> f64 {
    let (u, v) = (r[0], r[1]);
    let length = |i: usize| 64.0 * r[i].hypot(r[i + 1]);
    let (x, y) = (length(2), length(4));
    match sampling {
        "nearest" => levels[0][clamped((u * 64.0).floor(), (v * 64.0).floor(), 64)],
        "bilinear" => trilinear(levels, u, v, 0.0),
        "trilinear" => trilinear(levels, u, v, x.max(y).max(1.0).log2()),
        _ => {
            let (longest, shortest) = (x.max(y).max(1.0), x.min(y).max(1.0));
            let taps = (longest / shortest).ceil().clamp(1.0, most);
            let level = (longest / taps).max(1.0).log2();
            let (du, dv) = if x > y { (r[2], r[3]) } else { (r[4], r[5]) };
            let tap = |i: usize| {
                let t = (i as f64 + 0.5) / taps - 0.5;
                trilinear(levels, u + du * t, v + dv * t, level)
            };
            (0..taps as usize).map(tap).sum::<f64>() / taps
        }
    }
}

/// All ways of reading a filtered map, from its own texels. The level's fraction is a sampler's too.
fn lookups_interpolate(gpu: &Gpu) {
    let rows: Vec<Row> = rows(11, |r| {
        let mut side = || r.range(0.25, 3.0).exp2() / 64.0 * if r.unit() < 0.5 { -1.0 } else { 1.0 };
        let footprint: [f32; 4] = std::array::from_fn(|_| side());
        let stretch = r.range(1.0, 6.0);
        row([r.unit(), r.unit(), stretch * footprint[0], stretch * footprint[1], footprint[2], footprint[3]])
    })
    .into_iter()
    // The number of taps jumps where the ratio of the sides is whole, the texel of a nearest lookup
    // at its border: rounding decides there.
    .filter(|r| {
        let ratio = (r[2].hypot(r[3]) / r[4].hypot(r[5])).max(r[4].hypot(r[5]) / r[2].hypot(r[3]));
        let clear = |v: f32| (v - v.round()).abs() > 1e-3;
        clear(ratio) && clear(r[0] * 64.0) && clear(r[1] * 64.0)
    })
    .collect();
    for (sampling, wrong) in [
        ("nearest", "bilinear"),
        ("bilinear", "nearest"),
        ("trilinear", "bilinear"),
        ("anisotropic", "trilinear"),
    ] {
        let spec = format!("vsm.anisotropy=5,sampling={sampling}");
        let shadows = shadows(gpu, technique::parse(&spec).unwrap().as_ref(), 12);
        let body = "put4(0u, lookup_filtered(shadow_binding_0, shadow_binding_1, take2(0u), 0u, take2(2u), take2(4u)));";
        let found = run::<4>(gpu, &shadows, body, &rows);
        let levels = pyramid(gpu, shadows.map_texture(0).unwrap());
        let error = 2.0 * sampler_error(gpu);
        let expected = |s: &'static str| {
            let levels = &levels;
            move |r: &[f64; INPUTS]| ([looked_up(s, levels, r, 5.0)], error)
        };
        compare(&rows, &found, expected(sampling)).unwrap_or_else(|e| panic!("{sampling}: {e}"));
        compare(&rows, &found, expected(wrong)).unwrap_err();
    }
}

fn main() {
    let mut trials = Trials::default();
    trials.add_plain("every encode function is compared", || {
        let device = Capabilities { features: wgpu::Features::empty(), limits: wgpu::Limits::default() };
        for technique in technique::all() {
            for map in technique.maps(&device).unwrap() {
                assert!(ENCODE_FUNCTIONS.contains(&map.encode), "compare {} here", map.encode);
            }
        }
    });
    trials.add("esm encodes and bounds", esm_encodes_and_bounds);
    trials.add("vsm encodes", vsm_encodes);
    trials.add("vsm and chebyshev bound", vsm_and_chebyshev_bound);
    trials.add("evsm encodes and bounds", evsm_encodes_and_bounds);
    trials.add("msm encodes and bounds", msm_encodes_and_bounds);
    trials.add("lvsm encodes and bounds", lvsm_encodes_and_bounds);
    trials.add("csm sums its series", csm_sums_its_series);
    trials.add("raster depth is linearised", raster_depth_is_linearised);
    trials.add("raster depth is cleaned", raster_depth_is_cleaned);
    trials.add("receivers are projected", receivers_are_projected);
    trials.add("receiver planes are solved", receiver_planes_are_solved);
    trials.add("pcf is a weighted sum", pcf_is_a_weighted_sum);
    trials.add("taps agree", taps_agree);
    trials.add("merged taps follow the plane", merged_taps_follow_the_plane);
    trials.add("bicubic is a convolution", bicubic_is_a_convolution);
    trials.add("poisson is the mean of its disk", poisson_is_the_mean_of_its_disk);
    trials.add("footprint is the mean of its pixel", footprint_is_the_mean_of_its_pixel);
    trials.add("precision rounds the map", precision_rounds_the_map);
    trials.add("packed encodes", packed_encodes);
    trials.add("packed is the mean around a corner", packed_is_the_mean_around_a_corner);
    trials.add("stratified is the mean of its samples", stratified_is_the_mean_of_its_samples);
    trials.add("lookups interpolate", lookups_interpolate);
    trials.run();
}
