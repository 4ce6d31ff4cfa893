//! Figure 2: the exponential step.

use crate::{
    page::{Block, Cell, Page, Table, Unit},
    step::{Step, panel},
    verdict::{Fact, Ran, Verdict, esm as esm_says, less},
    workbench::Workbench,
};
use anyhow::Result;

const DECAYS: [&str; 3] = ["esm.c=20", "esm.c=40", "esm.c=80"];
/// The offset that the paper plots.
const CSM: &str = "csm.attenuation=0,offset=0.032";

pub(super) fn figure_2(bench: &Workbench<'_>) -> Result<Page> {
    let reach = [-0.05, 0.15];
    let step = |spec: &str| Step::measure(bench, spec, reach);
    let decays = [step(DECAYS[0])?, step(DECAYS[1])?, step(DECAYS[2])?];
    let csm = step(CSM)?;
    let mut page = Page::default();
    let panels = [panel(&[&decays[0], &decays[1], &decays[2]], reach), panel(&[&csm, &decays[2]], reach)];
    page.blocks
        .push(Block::Plot(panels.into(), "(a) growing c, (b) ESM with c = 80 and CSM of 16 terms.".into()));
    let mut table = Table::new(
        "Light behind: mean visibility of receivers up to 0.15 of the depth range behind the caster, where it ought to \
         be 0.",
        &["curve", "visibility at d = z", "light behind"],
    );
    for s in decays.iter().chain([&csm]) {
        table.row(
            s.name.as_str(),
            [s.at_zero(), s.light_behind()].map(|v| Cell::ours(v, Unit::Number)).into(),
        );
    }
    page.table(table);
    page.fact(larger_c(decays.each_ref().map(Step::light_behind)));
    page.verdict(better_than_csm(decays[2].light_behind(), csm.light_behind()));
    Ok(page)
}

fn larger_c([twenty, forty, eighty]: [f64; 3]) -> Fact {
    Fact {
        claim: "A larger c is a better step.".into(),
        source: esm_says("figure 2", "A larger factor c yields a better approximation."),
        found: format!("Light behind the caster with c of 20, 40, 80: {twenty:.4}, {forty:.4}, {eighty:.4}."),
        because: "exp(−c t) falls with c for every t above 0".into(),
    }
}

fn better_than_csm(esm: f64, csm: f64) -> Verdict {
    Verdict::new(
        esm_says(
            "figure 2",
            "(b) shows that an ESM80 achieves better quality than a CSM16 (with an offset of −0.032).",
        ),
        "ESM with c = 80 is a better step than CSM with 16 terms",
        Ran::new("a map whose every texel holds one depth, no bias", [DECAYS[2], CSM]),
        [less("light behind the caster, ESM", esm, "that of the CSM", csm).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(better_than_csm(0.1, 0.2).outcome(), Holds);
        assert_eq!(better_than_csm(0.2, 0.1).outcome(), Differs);
    }
}
