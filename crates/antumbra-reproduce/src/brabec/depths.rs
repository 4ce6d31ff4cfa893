//! Levels of grey (sections 3 and 4), and depths of few bits (section 6).

use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Fact, Ran, Verdict, at_least, at_most, brabec, more},
    workbench::Workbench,
};
use antumbra::{
    Capabilities, Technique,
    technique::{Bias, BiasTerms, Packed},
};
use antumbra_lab::truth::Truth;
use anyhow::Result;
use std::collections::BTreeSet;

/// Spec, name, levels that the paper counts.
const LEVELS: [(&str, &str, Option<f64>); 7] = [
    ("hard", "without filtering", Some(2.0)),
    ("stratified.grid=2", "PCF 2×2", Some(5.0)),
    ("stratified.grid=3", "PCF 3×3", None),
    ("stratified.grid=4", "PCF 4×4", None),
    ("packed.grid=2", "fast PCF 2×2", Some(5.0)),
    ("packed.grid=4", "fast PCF 4×4, added in floats", None),
    ("packed.grid=4,accumulation=bytes", "fast PCF 4×4, added in 8 bits", Some(20.0)),
];

/// How many different values occur, those that 8 bits cannot tell apart being one.
fn levels(visibility: &[f32]) -> usize {
    visibility.iter().map(|v| (v.clamp(0.0, 1.0) * 255.0).round() as u8).collect::<BTreeSet<_>>().len()
}

