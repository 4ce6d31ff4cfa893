//! Table 3: failing pixels.

use crate::{
    bench::Bench,
    page::{Cell, Page, Table, Unit},
    verdict::{Verdict, at_least, at_most, more},
};
use anyhow::{Context, Result};

/// Kernel, Z-Max, Threshold.
const PAPER: [(u32, f64, f64); 4] =
    [(1, 0.030, 0.028), (3, 0.061, 0.049), (5, 0.079, 0.061), (7, 0.093, 0.071)];
/// Name of the class in both classifiers.
const FAILED: &str = "assumption violated";

pub(super) fn table_3(bench: &Bench<'_>) -> Result<Page> {
    let zmax = PAPER.map(|(kernel, ..)| format!("esm.classifier=zmax,kernel={kernel}"));
    let threshold = PAPER.map(|(kernel, ..)| format!("esm.kernel={kernel}"));
    let specs: Vec<&str> = zmax.iter().chain(&threshold).map(String::as_str).collect();
    let study = bench.study(bench.shot("backyard", [800, 800]), bench.map(2048), &specs)?;
    let share = |spec: &String| -> Result<f64> {
        let look = study.look(spec)?;
        look.share(FAILED).with_context(|| format!("{spec} has no class '{FAILED}': {:?}", look.classes))
    };
    let zmax = zmax.iter().map(share).collect::<Result<Vec<f64>>>()?;
    let threshold = threshold.iter().map(share).collect::<Result<Vec<f64>>>()?;
    let mut table = Table::new(
        "Pixels whose kernel reaches casters behind the receiver.",
        &["failure", "no convolution", "3×3", "5×5", "7×7"],
    );
    let row = |ours: &[f64], paper: [f64; 4]| {
        ours.iter().zip(paper).map(|(o, p)| Cell::ours(*o, Unit::Share).paper(p)).collect()
    };
    table.row("Z-Max", row(&zmax, PAPER.map(|p| p.1)));
    table.row("Threshold", row(&threshold, PAPER.map(|p| p.2)));
    let mut page = Page::default();
    page.table(table);
    page.verdict(few(&zmax, &threshold));
    page.verdict(grows(&zmax, &threshold));
    page.verdict(conservative(&zmax, &threshold));
    Ok(page)
}

fn ends(shares: &[f64]) -> [Option<f64>; 2] {
    [shares.first().copied(), shares.last().copied()]
}

fn few(zmax: &[f64], threshold: &[f64]) -> Verdict {
    let [first, last] = [0, 1].map(|end| ends(zmax)[end].zip(ends(threshold)[end]));
    Verdict::new(
        "3 % of the pixels fail without convolution, at most 9.3 % with 7×7",
        [
            at_most("smaller share without convolution", first.map(|(z, t)| z.min(t)), "3 %", 0.03),
            at_most("larger share with 7×7", last.map(|(z, t)| z.max(t)), "9.3 %", 0.093),
        ],
    )
}

fn grows(zmax: &[f64], threshold: &[f64]) -> Verdict {
    let rising = |name: &str, shares: &[f64]| {
        let steps = shares.windows(2).map(|pair| pair[1] - pair[0]).reduce(f64::min);
        more(format!("smallest rise from kernel to kernel, {name}"), steps, "none", 0.0)
    };
    Verdict::new(
        "The larger the kernel, the more pixels fail",
        [rising("Z-Max", zmax), rising("Threshold", threshold)],
    )
}

fn conservative(zmax: &[f64], threshold: &[f64]) -> Verdict {
    let least = zmax.iter().zip(threshold).map(|(z, t)| z - t).reduce(f64::min);
    Verdict::new(
        "Z-Max is conservative: it never finds fewer pixels than Threshold",
        [at_least("smallest surplus of Z-Max", least, "none", 0.0)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let zmax = PAPER.map(|p| p.1);
        let threshold = PAPER.map(|p| p.2);
        for verdict in [few, grows, conservative] {
            assert_eq!(verdict(&zmax, &threshold).outcome(), Holds);
        }
        assert_eq!(few(&[0.1, 0.2], &threshold).outcome(), Differs);
        assert_eq!(grows(&[0.1, 0.1], &threshold).outcome(), Differs);
        assert_eq!(conservative(&threshold, &zmax).outcome(), Differs);
    }
}
