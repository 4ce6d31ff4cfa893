//! Figures 14 and 15: where many triangles share texels.

use super::{COMPARED, PUBLISHED, quality::studied};
use crate::{
    gallery,
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::{difference, gray},
    verdict::{Ran, Verdict, less, spsm as spsm_says},
    workbench::Workbench,
};
use anyhow::{Context, Result};

/// Name of the technique's kind of pixels.
const UNCERTAIN: &str = "uncertain";

pub(super) fn figure_14(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Shares of the pixels that see geometry. The paper leaves the last two without colour.",
        &["map", "uncertain", "by 3×3 triangles", "by one", "lit, or facing away"],
    );
    let mut shares = Vec::new();
    let mut tiles = Vec::new();
    for map in [512, 1024, 2048] {
        let study = bench.study(bench.shot("tangle", [640, 480]), bench.map(map), &[PUBLISHED, "spsm"])?;
        for (spec, name) in &COMPARED[1..3] {
            let look = study.look(spec)?;
            let of = |i: usize| look.classes.get(i).map(|c| c.share);
            let others = of(0).zip(of(1)).zip(of(2)).map(|((own, around), other)| 1.0 - other - around - own);
            table.row(
                format!("{name}, {map}²"),
                [of(2), of(1), of(0), others].map(|v| Cell::ours(v, Unit::Share)).into(),
            );
        }
        let look = study.look(PUBLISHED)?;
        let uncertain = look.share(UNCERTAIN).with_context(|| format!("SPSM has no pixels '{UNCERTAIN}'"))?;
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
        Ran::new("tangle, 640×480, maps of 512², 1024² and 2048²", [PUBLISHED]),
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
        let (study, traced) = studied(bench, "trees", [640, 480], map, &COMPARED.map(|c| c.0))?;
        for (spec, name) in COMPARED {
            let score = bench.score(&study, spec, &traced, None)?;
            let cells = [score.acne, Some(score.pixel_match)].map(|v| Cell::ours(v, Unit::Share));
            table.row(format!("{name}, {map}²"), cells.into());
            if spec == PUBLISHED {
                found.push(score.acne);
                images.push(gray(&study.look(spec)?.visibility()?));
            }
        }
        truth = Some(gray(&traced.truth.image));
    }
    let truth = truth.context("no truth")?;
    let window = gallery::window(&difference(&images[0], &truth), &truth, 6);
    let pictures =
        [("as published, 512²", &images[0]), ("as published, 1024²", &images[1]), ("rays", &truth)];
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
        Ran::new("trees, 640×480, 512² and 1024²", [PUBLISHED]),
        [less("fusion with 1024²", large, "that with 512²", small).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(fewer(&[0.1, 0.05, 0.02]).outcome(), Holds);
        assert_eq!(fewer(&[0.1, 0.05, 0.06]).outcome(), Differs);
        assert_eq!(reduced(Some(0.1), Some(0.05)).outcome(), Holds);
        assert_eq!(reduced(Some(0.05), Some(0.1)).outcome(), Differs);
        assert_eq!(reduced(None, Some(0.1)).outcome(), Open);
    }
}
