//! Figures 3, 4 and 9: where the exponential step fails, where it needs no offset, and when many texels fall on a pixel.

use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Saying, Verdict, at_least, at_most, esm, less},
    workbench::Workbench,
};
use antumbra::technique::Bias;
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// Depths of the caster on the left, of what the map holds on the right, of the receiver; what the filtered test gives
/// where the two sides meet.
const CASES: [(&str, [f32; 3], f64); 3] = [
    ("(a) half in shadow, the rest of the kernel behind the receiver", [0.25, 1.0, 0.75], 0.5),
    ("(b) lit, all of the kernel behind the receiver", [0.25, 1.0, 0.2], 1.0),
    ("(c) half in shadow, the rest of the kernel the receiver itself", [0.25, 0.75, 0.75], 0.5),
];
/// Spec, name.
const ANSWERS: [(&str, &str); 5] = [
    ("pcf.kernel=1,taps=bilinear", "PCF"),
    ("esm.kernel=1,sampling=bilinear,classifier=none", "ESM, clamped"),
    ("esm.kernel=1,sampling=bilinear", "ESM, custom filtering"),
    ("esm.kernel=5,sampling=bilinear,classifier=none", "ESM 5×5, clamped"),
    ("esm.kernel=5,sampling=bilinear", "ESM 5×5, custom filtering"),
];

pub(super) fn figure_3(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Visibility where a caster's edge lies under the middle of the kernel.",
        &["case", "filtered test", ANSWERS[0].1, ANSWERS[1].1, ANSWERS[2].1, ANSWERS[3].1, ANSWERS[4].1],
    );
    let mut errors = Vec::new();
    for (case, depths, expected) in CASES {
        let mut cells = vec![Cell::ours(expected, Unit::Number)];
        let mut row = Vec::new();
        for (spec, _) in ANSWERS {
            let found = f64::from(bench.beside(spec, depths, &[0.0])?[0]);
            cells.push(Cell::ours(found, Unit::Number));
            row.push((found - expected).abs());
        }
        table.row(case, cells);
        errors.push(row);
    }
    let mut page = Page::default();
    page.verdict(too_bright(errors[0][1]));
    page.verdict(unseen(errors[1][1]));
    page.verdict(correct(errors[2][1]));
    page.verdict(mended(errors[0][2]));
    page.verdict(too_wide(errors[0][3], errors[0][4]));
    page.table(table);
    page.text("A clamped product that grew beyond one is lit; one step of an 8-bit picture is 1/255.");
    Ok(page)
}

/// What the figure's caption says.
fn violated(words: &str) -> Saying {
    esm("figure 3", words)
}

/// What ran: one of [`ANSWERS`].
fn case(answer: usize) -> Ran {
    Ran::new("a map of two depths, 64²", [ANSWERS[answer].0])
}

/// A claim that an answer has no error that shows.
fn exact(words: &str, claim: &str, answer: usize, error: f64) -> Verdict {
    Verdict::new(
        violated(words),
        claim,
        case(answer),
        [at_most("its error", error, "a step of an 8-bit picture", 1.0 / 255.0)
            .ours("less is no difference in a picture of 8 bits")],
    )
}

fn too_bright(error: f64) -> Verdict {
    Verdict::new(
        violated(
            "x should be darkened by 50% but its intensity is incorrectly increased because z(p) > d(x).",
        ),
        "(a) A point that ought to be half in shadow is too bright where the kernel reaches behind it",
        case(1),
        [at_least("error of the clamped product", error, "a quarter", 0.25)
            .ours("half of the way from half lit, as it ought to be, to lit")],
    )
}

fn unseen(error: f64) -> Verdict {
    let words = "here x is lit anyway and therefore doesn't cause artifacts.";
    exact(words, "(b) Where the point is lit anyway, the failure does not show", 1, error)
}

