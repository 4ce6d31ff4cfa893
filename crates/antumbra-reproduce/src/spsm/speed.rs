//! Tables 1 and 2: frame times.

use super::PUBLISHED;
use crate::{
    numbers::{Measured, largest, smallest},
    page::{Cell, Page, Table, Unit},
    verdict::{Ran, Verdict, at_most, more, spsm as spsm_says},
    workbench::Workbench,
};
use anyhow::Result;

/// Scene, its name in the paper, milliseconds of standard and sub-pixel maps of 1024² and 2048².
const TABLE_1: [(&str, &str, [f64; 2], [f64; 2]); 3] = [
    ("spheres", "Spheres", [5.0, 6.8], [6.8, 8.6]),
    ("tangle", "YeahRight", [5.8, 7.4], [9.1, 10.7]),
    ("city", "City", [31.2, 32.2], [40.0, 41.6]),
];

const SPECS: [&str; 5] = ["hard", PUBLISHED, "spsm", "dpm", "exact"];
/// Pixels of the paper's pictures.
const RESOLUTION: [u32; 2] = [1920, 1080];

pub(super) fn table_1(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Frame times over that of the standard map: SPSM as published, with two layers, deep primitive maps (DPM), lists of \
         all triangles; and that of the standard map of 1024².",
        &["scene", "1024²", "2048²", "two layers", "2048²", "DPM", "2048²", "all", "2048²", "standard"],
    );
    let mut page = Page::default();
    let mut overheads = Vec::new();
    for (scene, name, standard, subpixel) in TABLE_1 {
        if bench.quick && scene == "city" {
            page.text("A quick run leaves the city out.");
            continue;
        }
        let maps = [1024, 2048].map(|m| bench.map(m));
        let frames: Vec<(u32, &str)> = maps.iter().flat_map(|map| SPECS.map(|spec| (*map, spec))).collect();
        let times = match bench.times(bench.shot(scene, RESOLUTION), &frames, bench.rounds()) {
            Ok(times) => times,
            Err(reason) => {
                page.text(format!("{scene} was not measured: {reason:#}"));
                continue;
            }
        };
        let both = |of: usize| [0, SPECS.len()].map(|first| times[first + of].over(&times[first]));
        let ratios = both(1);
        let mut cells: Vec<Cell> = (0..2)
            .map(|i| Cell::ours(ratios[i].value, Unit::Times).paper(subpixel[i] / standard[i]))
            .collect();
        cells.extend([2, 3, 4].map(both).into_iter().flatten().map(|t| Cell::ours(t.value, Unit::Times)));
        cells.push(Cell::ours(times[0].ms(), Unit::Milliseconds));
        table.row(format!("{scene} ({name})"), cells);
        overheads.extend(ratios);
    }
    page.table(table);
    page.verdict(small_overhead(&overheads));
    Ok(page)
}

fn small_overhead(ratios: &[Measured]) -> Verdict {
    let max = largest(ratios.iter().copied());
    Verdict::new(
        spsm_says(
            "§6.3",
            "SPSM achieves real time performance with a computational overhead going from 26% to 56% compared to the standard shadow mapping algorithm.",
        ),
        "SPSM takes 26 to 56 % more time than a standard map",
        Ran::new("spheres, tangle and city, 1920×1080, 1024² and 2048²", ["hard", PUBLISHED]),
        [at_most("largest frame time over that of the standard map", max, "1.57", 1.57)
            .document("table 1: 9.1 ms over 5.8 ms, YeahRight at 1024²")],
    )
}

/// Map, milliseconds of the standard and the sub-pixel map.
const TABLE_2: [(u32, f64, f64); 4] =
    [(512, 5.5, 10.0), (1024, 5.8, 9.1), (2048, 7.4, 10.7), (4096, 14.2, 18.1)];

pub(super) fn table_2(bench: &Workbench<'_>) -> Result<Page> {
    let frames: Vec<(u32, &str)> =
        TABLE_2.iter().flat_map(|(map, ..)| SPECS.map(|s| (bench.map(*map), s))).collect();
    let times = bench.times(bench.shot("tangle", RESOLUTION), &frames, bench.rounds())?;
    let mut table = Table::new(
        "Frame times of the standard map and of SPSM as published, and what all take over the standard map.",
        &["map", "standard", "SPSM", "SPSM over standard", "two layers", "DPM", "all triangles"],
    );
    let mut ratios = Vec::new();
    for ((map, standard, subpixel), group) in TABLE_2.iter().zip(times.chunks_exact(SPECS.len())) {
        let ratio = group[1].over(&group[0]);
        let mut cells = vec![
            Cell::ours(group[0].ms(), Unit::Milliseconds),
            Cell::ours(group[1].ms(), Unit::Milliseconds),
            Cell::ours(ratio.value, Unit::Times).paper(subpixel / standard),
        ];
        cells.extend(group[2..].iter().map(|time| Cell::ours(time.over(&group[0]).value, Unit::Times)));
        table.row(format!("{map}²"), cells);
        ratios.push(ratio);
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(shrinks(&ratios));
    Ok(page)
}

fn shrinks(ratios: &[Measured]) -> Verdict {
    // Of two maps' ranges the worst corners.
    let fall = |pair: &[Measured]| Measured {
        value: pair[0].value / pair[1].value,
        low: pair[0].low / pair[1].high,
        high: pair[0].high / pair[1].low,
    };
    Verdict::new(
        spsm_says(
            "§6.3",
            "increasing the resolution of the shadow map reduces the computational overhead of the SPSM",
        ),
        "The overhead of SPSM shrinks with the size of the map",
        Ran::new("tangle, 1920×1080, maps of 512² to 4096²", ["hard", PUBLISHED]),
        [more(
            "least fall of SPSM over standard from map to map",
            smallest(ratios.windows(2).map(fall)),
            "none",
            1.0,
        )
        .sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let exact = |ratios: &[f64]| ratios.iter().copied().map(Measured::exact).collect::<Vec<_>>();
        let paper: Vec<f64> = TABLE_2.iter().map(|(_, hard, spsm)| spsm / hard).collect();
        assert_eq!(shrinks(&exact(&paper)).outcome(), Holds);
        assert_eq!(shrinks(&exact(&[1.8, 1.5, 1.6])).outcome(), Differs);
        let paper: Vec<f64> = TABLE_1.iter().flat_map(|(.., s, p)| [p[0] / s[0], p[1] / s[1]]).collect();
        assert_eq!(small_overhead(&exact(&paper)).outcome(), Holds);
        assert_eq!(small_overhead(&exact(&[1.3, 9.0])).outcome(), Differs);
    }
}
