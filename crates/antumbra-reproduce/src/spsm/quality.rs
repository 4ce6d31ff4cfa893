//! Figures 2, 12 and 13: whose edges are right.

use super::{COMPARED, PUBLISHED};
use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::{Study, Traced},
    verdict::{Ran, Saying, Verdict, at_least, less, more, spsm as spsm_says},
    workbench::{Workbench, first_known},
};
use antumbra_lab::metrics::Score;
use antumbra_lab::truth::Truth;
use anyhow::{Context, Result};

/// Those of which claims are made: a standard map, and the paper's method.
const PAIR: [&str; 2] = [COMPARED[0].0, COMPARED[1].0];
/// The paper's method without its silhouettes.
const UNRECOVERED: (&str, &str) = ("spsm.packing=map,layers=1,uncertain=lit", "without recovery");

/// Techniques on a scene, and one shadow ray per pixel.
pub(super) fn studied(
    bench: &Workbench<'_>,
    scene: &'static str,
    resolution: [u32; 2],
    map: u32,
    specs: &[&str],
) -> Result<(Study, Traced)> {
    let study = bench.study(bench.shot(scene, resolution), bench.map(map), specs)?;
    let mut truths = bench.truths(&study, &[Truth::Hard])?;
    Ok((study, truths.remove(0)))
}

/// Adds a row of match, match near edges, RMSE.
fn row(table: &mut Table, name: String, score: &Score, paper: Option<f64>) {
    table.row(
        name,
        vec![
            Cell::ours(score.pixel_match, Unit::Share).paper(paper),
            Cell::ours(score.pixel_match_near_edges, Unit::Share),
            Cell::ours(score.rmse, Unit::Number),
        ],
    );
}

const HEAD: [&str; 4] = ["technique", "pixel match", "within 2 pixels of edges", "RMSE"];

