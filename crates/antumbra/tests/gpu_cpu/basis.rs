//! The linear-basis family: what is encoded, and the bounds from filtered values.

use super::{INPUTS, compare, compare_from, row, rows, run, shadows};
use antumbra::{
    technique, technique::csm, technique::esm, technique::evsm, technique::lvsm, technique::msm,
    technique::vsm,
};
use antumbra_testing::Gpu;

/// What csm's polynomials promise of a sine, and rounding.
const SINE: f64 = 4e-7;

/// exp: (3 + 2|x|) ulp are allowed, and c·z is rounded: 87 · (2 · 1.2e-7 + 6e-8) with some room.
pub(crate) fn esm_encodes_and_bounds(gpu: &Gpu) {
    const EXP: f64 = 3e-5;
    for c in [1.0, 20.0, 80.0, 87.0] {
        let shadows = shadows(gpu, &esm::Esm { c, ..esm::Esm::default() }, 1);
        let rows = rows(2, |r| {
            let (z, d) = (r.unit(), r.unit());
            row([z, d, c, (c * z).exp()])
        });
        let body = "
            put(0u, esm_encode(take(0u), 0u).x);
            put(1u, clamp(esm_ratio(take(1u), take(3u)), 0.0, 1.0));";
        let found = run::<2>(gpu, &shadows, body, &rows);
        let encode = |factor: f64| {
            move |r: &[f64; INPUTS]| {
                let e = esm::reference::encode(r[0], factor * r[2]);
                ([e], e * EXP)
            }
        };
        compare(&rows, &found, encode(1.0)).unwrap();
        compare(&rows, &found, encode(1.001)).unwrap_err();
        let bound = |sign: f64| {
            move |r: &[f64; INPUTS]| ([esm::reference::ratio(sign * r[1], r[3], r[2]).min(1.0)], EXP)
        };
        compare_from(1, &rows, &found, bound(1.0)).unwrap();
        compare_from(1, &rows, &found, bound(-1.0)).unwrap_err();
    }
}

/// Logarithms: exponents of some hundreds, each rounded by 6e-8 of its depth times c.
pub(crate) fn esm_of_logarithms(gpu: &Gpu) {
    for c in [1.0, 80.0, 300.0, 1000.0] {
        let esm = esm::Esm { storage: esm::Storage::Log32, c, ..esm::Esm::default() };
        let shadows = shadows(gpu, &esm, 1);
        let rows = rows(16, |r| {
            let (z, behind) = (r.unit(), r.unit() * r.unit());
            row([z, z + 0.01 * behind, c])
        });
        let body = "
            put(0u, esm_encode(take(0u), 0u).x);
            put(1u, esm_ratio(take(1u), take(0u)));";
        let found = run::<2>(gpu, &shadows, body, &rows);
        compare(&rows, &found, |r| ([r[0]], 0.0)).unwrap();
        let ratio = |factor: f64| {
            move |r: &[f64; INPUTS]| ([(factor * r[2] * (r[0] - r[1])).exp()], 3e-5 + 2e-7 * r[2])
        };
        compare_from(1, &rows, &found, ratio(1.0)).unwrap();
        compare_from(1, &rows, &found, ratio(1.01)).unwrap_err();
    }
}

/// Products of numbers below one: a few roundings of 6e-8.
pub(crate) fn vsm_encodes(gpu: &Gpu) {
    for slope in [0.5, 1.0, 3.7] {
        let shadows = shadows(gpu, &vsm::Vsm { slope, ..vsm::Vsm::default() }, 1);
        let rows = rows(3, |r| std::array::from_fn(|i| if i == 9 { slope } else { r.unit() }));
        let body = "
            let depths = mat3x3f(take3(0u), take3(3u), take3(6u));
            put2(0u, vsm_encode_sloped(depths, 0u).xy);
            put2(2u, vsm_encode(take(4u), 0u).xy);";
        let found = run::<4>(gpu, &shadows, body, &rows);
        let moments = |factor: f64| {
            move |r: &[f64; INPUTS]| {
                let depths = std::array::from_fn(|i| std::array::from_fn(|j| r[3 * i + j]));
                (vsm::reference::encode(depths, factor * r[9]), 1e-6)
            }
        };
        compare::<4, 2>(&rows, &found, moments(1.0)).unwrap();
        compare::<4, 2>(&rows, &found, moments(1.001)).unwrap_err();
        let plain = |factor: f64| move |r: &[f64; INPUTS]| ([r[4], factor * r[4] * r[4]], 1e-6);
        compare_from::<4, 2>(2, &rows, &found, plain(1.0)).unwrap();
        compare_from::<4, 2>(2, &rows, &found, plain(1.001)).unwrap_err();
    }
}

/// The variance is a difference of numbers up to one, rounded by 1.2e-7 altogether; the bound
/// changes with it by at most 1/(4σ²), which the reduction stretches by 1/(1 − r).
pub(crate) fn vsm_and_chebyshev_bound(gpu: &Gpu) {
    [0.2, 0.9].into_iter().for_each(|reduction| vsm_bound_reduced_by(gpu, reduction));
}

