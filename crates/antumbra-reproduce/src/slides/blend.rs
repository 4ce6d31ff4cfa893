//! What may be filtered: not depth; and what sums keep of it.

use crate::{
    gallery,
    page::{Block, Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Fact, Ran, Verdict, at_most, csm as csm_says, more, ours, slides},
    workbench::{FILTERED_DEPTH, Workbench},
};
use antumbra_lab::{
    chart::{Curve, Panel},
    truth::Truth,
};
use anyhow::Result;

/// Spec, name.
const ROW: [(&str, &str); 3] = [
    ("hard", "standard map"),
    (FILTERED_DEPTH, "depth filtered 5×5, then compared"),
    ("pcf.kernel=5,weights=box", "compared, then filtered 5×5"),
];

pub(super) fn depth(bench: &Workbench<'_>) -> Result<Page> {
    let specs = ROW.map(|r| r.0);
    let study = bench.study(bench.shot("spheres", [640, 480]), bench.map(512), &specs)?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
    let mut table = Table::new(
        "Partly lit: share of pixels between 0.05 and 0.95. RMSE to what rays see through 5×5.",
        &["technique", "partly lit", "RMSE"],
    );
    let (mut found, mut pictures) = (Vec::new(), Vec::new());
    for (spec, name) in ROW {
        let rmse = bench.score(&study, spec, ideal, None)?.rmse;
        let values = study.look(spec)?.visibility()?.values;
        let soft = values.iter().filter(|v| (0.05..0.95).contains(*v)).count() as f64 / values.len() as f64;
        table.row(name, vec![Cell::ours(soft, Unit::Share), Cell::ours(rmse, Unit::Number)]);
        found.push(rmse);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("rays, filtered 5×5 in light space", &ideal.picture));
    let mut page = Page::default();
    page.fact(two_point_eight());
    page.verdict(inappropriate(found[1], found[0]));
    page.verdict(not_equivalent(found[1], found[2]));
    edge(bench, &mut page)?;
    let window = gallery::window(&difference(pictures[1].1, &ideal.picture), pictures[1].1, 8);
    let captions = ["The scene.", "Enlarged: where filtered depth looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn edge(bench: &Workbench<'_>, page: &mut Page) -> Result<()> {
    let positions: Vec<f32> = (-160..160_i16).map(|i| (f32::from(i) + 0.5) / 40.0).collect();
    let mut curves = Vec::new();
    for (spec, name) in ROW {
        let answers = bench.edge(spec, 0.75, &positions)?;
        let points = positions.iter().zip(answers).map(|(x, v)| [f64::from(*x), f64::from(v)]).collect();
        curves.push(Curve { name: name.into(), points });
    }
    let panel = Panel {
        curves,
        x: [-4.0, 4.0],
        y: [-0.05, 1.05],
        x_label: "texels from the caster's edge".into(),
        y_label: "visibility, 0 in shadow, 1 lit".into(),
    };
    let caption =
        "A caster at a quarter of the depth range covers the left; the receivers are at three quarters.";
    page.blocks.push(Block::Plot(vec![panel], caption.into()));
    Ok(())
}

fn two_point_eight() -> Fact {
    // The weight of 3.2 with which 3.2 and 1.5 give 2.8.
    let weight: f64 = (2.8 - 1.5) / (3.2 - 1.5);
    Fact {
        claim: "Depth values are not blendable.".into(),
        source: slides("Shadow map filtering", "Depth Values are not “blendable”"),
        found: format!(
            "With the weight {weight:.3} depths of 3.2 and 1.5 blend to 2.8, which shadows a receiver at 3; of the \
             comparisons {weight:.3} are lit."
        ),
        because: "the test is no linear function of depth".into(),
    }
}

fn inappropriate(filtered: f64, none: f64) -> Verdict {
    Verdict::new(
        slides("Shadow map filtering", "Traditional bilinear filtering is inappropriate"),
        "Filtered depth comes no closer to the filtered ideal than no filter does",
        Ran::new("spheres, 640×480, 512²", [ROW[0].0, ROW[1].0]),
        [more("RMSE of filtered depth", filtered, "0.95 of that of the standard map", 0.95 * none)
            .ours("a filter that is appropriate brings a picture closer by more than a twentieth")],
    )
}

fn not_equivalent(filtered: f64, compared: f64) -> Verdict {
    Verdict::new(
        csm_says("§3", "filtering z(p)-values is not equivalent to filtering the result of the shadow test"),
        "Filtered depth is farther from the filtered ideal than filtered comparisons of the same kernel",
        Ran::new("spheres, 640×480, 512²", [ROW[1].0, ROW[2].0]),
        [more("RMSE of filtered depth", filtered, "twice that of filtered comparisons", 2.0 * compared)
            .ours("what is not equivalent is off by a multiple, not by rounding")],
    )
}

const SIZES: [u32; 4] = [256, 512, 1024, 2048];
/// Steps of depth that the library's tables of one word keep.
const STEPS: f64 = (1 << 24) as f64;

pub(super) fn sums(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Largest error of the mean depth of 3×3 texels, and of its square, as a share of the depth range.",
        &["map", "floats", "floats, squares", "whole numbers", "whole numbers, squares"],
    );
    let mut found = Vec::new();
    for size in SIZES {
        let errors = errors(bench.map(size));
        table.row(format!("{size}²"), errors.map(|e| Cell::ours(e, Unit::Number)).into());
        found.push(errors);
    }
    let mut page = Page::default();
    page.verdict(floats_fail(found[3][1], found[3][3]));
    page.table(table);
    Ok(page)
}

