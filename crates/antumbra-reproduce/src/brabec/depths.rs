//! Levels of grey (sections 3 and 4), and depths of few bits (section 6).

use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Fact, Ran, Verdict, at_most, brabec, more},
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
    (BYTES, "fast PCF 4×4, added in 8 bits", Some(20.0)),
];

/// Phases of 8 bits and their mean in an accumulation buffer of 8 bits.
const BYTES: &str = "packed.grid=4,accumulation=bytes";

/// All that 4×4 texels can give: exact sums, and bytes of phases that count 64 for three of their texels and
/// 63 for the fourth [footnote 2].
fn possible_levels() -> [usize; 2] {
    let (mut sums, mut bytes) = (BTreeSet::new(), BTreeSet::new());
    for mask in 0..=u16::MAX {
        let fourths = (mask & 0x8888).count_ones();
        sums.insert(mask.count_ones());
        // A quarter of what the phases add up to, rounded.
        bytes.insert((64 * mask.count_ones() - fourths + 2) / 4);
    }
    [sums.len(), bytes.len()]
}

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
    page.fact(twenty(counts[5], counts[6]));
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

/// Levels in the picture, of floats and of bytes.
fn twenty(floats: f64, bytes: f64) -> Fact {
    let [sums, rounded] = possible_levels();
    Fact {
        claim: "The 20 levels of fast PCF 4×4 are an erratum.".into(),
        source: brabec("§4", "With this multipass method, 4 * 5 = 20 shadowing levels can be generated."),
        found: format!(
            "All patterns of 4×4 texels give {sums} exact sums (in this picture {floats}), and {rounded} bytes where a \
             phase counts 64 for three of its texels and 63 for the fourth as footnote 2 has it (in this picture \
             {bytes}). Before, this program clamped 256 to 255 instead, because that gives the paper's 20."
        ),
        because: "phases are added and not told apart, so that their levels do not add up".into(),
    }
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
    let mut as_published = Vec::new();
    for (stored, bits, bias) in groups {
        let shot = bench.shot("brabec", [800, 600]);
        let study = bench.study_biased(shot, bench.map(512), &bits.map(|b| b.0), bias)?;
        let truth = &bench.truths(&study, &[Truth::Hard])?[0];
        let (mut errors, mut pictures) = (Vec::new(), Vec::new());
        for (spec, name) in bits {
            let score = bench.score(&study, spec, truth, None)?;
            let cells = [Some(1.0 - score.pixel_match), score.leak, score.acne];
            table.row(format!("{stored}, {name}"), cells.map(|v| Cell::ours(v, Unit::Share)).into());
            errors.push([score.acne, score.leak]);
            pictures.push((name, &study.look(spec)?.picture));
        }
        pictures.push(("rays", &truth.picture));
        let window = gallery::window(&difference(pictures[0].1, pictures[3].1), pictures[0].1, 8);
        let whole = format!("A 512² map: {stored}.");
        let captions = [whole.as_str(), "Enlarged: where 8 bits differ most from floats."];
        gallery::rows(&mut page, captions, 5, &pictures, window)?;
        if bias != Bias::Auto {
            as_published = errors;
        }
    }
    page.table(table);
    page.verdict(eight_show(as_published[0], as_published[3]));
    page.verdict(twelve_suffice(as_published[1], as_published[3]));
    page.text(
        "With a bias that does not know the steps of the stored depth, 8 bits show as bands of acne; the automatic \
         bias knows them, and few bits show as shadows that begin too late, or nowhere. A linear ramp spreads \
         its steps evenly between the lamp and the farthest receiver. Projected depth, without filtering here, spends \
         nearly all of them next to the near plane, which is a thousand times nearer than the far one.",
    );
    Ok(page)
}

const RAN: &str = "brabec, 800×600, 512², linear depth, a bias made for floats";
const MIXED: &str = "wrong pixels, with other biases and with projected depth too";
const WHY: &str = "pixels along edges are wrong whatever depth has; the paper has neither of the others";

/// Acne and leak with 8 bits and with floats.
fn eight_show(eight: [Option<f64>; 2], float: [Option<f64>; 2]) -> Verdict {
    Verdict::new(
        brabec(
            "§6",
            "When encoding depth values as color values we lose a lot of precision because of the (normal) 8 bits per \
             color channel.",
        ),
        "Depths of 8 bits lose precision that shows, as acne",
        Ran::new(RAN, [LINEAR[0].0, LINEAR[3].0]),
        [more("acne with 8 bits", eight[0], "1.5 times that with floats", float[0].map(|a| 1.5 * a))
            .ours("a lot shows where there is half as much again")
            .was(MIXED, WHY)],
    )
}

/// Acne and leak with 12 bits and with floats.
fn twelve_suffice(twelve: [Option<f64>; 2], float: [Option<f64>; 2]) -> Verdict {
    let tenth = |limit: Option<f64>| limit.map(|l| 1.1 * l);
    Verdict::new(
        brabec("§6", "support color depths of 12 bits per channel, a trend that will probably be picked up"),
        "Depths of 12 bits are a solution: neither acne nor leak beyond those of floats",
        Ran::new(RAN, [LINEAR[1].0, LINEAR[3].0]),
        [
            at_most("acne with 12 bits", twelve[0], "1.1 times that with floats", tenth(float[0]))
                .ours("a solution leaves less than a tenth of what was there")
                .was(MIXED, WHY),
            at_most("leak with 12 bits", twelve[1], "1.1 times that with floats", tenth(float[1]))
                .ours("a solution leaves less than a tenth of what was there"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let show = |eight: f64| eight_show([Some(eight), None], [Some(0.1), None]).outcome();
        assert_eq!([show(0.2), show(0.14)], [Holds, Differs]);
        let twelve = |acne, leak| twelve_suffice([Some(acne), Some(leak)], [Some(0.1), Some(0.2)]).outcome();
        assert_eq!([twelve(0.1, 0.2), twelve(0.12, 0.2), twelve(0.1, 0.3)], [Holds, Differs, Differs]);
        assert_eq!(possible_levels(), [17, 29]);
    }

    #[test]
    fn levels_are_what_8_bits_tell_apart() {
        assert_eq!(levels(&[0.0, 0.25, 0.25, 0.5, 0.75, 1.0, 0.5001]), 5);
        assert_eq!(levels(&[]), 0);
    }
}
