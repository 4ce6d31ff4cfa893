//! Table 3, figures 5, 6 and 10: failing pixels.

use crate::{
    gallery,
    numbers::steps,
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::difference,
    study::{Look, Study},
    verdict::{Fact, Ran, Verdict, at_least, at_most, esm, less, more},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::{Context, Result};

/// Kernel, Z-Max, Threshold.
const PAPER: [(u32, f64, f64); 4] =
    [(1, 0.030, 0.028), (3, 0.061, 0.049), (5, 0.079, 0.061), (7, 0.093, 0.071)];
/// Name of the class in both classifiers.
const FAILED: &str = "assumption violated";

/// A backyard with both classifiers and all kernels: Z-Max, then Threshold.
fn study(bench: &Workbench<'_>, scene: &'static str) -> Result<Study> {
    let zmax = PAPER.map(|(kernel, ..)| format!("esm.classifier=zmax,kernel={kernel},sampling=trilinear"));
    let threshold = PAPER.map(|(kernel, ..)| format!("esm.kernel={kernel},sampling=trilinear"));
    let specs: Vec<&str> = zmax.iter().chain(&threshold).map(String::as_str).collect();
    bench.study(bench.shot(scene, [800, 800]), bench.map(2048), &specs)
}

/// Pixels that fail.
fn failed(look: &Look) -> Result<Vec<bool>> {
    let told = look.classes.first().is_some_and(|class| class.name == FAILED);
    anyhow::ensure!(told, "{} has no pixels called '{FAILED}'", look.spec);
    Ok(look.kinds.iter().map(|kind| *kind == 1.0).collect())
}

fn among(pixels: &[bool]) -> f64 {
    pixels.iter().filter(|p| **p).count() as f64 / pixels.len().max(1) as f64
}

/// The share of all pixels that fail.
fn share(look: &Look) -> Result<f64> {
    Ok(among(&failed(look)?))
}

/// Of the pixels that Threshold finds, the share that Z-Max does not, for each kernel.
fn missed(study: &Study) -> Result<Vec<f64>> {
    let (zmax, threshold) = study.looks.split_at(PAPER.len());
    let pairs = zmax.iter().zip(threshold);
    pairs
        .map(|(zmax, threshold)| {
            let (zmax, threshold) = (failed(zmax)?, failed(threshold)?);
            let missed: Vec<bool> = zmax.iter().zip(&threshold).map(|(z, t)| *t && !z).collect();
            Ok(among(&missed) / among(&threshold).max(f64::MIN_POSITIVE))
        })
        .collect()
}

/// Shares of Z-Max and of Threshold.
fn shares(study: &Study) -> Result<[Vec<f64>; 2]> {
    let (zmax, threshold) = study.looks.split_at(PAPER.len());
    let all = |looks: &[Look]| looks.iter().map(share).collect::<Result<Vec<f64>>>();
    Ok([all(zmax)?, all(threshold)?])
}

pub(super) fn figure_10(bench: &Workbench<'_>) -> Result<Page> {
    let study = study(bench, "backyard")?;
    let mut tiles = Vec::new();
    for (look, (kernel, ..)) in study.looks.iter().zip(PAPER.iter().chain(&PAPER)) {
        let tinted = look.tinted.as_ref().with_context(|| look.spec.clone())?;
        tiles.push(Tile::new(format!("{kernel}×{kernel}: {:.1} %", 100.0 * share(look)?), tinted)?);
    }
    let [zmax, threshold] = shares(&study)?;
    let mut page = Page::default();
    page.verdict(grows(&zmax, &threshold));
    page.pictures("Visibility, failing pixels in red: Z-Max above, Threshold below.", 4, tiles);
    Ok(page)
}

const FIGURE_5: [(&str, &str); 3] = [
    ("esm.kernel=5,classifier=zmax,sampling=trilinear", "Z-Max"),
    ("esm.kernel=5,sampling=trilinear", "Threshold"),
    ("esm.kernel=5,classifier=none,sampling=trilinear", "no classifier"),
];

pub(super) fn figure_5(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("backyard", [800, 600]), bench.map(2048), &FIGURE_5.map(|f| f.0))?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
    let mut table =
        Table::new("Pixels found, and error to the ideal of 5×5.", &["classifier", "found", "RMSE"]);
    let mut pictures = Vec::new();
    let mut tinted = Vec::new();
    let mut errors = Vec::new();
    for (spec, name) in FIGURE_5 {
        let look = study.look(spec)?;
        let rmse = bench.score(&study, spec, ideal, None)?.rmse;
        let found = failed(look).ok().map(|failed| among(&failed));
        table.row(name, vec![Cell::ours(found, Unit::Share), Cell::ours(rmse, Unit::Number)]);
        errors.push(rmse);
        pictures.push((name, &look.picture));
        if let Some(red) = look.tinted.as_ref().filter(|_| look.share(FAILED).is_some()) {
            tinted.push(Tile::new(format!("{name}: pixels found"), red)?);
        }
    }
    pictures.push(("rays, filtered 5×5 in light space", &ideal.picture));
    let mut page = Page::default();
    page.verdict(helps([errors[0], errors[1]], errors[2]));
    page.verdict(more_accurate(errors[0], errors[1]));
    page.pictures("As in the figure: visibility, pixels found in red.", 2, tinted);
    let window = gallery::window(&difference(pictures[2].1, &ideal.picture), pictures[2].1, 8);
    let captions = ["What becomes of them.", "Enlarged: where doing nothing looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn helps(found: [f64; 2], none: f64) -> Verdict {
    Verdict::new(
        esm("§5", "the fixed 2 × 2 PCF filter is sufficient to remove visible artifacts"),
        "Filtering the pixels found removes artifacts, with either classifier",
        Ran::new("backyard, 800×600, 2048²", FIGURE_5.map(|f| f.0)),
        [
            less("RMSE with Z-Max", found[0], "that without any classifier", none).sentence(),
            less("RMSE with Threshold", found[1], "that without any classifier", none).sentence(),
        ],
    )
}

fn more_accurate(zmax: f64, threshold: f64) -> Verdict {
    Verdict::new(
        esm("§3.4", "Z-Max Classification is a conservative method and achieves more accurate results"),
        "Z-Max is more accurate than Threshold",
        Ran::new("backyard, 800×600, 2048²", [FIGURE_5[0].0, FIGURE_5[1].0]),
        [less("RMSE with Z-Max", zmax, "that with Threshold", threshold).sentence()],
    )
}

/// Depth ranges. The first but one is what the default ε allows.
const OFFSETS: [f32; 5] = [0.0005, 0.0012, 0.003, 0.01, 0.03];
const EPSILONS: [f32; 5] = [0.0, 0.01, 0.1, 0.5, 2.0];

pub(super) fn figure_6(bench: &Workbench<'_>) -> Result<Page> {
    let zmax = OFFSETS.map(|o| format!("esm.kernel=5,classifier=zmax,offset={o},sampling=trilinear"));
    let threshold = EPSILONS.map(|e| format!("esm.kernel=5,epsilon={e},sampling=trilinear"));
    let specs: Vec<&str> = zmax.iter().chain(&threshold).map(String::as_str).collect();
    let study = bench.study(bench.shot("backyard", [480, 360]), bench.map(1024), &specs)?;
    let mut page = Page::default();
    let mut table = Table::new("Pixels found.", &["setting", "share"]);
    let mut shares = Vec::new();
    let mut tiles = Vec::new();
    for look in &study.looks {
        let share = share(look)?;
        table.row(look.spec.as_str(), vec![Cell::ours(share, Unit::Share)]);
        shares.push(share);
        let tinted = look.tinted.as_ref().with_context(|| look.spec.clone())?;
        let setting = look.spec.rsplit(',').next().unwrap_or_default();
        tiles.push(Tile::new(format!("{setting}: {:.1} %", 100.0 * share), tinted)?);
    }
    let (offsets, epsilons) = shares.split_at(OFFSETS.len());
    page.verdict(underestimated(offsets));
    page.fact(threshold_acts(epsilons));
    page.pictures(
        "(a) Z-Max above, its offset growing; (b) Threshold below, its ε growing.",
        OFFSETS.len(),
        tiles,
    );
    page.table(table);
    Ok(page)
}

/// The least quotient of a share and the next.
fn falling(shares: &[f64]) -> Option<f64> {
    steps(shares.windows(2).map(|pair| [pair[1].max(1e-9), pair[0].max(1e-9)]))
}

fn underestimated(offsets: &[f64]) -> Verdict {
    let [min, max] = ends(offsets);
    Verdict::new(
        esm(
            "§3.3",
            "To avoid misclassification of fully lit surfaces we have to add a small offset to d(x).",
        ),
        "An offset that is too small flags surfaces that cannot fail",
        Ran::new(
            "backyard, 480×360, 1024², offsets of 0.0005 to 0.03 depth ranges",
            ["esm.kernel=5,classifier=zmax,sampling=trilinear"],
        ),
        [
            at_least("least fall of the share from offset to offset", falling(offsets), "none", 1.0)
                .sentence(),
            more(
                "share with the smallest offset",
                min,
                "1.5 times that with the largest",
                max.map(|m| 1.5 * m),
            )
            .ours("what an offset spares has to be a good part of what is flagged without"),
        ],
    )
}

fn threshold_acts(epsilons: &[f64]) -> Fact {
    let shares: Vec<String> = epsilons.iter().map(|share| format!("{:.1} %", 100.0 * share)).collect();
    Fact {
        claim: "The higher the threshold, the fewer pixels are found.".into(),
        source: esm("§3.3", "check if it exceeds 1 + ε where ε is a given threshold"),
        found: format!("With the ε of the table, from small to large: {}.", shares.join(", ")),
        because: "what exceeds a number exceeds every smaller one".into(),
    }
}

pub(super) fn table_3(bench: &Workbench<'_>) -> Result<Page> {
    let full = study(bench, "backyard")?;
    let [zmax, threshold] = shares(&full)?;
    let missed = missed(&full)?;
    let bare = shares(&study(bench, LEAFLESS)?)?;
    let mut table = Table::new(
        "Share of all pixels whose kernel reaches casters behind the receiver.",
        &["failure", "no convolution", "3×3", "5×5", "7×7"],
    );
    let row = |ours: &[f64], paper: [f64; 4]| {
        ours.iter().zip(paper).map(|(o, p)| Cell::ours(*o, Unit::Share).paper(p)).collect()
    };
    table.row("Z-Max", row(&zmax, PAPER.map(|p| p.1)));
    table.row("Threshold", row(&threshold, PAPER.map(|p| p.2)));
    table.row("Z-Max, without leaves", row(&bare[0], PAPER.map(|p| p.1)));
    table.row("Threshold, without leaves", row(&bare[1], PAPER.map(|p| p.2)));
    let mut page = Page::default();
    page.table(table);
    page.verdict(few("backyard", &zmax, &threshold));
    page.verdict(few(LEAFLESS, &bare[0], &bare[1]));
    page.verdict(grows(&zmax, &threshold));
    page.verdict(conservative(&missed));
    Ok(page)
}

fn ends(shares: &[f64]) -> [Option<f64>; 2] {
    [shares.first().copied(), shares.last().copied()]
}

fn few(scene: &str, zmax: &[f64], threshold: &[f64]) -> Verdict {
    let [first, last] = [0, 1].map(|end| ends(zmax)[end].zip(ends(threshold)[end]));
    Verdict::new(
        esm(
            "table 3",
            "Even for an additional 7 × 7 convolution only 7.1% (or 9.3% for Z-Max test) of the screen-space pixels \
             require special treatment.",
        ),
        format!("3 % of the pixels fail without convolution, at most 9.3 % with 7×7 (scene {scene})"),
        Ran::new(&format!("{scene}, {KERNELS}"), CLASSIFIERS),
        [
            at_most("smaller share without convolution", first.map(|(z, t)| z.min(t)), "3 %", 0.03)
                .document("table 3, Z-Max without convolution"),
            at_most("larger share with 7×7", last.map(|(z, t)| z.max(t)), "9.3 %", 0.093)
                .document("table 3, Z-Max with 7×7"),
        ],
    )
}

const LEAFLESS: &str = "backyard without leaves";
const KERNELS: &str = "800×800, 2048², kernels of 1, 3, 5 and 7";
const CLASSIFIERS: [&str; 2] = ["esm.classifier=zmax,sampling=trilinear", "esm.sampling=trilinear"];

/// What the pictures of all kernels are of.
fn classifiers() -> Ran {
    Ran::new(&format!("backyard, {KERNELS}"), CLASSIFIERS)
}

fn grows(zmax: &[f64], threshold: &[f64]) -> Verdict {
    let rising = |name: &str, shares: &[f64]| {
        let steps = shares.windows(2).map(|pair| pair[1] - pair[0]).reduce(f64::min);
        more(format!("smallest rise from kernel to kernel, {name}"), steps, "none", 0.0).sentence()
    };
    Verdict::new(
        esm("§5", "The larger the filter kernel the more often our assumption fails"),
        "The larger the kernel, the more pixels fail",
        classifiers(),
        [rising("Z-Max", zmax), rising("Threshold", threshold)],
    )
}

fn conservative(missed: &[f64]) -> Verdict {
    let most = missed.iter().copied().reduce(f64::max);
    Verdict::new(
        esm(
            "§3.3",
            "Checking if d(x) < z_max gives a conservative answer whether the assumption is violated for d(x) or not.",
        ),
        "Z-Max is conservative: it finds every pixel that Threshold finds",
        classifiers(),
        [at_most("largest share of Threshold's pixels that Z-Max misses", most, "none", 0.0).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let zmax = PAPER.map(|p| p.1);
        let threshold = PAPER.map(|p| p.2);
        assert_eq!(few("s", &zmax, &threshold).outcome(), Holds);
        assert_eq!(grows(&zmax, &threshold).outcome(), Holds);
        assert_eq!(few("s", &[0.1, 0.2], &threshold).outcome(), Differs);
        assert_eq!(grows(&[0.1, 0.1], &threshold).outcome(), Differs);
        assert_eq!(conservative(&[0.0, 0.0]).outcome(), Holds);
        assert_eq!(conservative(&[0.0, 0.001]).outcome(), Differs);
        assert_eq!(more_accurate(0.1, 0.2).outcome(), Holds);
        assert_eq!(more_accurate(0.2, 0.1).outcome(), Differs);
        assert_eq!(helps([0.1, 0.2], 0.3).outcome(), Holds);
        assert_eq!(helps([0.1, 0.4], 0.3).outcome(), Differs);
        assert_eq!(underestimated(&[0.5, 0.3, 0.1]).outcome(), Holds);
        assert_eq!(underestimated(&[0.1, 0.3, 0.01]).outcome(), Differs);
        assert_eq!(underestimated(&[0.12, 0.11, 0.1]).outcome(), Differs);
        assert!(threshold_acts(&[0.5, 0.25]).found.ends_with(": 50.0 %, 25.0 %."));
    }
}
