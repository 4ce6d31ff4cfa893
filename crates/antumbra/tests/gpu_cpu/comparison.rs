//! The comparison family: sums over depth texels.

use super::{INPUTS, Row, bilinear, clamped, compare, noise, row, rows, run, sampler_error, shadows};
use antumbra::{Technique, technique, technique::pcf::Taps, technique::poisson::Spin};
use antumbra_testing::Gpu;

/// The share of rows that differ: a depth within rounding of a texel's may fall on either side.
pub(crate) fn strays<const M: usize>(
    rows: &[Row],
    found: &[[f32; M]],
    expected: impl Fn(&[f64; INPUTS]) -> ([f64; M], f64),
) -> usize {
    let differs = |i: &usize| compare(&rows[*i..=*i], &found[*i..=*i], &expected).is_err();
    (0..rows.len()).filter(differs).count()
}

/// Places of a receiver, its depth, its plane, and its footprint, which is up to a few texels.
pub(crate) fn tilted_receivers(seed: u64) -> Vec<Row> {
    rows(seed, |r| {
        let mut side = || r.range(-3.0, 3.0) / 64.0;
        let footprint: [f32; 4] = std::array::from_fn(|_| side());
        let [a, b, c, d] = footprint;
        row([r.unit(), r.unit(), r.unit(), r.range(-2.0, 2.0), r.range(-2.0, 2.0), a, b, c, d])
    })
}

/// Asks a technique's function alone, without the glue.
pub(crate) fn ask(gpu: &Gpu, technique: &dyn Technique, rows: &[Row]) -> Vec<[f32; 1]> {
    let name = technique.about().name;
    let body = format!(
        "put(0u, {name}_visibility(shadow_binding_0, shadow_binding_1, take2(0u), 0u, take(2u), take2(3u), take2(5u), take2(7u)));"
    );
    run::<1>(gpu, &shadows(gpu, technique, 9), &body, rows)
}

/// A comparison technique in f64, over the depth texels of [`shadows`] with seed 9. Wrong on purpose
/// where a share is not 1, or downhill not 0.
pub(crate) struct Comparisons {
    pub(crate) depths: Vec<f64>,
    /// Share of the plane that is followed uphill.
    pub(crate) uphill: f64,
    /// The same downhill.
    pub(crate) downhill: f64,
    /// Steps of the stored depth.
    pub(crate) steps: Option<f64>,
}

