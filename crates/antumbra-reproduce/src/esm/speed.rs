//! Tables 1 and 2: frame times.

use crate::{
    numbers::{Measured, largest, smallest},
    page::{Cell, Page, Table, Unit},
    verdict::{Ran, Verdict, at_least, at_most, esm, more, same_order},
    workbench::Workbench,
};
use anyhow::Result;

/// Kernel, map, frames per second of Threshold, Z-Max, VSM, CSM.
const TABLE_1: [(u32, u32, [f64; 4]); 9] = [
    (1, 512, [145.0, 132.0, 152.0, 83.0]),
    (1, 1024, [140.0, 123.0, 140.0, 68.0]),
    (1, 2048, [119.0, 101.0, 106.0, 40.0]),
    (3, 512, [141.0, 127.0, 149.0, 75.0]),
    (3, 1024, [132.0, 113.0, 131.0, 56.0]),
    (3, 2048, [102.0, 78.0, 87.0, 27.0]),
    (7, 512, [138.0, 119.0, 146.0, 71.0]),
    (7, 1024, [124.0, 100.0, 125.0, 46.0]),
    (7, 2048, [86.0, 61.0, 78.0, 19.0]),
];
const NAMES: [&str; 4] = ["ESM, Threshold", "ESM, Z-Max", "VSM", "CSM"];

fn specs(kernel: u32) -> [String; 4] {
    [
        "esm.sampling=trilinear,kernel=",
        "esm.classifier=zmax,sampling=trilinear,kernel=",
        "vsm.sampling=trilinear,kernel=",
        "csm.sampling=trilinear,kernel=",
    ]
    .map(|s| format!("{s}{kernel}"))
}

fn convolution(kernel: u32) -> String {
    if kernel == 1 { "none".into() } else { format!("{kernel}×{kernel}") }
}

