//! Figures 2 and 12 to 15: whose edges are right.

use crate::{
    gallery,
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::{difference, gray},
    study::{Study, Traced},
    verdict::{Ran, Saying, Verdict, at_least, less, more, spsm as spsm_says},
    workbench::{Workbench, first_known},
};
use antumbra_lab::metrics::Score;
use antumbra_lab::truth::Truth;
use anyhow::{Context, Result};

const PAIR: [(&str, &str); 2] = [("hard", "standard map"), ("spsm", "SPSM")];
/// Name of the technique's kind of pixels.
const UNCERTAIN: &str = "uncertain";

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
    let (study, truth) = studied(bench, "spheres", [640, 480], 512, &PAIR.map(|p| p.0))?;
    let mut table = Table::new("Against one shadow ray per pixel.", &HEAD);
    let mut edges = Vec::new();
    let mut pictures = Vec::new();
    for (spec, name) in PAIR {
        let score = bench.score(&study, spec, &truth, None)?;
        row(&mut table, name.into(), &score, None);
        edges.push(score.pixel_match_near_edges);
        pictures.push((name, &study.look(spec)?.picture));
    }
    let tinted = study.look("spsm")?.tinted.as_ref().context("SPSM tells no kinds of pixels apart")?;
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    pictures.extend([("uncertain pixels, red", tinted), ("rays", &truth.picture)]);
    let mut page = Page::default();
    page.verdict(smooth(edges[0], edges[1]));
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
        Ran::new("spheres, 640×480, 512²", PAIR.map(|p| p.0)),
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
    let mut found = Vec::new();
    for map in [1024, 2048] {
        let (study, truth) = studied(bench, "tangle", [800, 600], map, &PAIR.map(|p| p.0))?;
        let mut pictures = Vec::new();
        for (i, (spec, name)) in PAIR.into_iter().enumerate() {
            let score = bench.score(&study, spec, &truth, None)?;
            row(&mut table, format!("{name}, {map}²"), &score, (map == 2048).then_some(MATCH[i]));
            found.push(score.pixel_match);
            pictures.push((name, &study.look(spec)?.picture));
        }
        pictures.push(("rays", &truth.picture));
        let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
        let captions =
            [format!("Maps of {map}²."), "Enlarged: where the standard map looks most wrong.".into()];
        gallery::rows(&mut page, [&captions[0], &captions[1]], 3, &pictures, window)?;
    }
    page.table(table);
    page.verdict(matches(found[2], found[3]));
    page.verdict(outperforms(found[0], found[1]));
    Ok(page)
}

fn matches(hard: f64, spsm: f64) -> Verdict {
    Verdict::new(
        spsm_says(
            "§6.2",
            "a pixel match of ≈ 99.63% while the standard shadow mapping achieves a pixel match of ≈ 97.93% using a single 2K × 2K shadow map",
        ),
        "With a 2048² map SPSM matches 99.63 % of the pixels, a standard map fewer",
        Ran::new("tangle, 800×600, 2048²", PAIR.map(|p| p.0)),
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
        Ran::new("tangle, 800×600, 1024²", PAIR.map(|p| p.0)),
        [more("pixel match of SPSM", spsm, "that of the standard map", hard).sentence()],
    )
}

