//! Table 1: frame times.

use crate::{
    numbers::steps,
    page::{Cell, Page, Table, Unit},
    verdict::{Verdict, more, same_order},
    workbench::Workbench,
};
use anyhow::Result;

const SIZES: [u32; 4] = [256, 512, 1024, 2048];
const PCF: [f64; 4] = [76.0, 74.0, 71.0, 69.0];
/// Kernel, terms, frames per second.
const PAPER: [(u32, u32, [f64; 4]); 9] = [
    (1, 4, [64.0, 62.0, 60.0, 50.0]),
    (1, 8, [55.0, 53.0, 49.0, 38.0]),
    (1, 16, [47.0, 45.0, 39.0, 26.0]),
    (3, 4, [63.0, 61.0, 57.0, 43.0]),
    (3, 8, [53.0, 50.0, 44.0, 30.0]),
    (3, 16, [42.0, 39.0, 32.0, 19.0]),
    (7, 4, [62.0, 60.0, 53.0, 36.0]),
    (7, 8, [52.0, 49.0, 41.0, 24.0]),
    (7, 16, [41.0, 38.0, 28.0, 14.0]),
];

pub(super) fn table_1(bench: &Workbench<'_>) -> Result<Page> {
    let specs: Vec<String> = std::iter::once("pcf.kernel=1".to_string())
        .chain(PAPER.map(|(k, m, _)| format!("csm.terms={m},kernel={k},sampling=anisotropic")))
        .collect();
    let frames: Vec<(u32, &str)> =
        specs.iter().flat_map(|spec| SIZES.map(|size| (bench.map(size), spec.as_str()))).collect();
    let times = bench.times(bench.shot("fence", [1024, 768]), &frames, bench.rounds(3))?;
    let times: Vec<f64> = times.iter().map(|t| t.frame.median_ms).collect();
    let (pcf, csm) = times.split_at(SIZES.len());
    let ours: Vec<[f64; 4]> = csm.chunks_exact(4).map(|row| [0, 1, 2, 3].map(|i| row[i] / pcf[i])).collect();
    let paper = PAPER.map(|(.., fps)| [0, 1, 2, 3].map(|i| PCF[i] / fps[i]));
    let mut page = Page::default();
    let mut table = Table::new(
        "Frame time over that of PCF with a map of the same size.",
        &["kernel and terms", "256²", "512²", "1024²", "2048²"],
    );
    for (((kernel, terms, _), ours), paper) in PAPER.iter().zip(&ours).zip(paper) {
        let name = match kernel {
            1 => format!("no convolution, M = {terms}"),
            _ => format!("{kernel}×{kernel}, M = {terms}"),
        };
        table.row(name, ours.iter().zip(paper).map(|(o, p)| Cell::ours(*o, Unit::Times).paper(p)).collect());
    }
    page.table(table);
    let mut absolute =
        Table::new("Our frame times.", &["kernel and terms", "256²", "512²", "1024²", "2048²"]);
    for (spec, row) in specs.iter().zip(times.chunks_exact(4)) {
        absolute.row(spec.as_str(), row.iter().map(|t| Cell::ours(*t, Unit::Milliseconds)).collect());
    }
    page.table(absolute);
    page.verdict(slower(&ours));
    page.verdict(grows(&ours));
    page.verdict(same_order(&ours.concat(), &paper.concat(), 0.9));
    Ok(page)
}

fn slower(ours: &[[f64; 4]]) -> Verdict {
    let min = ours.iter().flatten().copied().reduce(f64::min);
    Verdict::new(
        "CSMs are slower than PCF of one bilinear lookup",
        [more("smallest ratio to PCF", min, "1", 1.0)],
    )
}

/// Rows are kernels 1, 3 and 7 of 4, 8 and 16 terms.
fn grows(ours: &[[f64; 4]]) -> Verdict {
    let columns =
        |rows: [usize; 3]| (0..4).map(move |i| rows.map(|r| ours.get(r).map_or(f64::NAN, |row| row[i])));
    let over_terms = (0..3).flat_map(|k| columns([3 * k, 3 * k + 1, 3 * k + 2]));
    let over_kernels = (0..3).flat_map(|m| columns([m, m + 3, m + 6]));
    Verdict::new(
        "Time grows with the number of terms, and with the kernel on the largest map",
        [
            more("least growth from terms to terms", steps(over_terms), "none", 1.0),
            more(
                "least growth from kernel to kernel at 2048²",
                steps(over_kernels.enumerate().filter(|(i, _)| i % 4 == 3).map(|(_, c)| c)),
                "none",
                1.0,
            ),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let paper: Vec<[f64; 4]> =
            PAPER.iter().map(|(.., fps)| [0, 1, 2, 3].map(|i| PCF[i] / fps[i])).collect();
        for verdict in [slower, grows] {
            assert_eq!(verdict(&paper).outcome(), Holds);
        }
        let flat = paper.concat();
        assert_eq!(same_order(&flat, &flat, 0.9).outcome(), Holds);
        let backwards: Vec<f64> = flat.iter().map(|v| 1.0 / v).collect();
        assert_eq!(same_order(&backwards, &flat, 0.9).outcome(), Differs);
        let mut wrong = paper.clone();
        wrong[0][1] = 0.9;
        assert_eq!(slower(&wrong).outcome(), Differs);
        wrong = paper.clone();
        wrong[2][0] = wrong[1][0] - 0.1;
        assert_eq!(grows(&wrong).outcome(), Differs);
        wrong = paper;
        wrong[8][3] = wrong[5][3] - 0.1;
        assert_eq!(grows(&wrong).outcome(), Differs);
    }
}
