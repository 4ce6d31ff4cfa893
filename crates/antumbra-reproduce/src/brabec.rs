//! Brabec and Seidel 2001, Hardware-accelerated rendering of antialiased shadows with shadow maps.

use crate::{
    bench::Bench,
    gallery,
    page::{Cell, Page, Table, Unit},
    raster::difference,
    study::Truth,
    target::{Source, Target},
    verdict::{Verdict, at_most, less, more},
};
use anyhow::Result;

pub(crate) const SOURCE: Source = Source {
    key: "brabec",
    name: "Brabec and Seidel 2001, Hardware-accelerated rendering of antialiased shadows",
    targets: &[
        Target {
            id: "brabec/figure-7",
            title: "Four ways to filter a shadow map of 512²",
            paper: "7,000 polygons, 800×600 pixels, a 512² map: without filtering (25 to 30 fps), PCF 2×2 of four jittered \
                    passes (10 fps), fast PCF 2×2 of packed neighbours (15 to 20 fps), fast PCF 4×4 (5 fps). Fast PCF is \
                    comparable to PCF in quality; with 4×4 blockiness is reduced to a minimum.",
            ours: "The scene brabec (7,000 triangles, a spot light) at the same sizes. stratified is the PCF of jittered \
                   passes, packed the fast one. The truth is sharp, with 16 rays per pixel.",
            seconds: [15, 3],
            run: figure_7,
        },
        Target {
            id: "brabec/figure-8",
            title: "A larger map still wants filtering",
            paper: "A 1024² map without filtering is still blocky (15 fps); with fast PCF 2×2 boundaries are smooth (10 fps).",
            ours: "The scene brabec from half the distance, with a 1024² map.",
            seconds: [12, 2],
            run: figure_8,
        },
    ],
};

/// Spec, name, texels that are averaged, frames per second.
type Filter = (&'static str, &'static str, u32, f64);

const FIGURE_7: [Filter; 4] = [
    ("hard", "(a) without filtering", 1, 27.5),
    ("stratified.grid=2", "(b) PCF 2×2", 1, 10.0),
    ("packed.grid=2", "(c) fast PCF 2×2", 2, 17.5),
    ("packed.grid=4", "(d) fast PCF 4×4", 4, 5.0),
];

fn figure_7(bench: &Bench<'_>) -> Result<Page> {
    let Measured { mut page, errors, blocks, ratios } = filters(bench, 1.0, 512, &FIGURE_7)?;
    page.verdict(close_to_pcf(errors[1], errors[2], errors[0]));
    page.verdict(faster_than_pcf(ratios[1], ratios[2]));
    page.verdict(least_blocky([blocks[0], blocks[2], blocks[3]]));
    Ok(page)
}

fn figure_8(bench: &Bench<'_>) -> Result<Page> {
    let pair = [("hard", "(a) without filtering", 1, 15.0), ("packed.grid=2", "(b) fast PCF 2×2", 2, 10.0)];
    let Measured { mut page, errors, .. } = filters(bench, 0.5, 1024, &pair)?;
    page.verdict(smooth(errors[0], errors[1]));
    Ok(page)
}

/// A page with pictures and a table, and the numbers in it, one for each filter.
struct Measured {
    page: Page,
    /// To the sharp truth.
    errors: Vec<f64>,
    /// To what rays see through a kernel as wide as the filter.
    blocks: Vec<f64>,
    /// Frame times over the first one's.
    ratios: Vec<f64>,
}

fn filters(bench: &Bench<'_>, distance: f32, map: u32, row: &[Filter]) -> Result<Measured> {
    let specs: Vec<&str> = row.iter().map(|r| r.0).collect();
    let (shot, map) = (bench.shot("brabec", [800, 600]).from(distance), bench.map(map));
    let study = bench.study(shot, map, &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let entrants: Vec<(u32, &str)> = specs.iter().map(|s| (map, *s)).collect();
    let times = bench.race(shot, &entrants, bench.rounds(7))?;
    let mut table = Table::new(
        "RMSE to the sharp truth; blockiness, the RMSE to what rays see through a kernel as wide as the filter; frame \
         time over that without filtering (the paper's from frames per second).",
        &["technique", "RMSE", "blockiness", "frame time"],
    );
    let (mut errors, mut blocks, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    let mut pictures = Vec::new();
    for ((spec, name, width, fps), time) in row.iter().zip(&times) {
        let ideal = &bench.truths(&study, &[Truth::LightSpace(*width)])?[0];
        errors.push(bench.score(&study, spec, truth, None)?.rmse);
        blocks.push(bench.score(&study, spec, ideal, None)?.rmse);
        ratios.push(time.frame.median_ms / times[0].frame.median_ms);
        let last = errors.len() - 1;
        table.row(
            *name,
            vec![
                Cell::ours(errors[last], Unit::Number),
                Cell::ours(blocks[last], Unit::Number),
                Cell::ours(ratios[last], Unit::Times).paper(row[0].3 / fps),
            ],
        );
        pictures.push((*name, &study.look(spec)?.picture));
    }
    pictures.push(("16 rays per pixel", &truth.picture));
    let mut page = Page::default();
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = [
        "As in the figure, with what rays say on the right.",
        "Enlarged: where no filtering looks most wrong.",
    ];
    gallery::rows(&mut page, captions, pictures.len(), &pictures, window)?;
    page.table(table);
    Ok(Measured { page, errors, blocks, ratios })
}

fn close_to_pcf(pcf: f64, fast: f64, none: f64) -> Verdict {
    Verdict::new(
        "Fast PCF 2×2 is close to PCF 2×2 in quality",
        [
            at_most("RMSE of fast PCF", fast, "that of PCF and a quarter", 1.25 * pcf),
            less("RMSE of fast PCF", fast, "that without filtering", none),
        ],
    )
}

fn faster_than_pcf(pcf: f64, fast: f64) -> Verdict {
    Verdict::new(
        "Fast PCF 2×2 is faster than PCF 2×2",
        [less("its frame time, in frames without filtering", fast, "that of PCF", pcf)],
    )
}

/// Blockiness without filtering, of fast PCF 2×2 and 4×4.
fn least_blocky([none, two, four]: [f64; 3]) -> Verdict {
    Verdict::new(
        "Fast PCF 4×4 has the least blockiness",
        [
            less("blockiness of fast PCF 2×2", two, "that without filtering", none),
            less("blockiness of fast PCF 4×4", four, "that of 2×2", two),
        ],
    )
}

fn smooth(none: f64, fast: f64) -> Verdict {
    Verdict::new(
        "At 1024² too, fast PCF smooths blocky boundaries",
        [more("RMSE without filtering", none, "1.1 times that of fast PCF 2×2", 1.1 * fast)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(close_to_pcf(0.1, 0.12, 0.2).outcome(), Holds);
        assert_eq!(close_to_pcf(0.1, 0.13, 0.2).outcome(), Differs);
        assert_eq!(close_to_pcf(0.1, 0.12, 0.11).outcome(), Differs);
        assert_eq!(faster_than_pcf(2.0, 1.5).outcome(), Holds);
        assert_eq!(faster_than_pcf(1.5, 2.0).outcome(), Differs);
        assert_eq!(least_blocky([0.3, 0.2, 0.1]).outcome(), Holds);
        assert_eq!(least_blocky([0.3, 0.1, 0.2]).outcome(), Differs);
        assert_eq!(smooth(0.2, 0.1).outcome(), Holds);
        assert_eq!(smooth(0.1, 0.1).outcome(), Differs);
    }
}