/// Depth on a tilted plane.
fn plane(x: u32, y: u32, size: u32) -> f64 {
    let [x, y] = [x, y].map(|n| (f64::from(n) + 0.5) / f64::from(size));
    f64::from((0.2 + 0.5 * x + 0.25 * y) as f32)
}

/// Largest errors of means of 3×3 with tables of floats and of whole numbers: of depth and of its square.
fn errors(size: u32) -> [f64; 4] {
    let side = size as usize;
    let mut all = [0.0; 4];
    for (i, power) in [1, 2].into_iter().enumerate() {
        let value = |k: usize| plane((k % side) as u32, (k / side) as u32, size).powi(power);
        let floats = prefix(side, |k| value(k) as f32, |a, b| a + b);
        // Sums wrap around; what a rectangle holds does not.
        let whole = prefix(side, |k| (value(k) * STEPS).round() as u64, u64::wrapping_add);
        for (x, y) in (1..side - 1).flat_map(|y| (1..side - 1).map(move |x| (x, y))) {
            let mean =
                (y - 1..y + 2).flat_map(|y| (x - 1..x + 2).map(move |x| value(y * side + x))).sum::<f64>()
                    / 9.0;
            let corner = |x: usize, y: usize| (y * side).wrapping_add(x);
            let at = |x: usize, y: usize| (x > 0 && y > 0).then(|| corner(x - 1, y - 1));
            let [lr, ur, ll, ul] = [at(x + 2, y + 2), at(x + 2, y - 1), at(x - 1, y + 2), at(x - 1, y - 1)];
            let f = |k: Option<usize>| k.map_or(0.0, |k| floats[k]);
            let w = |k: Option<usize>| k.map_or(0, |k| whole[k]);
            let by_floats = f64::from(f(lr) - f(ur) - f(ll) + f(ul)) / 9.0;
            let sum = w(lr).wrapping_sub(w(ur)).wrapping_sub(w(ll)).wrapping_add(w(ul));
            let by_whole = sum as f64 / STEPS / 9.0;
            all[i] = f64::max(all[i], (by_floats - mean).abs());
            all[2 + i] = f64::max(all[2 + i], (by_whole - mean).abs());
        }
    }
    all
}

/// Sums of all texels above and to the left: rows first, then columns, as on a device.
fn prefix<T: Copy>(side: usize, value: impl Fn(usize) -> T, add: impl Fn(T, T) -> T) -> Vec<T> {
    let mut sums: Vec<T> = (0..side * side).map(value).collect();
    for k in (0..side * side).filter(|k| k % side > 0) {
        sums[k] = add(sums[k], sums[k - 1]);
    }
    for k in side..side * side {
        sums[k] = add(sums[k], sums[k - side]);
    }
    sums
}

/// Errors of the mean square by floats and by whole numbers in the largest map.
fn floats_fail(floats: f64, whole: f64) -> Verdict {
    Verdict::new(
        ours(
            "the slides do not say in what a table is summed; the library sums whole numbers and this is why",
        ),
        "In a 2048² map floats cannot hold a variance that whole numbers can",
        Ran::other("a tilted plane, sums in f32 and in whole numbers of 24 bits, on the processor"),
        [
            more("error of the mean square by floats", floats, "the least variance of a VSM, 10⁻⁶", 1e-6)
                .ours("a VSM lights what varies by less, whatever its error"),
            at_most("that by whole numbers", whole, "the least variance of a VSM, 10⁻⁶", 1e-6)
                .ours("a VSM lights what varies by less, whatever its error"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(inappropriate(0.3, 0.2).outcome(), Holds);
        assert_eq!(inappropriate(0.1, 0.2).outcome(), Differs);
        assert_eq!(not_equivalent(0.3, 0.1).outcome(), Holds);
        assert_eq!(not_equivalent(0.15, 0.1).outcome(), Differs);
        assert_eq!(floats_fail(1e-3, 1e-8).outcome(), Holds);
        assert_eq!(floats_fail(1e-8, 1e-8).outcome(), Differs);
    }

    #[test]
    fn tables_sum_what_lies_above_and_to_the_left() {
        assert_eq!(prefix(3, |k| k as u64, |a, b| a + b), [0, 1, 3, 3, 8, 15, 9, 21, 36]);
        let [float, _, whole, _] = errors(8);
        assert!(whole < 1e-7 && float < 1e-6, "{float} {whole}");
    }
}
