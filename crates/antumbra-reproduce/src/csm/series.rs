//! What the text says of the series itself: shift invariance (§3.2), convergence (§2), memory (§5).

use crate::{
    page::{Block, Cell, Page, Table, Unit},
    step::{Step, panel},
    verdict::{Fact, Ran, Verdict, at_most, csm as csm_says, less},
    workbench::Workbench,
};
use anyhow::Result;

/// Depths of casters over which the step is moved.
const CASTERS: [f32; 5] = [0.1, 0.3, 0.5, 0.7, 0.85];
/// d − z: the same for all casters.
const REACH: f32 = 0.1;
const SPEC: &str = "csm.lift=none";
const TERMS: [u32; 6] = [1, 2, 4, 8, 16, 32];
const FLAT: &str = "a map whose every texel holds one depth, no bias";

pub(super) fn series(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let behind: Vec<f32> = (-100..=100).map(|i: i16| REACH * f32::from(i) / 100.0).collect();
    let mut curves = Vec::new();
    for caster in CASTERS {
        let depths: Vec<f32> = behind.iter().map(|b| caster + b).collect();
        curves.push(bench.curve(SPEC, caster, &depths)?);
    }
    let mut table = Table::new("Largest difference to the step at a depth of 0.5.", &["depth", "difference"]);
    let mut largest: f64 = 0.0;
    for (caster, curve) in CASTERS.iter().zip(&curves) {
        let apart = apart(curve, &curves[2]);
        table.row(caster.to_string(), vec![Cell::ours(apart, Unit::Number)]);
        largest = largest.max(apart);
    }
    page.verdict(invariant(largest));
    page.table(table);
    let reach = [-0.2, 0.2];
    let mut steps = Vec::new();
    for terms in TERMS {
        steps.push(Step::measure(bench, &format!("csm.lift=none,attenuation=0,terms={terms}"), reach)?);
    }
    let wrong: Vec<f64> = steps.iter().map(error).collect();
    let mut table =
        Table::new("Mean distance from the step up to 0.2 before and behind it.", &["terms", "error"]);
    for (terms, wrong) in TERMS.iter().zip(&wrong) {
        table.row(terms.to_string(), vec![Cell::ours(*wrong, Unit::Number)]);
    }
    page.verdict(converges(&wrong));
    page.table(table);
    page.blocks
        .push(Block::Plot(vec![panel(&steps.iter().collect::<Vec<_>>(), reach)], "1 to 32 terms.".into()));
    memory(bench, &mut page)?;
    Ok(page)
}

/// Largest difference of two curves.
fn apart(a: &[f32], b: &[f32]) -> f64 {
    a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs())).fold(0.0, f64::max)
}

/// Mean distance from the step: lit before, dark behind.
fn error(step: &Step) -> f64 {
    let wrong = |p: &[f64; 2]| if p[0] > 0.0 { p[1] } else { 1.0 - p[1] };
    step.points.iter().map(wrong).sum::<f64>() / step.points.len() as f64
}

fn memory(bench: &Workbench<'_>, page: &mut Page) -> Result<()> {
    let specs = ["vsm", "csm.terms=4", "csm.terms=8", "csm"];
    let study = bench.study(bench.shot("blocks", [640, 480]), bench.map(1024), &specs)?;
    let mut table =
        Table::new("Bytes of the filtered maps and all that lookups need.", &["technique", "memory"]);
    let mut bytes = Vec::new();
    for spec in specs {
        bytes.push(study.look(spec)?.memory.kept_bytes as f64);
        table.row(spec, vec![Cell::ours(bytes[bytes.len() - 1], Unit::Bytes)]);
    }
    page.fact(four_times(bytes[3] / bytes[0], bytes[1] / bytes[0]));
    page.table(table);
    Ok(())
}

fn invariant(largest: f64) -> Verdict {
    Verdict::new(
        csm_says("§3.2", "this can be done by independently changing d and z, while keeping the approximation error due to truncation constant"),
        "The step is the same wherever its caster is",
        Ran::new(&format!("{FLAT}, casters at 0.1 to 0.85 of the depth range"), [SPEC]),
        [at_most("largest difference between steps", largest, "5 levels of 8 bits", 5.0 / 255.0)
            .ours("half a level of each coefficient, weighted by 2/c_k, adds up to 2.2 levels at most; two steps differ by twice that")],
    )
}

/// Errors by terms, few to many.
fn converges(wrong: &[f64]) -> Verdict {
    let falls = |pair: &[f64]| pair[1] / pair[0];
    let slowest = wrong.windows(2).map(falls).reduce(f64::max);
    Verdict::new(
        csm_says("§2", "even though it is also approximate, it converges to the exact solution instead of an upper bound"),
        "The series converges to the step: twice the terms, less error",
        Ran::new(FLAT, ["csm.lift=none,attenuation=0"]),
        [less("largest quotient of the errors of twice the terms and of the terms", slowest, "0.8", 0.8)
            .ours("the error of a partial sum in the mean falls nearly as one over its terms; 0.8 leaves room for 8 bits")],
    )
}

fn four_times(sixteen: f64, four: f64) -> Fact {
    Fact {
        claim: "With 16 terms a CSM takes four times the memory of a 32-bit VSM, with 4 the same.".into(),
        source: csm_says(
            "§5",
            "the CSM requires four times more memory for M = 16 than a VSM with 32-bit floating point precision",
        ),
        found: format!("{sixteen:.2} times with 16 terms, {four:.2} times with 4."),
        because: "32 and 8 bytes of coefficients stand beside two floats".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(invariant(0.01).outcome(), Holds);
        assert_eq!(invariant(0.1).outcome(), Differs);
        assert_eq!(converges(&[0.4, 0.2, 0.1]).outcome(), Holds);
        assert_eq!(converges(&[0.4, 0.2, 0.19]).outcome(), Differs);
        assert!((apart(&[0.0, 1.0], &[0.25, 1.0]) - 0.25).abs() < 1e-9);
        let step = Step { name: "s".into(), points: vec![[-0.1, 0.9], [0.1, 0.3]] };
        assert!((error(&step) - 0.2).abs() < 1e-9);
    }
}
