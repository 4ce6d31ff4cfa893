//! Table 1: frame times.

use crate::{
    numbers::{Measured, smallest},
    page::{Cell, Page, Table, Unit},
    study::Timed,
    verdict::{Ran, Verdict, csm, more, same_order},
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
    let times = bench.times(bench.shot("fence", [1024, 768]), &frames, bench.rounds())?;
    let (pcf, own) = times.split_at(SIZES.len());
    let ratios: Vec<[Measured; 4]> =
        own.chunks_exact(4).map(|row| [0, 1, 2, 3].map(|i| row[i].over(&pcf[i]))).collect();
    let ours: Vec<[f64; 4]> = ratios.iter().map(|row| row.map(|r| r.value)).collect();
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
        absolute.row(spec.as_str(), row.iter().map(|t| Cell::ours(t.ms(), Unit::Milliseconds)).collect());
    }
    page.table(absolute);
    page.verdict(slower(&ratios));
    page.verdict(grows(&own.chunks_exact(4).map(|row| [0, 1, 2, 3].map(|i| &row[i])).collect::<Vec<_>>()));
    let rates = csm("table 1", "Frame rates for the complex scene (365k faces) from Figure 10");
    page.verdict(same_order(rates, ran(), &ours.concat(), &paper.concat(), 0.9));
    Ok(page)
}

fn ran() -> Ran {
    let scene = "fence, 1024×768, maps of 256² to 2048², kernels 1, 3, 7 and terms 4, 8, 16";
    Ran::new(scene, ["pcf.kernel=1", "csm.sampling=anisotropic"])
}

fn slower(ours: &[[Measured; 4]]) -> Verdict {
    let min = smallest(ours.iter().flatten().copied());
    Verdict::new(
        csm("§5", "CSMs are generally slower than PCF but enable effective anti-aliasing."),
        "CSMs are slower than PCF of one bilinear lookup",
        ran(),
        [more("smallest ratio to PCF", min, "1", 1.0).sentence()],
    )
}

/// Rows are kernels 1, 3 and 7 of 4, 8 and 16 terms.
fn grows(ours: &[[&Timed; 4]]) -> Verdict {
    let over =
        |[less, more]: [usize; 2], size: usize| Some(ours.get(more)?[size].over(ours.get(less)?[size]));
    let terms = [0, 1, 3, 4, 6, 7].iter().flat_map(|r| (0..4).filter_map(move |i| over([*r, r + 1], i)));
    let kernels = (0..6).filter_map(|row| over([row, row + 3], 3));
    Verdict::new(
        csm("§5", "reconstruction order M determines the number of texture fetches per pixel that is shaded"),
        "Time grows with the number of terms, and with the kernel on the largest map",
        ran(),
        [
            more("least growth from terms to terms", smallest(terms), "none", 1.0).sentence(),
            more("least growth from kernel to kernel at 2048²", smallest(kernels), "none", 1.0)
                .document("table 1: frame rates fall from kernel to kernel in every column"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        let paper: Vec<[f64; 4]> =
            PAPER.iter().map(|(.., fps)| [0, 1, 2, 3].map(|i| PCF[i] / fps[i])).collect();
        let exact = |rows: &[[f64; 4]]| rows.iter().map(|r| r.map(Measured::exact)).collect::<Vec<_>>();
        assert_eq!(slower(&exact(&paper)).outcome(), Holds);
        let mut wrong = paper.clone();
        wrong[0][1] = 0.9;
        assert_eq!(slower(&exact(&wrong)).outcome(), Differs);
        let flat = paper.concat();
        let order = |ours: &[f64]| same_order(csm("table 1", "rates"), ran(), ours, &flat, 0.9).outcome();
        assert_eq!(order(&flat), Holds);
        assert_eq!(order(&flat.iter().map(|v| 1.0 / v).collect::<Vec<_>>()), Differs);
    }

    #[test]
    fn growth_is_of_rounds() {
        let grow = |change: &dyn Fn(usize, usize, f64) -> Vec<f64>| {
            let timed =
                |r: usize, i: usize| Timed { frames: change(r, i, PCF[i] / PAPER[r].2[i]), lookups: vec![] };
            let all: Vec<[Timed; 4]> = (0..9).map(|r| [0, 1, 2, 3].map(|i| timed(r, i))).collect();
            grows(&all.iter().map(|row| row.each_ref()).collect::<Vec<_>>()).outcome()
        };
        assert_eq!(grow(&|_, _, ms| vec![ms; 9]), Holds);
        assert_eq!(grow(&|r, i, ms| vec![if (r, i) == (2, 0) { 1.0 } else { ms }; 9]), Differs);
        assert_eq!(grow(&|r, i, ms| vec![if (r, i) == (8, 3) { 1.0 } else { ms }; 9]), Differs);
        let noisy = |r: usize, _: usize, ms: f64| {
            (0..9).map(|round| ms * if (r + round).is_multiple_of(2) { 1.0 } else { 2.0 }).collect()
        };
        assert_eq!(grow(&noisy), Open);
    }
}
