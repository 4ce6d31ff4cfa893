//! Figures 5, 6 and 11: what is decided within a texel and within a pixel.

use super::{COMPARED, PUBLISHED};
use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_most, less, spsm as spsm_says},
    workbench::Workbench,
};
use antumbra::technique::{BiasTerms, spsm::reference};
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// What SPSM has by itself: too little for comparisons with whole texels.
const SAME: BiasTerms = BiasTerms { constant_texels: 0.05, slope_texels: 0.05, ..BiasTerms::NONE };

/// By what the paper shows: no slopes, linear levels, those of the power; and others.
const SLOPES: [(&str, &str); 6] = [
    ("hard", "standard map, no slopes"),
    ("spsm.packing=map,layers=1,exponent=1", "SPSM, linear 8 bits"),
    (PUBLISHED, "SPSM, 8 bits with a power"),
    COMPARED[2],
    COMPARED[3],
    COMPARED[4],
];

/// Angles of slopes, degrees.
const ANGLES: [f64; 6] = [5.0, 40.0, 60.0, 80.0, 86.0, 89.0];

pub(super) fn figure_5(_: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Degrees from one of 8 bits' levels to the next.",
        &["exponent", "5°", "40°", "60°", "80°", "86°", "89°"],
    );
    for exponent in [1, 3, 5, 7] {
        let angle = |level: f64| reference::dequantize(level, exponent).atan().to_degrees();
        let apart = |degrees: f64| {
            let level = reference::quantize(degrees.to_radians().tan(), exponent);
            angle(level + 0.5) - angle(level - 0.5)
        };
        table.row(
            exponent.to_string(),
            ANGLES
                .map(|degrees| {
                    let cell = Cell::ours(apart(degrees), Unit::Number);
                    let paper =
                        [(1, 0.70), (5, 0.17)].into_iter().find(|p| p.0 == exponent && degrees == 80.0);
                    cell.paper(paper.map(|p| p.1))
                })
                .into(),
        );
    }
    let mut page = Page::default();
    page.table(table);
    Ok(page)
}

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
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 6);
    let captions = ["The scene.", "Enlarged: where the standard map looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    page.verdict(slopes_remove_acne(acne[0], acne[2]));
    page.verdict(powers_help(acne[1], acne[2]));
    Ok(page)
}

fn slopes_remove_acne(hard: Option<f64>, spsm: Option<f64>) -> Verdict {
    Verdict::new(
        spsm_says(
            "§3.4",
            "We found that using the power function f(x) = x5 was sufficient to address most of the projection aliasing issue",
        ),
        "Slopes of 8 bits, spread by a power, remove the projection aliasing of a standard map with the same bias",
        Ran::new("spheres, 640×480, 1024², one bias for all", [SLOPES[0].0, PUBLISHED]),
        [less("acne of SPSM", spsm, "a tenth of the standard map's", hard.map(|h| 0.1 * h))
            .ours("most is nine of ten")],
    )
}

fn powers_help(linear: Option<f64>, power: Option<f64>) -> Verdict {
    Verdict::new(
        spsm_says(
            "§3.4",
            "The high precision required in this situation can't be addressed by a linear quantization.",
        ),
        "Slopes of 8 bits in linear levels leave more acne than those that a power spreads",
        Ran::new("spheres, 640×480, 1024², one bias for all", [SLOPES[1].0, PUBLISHED]),
        [less("acne with the power", power, "that with linear levels", linear).sentence()],
    )
}

const SAMPLES: [(&str, &str); 8] = [
    COMPARED[0],
    (PUBLISHED, "SPSM as published, one sample"),
    ("spsm.packing=map,layers=1,samples=2", "2×2 samples"),
    ("spsm.packing=map,layers=1,samples=4", "4×4 samples"),
    COMPARED[2],
    ("spsm.samples=4", "two layers, 4×4 samples"),
    ("dpm.samples=4", "deep primitive maps, 4×4 samples"),
    COMPARED[4],
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
        assert_eq!(powers_help(Some(0.1), Some(0.01)).outcome(), Holds);
        assert_eq!(powers_help(Some(0.01), Some(0.01)).outcome(), Differs);
        assert_eq!(slopes_remove_acne(Some(0.3), Some(0.01)).outcome(), Holds);
        assert_eq!(slopes_remove_acne(Some(0.3), Some(0.1)).outcome(), Differs);
        assert_eq!(slopes_remove_acne(None, Some(0.1)).outcome(), Open);
        assert_eq!(smoother(0.1, 0.05).outcome(), Holds);
        assert_eq!(smoother(0.1, 0.09).outcome(), Differs);
        assert_eq!(cheap(Measured::exact(1.05)).outcome(), Holds);
        assert_eq!(cheap(Measured::exact(1.3)).outcome(), Differs);
    }
}
