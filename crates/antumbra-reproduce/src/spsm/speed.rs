//! Tables 1 and 2: frame times.

use crate::{
    numbers::steps,
    page::{Cell, Page, Table, Unit},
    verdict::{Verdict, at_most, more},
    workbench::Workbench,
};
use anyhow::Result;

/// Scene, its name in the paper, milliseconds of standard and sub-pixel maps of 1024² and 2048².
const TABLE_1: [(&str, &str, [f64; 2], [f64; 2]); 3] = [
    ("spheres", "Spheres", [5.0, 6.8], [6.8, 8.6]),
    ("tangle", "YeahRight", [5.8, 7.4], [9.1, 10.7]),
    ("city", "City", [31.2, 32.2], [40.0, 41.6]),
];

pub(super) fn table_1(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Frame times over that of the standard map, of SPSM and of deep primitive maps (DPM), and those of 1024².",
        &["scene", "1024²", "2048²", "DPM, 1024²", "DPM, 2048²", "standard", "SPSM", "DPM"],
    );
    let mut page = Page::default();
    let mut overheads = Vec::new();
    for (scene, name, standard, subpixel) in TABLE_1 {
        if bench.quick && scene == "city" {
            page.text("A quick run leaves the city out.");
            continue;
        }
        let maps = [1024, 2048].map(|m| bench.map(m));
        let frames: Vec<(u32, &str)> =
            maps.iter().flat_map(|map| ["hard", "spsm", "dpm"].map(|spec| (*map, spec))).collect();
        let rounds = if scene == "city" { 1 } else { bench.rounds(3) };
        let times = match bench.times(bench.shot(scene, [960, 540]), &frames, rounds) {
            Ok(times) => times,
            Err(reason) => {
                page.text(format!("{scene} was not measured: {reason:#}"));
                continue;
            }
        };
        let ms: Vec<f64> = times.iter().map(|t| t.frame.median_ms).collect();
        let ratios = [ms[1] / ms[0], ms[4] / ms[3]];
        let mut cells: Vec<Cell> =
            (0..2).map(|i| Cell::ours(ratios[i], Unit::Times).paper(subpixel[i] / standard[i])).collect();
        cells.extend([ms[2] / ms[0], ms[5] / ms[3]].map(|t| Cell::ours(t, Unit::Times)));
        cells.extend([ms[0], ms[1], ms[2]].map(|t| Cell::ours(t, Unit::Milliseconds)));
        table.row(format!("{scene} ({name})"), cells);
        overheads.extend(ratios);
    }
    page.table(table);
    page.verdict(small_overhead(&overheads));
    Ok(page)
}

fn small_overhead(ratios: &[f64]) -> Verdict {
    Verdict::new(
        "SPSM takes 26 to 56 % more time than a standard map",
        [at_most(
            "largest frame time over that of the standard map",
            ratios.iter().copied().reduce(f64::max),
            "1.57",
            1.57,
        )],
    )
}

/// Map, milliseconds of the standard and the sub-pixel map.
const TABLE_2: [(u32, f64, f64); 4] =
    [(512, 5.5, 10.0), (1024, 5.8, 9.1), (2048, 7.4, 10.7), (4096, 14.2, 18.1)];

pub(super) fn table_2(bench: &Workbench<'_>) -> Result<Page> {
    let frames: Vec<(u32, &str)> =
        TABLE_2.iter().flat_map(|(map, ..)| ["hard", "spsm"].map(|s| (bench.map(*map), s))).collect();
    let times = bench.times(bench.shot("tangle", [960, 540]), &frames, bench.rounds(3))?;
    let mut table = Table::new(
        "Frame times, and SPSM over the standard map.",
        &["map", "standard", "SPSM", "SPSM over standard"],
    );
    let mut ratios = Vec::new();
    for ((map, standard, subpixel), pair) in TABLE_2.iter().zip(times.chunks_exact(2)) {
        let [hard, spsm] = [0, 1].map(|i| pair[i].frame.median_ms);
        ratios.push(spsm / hard);
        let cells = vec![
            Cell::ours(hard, Unit::Milliseconds),
            Cell::ours(spsm, Unit::Milliseconds),
            Cell::ours(spsm / hard, Unit::Times).paper(subpixel / standard),
        ];
        table.row(format!("{map}²"), cells);
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(shrinks(&ratios));
    Ok(page)
}

fn shrinks(ratios: &[f64]) -> Verdict {
    let fall = steps(ratios.windows(2).map(|pair| [pair[1], pair[0]]));
    Verdict::new(
        "The overhead of SPSM shrinks with the size of the map",
        [more("least fall of SPSM over standard from map to map", fall, "none", 1.0)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let paper: Vec<f64> = TABLE_2.iter().map(|(_, hard, spsm)| spsm / hard).collect();
        assert_eq!(shrinks(&paper).outcome(), Holds);
        assert_eq!(shrinks(&[1.8, 1.5, 1.6]).outcome(), Differs);
        let paper: Vec<f64> = TABLE_1.iter().flat_map(|(.., s, p)| [p[0] / s[0], p[1] / s[1]]).collect();
        assert_eq!(small_overhead(&paper).outcome(), Holds);
        assert_eq!(small_overhead(&[1.3, 9.0]).outcome(), Differs);
    }
}