fn vsm_bound_reduced_by(gpu: &Gpu, reduction: f32) {
    let shadows = shadows(gpu, &vsm::Vsm { reduction, ..vsm::Vsm::default() }, 1);
    let rows = rows(4, |r| {
        let (mean, variance) = (r.unit(), 10f32.powf(r.range(-6.0, -1.0)));
        let least = 10f32.powf(r.range(-5.0, -2.0));
        row([r.unit(), mean, mean * mean + variance, least, reduction])
    });
    let body = "
        put(0u, vsm_bound(take(0u), take2(1u), take(3u)));
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
pub(crate) fn evsm_encodes_and_bounds(gpu: &Gpu) {
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
            put4(0u, evsm_encode(take(0u), 0u));
            let moments = vec4f(take2(1u), take2(3u));
            put(4u, evsm_bound(take(0u), moments, evsm_least_variance()));";
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
pub(crate) fn msm_encodes_and_bounds(gpu: &Gpu) {
    [0.0, 0.35].into_iter().for_each(|reduction| msm_reduced_by(gpu, reduction));
}

fn msm_reduced_by(gpu: &Gpu, reduction: f32) {
    use msm::reference;
    const BIAS: f32 = 1e-3;
    let msm = msm::Msm { moment_bias: BIAS, reduction, ..msm::Msm::default() };
    let shadows = shadows(gpu, &msm, 1);
    // Three casters, mixed.
    let rows = rows(14, |r| {
        let z = [r.unit(), r.unit(), r.unit()].map(|z| reference::moments(z.into()));
        let (a, b) = (f64::from(r.unit()), f64::from(r.unit()));
        let m: [f64; 4] =
            std::array::from_fn(|i| a * z[0][i] + (1.0 - a) * (b * z[1][i] + (1.0 - b) * z[2][i]));
        row([r.unit(), m[0] as f32, m[1] as f32, m[2] as f32, m[3] as f32, reduction])
    });
    let body = "
        let moments = vec4f(take2(1u), take2(3u));
        put4(0u, msm_encode(take(0u), 0u));
        put4(4u, msm_restore(msm_transform(moments)));
        put(8u, msm_bound(take(0u), moments));";
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
                let v = reference::bound(d, m, BIAS.into()).clamp(0.0, 1.0);
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
pub(crate) fn lvsm_encodes_and_bounds(gpu: &Gpu) {
    let lvsm = lvsm::Lvsm { intervals: 7, overlap: 0.25, least_variance: 1e-4, ..lvsm::Lvsm::default() };
    let shadows = shadows(gpu, &lvsm, 1);
    let rows = rows(15, |r| {
        let (mean, variance) = (r.unit(), 10f32.powf(r.range(-6.0, -1.0)));
        row([r.unit(), mean, mean * mean + variance, (r.unit() * 8.0).floor()])
    });
    let body = "
        let i = u32(take(3u));
        let pair = lvsm_encode(take(0u), i / 2u);
        put2(0u, select(pair.xy, pair.zw, i % 2u == 1u));
        put(2u, lvsm_one(take(0u), take2(1u), i, lvsm_least_variance()));";
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

/// Every layer's sum, from the stored form, is the series. Doubling angles doubles errors: basis k errs
/// by 2k − 1 times what one sine does.
pub(crate) fn csm_sums_its_series(gpu: &Gpu) {
    let settings = [
        csm::Csm::default(),
        csm::Csm { terms: 5, attenuation: 0.0, ..csm::Csm::default() },
        csm::Csm { terms: 1, ..csm::Csm::default() },
        csm::Csm { terms: 32, ..csm::Csm::default() },
    ];
    for csm in settings {
        let shadows = shadows(gpu, &csm, 1);
        let rows = rows(5, |r| row([r.unit(), r.unit(), 1.0 + (r.unit() * 32.0).floor()]));
        let body = "
            let k = u32(take(2u)) - 1u;
            let pair = csm_basis(take(0u), k / 2u);
            put2(0u, select(pair.xy, pair.zw, k % 2u == 1u));
            var sum = 0.5;
            for (var layer = 0u; layer < (csm_terms + 1u) / 2u; layer += 1u) {
                let stored = csm_encode(take(0u), layer);
                sum += csm_layer(csm_basis(csm_span() * take(1u), layer), stored, layer);
            }
            put(2u, sum);";
        let found = run::<3>(gpu, &shadows, body, &rows);
        let basis = |factor: f64| {
            move |r: &[f64; INPUTS]| {
                (csm::reference::basis(r[2] as u32, factor * r[0]), (2.0 * r[2] - 1.0) * SINE + 1e-5)
            }
        };
        compare(&rows, &found, basis(1.0)).unwrap();
        compare(&rows, &found, basis(1.001)).unwrap_err();
        // Term k errs as basis k does, (2k − 1) times a sine, and weighs 2/π/(2k − 1), on both sides.
        let error = 4.0 / std::f64::consts::PI * f64::from(csm.terms) * SINE + 2e-5;
        let span = f64::from(csm.span());
        let series = |sign: f64| {
            move |r: &[f64; INPUTS]| {
                let v = csm::reference::series(&csm, span * r[1], span * r[0]) - 0.5;
                ([0.5 + sign * v], error)
            }
        };
        compare_from(2, &rows, &found, series(1.0)).unwrap();
        // Eq. 11 of the paper, whose sign is reversed.
        compare_from(2, &rows, &found, series(-1.0)).unwrap_err();
        compare_from(2, &rows, &found, series(1.05)).unwrap_err();
    }
}