pub(super) fn figure_13(bench: &Workbench<'_>) -> Result<Page> {
    // As published: rays that meet no triangle are lit.
    let rgsm = first_known(&["rgsm.neighbours=5,missed=lit"]);
    let mut entries: Vec<(&str, &str)> = vec![PAIR[0]];
    entries.extend(rgsm.map(|_| ("rgsm.neighbours=3,missed=lit", "RGSM 3×3")));
    entries.extend(rgsm.map(|spec| (spec, "RGSM 5×5")));
    entries.push(PAIR[1]);
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
    page.verdict(works([of("standard map", "tangle"), of("SPSM", "tangle")]));
    page.verdict(match rgsm {
        None => Verdict::open(dense(), DENSE, "this program has no technique called rgsm"),
        Some(_) => rgsm_fails(
            ["contact", "tangle"].map(|scene| [of("standard map", scene), of("RGSM 5×5", scene)]),
            of("SPSM", "tangle"),
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
        Ran::new("tangle, 640×480, 512²", PAIR.map(|p| p.0)),
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
        Ran::new("contact and tangle, 640×480, 512²", ["hard", "rgsm.neighbours=5,missed=lit", "spsm"]),
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

pub(super) fn figure_14(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Shares of the pixels that see geometry. The paper leaves the last two without colour.",
        &["map", "uncertain", "by 3×3 triangles", "by one", "lit, or facing away"],
    );
    let mut shares = Vec::new();
    let mut tiles = Vec::new();
    for map in [512, 1024, 2048] {
        let study = bench.study(bench.shot("tangle", [640, 480]), bench.map(map), &["spsm"])?;
        let look = study.look("spsm")?;
        let uncertain = look.share(UNCERTAIN).with_context(|| format!("SPSM has no pixels '{UNCERTAIN}'"))?;
        let of = |i: usize| look.classes.get(i).map(|c| c.share);
        let others = of(0).zip(of(1)).map(|(own, around)| 1.0 - uncertain - around - own);
        let cells = [Some(uncertain), of(1), of(0), others].map(|v| Cell::ours(v, Unit::Share));
        table.row(format!("{map}²"), cells.into());
        let tinted = look.tinted.as_ref().context("SPSM tells no kinds of pixels apart")?;
        tiles.push(Tile::new(format!("{map}²: {:.1} % uncertain", 100.0 * uncertain), tinted)?);
        shares.push(uncertain);
    }
    let mut page = Page::default();
    page.verdict(fewer(&shares));
    page.pictures(
        "Red: uncertain. Green: shadowed by a triangle of 3×3 texels. Blue: by the texel's own.",
        3,
        tiles,
    );
    page.table(table);
    Ok(page)
}

fn fewer(shares: &[f64]) -> Verdict {
    let max = shares.windows(2).map(|pair| pair[1] / pair[0]).reduce(f64::max);
    Verdict::new(
        spsm_says(
            "§6.3",
            "We observe that the costly silhouette recovery concerns few pixels when using high resolution shadow maps.",
        ),
        "The larger the map, the fewer pixels need silhouette recovery",
        Ran::new("tangle, 640×480, maps of 512², 1024² and 2048²", ["spsm"]),
        [less("largest quotient of the shares of a map and the next smaller", max, "1", 1.0).sentence()],
    )
}

pub(super) fn figure_15(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "Fusion: share of the pixels that rays see lit which are answered shadowed.",
        &["technique and map", "fusion", "pixel match"],
    );
    let mut found = Vec::new();
    let mut images = Vec::new();
    let mut truth = None;
    for map in [512, 1024] {
        let (study, traced) = studied(bench, "trees", [640, 480], map, &PAIR.map(|p| p.0))?;
        for (spec, name) in PAIR {
            let score = bench.score(&study, spec, &traced, None)?;
            let cells = [score.acne, Some(score.pixel_match)].map(|v| Cell::ours(v, Unit::Share));
            table.row(format!("{name}, {map}²"), cells.into());
            if spec == "spsm" {
                found.push(score.acne);
                images.push(gray(&study.look(spec)?.visibility()?));
            }
        }
        truth = Some(gray(&traced.truth.image));
    }
    let truth = truth.context("no truth")?;
    let window = gallery::window(&difference(&images[0], &truth), &truth, 6);
    let pictures = [("SPSM, 512²", &images[0]), ("SPSM, 1024²", &images[1]), ("rays", &truth)];
    page.verdict(reduced(found[0], found[1]));
    let captions = ["Visibility.", "Enlarged: where the smaller map is most wrong."];
    gallery::rows(&mut page, captions, 3, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn reduced(small: Option<f64>, large: Option<f64>) -> Verdict {
    Verdict::new(
        spsm_says("figure 15", "Increasing the resolution helps reduce these artifacts"),
        "A larger map reduces shadow fusion",
        Ran::new("trees, 640×480, 512² and 1024²", ["spsm"]),
        [less("fusion with 1024²", large, "that with 512²", small).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

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
        assert_eq!(fewer(&[0.1, 0.05, 0.02]).outcome(), Holds);
        assert_eq!(fewer(&[0.1, 0.05, 0.06]).outcome(), Differs);
        assert_eq!(reduced(Some(0.1), Some(0.05)).outcome(), Holds);
        assert_eq!(reduced(Some(0.05), Some(0.1)).outcome(), Differs);
        assert_eq!(reduced(None, Some(0.1)).outcome(), Open);
    }
}
