//! Figures 4, 5 and 6: what the series' settings do to shadows.

use crate::{
    gallery,
    numbers::steps,
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::difference,
    study::{Study, Traced},
    verdict::{Ran, Verdict, at_most, csm, less, more},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

const OFFSET: &str = "csm.kernel=5,sampling=trilinear";
const SCALE: &str = "csm.kernel=5,lift=scale,sampling=trilinear";
const FIGURE_4: &str = "blocks, 640×480, 1024²";
/// Share of the depth range within which a caster is in contact.
const NEAR: f64 = 0.05;
/// The same for the ramp of 16 terms.
const RAMP: f64 = 0.07;

pub(super) fn figure_4(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("blocks", [640, 480]), bench.map(1024), &[SCALE, OFFSET])?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
    let regions = bench.regions(&study, RAMP)?;
    let contact = regions.get("contact").map(Vec::as_slice).unwrap_or_default();
    // The ramp itself is no blur.
    let edges: Vec<bool> = ideal.truth.shadowable.iter().zip(contact).map(|(s, c)| *s && !c).collect();
    let mut table = Table::new(
        "Partly lit: share of pixels between 0.05 and 0.95, away from casters. Contact: mean visibility of shadowed pixels beside their \
         caster, where rays say 0.",
        &["setting", "partly lit", "contact", "RMSE to the ideal of 5×5"],
    );
    let mut found = Vec::new();
    for (spec, name) in [(SCALE, "(a) scale"), (OFFSET, "(b) offset")] {
        let soft = partly(&study.look(spec)?.visibility()?.values, &edges);
        let touch = bench.score(&study, spec, ideal, Some(("contact", contact)))?.leak;
        let rmse = bench.score(&study, spec, ideal, None)?.rmse;
        let cells = [(Some(soft), Unit::Share), (touch, Unit::Share), (Some(rmse), Unit::Number)];
        table.row(name, cells.map(|(v, unit)| Cell::ours(v, unit)).into());
        found.push((soft, touch));
    }
    table.row("rays, filtered 5×5", vec![Cell::ours(partly(&ideal.truth.image.values, &edges), Unit::Share)]);
    let mut page = Page::default();
    page.verdict(sharper(found[0].0, found[1].0));
    page.verdict(contact_limits(found[0].1, found[1].1));
    let (a, b) = (&study.look(SCALE)?.picture, &study.look(OFFSET)?.picture);
    let window = gallery::window(&difference(a, b), a, 6);
    let pictures =
        [("(a) scale", a), ("(b) offset", b), ("rays, filtered 5×5 in light space", &ideal.picture)];
    let captions =
        ["As in the figure, with what rays say on the right.", "Enlarged: where the two differ most."];
    gallery::rows(&mut page, captions, 3, &pictures, window)?;
    page.table(table);
    Ok(page)
}

/// Share of the pixels of a mask that are neither lit nor dark.
fn partly(values: &[f32], mask: &[bool]) -> f64 {
    let chosen = || values.iter().zip(mask).filter(|(_, m)| **m).map(|(v, _)| *v);
    chosen().filter(|v| (0.05..0.95).contains(v)).count() as f64 / chosen().count().max(1) as f64
}

fn sharper(scale: f64, offset: f64) -> Verdict {
    Verdict::new(
        csm("figure 4", "scaling f sharpens the transition but also reduces filtering (shadows are sharper)"),
        "Scaling reduces filtering: shadows are sharper",
        Ran::new(FIGURE_4, [SCALE, OFFSET]),
        [less("share of partly lit pixels with a scale", scale, "that with an offset", offset)
            .sentence()
            .was("the same of all pixels that can be in shadow", "the ramp beside casters is no blur")],
    )
}

