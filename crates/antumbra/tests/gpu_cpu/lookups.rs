//! Ways of reading a filtered map.

use super::{INPUTS, Row, bilinear, clamped, compare, noise, row, rows, run, sampler_error, shadows};
use antumbra::{Size, technique, technique::esm};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{depth_texture, shadow_map, texels};

/// f64 image pyramid of channel 0 of a map.
fn pyramid(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<Vec<f64>> {
    (0..texture.mip_level_count())
        .map(|mip| texels(gpu, texture, 0, mip).iter().map(|t| t[0]).collect())
        .collect()
}

/// Variance of the Gaussian of three taps in squares of texels: both side taps weigh e^(−1/(2·0.8²)) of the middle.
const BLUR: f64 = 2.0 * 0.457_833_361_771_614_3 / (1.0 + 2.0 * 0.457_833_361_771_614_3);

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
        "fitted" => {
            // A texel of level l is a box of 2^l texels under a tent of as many, beside the blur.
            let area = 64.0 * 64.0 * (r[2] * r[5] - r[3] * r[4]).abs();
            let beyond = area / 12.0 - BLUR;
            trilinear(levels, u, v, 0.5 * (4.0 * beyond + 1.0 / 3.0).max(1.0).log2())
        }
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
pub(crate) fn lookups_interpolate(gpu: &Gpu) {
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
        ("trilinear", "fitted"),
        ("fitted", "trilinear"),
        ("anisotropic", "trilinear"),
    ] {
        let spec = format!("vsm.anisotropy=5,sampling={sampling}");
        let shadows = shadows(gpu, technique::parse(&spec).unwrap().as_ref(), 12);
        let body = "put4(0u, lookup_filtered(shadow_binding_0, shadow_binding_1, take2(0u), 0u, 0u, take2(2u), take2(4u)));";
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

/// The map's own texels, interpolated as e^(c z) in f64, against the lookup that never leaves
/// logarithms. Ordinary interpolation of the logarithms is the negative control.
pub(crate) fn logarithms_interpolate_as_powers(gpu: &Gpu) {
    const C: f64 = 300.0;
    let spec = "esm.storage=log32,c=300,sampling=trilinear,kernel=3";
    let shadows = shadows(gpu, technique::parse(spec).unwrap().as_ref(), 12);
    let rows = rows(17, |r| {
        let side = r.range(0.25, 3.0).exp2() / 64.0;
        row([r.unit(), r.unit(), side, 0.0, 0.0, side])
    });
    let body = "put(0u, lookup_filtered(shadow_binding_0, shadow_binding_1, take2(0u), 0u, 0u, take2(2u), take2(4u)).x);";
    let found = run::<1>(gpu, &shadows, body, &rows);
    let levels = pyramid(gpu, shadows.map_texture(0).unwrap());
    let powers: Vec<Vec<f64>> =
        levels.iter().map(|l| l.iter().map(|z| (C * (z - 1.0)).exp()).collect()).collect();
    let expected = |r: &[f64; INPUTS]| ([looked_up("trilinear", &powers, r, 1.0).ln() / C + 1.0], 2e-5);
    compare(&rows, &found, expected).unwrap();
    compare(&rows, &found, |r| ([looked_up("trilinear", &levels, r, 1.0)], 2e-5)).unwrap_err();
    // The blur and the mips, from the depths themselves.
    let depth = noise(12);
    let weights = antumbra::Kernel::new(antumbra::Weights::Gaussian, 3, 0.0).taps;
    for (x, y) in [(5u32, 9u32), (31, 2), (40, 50)] {
        let taps: Vec<(f64, f64)> = (0..9)
            .map(|i| {
                let (dx, dy) = (i % 3, i / 3);
                let weight = f64::from(weights[dx as usize]) * f64::from(weights[dy as usize]);
                (weight, f64::from(depth(x + dx - 1, y + dy - 1)))
            })
            .collect();
        let (mean, e) = (levels[0][(y * 64 + x) as usize], esm::reference::log_mean(&taps, C));
        assert!((mean - e).abs() < 1e-5, "{mean} instead of {e}");
    }
    let quarter = |i: usize, j: usize| (0.25, levels[0][(2 * 7 + j) * 64 + 2 * 3 + i]);
    let e = esm::reference::log_mean(&[quarter(0, 0), quarter(1, 0), quarter(0, 1), quarter(1, 1)], C);
    assert!((levels[1][7 * 32 + 3] - e).abs() < 1e-5);
}

/// Sums and differences of whole numbers of one, two and four words, against u128.
pub(crate) fn words_add_up(gpu: &Gpu) {
    for (spec, words) in [("csm", 1), ("vsm", 2), ("esm", 4)] {
        let settings = format!("{spec}.sampling=summed");
        let shadows = shadows(gpu, technique::parse(&settings).unwrap().as_ref(), 1);
        // Words of all ones and of zero are where carries run through. Inputs are halves of words.
        let rows = rows(18, |r| {
            let mut row: Row = [0.0; INPUTS];
            for word in row.chunks_exact_mut(2) {
                let kind = r.unit() * 4.0;
                let half = |u: f32| if kind < 1.0 { 0.0 } else { (u * 65536.0).floor() };
                let half = |u: f32| if (1.0..2.0).contains(&kind) { 65535.0 } else { half(u) };
                word.fill_with(|| half(r.unit()));
            }
            row
        });
        let body = "
            var a = vec4u(0u);
            var b = vec4u(0u);
            for (var i = 0u; i < 4u; i += 1u) {
                a[i] = (u32(take(2u * i)) << 16u) | u32(take(2u * i + 1u));
                b[i] = (u32(take(8u + 2u * i)) << 16u) | u32(take(9u + 2u * i));
            }
            put4(0u, vec4f(words_add(a, b) >> vec4u(16u)));
            put4(4u, vec4f(words_add(a, b) & vec4u(65535u)));
            put4(8u, vec4f(words_subtract(a, b) >> vec4u(16u)));
            put4(12u, vec4f(words_subtract(a, b) & vec4u(65535u)));";
        let found = run::<16>(gpu, &shadows, body, &rows);
        let whole = |w: &[u32]| w.iter().rev().fold(0u128, |n, w| n << 32 | u128::from(*w));
        let modulus = |n: u128| if words == 4 { n } else { n & ((1u128 << (32 * words)) - 1) };
        let mut carries = 0;
        for (row, found) in rows.iter().zip(&found) {
            let bits: [u32; 8] = std::array::from_fn(|i| (row[2 * i] as u32) << 16 | row[2 * i + 1] as u32);
            for first in (0..4).step_by(words) {
                let [a, b] = [&bits[first..first + words], &bits[4 + first..4 + first + words]].map(whole);
                let read = |at: usize| -> Vec<u32> {
                    (first..first + words)
                        .map(|i| (found[at + i] as u32) << 16 | found[at + 4 + i] as u32)
                        .collect()
                };
                assert_eq!(whole(&read(0)), modulus(a.wrapping_add(b)), "{a:x} + {b:x}");
                assert_eq!(whole(&read(8)), modulus(a.wrapping_sub(b)), "{a:x} - {b:x}");
                // What addition word by word would give is the negative control.
                let plain: Vec<u32> =
                    (first..first + words).map(|i| bits[i].wrapping_add(bits[4 + i])).collect();
                carries += usize::from(whole(&plain) != modulus(a.wrapping_add(b)));
            }
        }
        assert!(carries > 1000 || words == 1, "hardly any carry: {carries}");
    }
}

/// Mean over a box of an image of texels, clipped to it, in f64.
fn box_mean(image: impl Fn(usize, usize) -> f64, side: usize, centre: [f64; 2], width: [f64; 2]) -> f64 {
    let clip = |i: usize| {
        let (low, high) = (centre[i] - 0.5 * width[i], centre[i] + 0.5 * width[i]);
        (low.clamp(0.0, side as f64), high.clamp(0.0, side as f64))
    };
    let ((x0, x1), (y0, y1)) = (clip(0), clip(1));
    let cover = |low: f64, high: f64, i: usize| (high.min(i as f64 + 1.0) - low.max(i as f64)).max(0.0);
    let mut sum = 0.0;
    for y in y0 as usize..(y1.ceil() as usize).min(side) {
        for x in x0 as usize..(x1.ceil() as usize).min(side) {
            sum += image(x, y) * cover(x0, x1, x) * cover(y0, y1, y);
        }
    }
    sum / ((x1 - x0) * (y1 - y0))
}

/// Sixteen loads give the exact box, for one, two and four words, for kernels and for footprints.
pub(crate) fn sums_are_means_over_boxes(gpu: &Gpu) {
    for (spec, kernel) in [("csm", 5.0), ("vsm", 3.0), ("lvsm", 1.0), ("esm.c=3", 7.0), ("evsm", 5.0)] {
        let dot = if spec.contains('.') { ',' } else { '.' };
        let settings = format!("{spec}{dot}sampling=summed,kernel={kernel}");
        let summed = shadows(gpu, technique::parse(&settings).unwrap().as_ref(), 12);
        let plain = technique::parse(&format!("{spec}{dot}sampling=nearest,kernel=1")).unwrap();
        let plain = shadows(gpu, plain.as_ref(), 12);
        // evsm's steepness depends on how it is stored.
        if spec == "evsm" {
            continue;
        }
        let image = pyramid(gpu, plain.map_texture(0).unwrap()).swap_remove(0);
        let most = image.iter().fold(0.0f64, |a, b| a.max(*b));
        let rows = rows(19, |r| {
            row([r.unit(), r.unit(), r.range(0.0, 20.0) / 64.0, 0.0, 0.0, r.range(0.0, 4.0) / 64.0])
        });
        // Where two pipelines round texels of one depth to different bytes.
        let bytes = spec == "csm" && !gpu.is_software();
        let rounding = if bytes { 1.0 / 255.0 } else { 4e-5 };
        let body = "put(0u, lookup_filtered(shadow_binding_0, shadow_binding_1, take2(0u), 0u, 0u, take2(2u), take2(4u)).x);";
        let found = run::<1>(gpu, &summed, body, &rows);
        let mean = |shift: f64| {
            let image = &image;
            move |r: &[f64; INPUTS]| {
                let width = [r[2], r[5]].map(|w| (64.0 * w).max(kernel));
                let centre = [64.0 * r[0] + shift, 64.0 * r[1]];
                let mean = box_mean(|x, y| image[y * 64 + x], 64, centre, width);
                ([mean], most * rounding)
            }
        };
        compare(&rows, &found, mean(0.0)).unwrap_or_else(|e| panic!("{settings}: {e}"));
        compare(&rows, &found, mean(if bytes { 0.5 } else { 0.01 })).unwrap_err();
    }
}

/// At 2048² the table's last entries are sums of four million values: small boxes there are as exact
/// as anywhere. Adding up 32-bit floats instead is the negative control.
pub(crate) fn sums_are_exact_at_2048(gpu: &Gpu) {
    const SIDE: usize = 2048;
    let depth = |x: u32, y: u32| ((x * 7919 + y * 104_729) % 4093) as f32 / 4093.0;
    let texture = depth_texture(gpu, Size::square(SIDE as u32), depth);
    // A coefficient on the border between two levels may fall on either side: one of nine texels.
    for (spec, error) in [("csm.terms=2,sampling=summed", 5e-4), ("vsm.sampling=summed", 1e-6)] {
        let technique = technique::parse(spec).unwrap();
        let shadows = shadow_map(gpu, technique.as_ref(), &texture, Size::square(SIDE as u32).into());
        let rows: Vec<Row> = rows(20, |r| row([1.0 - 0.02 * r.unit(), 1.0 - 0.02 * r.unit()]));
        let body = "
            let d = vec2f(1e-9);
            put(0u, lookup_filtered(shadow_binding_0, shadow_binding_1, take2(0u), 0u, 0u, d, d).x);";
        let found = run::<1>(gpu, &shadows, body, &rows);
        let csm = technique::csm::Csm { terms: 2, ..technique::csm::Csm::default() };
        let value = |x: usize, y: usize| {
            let z = f64::from(depth(x as u32, y as u32));
            let [sine, _] = technique::csm::reference::basis(1, f64::from(csm.span()) * z);
            if spec.starts_with("vsm") { z } else { ((0.5 + 0.5 * sine) * 255.0 + 0.5).floor() / 255.0 }
        };
        let mean = |shift: f64| {
            move |r: &[f64; INPUTS]| {
                let centre = [r[0] * SIDE as f64 + shift, r[1] * SIDE as f64];
                ([box_mean(value, SIDE, centre, [3.0; 2])], error)
            }
        };
        compare(&rows, &found, mean(0.0)).unwrap_or_else(|e| panic!("{spec}: {e}"));
        compare(&rows, &found, mean(0.01)).unwrap_err();
    }
    let mut table = vec![0f32; SIDE * SIDE];
    for y in 0..SIDE {
        let mut row = 0f32;
        for x in 0..SIDE {
            row += depth(x as u32, y as u32);
            table[y * SIDE + x] = row + if y > 0 { table[(y - 1) * SIDE + x] } else { 0.0 };
        }
    }
    let (x, y) = (2040, 2040);
    let at = |x: usize, y: usize| table[y * SIDE + x];
    let mean = (at(x + 2, y + 2) - at(x - 1, y + 2) - at(x + 2, y - 1) + at(x - 1, y - 1)) / 9.0;
    let direct = (0..9).map(|i| depth((x + i % 3) as u32, (y + i / 3) as u32)).sum::<f32>() / 9.0;
    assert!((mean - direct).abs() > 1e-3, "32-bit floats would do: {mean} against {direct}");
}