pub(super) fn figure_2(bench: &Workbench<'_>) -> Result<Page> {
    let mut entries = COMPARED.to_vec();
    entries.insert(1, UNRECOVERED);
    let specs: Vec<&str> = entries.iter().map(|e| e.0).collect();
    let (study, truth) = studied(bench, "spheres", [640, 480], 512, &specs)?;
    let mut table = Table::new("Against one shadow ray per pixel.", &HEAD);
    let mut edges = Vec::new();
    let mut pictures = Vec::new();
    for (spec, name) in entries {
        let score = bench.score(&study, spec, &truth, None)?;
        row(&mut table, name.into(), &score, None);
        edges.push(score.pixel_match_near_edges);
        pictures.push((name, &study.look(spec)?.picture));
    }
    let tinted = study.look(PUBLISHED)?.tinted.as_ref().context("SPSM tells no kinds of pixels apart")?;
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    pictures.extend([("recovered pixels of the published, red", tinted), ("rays", &truth.picture)]);
    let mut page = Page::default();
    page.verdict(smooth(edges[0], edges[2]));
    let captions = ["The scene.", "Enlarged: where the standard map looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn smooth(hard: Option<f64>, spsm: Option<f64>) -> Verdict {
    Verdict::new(
        spsm_says(
            "§6.2",
            "Most of the aliasing observed with the standard shadow mapping disappears with the SPSM",
        ),
        "SPSM recovers silhouettes that a standard map of the same size breaks into texels",
        Ran::new("spheres, 640×480, 512²", PAIR),
        [less(
            "share of wrong pixels near edges with SPSM",
            spsm.map(|s| 1.0 - s),
            "half of that with the standard map",
            hard.map(|h| 0.5 * (1.0 - h)),
        )
        .ours("most is more than half")],
    )
}

/// Standard map and SPSM at 2048².
const MATCH: [f64; 2] = [0.9793, 0.9963];

pub(super) fn figure_12(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new("Against one shadow ray per pixel.", &HEAD);
    let mut found = [[0.0; 2]; 2];
    for (at, map) in [1024, 2048].into_iter().enumerate() {
        let (study, truth) = studied(bench, "tangle", [800, 600], map, &COMPARED.map(|c| c.0))?;
        let mut pictures = Vec::new();
        for (i, (spec, name)) in COMPARED.into_iter().enumerate() {
            let score = bench.score(&study, spec, &truth, None)?;
            let paper = MATCH.get(i).filter(|_| map == 2048).copied();
            row(&mut table, format!("{name}, {map}²"), &score, paper);
            if let Some(found) = found[at].get_mut(i) {
                *found = score.pixel_match;
            }
            pictures.push((name, &study.look(spec)?.picture));
        }
        pictures.push(("rays", &truth.picture));
        let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
        let captions =
            [format!("Maps of {map}²."), "Enlarged: where the standard map looks most wrong.".into()];
        gallery::rows(&mut page, [&captions[0], &captions[1]], 3, &pictures, window)?;
    }
    page.table(table);
    page.verdict(matches(found[1][0], found[1][1]));
    page.verdict(outperforms(found[0][0], found[0][1]));
    Ok(page)
}

fn matches(hard: f64, spsm: f64) -> Verdict {
    Verdict::new(
        spsm_says(
            "§6.2",
            "a pixel match of ≈ 99.63% while the standard shadow mapping achieves a pixel match of ≈ 97.93% using a single 2K × 2K shadow map",
        ),
        "With a 2048² map SPSM matches 99.63 % of the pixels, a standard map fewer",
        Ran::new("tangle, 800×600, 2048²", PAIR),
        [
            at_least("pixel match of SPSM", spsm, "the paper's", MATCH[1]).document("§6.2"),
            more("pixel match of SPSM", spsm, "that of the standard map", hard).sentence(),
        ],
    )
}

fn outperforms(hard: f64, spsm: f64) -> Verdict {
    Verdict::new(
        spsm_says(
            "§6.2",
            "In every scene, the SPSM outperforms the standard shadow mapping algorithm in terms of visual quality.",
        ),
        "SPSM outperforms a standard map at 1024² too",
        Ran::new("tangle, 800×600, 1024²", PAIR),
        [more("pixel match of SPSM", spsm, "that of the standard map", hard).sentence()],
    )
}

pub(super) fn figure_13(bench: &Workbench<'_>) -> Result<Page> {
    // As published: rays that meet no triangle are lit.
    let rgsm = first_known(&["rgsm.neighbours=5,missed=lit"]);
    let mut entries: Vec<(&str, &str)> = vec![COMPARED[0]];
    entries.extend(rgsm.map(|_| ("rgsm.neighbours=3,missed=lit", "RGSM 3×3")));
    entries.extend(rgsm.map(|spec| (spec, "RGSM 5×5")));
    entries.extend(&COMPARED[1..]);
    let specs: Vec<&str> = entries.iter().map(|e| e.0).collect();
    let mut page = Page::default();
    let mut table = Table::new("Against one shadow ray per pixel, maps of 512².", &HEAD);
    let mut wrong = Vec::new();
    for scene in ["contact", "tangle"] {
        let (study, truth) = studied(bench, scene, [640, 480], 512, &specs)?;
        let mut pictures = Vec::new();
        for (spec, name) in &entries {
            let score = bench.score(&study, spec, &truth, None)?;
            row(&mut table, format!("{scene}: {name}"), &score, None);
            wrong.push((*name, scene, 1.0 - score.pixel_match));
            pictures.push((*name, &study.look(spec)?.picture));
        }
        pictures.push(("rays", &truth.picture));
        let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 6);
        let captions =
            [format!("The scene {scene}."), "Enlarged: where the standard map looks most wrong.".into()];
        gallery::rows(&mut page, [&captions[0], &captions[1]], pictures.len(), &pictures, window)?;
    }
    page.table(table);
    let of = |name: &str, scene: &str| wrong.iter().find(|w| w.0 == name && w.1 == scene).map(|w| w.2);
    page.verdict(works([of("standard map", "tangle"), of(COMPARED[1].1, "tangle")]));
    page.verdict(match rgsm {
        None => Verdict::open(dense(), DENSE, "this program has no technique called rgsm"),
        Some(_) => rgsm_fails(
            ["contact", "tangle"].map(|scene| [of("standard map", scene), of("RGSM 5×5", scene)]),
            of(COMPARED[1].1, "tangle"),
        ),
    });
    Ok(page)
}