fn contact_limits(scale: Option<f64>, offset: Option<f64>) -> Verdict {
    Verdict::new(
        csm(
            "figure 4",
            "subtracting an offset preserves convolution results but may exhibit reconstruction limitations near \
             contact points (depending on M)",
        ),
        "An offset loses more shadow near contact points than a scale",
        Ran::new(FIGURE_4, [SCALE, OFFSET]),
        [more("visibility beside casters with an offset", offset, "that with a scale", scale).sentence()],
    )
}

/// Bits, spec.
const STORAGE: [(&str, &str); 3] = [
    ("8 bits", "csm.kernel=5,sampling=trilinear"),
    ("16 bits", "csm.kernel=5,storage=float16,sampling=trilinear"),
    ("32 bits", "csm.kernel=5,storage=float32,sampling=trilinear"),
];

pub(super) fn figure_5(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "To 32 bits: RMSE and largest difference between the visibilities. To the ideal: RMSE to what rays see through \
         5×5.",
        &["scene and storage", "RMSE to 32 bits", "largest", "RMSE to the ideal"],
    );
    for (scene, resolution) in [("fence", [640, 480]), ("blocks", [640, 480])] {
        let study = bench.study(bench.shot(scene, resolution), bench.map(2048), &STORAGE.map(|s| s.1))?;
        let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
        let exact = study.look(STORAGE[2].1)?.visibility()?.values;
        let mut found = Vec::new();
        for (bits, spec) in STORAGE {
            let values = study.look(spec)?.visibility()?.values;
            let [rmse, largest] = apart(&values, &exact, &ideal.truth.shadowable);
            let error = bench.score(&study, spec, ideal, None)?.rmse;
            let cells = [rmse, largest, error].map(|v| Cell::ours(v, Unit::Number));
            table.row(format!("{scene}: {bits}"), cells.into());
            found.push((rmse, error));
        }
        page.verdict(eight_bits(scene, found[0].0, found[0].1, found[2].1));
    }
    let sheet = bench.sheet(bench.shot("blocks", [640, 480]), bench.map(1024), "csm")?;
    page.pictures(
        "Depth and basis textures for M = 16, one channel each, blue positive and red negative.",
        1,
        vec![Tile::new("Sines and cosines of depth, four to a texture.", &sheet)?],
    );
    page.table(table);
    Ok(page)
}

/// Root of the mean square and largest of the differences over a mask.
fn apart(a: &[f32], b: &[f32], mask: &[bool]) -> [f64; 2] {
    let differences =
        || a.iter().zip(b).zip(mask).filter(|(_, m)| **m).map(|((a, b), _)| f64::from((a - b).abs()));
    let squares: f64 = differences().map(|d| d * d).sum();
    [(squares / differences().count().max(1) as f64).sqrt(), differences().fold(0.0, f64::max)]
}

fn eight_bits(scene: &str, rmse: f64, error: f64, exact_error: f64) -> Verdict {
    Verdict::new(
        csm("§4.1", "32-bit floating precision did not produced noticeable differences"),
        format!("8 bits suffice: 32 make no noticeable difference (scene {scene})"),
        Ran::new(&format!("{scene}, 640×480, 2048²"), STORAGE.map(|s| s.1)),
        [
            at_most("RMSE between 8 and 32 bits", rmse, "two levels of an 8-bit picture", 2.0 / 255.0)
                .ours("nobody notices two levels"),
            at_most("RMSE of 8 bits to the ideal", error, "that of 32 bits and 2 %", 1.02 * exact_error)
                .ours(
                    "a difference of 2 % in error is below what kernels and maps of the paper's sizes make",
                ),
        ],
    )
}

const TERMS: [u32; 6] = [1, 2, 4, 8, 16, 32];
/// The other way to light surfaces, as sharp as the series is.
const SCALED: &str = "csm.terms=4,lift=scale,sampling=trilinear";

