//! Figures 6 and 11: what is decided within a texel and within a pixel.

use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_most, less, spsm as spsm_says},
    workbench::Workbench,
};
use antumbra::technique::BiasTerms;
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// What SPSM has by itself: too little for comparisons with whole texels.
const SAME: BiasTerms = BiasTerms { constant_texels: 0.05, slope_texels: 0.05, ..BiasTerms::NONE };

const SLOPES: [(&str, &str); 3] = [
    ("hard", "standard map, no slopes"),
    ("spsm.packing=map,layers=1", "SPSM, 8 bits with a power"),
    ("spsm", "SPSM, 12 bits"),
];

pub(super) fn figure_6(bench: &Workbench<'_>) -> Result<Page> {
    let shot = bench.shot("spheres", [640, 480]);
    let study = bench.study_biased(shot, bench.map(1024), &SLOPES.map(|s| s.0), SAME.into())?;
    let truth = &bench.truths(&study, &[Truth::Hard])?[0];
    let mut table = Table::new(
        "Acne: share of the pixels that rays see lit which are answered shadowed; all with one bias.",
        &["technique", "acne", "pixel match"],
    );
    let (mut acne, mut pictures) = (Vec::new(), Vec::new());
    for (spec, name) in SLOPES {
        let score = bench.score(&study, spec, truth, None)?;
        table.row(name, [score.acne, Some(score.pixel_match)].map(|v| Cell::ours(v, Unit::Share)).into());
        acne.push(score.acne);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("rays", &truth.picture));
    let mut page = Page::default();
    let window = gallery::window(&difference(pictures[0].1, pictures[3].1), pictures[0].1, 6);
    let captions = ["The scene.", "Enlarged: where the standard map looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    page.verdict(slopes_remove_acne(acne[0], acne[1]));
    Ok(page)
}

fn slopes_remove_acne(hard: Option<f64>, spsm: Option<f64>) -> Verdict {
    Verdict::new(
        spsm_says(
            "§3.4",
            "We found that using the power function f(x) = x5 was sufficient to address most of the projection aliasing issue",
        ),
        "Slopes of 8 bits, spread by a power, remove the projection aliasing of a standard map with the same bias",
        Ran::new("spheres, 640×480, 1024², one bias for all", [SLOPES[0].0, SLOPES[1].0]),
        [less("acne of SPSM", spsm, "a tenth of the standard map's", hard.map(|h| 0.1 * h))
            .ours("most is nine of ten")],
    )
}

const SAMPLES: [(&str, &str); 4] = [
    ("hard", "standard map"),
    ("spsm", "SPSM, one sample"),
    ("spsm.samples=2", "2×2 samples"),
    ("spsm.samples=4", "4×4 samples"),
];

pub(super) fn figure_11(bench: &Workbench<'_>) -> Result<Page> {
    let specs = SAMPLES.map(|s| s.0);
    let (shot, map) = (bench.shot("spheres", [640, 480]), bench.map(1024));
    let study = bench.study(shot, map, &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let times = bench.times(shot, &specs.map(|s| (map, s)), bench.rounds())?;
    let mut table = Table::new(
        "RMSE to 16 rays per pixel; frame time over that of one sample.",
        &["technique", "RMSE", "frame time"],
    );
    let (mut errors, mut ratios, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for ((spec, name), time) in SAMPLES.into_iter().zip(&times) {
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        let ratio = time.over(&times[1]);
        table.row(name, vec![Cell::ours(rmse, Unit::Number), Cell::ours(ratio.value, Unit::Times)]);
        errors.push(rmse);
        ratios.push(ratio);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("16 rays per pixel", &truth.picture));
    let mut page = Page::default();
    // Where one sample is most wrong, away from what more samples cannot mend.
    let window = gallery::window(&difference(pictures[1].1, pictures[3].1), pictures[0].1, 12);
    let captions = ["The scene.", "Enlarged: where samples matter most."];
    gallery::rows(&mut page, captions, 5, &pictures, window)?;
    page.table(table);
    page.verdict(smoother(errors[1], errors[3]));
    page.verdict(cheap(ratios[3]));
    Ok(page)
}

fn smoother(one: f64, sixteen: f64) -> Verdict {
    Verdict::new(
        spsm_says(
            "§5",
            "perform multiple shadow evaluation according to multi-sampling locations in the SPSM",
        ),
        "Asking for the shadow at several positions of a pixel smooths its edge",
        Ran::new("spheres, 640×480, 1024²", [SAMPLES[1].0, SAMPLES[3].0]),
        [less("RMSE with 4×4 samples", sixteen, "0.7 of that with one", 0.7 * one)
            .ours("the paper has no number; what is called smoother has lost a third of its error")],
    )
}

fn cheap(ratio: Measured) -> Verdict {
    Verdict::new(
        spsm_says(
            "§5",
            "This test is performed only for uncertain pixels, hence reducing the multi-sample shadow operations to a small portion of pixels in the image with a minimal cost",
        ),
        "Anti-aliasing costs little, since only pixels near edges are sampled",
        Ran::new("spheres, 640×480, 1024²", [SAMPLES[1].0, SAMPLES[3].0]),
        [at_most("frame time with 4×4 samples over that with one", ratio, "1.1", 1.1)
            .ours("a cost is called minimal up to a tenth")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(slopes_remove_acne(Some(0.3), Some(0.01)).outcome(), Holds);
        assert_eq!(slopes_remove_acne(Some(0.3), Some(0.1)).outcome(), Differs);
        assert_eq!(slopes_remove_acne(None, Some(0.1)).outcome(), Open);
        assert_eq!(smoother(0.1, 0.05).outcome(), Holds);
        assert_eq!(smoother(0.1, 0.09).outcome(), Differs);
        assert_eq!(cheap(Measured::exact(1.05)).outcome(), Holds);
        assert_eq!(cheap(Measured::exact(1.3)).outcome(), Differs);
    }
}