pub(super) fn grey_levels(bench: &Workbench<'_>) -> Result<Page> {
    let specs = LEVELS.map(|l| l.0);
    let study = bench.study(bench.shot("brabec", [800, 600]), bench.map(512), &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let mut table = Table::new(
        "Different bytes among the pixels that can be in shadow, RMSE to 16 rays per pixel.",
        &["technique", "levels", "RMSE"],
    );
    let (mut counts, mut pictures) = (Vec::new(), Vec::new());
    for (spec, name, paper) in LEVELS {
        let plane = study.look(spec)?.visibility()?;
        let seen: Vec<f32> =
            plane.values.iter().zip(&truth.truth.shadowable).filter(|(_, s)| **s).map(|(v, _)| *v).collect();
        let count = levels(&seen) as f64;
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        table.row(name, vec![Cell::ours(count, Unit::Number).paper(paper), Cell::ours(rmse, Unit::Number)]);
        counts.push(count);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("16 rays per pixel", &truth.picture));
    let mut page = Page::default();
    let window = gallery::window(&difference(pictures[0].1, pictures[7].1), pictures[0].1, 12);
    gallery::close_ups(&mut page, "Enlarged: where no filtering looks most wrong.", 4, &pictures, window)?;
    page.table(table);
    page.fact(five(counts[1], counts[4]));
    page.verdict(twenty(counts[6]));
    Ok(page)
}

fn five(pcf: f64, fast: f64) -> Fact {
    Fact {
        claim: "A 2×2 footprint gives five levels of shadowing.".into(),
        source: brabec(
            "§3",
            "five different levels of shadowing per pixel are stored in the alpha channel of the frame buffer",
        ),
        found: format!("PCF 2×2 shows {pcf} levels, fast PCF 2×2 {fast}."),
        because: "four comparisons have five sums".into(),
    }
}

fn twenty(levels: f64) -> Verdict {
    Verdict::new(
        brabec("§4", "With this multipass method, 4 * 5 = 20 shadowing levels can be generated."),
        "Fast PCF 4×4 gives 20 levels",
        Ran::new("brabec, 800×600, 512²", [LEVELS[6].0]),
        [
            at_least("levels in the picture", levels, "20", 20.0).document("§4"),
            at_most("levels in the picture", levels, "20", 20.0).document("§4"),
        ],
    )
}

/// Fast PCF keeps depth that is linear, as the paper's ramp.
const LINEAR: [(&str, &str); 4] = [
    ("packed.grid=2,precision=8", "8 bits"),
    ("packed.grid=2,precision=12", "12 bits"),
    ("packed.grid=2,precision=16", "16 bits"),
    ("packed.grid=2", "32-bit floats"),
];
/// A standard map keeps projected depth.
const PROJECTED: [(&str, &str); 4] = [
    ("hard.precision=8", "8 bits"),
    ("hard.precision=12", "12 bits"),
    ("hard.precision=16", "16 bits"),
    ("hard", "32-bit floats"),
];

pub(super) fn few_bits(bench: &Workbench<'_>) -> Result<Page> {
    let packed = Packed::default().describe(&Capabilities::full())?;
    let floats = BiasTerms { depth_steps: 0.0, ..packed.bias };
    let groups = [
        ("linear depth, a bias made for floats", LINEAR, floats.into()),
        ("linear depth, the automatic bias", LINEAR, Bias::Auto),
        ("projected depth, the automatic bias", PROJECTED, Bias::Auto),
    ];
    let mut table = Table::new(
        "Against one shadow ray per pixel. Leak: mean visibility inside shadows.",
        &["depths", "wrong pixels", "leak", "acne"],
    );
    let mut page = Page::default();
    let mut verdicts = Vec::new();
    for (stored, bits, bias) in groups {
        let shot = bench.shot("brabec", [800, 600]);
        let study = bench.study_biased(shot, bench.map(512), &bits.map(|b| b.0), bias)?;
        let truth = &bench.truths(&study, &[Truth::Hard])?[0];
        let (mut wrong, mut pictures) = (Vec::new(), Vec::new());
        for (spec, name) in bits {
            let score = bench.score(&study, spec, truth, None)?;
            let cells = [Some(1.0 - score.pixel_match), score.leak, score.acne];
            table.row(format!("{stored}, {name}"), cells.map(|v| Cell::ours(v, Unit::Share)).into());
            wrong.push(1.0 - score.pixel_match);
            pictures.push((name, &study.look(spec)?.picture));
        }
        pictures.push(("rays", &truth.picture));
        let window = gallery::window(&difference(pictures[0].1, pictures[3].1), pictures[0].1, 8);
        let whole = format!("A 512² map: {stored}.");
        let captions = [whole.as_str(), "Enlarged: where 8 bits differ most from floats."];
        gallery::rows(&mut page, captions, 5, &pictures, window)?;
        verdicts.push(bits_show(stored, wrong[0], wrong[1], wrong[3]));
    }
    page.table(table);
    verdicts.into_iter().for_each(|verdict| page.verdict(verdict));
    page.text(
        "With a bias that does not know the steps of the stored depth, 8 bits show as bands of acne; the automatic \
         bias knows them, and few bits show as shadows that begin too late, or nowhere. A linear ramp spreads \
         its steps evenly between the lamp and the farthest receiver. Projected depth, without filtering here, spends \
         nearly all of them next to the near plane, which is a thousand times nearer than the far one.",
    );
    Ok(page)
}

fn bits_show(stored: &str, eight: f64, twelve: f64, float: f64) -> Verdict {
    Verdict::new(
        brabec(
            "§6",
            "When encoding depth values as color values we lose a lot of precision because of the (normal) 8 bits per color channel.",
        ),
        format!("Depths of 8 bits lose precision that shows; 12 bits are a solution ({stored})"),
        Ran::new("brabec, 800×600, 512²", [LINEAR[0].0, LINEAR[1].0, LINEAR[3].0]),
        [
            more("wrong pixels with 8 bits", eight, "1.5 times those with floats", 1.5 * float)
                .ours("what is lost shows where there are half as many more wrong pixels"),
            at_most("wrong pixels with 12 bits", twelve, "1.1 times those with floats", 1.1 * float)
                .ours("a solution leaves less than a tenth of them"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(twenty(20.0).outcome(), Holds);
        assert_eq!(twenty(17.0).outcome(), Differs);
        assert_eq!(twenty(35.0).outcome(), Differs);
        assert_eq!(bits_show("linear", 0.1, 0.02, 0.02).outcome(), Holds);
        assert_eq!(bits_show("linear", 0.025, 0.02, 0.02).outcome(), Differs);
        assert_eq!(bits_show("linear", 0.1, 0.05, 0.02).outcome(), Differs);
    }

    #[test]
    fn levels_are_what_8_bits_tell_apart() {
        assert_eq!(levels(&[0.0, 0.25, 0.25, 0.5, 0.75, 1.0, 0.5001]), 5);
        assert_eq!(levels(&[]), 0);
    }
}