pub(super) fn figure_6(bench: &Workbench<'_>) -> Result<Page> {
    let specs = TERMS.map(|terms| format!("csm.terms={terms},sampling=trilinear"));
    let mut names: Vec<&str> = specs.iter().map(String::as_str).collect();
    names.push(SCALED);
    let mut page = Page::default();
    let mut table = Table::new(
        "Mean visibility where rays say full shadow: beside the caster and away from it; RMSE to the ideal of 3×3.",
        &["scene and terms", "beside casters", "away from them", "RMSE"],
    );
    for scene in ["blocks", "spheres"] {
        let study = bench.study(bench.shot(scene, [640, 480]), bench.map(1024), &names)?;
        let ideal = &bench.truths(&study, &[Truth::LightSpace(3)])?[0];
        let regions = bench.regions(&study, NEAR)?;
        let contact = regions.get("contact").map(Vec::as_slice).unwrap_or_default();
        let away: Vec<bool> = contact.iter().map(|c| !c).collect();
        let mut found = Vec::new();
        let mut captions: Vec<String> = TERMS.iter().map(|terms| format!("M = {terms}")).collect();
        captions.push("M = 4, scaled".into());
        for (caption, spec) in captions.iter().zip(&names) {
            let values = at(bench, &study, spec, ideal, contact, &away)?;
            let units = [Unit::Share, Unit::Share, Unit::Number];
            let cells = values.iter().zip(units).map(|(v, unit)| Cell::ours(*v, unit)).collect();
            table.row(format!("{scene}: {caption}"), cells);
            found.push(values.map(|v| v.unwrap_or(f64::NAN)));
        }
        let of = |terms: u32| TERMS.iter().position(|t| *t == terms).map_or([f64::NAN; 3], |i| found[i]);
        if scene == "blocks" {
            page.verdict(brighter_with_few(&found[..TERMS.len()].iter().map(|f| f[0]).collect::<Vec<_>>()));
            page.verdict(sixteen_is_sharper(of(4), of(16)));
        }
        page.verdict(satisfactory(4, scene, of(4)[1]));
        page.verdict(satisfactory(2, scene, of(2)[1]));
        let mut pictures = Vec::new();
        for (name, spec) in captions.iter().zip(&names) {
            pictures.push((name.as_str(), &study.look(spec)?.picture));
        }
        let (few, many) = (pictures[0].1, pictures[TERMS.len() - 1].1);
        let window = gallery::window(&difference(few, many), many, 5);
        pictures.push(("rays, filtered 3×3 in light space", &ideal.picture));
        let captions = [
            format!("The scene {scene}, as in the figure, and what rays say."),
            "Enlarged: where fewest and most terms differ most.".into(),
        ];
        gallery::rows(&mut page, [&captions[0], &captions[1]], 4, &pictures, window)?;
    }
    page.table(table);
    page.text(
        "The step of M terms falls over about 1/M of the depth range, more with attenuation; a shadow is dark only \
         where its caster is farther away than that. How many terms suffice depends therefore on how tightly the \
         light's depth range fits the casters.",
    );
    Ok(page)
}

/// Leak beside casters, leak away from them, RMSE.
fn at(
    bench: &Workbench<'_>,
    study: &Study,
    spec: &str,
    ideal: &Traced,
    contact: &[bool],
    away: &[bool],
) -> Result<[Option<f64>; 3]> {
    Ok([
        bench.score(study, spec, ideal, Some(("contact", contact)))?.leak,
        bench.score(study, spec, ideal, Some(("away", away)))?.leak,
        Some(bench.score(study, spec, ideal, None)?.rmse),
    ])
}

fn brighter_with_few(beside: &[f64]) -> Verdict {
    let falls = steps(beside.windows(2).map(|pair| [pair[1], pair[0]]));
    Verdict::new(
        csm(
            "§5",
            "A small M results in wrongfully brightened shadows when occluder and receiver are close to each other",
        ),
        "Few terms brighten shadows beside their casters: the more terms, the darker",
        Ran::new("blocks, 640×480, 1024², M of 1 to 32", ["csm.sampling=trilinear"]),
        [more("least quotient of the visibilities of fewer and more terms", falls, "1", 1.0).sentence()],
    )
}

