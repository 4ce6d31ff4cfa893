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

mod depths;

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
            seconds: [20, 4],
            run: figure_7,
        },
        Target {
            id: "brabec/figure-8",
            title: "A larger map still wants filtering",
            paper: "A 1024² map without filtering is still blocky (15 fps); with fast PCF 2×2 boundaries are smooth (10 fps).",
            ours: "The scene brabec from half the distance, with a 1024² map.",
            seconds: [15, 4],
            run: figure_8,
        },
        Target {
            id: "brabec/levels",
            title: "Levels of grey",
            paper: "Sections 3 and 4: a 2×2 footprint has five levels of shadowing; fast PCF 4×4 adds four phases of five \
                    levels, which makes 20.",
            ours: "The scene brabec, 800×600 pixels, a 512² map. Levels are the different bytes in the picture of \
                   visibility.",
            seconds: [15, 4],
            run: depths::grey_levels,
        },
        Target {
            id: "brabec/depth",
            title: "Depths of few bits",
            paper: "Section 6: encoding depth in 8 bits of a colour loses precision; 12 bits per channel are a solution.",
            ours: "The scene brabec, 800×600 pixels, a 512² map without filtering, depths of 8, 12, 16 bits and floats.",
            seconds: [10, 4],
            run: depths::few_bits,
        },
    ],
};

/// Spec, name, frames per second.
const FIGURE_7: [(&str, &str, f64); 4] = [
    ("hard", "(a) without filtering", 27.5),
    ("stratified.grid=2", "(b) PCF 2×2", 10.0),
    ("packed.grid=2", "(c) fast PCF 2×2", 17.5),
    ("packed.grid=4", "(d) fast PCF 4×4", 5.0),
];

fn figure_7(bench: &Bench<'_>) -> Result<Page> {
    let (page, errors, ratios) = filters(bench, 1.0, 512, &FIGURE_7)?;
    let mut page = page;
    page.verdict(close_to_pcf(errors[1], errors[2], errors[0]));
    page.verdict(faster_than_pcf(ratios[1], ratios[2]));
    page.verdict(least_blocky([errors[0], errors[2], errors[3]]));
    Ok(page)
}

fn figure_8(bench: &Bench<'_>) -> Result<Page> {
    let pair = [("hard", "(a) without filtering", 15.0), ("packed.grid=2", "(b) fast PCF 2×2", 10.0)];
    let (mut page, errors, _) = filters(bench, 0.5, 1024, &pair)?;
    page.verdict(smooth(errors[0], errors[1]));
    Ok(page)
}

/// Pictures and a table; errors and frame times over the first one's.
fn filters(
    bench: &Bench<'_>,
    distance: f32,
    map: u32,
    row: &[(&str, &str, f64)],
) -> Result<(Page, Vec<f64>, Vec<f64>)> {
    let specs: Vec<&str> = row.iter().map(|r| r.0).collect();
    let (shot, map) = (bench.shot("brabec", [800, 600]).from(distance), bench.map(map));
    let study = bench.study(shot, map, &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let entrants: Vec<(u32, &str)> = specs.iter().map(|s| (map, *s)).collect();
    let times = bench.race(shot, &entrants, bench.rounds(7))?;
    let mut table = Table::new(
        "RMSE to the truth; frame time over that without filtering (the paper's from frames per second).",
        &["technique", "RMSE", "frame time"],
    );
    let (mut errors, mut ratios, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for ((spec, name, fps), time) in row.iter().zip(&times) {
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        let ratio = time.frame.median_ms / times[0].frame.median_ms;
        table.row(
            *name,
            vec![Cell::ours(rmse, Unit::Number), Cell::ours(ratio, Unit::Times).paper(row[0].2 / fps)],
        );
        errors.push(rmse);
        ratios.push(ratio);
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
    Ok((page, errors, ratios))
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

/// Errors without filtering, of fast PCF 2×2 and 4×4.
fn least_blocky([none, two, four]: [f64; 3]) -> Verdict {
    Verdict::new(
        "Fast PCF 4×4 has the least blockiness",
        [
            less("RMSE of fast PCF 2×2", two, "that without filtering", none),
            less("RMSE of fast PCF 4×4", four, "that of 2×2", two),
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