impl Comparisons {
    pub(crate) fn new() -> Self {
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
    pub(crate) fn nearest(&self, r: &[f64; INPUTS], place: [f64; 2]) -> f64 {
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
pub(crate) fn holds<const M: usize, F: Fn(&[f64; INPUTS]) -> ([f64; M], f64)>(
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

pub(crate) type Sum = Box<dyn Fn(&[f64; INPUTS]) -> ([f64; 1], f64)>;

/// The whole kernel on a tilted receiver, as a sum over the depth texels.
pub(crate) fn pcf_is_a_weighted_sum(gpu: &Gpu) {
    let rows = tilted_receivers(10);
    let error = sampler_error(gpu);
    for (kernel, taps) in [(4, Taps::Bilinear), (5, Taps::Bilinear), (4, Taps::Nearest), (5, Taps::Nearest)] {
        let pcf = technique::Pcf { kernel, taps, ..technique::Pcf::default() };
        let found = ask(gpu, &pcf, &rows);
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
pub(crate) fn taps_agree(gpu: &Gpu) {
    let facing: Vec<Row> = tilted_receivers(16).iter().map(|r| row([r[0], r[1], r[2], 0.0, 0.0])).collect();
    for kernel in [1, 2, 3, 6, 7, 16] {
        for weights in [antumbra::Weights::Gaussian, antumbra::Weights::Box] {
            let with =
                |taps, sigma| technique::Pcf { kernel, weights, taps, sigma, ..technique::Pcf::default() };
            let one_by_one = ask(gpu, &with(Taps::Bilinear, 0.0), &facing);
            for taps in [Taps::Merged, Taps::Gather] {
                let found = ask(gpu, &with(taps, 0.0), &facing);
                let differ = |a: &[[f32; 1]], b: &[[f32; 1]]| {
                    let error = sampler_error(gpu) as f32;
                    std::iter::zip(a, b).filter(|(a, b)| (a[0] - b[0]).abs() > error).count()
                };
                let count = differ(&found, &one_by_one);
                assert!(count <= 6, "{count} rows differ for {:?}", with(taps, 0.0));
                if kernel > 2 && weights == antumbra::Weights::Gaussian {
                    let count = differ(&ask(gpu, &with(taps, 3.0), &facing), &one_by_one);
                    let least = if gpu.is_software() { 1000 } else { 200 };
                    assert!(count > least, "another kernel differs in {count} rows only");
                }
            }
        }
    }
}

/// On tilted receivers too, each group of 2×2 texels compares the plane over the highest of them.
pub(crate) fn merged_taps_follow_the_plane(gpu: &Gpu) {
    let rows = tilted_receivers(17);
    let error = sampler_error(gpu);
    for (kernel, taps) in [(5_u32, Taps::Merged), (5, Taps::Gather), (4, Taps::Gather)] {
        let pcf = technique::Pcf { kernel, taps, ..technique::Pcf::default() };
        let found = ask(gpu, &pcf, &rows);
        let weights: Vec<f64> =
            antumbra::Kernel::new(pcf.weights, kernel, 0.0).taps.iter().map(|w| f64::from(*w)).collect();
        let sum = |comparisons: Comparisons, weights: &[f64], shift: f64| -> Sum {
            let weights = weights.to_vec();
            Box::new(move |r| {
                let r = &std::array::from_fn(|i| if i < 2 { r[i] + shift / 64.0 } else { r[i] });
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
        let dropped = [&[0.0], &weights[1..]].concat();
        let brighter: Vec<f64> = weights.iter().map(|w| w * 1.02).collect();
        let plain = Comparisons::new;
        let wrong = [
            ("a flatter plane", sum(Comparisons { uphill: 0.8, ..plain() }, &weights, 0.0)),
            ("a plane followed downhill", sum(Comparisons { downhill: 1.0, ..plain() }, &weights, 0.0)),
            ("half a texel aside", sum(plain(), &weights, 0.5)),
            ("a row and a column of taps dropped", sum(plain(), &dropped, 0.0)),
            ("weights that do not sum to one", sum(plain(), &brighter, 0.0)),
        ];
        holds(&technique::spec(&pcf), &rows, &found, sum(plain(), &weights, 0.0), &wrong);
    }
}

/// The four lookups are the convolution of 16 comparisons with the B-spline.
pub(crate) fn bicubic_is_a_convolution(gpu: &Gpu) {
    let rows = tilted_receivers(18);
    let bicubic = technique::Bicubic::default();
    let found = ask(gpu, &bicubic, &rows);
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
pub(crate) fn poisson_is_the_mean_of_its_disk(gpu: &Gpu) {
    let rows = tilted_receivers(19);
    let error = sampler_error(gpu);
    for spin in [Spin::Fixed, Spin::Noise] {
        let poisson = technique::Poisson { kernel: 5.0, points: 11, spin, ..technique::Poisson::default() };
        let found = ask(gpu, &poisson, &rows);
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
        let share = if gpu.is_software() { 2 } else { 4 };
        for (why, wrong) in &wrong {
            let count = strays(&rows, &found, wrong);
            assert!(count > rows.len() / share, "{why} went unnoticed but in {count} rows");
        }
    }
}

/// The mean over the parallelogram, with as many lookups as texels or as the budget allows.
pub(crate) fn footprint_is_the_mean_of_its_pixel(gpu: &Gpu) {
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
        let found = ask(gpu, &footprint, &rows);
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
