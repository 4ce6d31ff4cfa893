//! The comparison family: sums over depth texels.

use super::{INPUTS, bilinear, compare, noise, row, rows, run, sampler_error, shadows};
use antumbra::technique;
use antumbra_testing::Gpu;

/// The whole kernel on a tilted receiver, as a sum over the depth texels.
pub(crate) fn pcf_is_a_weighted_sum(gpu: &Gpu) {
    let pcf = technique::Pcf { kernel: 4, ..technique::Pcf::default() };
    let shadows = shadows(gpu, &pcf, 9);
    let depth = noise(9);
    let depths: Vec<f64> =
        (0..64).flat_map(|y| (0..64).map(move |x| (x, y))).map(|(x, y)| f64::from(depth(x, y))).collect();
    let rows = rows(10, |r| row([r.unit(), r.unit(), r.unit(), r.range(-2.0, 2.0), r.range(-2.0, 2.0)]));
    let body = "put(0u, pcf_visibility(shadow_binding_0, shadow_binding_1, take2(0u), 0u, take(2u), take2(3u), vec2f(0.0), vec2f(0.0)));";
    let found = run::<1>(gpu, &shadows, body, &rows);
    let weights: Vec<f64> =
        antumbra::Kernel::new(pcf.weights, pcf.kernel, 0.0).taps.iter().map(|w| f64::from(*w)).collect();
    // Downhill taps compare the receiver's own depth: `downhill` is the share of the plane they follow.
    let sum = |uphill: f64, downhill: f64| {
        let (depths, weights) = (&depths, &weights);
        move |r: &[f64; INPUTS]| {
            let mut lit = 0.0;
            for (j, wy) in weights.iter().enumerate() {
                for (i, wx) in weights.iter().enumerate() {
                    let (du, dv) = ((i as f64 - 1.5) / 64.0, (j as f64 - 1.5) / 64.0);
                    let rise = r[3] * du + r[4] * dv;
                    let d = r[2] + uphill * rise.min(0.0) + downhill * rise.max(0.0);
                    let test = |texel: usize| if d <= depths[texel] { 1.0 } else { 0.0 };
                    lit += wx * wy * bilinear(r[0] + du, r[1] + dv, 64, test);
                }
            }
            ([lit], sampler_error(gpu))
        }
    };
    // A depth within rounding of a texel's may fall on either side: allow a handful of rows.
    let strays = |uphill, downhill| {
        let differs = |i: usize| compare(&rows[i..=i], &found[i..=i], sum(uphill, downhill)).is_err();
        (0..rows.len()).filter(|i| differs(*i)).count()
    };
    assert!(strays(1.0, 0.0) <= 4, "{} rows differ", strays(1.0, 0.0));
    assert!(strays(0.9, 0.0) > 100, "a plane that is a tenth too flat went unnoticed");
    assert!(strays(1.0, 1.0) > 100, "a plane followed downhill went unnoticed");
}
