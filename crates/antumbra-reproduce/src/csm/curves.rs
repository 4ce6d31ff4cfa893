//! Figure 3: the step of the shadow test.

use crate::{
    page::{Block, Cell, Page, Table, Unit},
    step::{Step, panel},
    verdict::{Fact, Ran, Verdict, at_least, at_most, csm, less},
    workbench::Workbench,
};
use anyhow::Result;

/// d − z at the ends.
const REACH: f32 = 0.2;

const PLAIN: [&str; 3] = [
    "csm.lift=none,attenuation=0,terms=1",
    "csm.lift=none,attenuation=0,terms=4",
    "csm.lift=none,attenuation=0",
];
const ATTENUATED: &str = "csm.lift=none";
const OFFSET: &str = "csm.lift=offset";
const SCALED: &str = "csm.lift=scale";

pub(super) fn figure_3(bench: &Workbench<'_>) -> Result<Page> {
    let reach = [-REACH, REACH];
    let step = |spec: &str| Step::measure(bench, spec, reach);
    let plain = [step(PLAIN[0])?, step(PLAIN[1])?, step(PLAIN[2])?];
    let (attenuated, offset, scaled) = (step(ATTENUATED)?, step(OFFSET)?, step(SCALED)?);
    let mut page = Page::default();
    let panels = [
        panel(&[&plain[0], &plain[1], &plain[2]], reach),
        panel(&[&plain[2], &attenuated], reach),
        panel(&[&attenuated, &offset], reach),
        panel(&[&attenuated, &scaled], reach),
    ];
    page.blocks.push(Block::Plot(
        panels.into(),
        "(a) number of terms, (b) attenuation, (c) offset, (d) scale. From left to right, then below.".into(),
    ));
    let mut table = Table::new(
        "Measured on the curves.",
        &[
            "curve",
            "visibility at d = z",
            "steepest fall per depth range",
            "ringing: sum of all rises",
            "from 0.95 to 0.05",
        ],
    );
    for s in plain.iter().chain([&attenuated, &offset, &scaled]) {
        let values = [s.at_zero(), s.steepness(), s.ringing(), s.width()];
        table.row(s.name.as_str(), values.map(|v| Cell::ours(v, Unit::Number)).into());
    }
    page.table(table);
    page.fact(steeper(plain.each_ref().map(Step::steepness)));
    page.verdict(attenuation([&plain[2], &attenuated].map(|s| [s.ringing(), s.steepness()])));
    page.verdict(lifted(attenuated.at_zero(), offset.at_zero(), scaled.at_zero()));
    page.fact(scale_is_steep(attenuated.width(), scaled.width()));
    Ok(page)
}

const CURVES: &str = "a map whose every texel holds one depth, no bias";

fn steeper([one, four, sixteen]: [f64; 3]) -> Fact {
    Fact {
        claim: "More terms make a steeper step.".into(),
        source: csm("§5", "As M grows, the reconstructed step function becomes steeper"),
        found: format!("Steepest falls with 1, 4 and 16 terms: {one:.3}, {four:.3} and {sixteen:.3}."),
        because: "the slope of a partial sum at the step is the number of its terms, up to a factor".into(),
    }
}

/// Ringing and steepness without and with attenuation.
fn attenuation([[ringing, steep], [less_ringing, less_steep]]: [[f64; 2]; 2]) -> Verdict {
    Verdict::new(
        csm("§3.2.1", "reducing ringing also means that the reconstructed Heaviside step becomes less steep"),
        "Attenuation suppresses ringing and makes the step less steep",
        Ran::new(CURVES, [PLAIN[2], ATTENUATED]),
        [
            less("ringing with attenuation", less_ringing, "half of that without", 0.5 * ringing).ours(
                "the paper gives neither a strength nor a number; what is suppressed is less than half",
            ),
            less("steepness with attenuation", less_steep, "that without", steep).sentence(),
        ],
    )
}

fn lifted(plain: f64, offset: f64, scaled: f64) -> Verdict {
    let lit = "a hundredth is less than 8 bits show";
    Verdict::new(
        csm("§3.2.2", "This is undesirable, as all lit surfaces would be 50% shadowed."),
        "A lit surface is half dark without an offset or a scale, and lit with either",
        Ran::new(CURVES, [ATTENUATED, OFFSET, SCALED]),
        [
            at_most(
                "distance from the paper's 50 % of visibility at d = z without",
                (plain - 0.5).abs(),
                "0.02",
                0.02,
            )
            .ours("the paper's 50 %, give or take what 8-bit coefficients of 16 terms add up to"),
            at_least("with an offset", offset, "0.99", 0.99).ours(lit),
            at_least("with a scale", scaled, "0.99", 0.99).ours(lit),
        ],
    )
}

fn scale_is_steep(plain: f64, scaled: f64) -> Fact {
    Fact {
        claim: "A scale makes the transition steeper.".into(),
        source: csm("§3.2.2", "Scaling the expansion by 2.0 makes the transition steeper"),
        found: format!(
            "From 0.95 to 0.05 the step takes {scaled:.4} of the depth range with a scale, {plain:.4} without."
        ),
        because: "twice a function has twice its slope".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(attenuation([[1.0, 9.0], [0.1, 5.0]]).outcome(), Holds);
        assert_eq!(attenuation([[1.0, 9.0], [0.8, 5.0]]).outcome(), Differs);
        assert_eq!(attenuation([[1.0, 5.0], [0.1, 9.0]]).outcome(), Differs);
        assert_eq!(lifted(0.5, 1.0, 1.0).outcome(), Holds);
        assert_eq!(lifted(0.8, 1.0, 1.0).outcome(), Differs);
        assert_eq!(lifted(0.5, 0.9, 1.0).outcome(), Differs);
    }
}
