//! Comparison techniques that store depth in their own way: packed, stratified, rounded.

use super::{
    INPUTS, Row, SIZE, clamped, compare,
    comparison::{Comparisons, Sum, ask, holds, strays, tilted_receivers},
    noise, row, rows, run, shadows,
};
use antumbra::{
    Capabilities, Precision, Technique,
    technique::{self, stratified::Jitter},
};
use antumbra_testing::{
    Gpu,
    ask::{depth_layers, shadow_map},
};

/// Four neighbours each, exactly.
pub(crate) fn packed_encodes(gpu: &Gpu) {
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
pub(crate) fn packed_is_the_mean_around_a_corner(gpu: &Gpu) {
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
pub(crate) fn stratified_is_the_mean_of_its_samples(gpu: &Gpu) {
    let rows = tilted_receivers(24);
    for (grid, jitter) in
        [(2_u32, Jitter::Centred), (3, Jitter::Centred), (4, Jitter::Centred), (3, Jitter::Random)]
    {
        let stratified = technique::Stratified { grid, jitter, ..technique::Stratified::default() };
        let samples = grid * grid;
        let maps: Vec<_> = (0..samples).map(|k| noise(30 + u64::from(k))).collect();
        let depth = depth_layers(gpu, SIZE, samples, |k, x, y| maps[k as usize](x, y));
        let shadows = shadow_map(gpu, &stratified, &depth, SIZE.into());
        let body = "put(0u, stratified_visibility(shadow_binding_0, take2(0u), 0u, take(2u), take2(3u), vec2f(0.0), vec2f(0.0)));";
        let found = run::<1>(gpu, &shadows, body, &rows);
        let mean = |shift: f64, swapped: bool, dropped: usize| -> Sum {
            let offsets = stratified.describe(&Capabilities::full()).unwrap().sample_offsets;
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
pub(crate) fn precision_rounds_the_map(gpu: &Gpu) {
    let depth = noise(9);
    for (precision, steps) in
        [(Precision::Bits8, 255.0), (Precision::Bits12, 4095.0), (Precision::Bits16, 65535.0)]
    {
        let rows = rows(21, |r| {
            let (u, v) = (r.unit(), r.unit());
            let near = depth((u * 64.0) as u32, (v * 64.0) as u32) + r.range(-2.0, 2.0) / steps as f32;
            row([u, v, near])
        });
        let found = ask(gpu, &technique::Hard { precision }, &rows);
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