pub(super) fn table_1(bench: &Workbench<'_>) -> Result<Page> {
    let cells: Vec<(u32, [String; 4])> = TABLE_1.map(|(k, map, _)| (bench.map(map), specs(k))).into();
    let frames: Vec<(u32, &str)> =
        cells.iter().flat_map(|(map, specs)| specs.iter().map(|s| (*map, s.as_str()))).collect();
    let times = bench.times(bench.shot("backyard", [800, 600]), &frames, bench.rounds())?;
    let ratios: Vec<[Measured; 4]> =
        times.chunks_exact(4).map(|t| [0, 1, 2, 3].map(|i| t[i].over(&t[0]))).collect();
    let ours: Vec<[f64; 4]> = ratios.iter().map(|row| row.map(|r| r.value)).collect();
    let paper = TABLE_1.map(|(.., fps)| fps.map(|f| fps[0] / f));
    let mut table = Table::new(
        "Frame time over that of ESM with Threshold, same map and kernel.",
        &["convolution, map", NAMES[1], NAMES[2], NAMES[3], "ESM, Threshold: frame"],
    );
    for (((kernel, map, _), (ours, paper)), time) in
        TABLE_1.iter().zip(ours.iter().zip(paper)).zip(times.chunks_exact(4))
    {
        let mut cells: Vec<Cell> = (1..4).map(|i| Cell::ours(ours[i], Unit::Times).paper(paper[i])).collect();
        cells.push(Cell::ours(time[0].ms(), Unit::Milliseconds));
        table.row(format!("{}, {map}²", convolution(*kernel)), cells);
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(faster_than_csm(&ratios));
    page.verdict(threshold_is_faster(TABLE_1_RAN, ratios.iter().map(|r| r[1])));
    let last = |rows: &[[f64; 4]]| rows.iter().flat_map(|r| [r[1], r[2], r[3]]).collect::<Vec<f64>>();
    let rates = esm("table 1", "We compare ESMs (Thresholding and Z-Max) against VSMs and CSMs.");
    page.verdict(same_order(rates, ran(TABLE_1_RAN), &last(&ours), &last(&paper), 0.8));
    Ok(page)
}

const TABLE_1_RAN: &str = "backyard, 800×600, maps of 512² to 2048², kernels 1, 3, 7";
const TABLE_2_RAN: &str = "spheres, 800×800, maps of 128² to 1024², kernels 1, 3, 5";

fn ran(scene: &str) -> Ran {
    Ran::new(scene, specs(1))
}

fn faster_than_csm(ours: &[[Measured; 4]]) -> Verdict {
    let min = smallest(ours.iter().map(|r| r[3]));
    Verdict::new(
        esm("§5", "the quality that ESMs achieve with 8× less memory and a significantly better performance"),
        "ESM is significantly faster than CSM",
        ran(TABLE_1_RAN),
        [at_least("smallest ratio of CSM's frame time to ESM's", min, "1.5", 1.5)
            .ours("significantly is a half; the least of table 1 is 145/83 of a card")],
    )
}

fn threshold_is_faster(scene: &str, ratios: impl Iterator<Item = Measured>) -> Verdict {
    Verdict::new(
        esm(
            "§3.4",
            "Threshold Classification does not require any additional resources and renders efficiently",
        ),
        "Threshold is faster than Z-Max, for every map and kernel",
        ran(scene),
        [more("smallest ratio of Z-Max to Threshold", smallest(ratios), "1", 1.0)
            .document("tables 1 and 2: its frame rates are higher in every cell")],
    )
}

/// Kernel, frames per second of Z-Max and of Threshold for 128² to 1024².
const TABLE_2: [(u32, [f64; 4], [f64; 4]); 3] = [
    (1, [410.0, 393.0, 374.0, 347.0], [569.0, 556.0, 527.0, 438.0]),
    (3, [369.0, 357.0, 345.0, 273.0], [547.0, 536.0, 495.0, 374.0]),
    (5, [358.0, 351.0, 338.0, 237.0], [544.0, 527.0, 474.0, 342.0]),
];
const SIZES: [u32; 4] = [128, 256, 512, 1024];

pub(super) fn table_2(bench: &Workbench<'_>) -> Result<Page> {
    let pairs: Vec<(u32, [String; 2])> = TABLE_2
        .iter()
        .flat_map(|(kernel, ..)| SIZES.map(|size| (size, *kernel)))
        .map(|(size, kernel)| {
            let [threshold, zmax, ..] = specs(kernel);
            (bench.map(size), [zmax, threshold])
        })
        .collect();
    let frames: Vec<(u32, &str)> =
        pairs.iter().flat_map(|(map, pair)| pair.iter().map(|s| (*map, s.as_str()))).collect();
    let times = bench.times(bench.shot("spheres", [800, 800]), &frames, bench.rounds())?;
    let ratios: Vec<Measured> = times.chunks_exact(2).map(|t| t[0].over(&t[1])).collect();
    let mut table = Table::new(
        "Frame time of Z-Max over that of Threshold.",
        &["convolution", "128²", "256²", "512²", "1024²"],
    );
    for ((kernel, zmax, threshold), ours) in TABLE_2.iter().zip(ratios.chunks_exact(4)) {
        let cells =
            (0..4).map(|i| Cell::ours(ours[i].value, Unit::Times).paper(threshold[i] / zmax[i])).collect();
        table.row(convolution(*kernel), cells);
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(threshold_is_faster(TABLE_2_RAN, ratios.iter().copied()));
    page.verdict(cheap(&ratios));
    Ok(page)
}

fn cheap(ratios: &[Measured]) -> Verdict {
    let max = largest(ratios.iter().copied());
    Verdict::new(
        esm("table 2", "Failure detection performance for Z-Max and Thresholding (800x800 viewport)"),
        "Z-Max takes at most a half more than Threshold",
        ran(TABLE_2_RAN),
        [at_most("largest ratio of Z-Max to Threshold", max, "the paper's largest, 544/358", 544.0 / 358.0)
            .document("table 2, 5×5 at 128²")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let paper = TABLE_1.map(|(.., fps)| fps.map(|f| fps[0] / f));
        let exact = paper.map(|row| row.map(Measured::exact));
        assert_eq!(faster_than_csm(&exact).outcome(), Holds);
        assert_eq!(faster_than_csm(&[[1.0, 1.0, 1.0, 1.1].map(Measured::exact)]).outcome(), Differs);
        let threshold = |ratios: &[f64]| {
            threshold_is_faster(TABLE_1_RAN, ratios.iter().copied().map(Measured::exact)).outcome()
        };
        assert_eq!(threshold(&paper.map(|r| r[1])), Holds);
        assert_eq!(threshold(&[1.2, 0.9]), Differs);
        let flat = paper.concat();
        let order = |ours: &[f64]| same_order(esm("table 1", "rates"), ran(""), ours, &flat, 0.8).outcome();
        assert_eq!(order(&flat), Holds);
        assert_eq!(order(&flat.iter().map(|v| -v).collect::<Vec<_>>()), Differs);
        let paper: Vec<Measured> =
            TABLE_2.iter().flat_map(|(_, z, t)| [0, 1, 2, 3].map(|i| Measured::exact(t[i] / z[i]))).collect();
        assert_eq!(cheap(&paper).outcome(), Holds);
        assert_eq!(cheap(&[1.1, 1.7].map(Measured::exact)).outcome(), Differs);
    }
}