fn dense() -> Saying {
    spsm_says(
        "§6.2",
        "the RGSM works for low density polygon models but fails to properly render shadows for highly tessellated models (Figure 13 middle), even with large kernel size ≥ 5 × 5",
    )
}

const DENSE: &str = "RGSM works for few triangles and fails for dense meshes, twice as often as SPSM";

fn works([hard, spsm]: [Option<f64>; 2]) -> Verdict {
    Verdict::new(
        spsm_says(
            "figure 13",
            "The SPSM correctly recovers the shadow boundaries of occluders whatever their polygon density.",
        ),
        "SPSM recovers boundaries of dense meshes",
        Ran::new("tangle, 640×480, 512²", PAIR),
        [less("wrong pixels of SPSM on tangle", spsm, "half of the standard map's", hard.map(|h| 0.5 * h))
            .ours("boundaries are recovered where most of what is wrong of them is mended")],
    )
}

/// Wrong pixels of standard map and RGSM on few triangles and on many, and of SPSM on many.
fn rgsm_fails([few, many]: [[Option<f64>; 2]; 2], spsm: Option<f64>) -> Verdict {
    let works = "what works is less than half as wrong as a standard map";
    Verdict::new(
        dense(),
        DENSE,
        Ran::new("contact and tangle, 640×480, 512²", ["hard", "rgsm.neighbours=5,missed=lit", PUBLISHED]),
        [
            less(
                "wrong pixels of RGSM 5×5 on contact",
                few[1],
                "half of the standard map's",
                few[0].map(|h| 0.5 * h),
            )
            .ours(works),
            more(
                "wrong pixels of RGSM 5×5 on tangle",
                many[1],
                "half of the standard map's",
                many[0].map(|h| 0.5 * h),
            )
            .ours(works),
            more("wrong pixels of RGSM 5×5 on tangle", many[1], "twice those of SPSM", spsm.map(|s| 2.0 * s))
                .ours("where one fails and the other does not, their errors are a multiple of one another")
                .was("the claim that RGSM fails where SPSM does not", "SPSM was wrong there too"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(smooth(Some(0.8), Some(0.95)).outcome(), Holds);
        assert_eq!(smooth(Some(0.8), Some(0.85)).outcome(), Differs);
        assert_eq!(matches(0.98, 0.998).outcome(), Holds);
        assert_eq!(matches(0.98, 0.99).outcome(), Differs);
        assert_eq!(matches(0.999, 0.998).outcome(), Differs);
        assert_eq!(outperforms(0.98, 0.99).outcome(), Holds);
        assert_eq!(outperforms(0.99, 0.98).outcome(), Differs);
        assert_eq!(works([Some(0.04), Some(0.01)]).outcome(), Holds);
        assert_eq!(works([Some(0.04), Some(0.03)]).outcome(), Differs);
        let few = [Some(0.02), Some(0.002)];
        assert_eq!(rgsm_fails([few, [Some(0.04), Some(0.03)]], Some(0.01)).outcome(), Holds);
        assert_eq!(rgsm_fails([few, [Some(0.04), Some(0.01)]], Some(0.01)).outcome(), Differs);
        assert_eq!(
            rgsm_fails([[Some(0.02), Some(0.02)], [Some(0.04), Some(0.03)]], Some(0.01)).outcome(),
            Differs
        );
    }
}