fn correct(error: f64) -> Verdict {
    let words = "(c) depicts a setup where our assumption holds and correct filtering is applied.";
    exact(words, "(c) Where nothing lies behind the receiver, the filter is correct", 1, error)
}

fn mended(error: f64) -> Verdict {
    let words = "In both cases however a failure is detected and we enable PCF.";
    exact(words, "Custom filtering mends (a)", 2, error)
}

fn too_wide(clamped: f64, custom: f64) -> Verdict {
    let words =
        "our current custom PCF cannot remove artifacts that occur when additional convolutions are used";
    Verdict::new(
        esm("§3.4", words),
        "Custom filtering cannot mend wide convolutions",
        case(4),
        [at_least("error with custom filtering after 5×5", custom, "half of that without", 0.5 * clamped)
            .ours("what leaves half of an error does not remove it")],
    )
}

const UNBIASED: [(&str, &str); 2] = [("hard", "shadow map"), ("esm.kernel=1,sampling=bilinear", "ESM")];

pub(super) fn figure_4(bench: &Workbench<'_>) -> Result<Page> {
    let (shot, map) = (bench.shot("spheres", [640, 480]), bench.map(1024));
    let specs = UNBIASED.map(|u| u.0);
    let mut table = Table::new(
        "Acne: share of fully lit pixels that come out in shadow.",
        &["technique", "without an offset", "with one"],
    );
    let studies = [Bias::NONE, Bias::Auto].map(|bias| bench.study_biased(shot, map, &specs, bias));
    let [none, auto] = studies;
    let (none, auto) = (none?, auto?);
    let truth = &bench.truths(&none, &[Truth::Hard])?[0];
    let acne = |study, spec| Ok::<_, anyhow::Error>(bench.score(study, spec, truth, None)?.acne);
    let mut found = Vec::new();
    for (spec, name) in UNBIASED {
        let pair = [acne(&none, spec)?, acne(&auto, spec)?];
        table.row(name, pair.map(|v| Cell::ours(v, Unit::Share)).into());
        found.push(pair);
    }
    let mut page = Page::default();
    page.verdict(needs_offset(found[0][0], found[0][1]));
    page.verdict(needs_none(found[1][0], found[0][0], found[0][1]));
    let pictures = [
        ("(a) shadow map, no offset", &none.look(specs[0])?.picture),
        ("shadow map, offset", &auto.look(specs[0])?.picture),
        ("(b) ESM, no offset", &none.look(specs[1])?.picture),
        ("rays", &truth.picture),
    ];
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = ["As in the figure.", "Enlarged: where the shadow map without an offset is most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

const SPHERES: &str = "spheres, 640×480, 1024²";

fn needs_offset(without: Option<f64>, with: Option<f64>) -> Verdict {
    Verdict::new(
        esm("figure 4", "without polygon offset numerical imprecision generates incorrect self-shadowing."),
        "Without an offset a shadow map shadows lit surfaces; an offset removes that",
        Ran::new(SPHERES, ["hard, without a bias", "hard"]),
        [
            at_least("acne of the shadow map without an offset", without, "a tenth of the lit pixels", 0.1)
                .ours("a pattern that is seen all over lit surfaces"),
            less("with an offset", with, "a tenth of that", without.map(|w| 0.1 * w))
                .ours("what is solved is gone but for single pixels"),
        ],
    )
}

fn needs_none(found: Option<f64>, without: Option<f64>, with: Option<f64>) -> Verdict {
    let allowed = with.zip(without).map(|(with, without)| with.max(0.01 * without));
    let than = "that of a shadow map with one, or a hundredth of what it has without";
    Verdict::new(
        esm("§3.2", "polygon offsetting is not required for ESMs"),
        "ESM needs no offset",
        Ran::new(SPHERES, ["esm.kernel=1,sampling=bilinear, without a bias"]),
        [at_most("acne of ESM without an offset", found, than, allowed)
            .ours("as good as what an offset gives a shadow map, or next to nothing of what it takes away")],
    )
}

/// Spec, name.
const MINIFIED: [(&str, &str); 3] = [
    ("esm.kernel=1,sampling=trilinear,classifier=none", "(a) trilinear"),
    ("esm.kernel=1,sampling=trilinear", "(b) trilinear, custom filtering"),
    ("esm.kernel=1,sampling=anisotropic,classifier=none", "(c) anisotropic"),
];

pub(super) fn figure_9(bench: &Workbench<'_>) -> Result<Page> {
    let study =
        bench.study(bench.shot("fence", [640, 480]).from(3.0), bench.map(2048), &MINIFIED.map(|m| m.0))?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let dark: Vec<bool> =
        truth.truth.image.values.iter().zip(&truth.truth.shadowable).map(|(v, s)| *s && *v < 0.1).collect();
    let mut table = Table::new(
        "Wrongly lit: share of pixels whose rays are 90 % in shadow or more that come out more than half lit; RMSE to 16 \
         rays per pixel.",
        &["filter", "wrongly lit", "RMSE"],
    );
    let mut wrong = Vec::new();
    let mut pictures = Vec::new();
    for (spec, name) in MINIFIED {
        let values = study.look(spec)?.visibility()?.values;
        let lit = values.iter().zip(&dark).filter(|(v, d)| **d && **v > 0.5).count();
        let share = lit as f64 / dark.iter().filter(|d| **d).count().max(1) as f64;
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        table.row(name, vec![Cell::ours(share, Unit::Share), Cell::ours(rmse, Unit::Number)]);
        wrong.push(share);
        pictures.push((name, &study.look(spec)?.picture));
    }
    let mut page = Page::default();
    page.verdict(prevented(1, "Custom filtering", wrong[1], wrong[0]));
    page.verdict(prevented(2, "Anisotropic filtering without it", wrong[2], wrong[0]));
    pictures.push(("rays", &truth.picture));
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = ["As in the figure, with what rays say.", "Enlarged: where (a) looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn prevented(which: usize, how: &str, with: f64, without: f64) -> Verdict {
    let words = match which {
        1 => "trilinear with custom PCF can prevent artifacts",
        _ => "10× anisotropic filtering without custom filtering often handles such failure cases properly.",
    };
    Verdict::new(
        esm("figure 9", words),
        format!("{how} prevents most pixels that are lit though they ought to be in shadow"),
        Ran::new("fence from three times its distance, 640×480, 2048²", [MINIFIED[which].0, MINIFIED[0].0]),
        [at_most(
            "share that is wrongly lit",
            with,
            "half of that of trilinear lookups alone",
            0.5 * without,
        )
        .ours("most of them")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(too_bright(0.5).outcome(), Holds);
        assert_eq!(too_bright(0.1).outcome(), Differs);
        for verdict in [unseen, correct, mended] {
            assert_eq!(verdict(0.0).outcome(), Holds);
            assert_eq!(verdict(0.1).outcome(), Differs);
        }
        assert_eq!(too_wide(0.5, 0.4).outcome(), Holds);
        assert_eq!(too_wide(0.5, 0.1).outcome(), Differs);
        assert_eq!(needs_offset(Some(0.4), Some(0.01)).outcome(), Holds);
        assert_eq!(needs_offset(Some(0.4), Some(0.1)).outcome(), Differs);
        assert_eq!(needs_offset(Some(0.01), Some(0.0)).outcome(), Differs);
        assert_eq!(needs_none(Some(0.001), Some(0.4), Some(0.001)).outcome(), Holds);
        assert_eq!(needs_none(Some(0.1), Some(0.4), Some(0.001)).outcome(), Differs);
        assert_eq!(needs_none(None, Some(0.4), Some(0.001)).outcome(), Open);
        assert_eq!(prevented(1, "It", 0.01, 0.1).outcome(), Holds);
        assert_eq!(prevented(1, "It", 0.09, 0.1).outcome(), Differs);
    }
}