/// Four terms, or the two that fit in one texture, with the one setting that all of the paper's results have.
fn satisfactory(terms: u32, scene: &str, away: f64) -> Verdict {
    let (place, words) = match terms {
        2 => (
            "figure 6",
            "When using a tightly fitted light frustum a single 8-bit RGBA texture usually faithfully reconstructs the \
             shadow test.",
        ),
        _ => ("§5", "In practice M = 4 yields satisfactory shadows without noticeable intensity artifacts."),
    };
    let limit = at_most(format!("visibility in full shadow with M = {terms}"), away, "5 %", 0.05)
        .ours("13 of 255 levels of light in full shadow begin to show");
    Verdict::new(
        csm(place, words),
        format!(
            "M = {terms} is satisfactory: away from contact, shadows have no noticeable light (scene {scene})"
        ),
        Ran::new(&format!("{scene}, 640×480, 1024²"), [format!("csm.terms={terms},sampling=trilinear")]),
        [limit],
    )
}

/// Beside casters, away from them, RMSE.
fn sixteen_is_sharper(four: [f64; 3], sixteen: [f64; 3]) -> Verdict {
    Verdict::new(
        csm(
            "§5",
            "As M grows, the reconstructed step function becomes steeper, which produces correctly shaded shadows.",
        ),
        "M = 16 is sharper: less light beside casters and closer to the ideal than M = 4",
        Ran::new("blocks, 640×480, 1024²", ["csm.terms=4,sampling=trilinear", "csm.sampling=trilinear"]),
        [
            less("visibility beside casters with M = 16", sixteen[0], "that with M = 4", four[0]).sentence(),
            less("RMSE with M = 16", sixteen[2], "that with M = 4", four[2]).sentence(),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(sharper(0.1, 0.2).outcome(), Holds);
        assert_eq!(sharper(0.2, 0.1).outcome(), Differs);
        assert_eq!(contact_limits(Some(0.1), Some(0.3)).outcome(), Holds);
        assert_eq!(contact_limits(Some(0.3), Some(0.1)).outcome(), Differs);
        assert_eq!(contact_limits(None, Some(0.1)).outcome(), Open);
        assert_eq!(eight_bits("s", 0.002, 0.1, 0.1).outcome(), Holds);
        assert_eq!(eight_bits("s", 0.02, 0.1, 0.1).outcome(), Differs);
        assert_eq!(eight_bits("s", 0.002, 0.11, 0.1).outcome(), Differs);
        assert_eq!(brighter_with_few(&[0.9, 0.5, 0.2]).outcome(), Holds);
        assert_eq!(brighter_with_few(&[0.9, 0.5, 0.6]).outcome(), Differs);
        for terms in [2, 4] {
            assert_eq!(satisfactory(terms, "s", 0.02).outcome(), Holds);
            assert_eq!(satisfactory(terms, "s", 0.2).outcome(), Differs);
        }
        assert_eq!(sixteen_is_sharper([0.5, 0.1, 0.2], [0.3, 0.0, 0.1]).outcome(), Holds);
        assert_eq!(sixteen_is_sharper([0.5, 0.1, 0.2], [0.6, 0.0, 0.1]).outcome(), Differs);
        assert_eq!(sixteen_is_sharper([0.5, 0.1, 0.2], [0.3, 0.0, 0.3]).outcome(), Differs);
    }

    #[test]
    fn masks_choose() {
        assert_eq!(partly(&[0.5, 0.5, 1.0, 0.0], &[true, false, true, true]), 1.0 / 3.0);
        assert_eq!(apart(&[0.0, 1.0, 0.5], &[0.5, 0.0, 0.5], &[true, false, true])[1], 0.5);
    }
}
