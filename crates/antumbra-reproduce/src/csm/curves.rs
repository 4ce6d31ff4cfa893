//! Figure 3: the step of the shadow test.

use crate::{
    bench::Bench,
    page::{Block, Cell, Page, Table, Unit},
    verdict::{Verdict, at_least, at_most, less, more},
};
use antumbra_lab::chart::{Curve, Panel};
use anyhow::Result;

const CASTER: f32 = 0.5;
const POINTS: u16 = 801;
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

/// Visibility over d − z, and what can be said of it.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    pub(crate) name: String,
    pub(crate) points: Vec<[f64; 2]>,
}

impl Step {
    pub(crate) fn measure(bench: &Bench<'_>, spec: &str, reach: [f32; 2]) -> Result<Self> {
        let at = |i: u16| reach[0] + (reach[1] - reach[0]) * f32::from(i) / f32::from(POINTS - 1);
        let behind: Vec<f32> = (0..POINTS).map(at).collect();
        let depths: Vec<f32> = behind.iter().map(|b| CASTER + b).collect();
        let answers = bench.curve(spec, CASTER, &depths)?;
        let points = behind.iter().zip(answers).map(|(x, y)| [f64::from(*x), f64::from(y)]).collect();
        Ok(Self { name: spec.into(), points })
    }

    /// Visibility of a lit surface: d = z.
    pub(crate) fn at_zero(&self) -> f64 {
        self.points.iter().min_by(|a, b| a[0].abs().total_cmp(&b[0].abs())).map_or(f64::NAN, |p| p[1])
    }

    /// Steepest fall per depth range.
    fn steepness(&self) -> f64 {
        let slope = |p: &[[f64; 2]]| (p[0][1] - p[1][1]) / (p[1][0] - p[0][0]);
        self.points.windows(2).map(slope).fold(f64::NAN, f64::max)
    }

    /// All rises together: a step without ringing only falls.
    fn ringing(&self) -> f64 {
        self.points.windows(2).map(|p| (p[1][1] - p[0][1]).max(0.0)).sum()
    }

    /// How far the depths at which it passes 0.95 and 0.05 lie apart.
    fn width(&self) -> f64 {
        let last = |level: f64| self.points.iter().rev().find(|p| p[1] > level).map_or(f64::NAN, |p| p[0]);
        last(0.05) - last(0.95)
    }

    /// Mean of the visibility that a shadowed receiver gets over the plotted range.
    pub(crate) fn light_behind(&self) -> f64 {
        let behind: Vec<f64> = self.points.iter().filter(|p| p[0] > 0.0).map(|p| p[1]).collect();
        behind.iter().sum::<f64>() / behind.len() as f64
    }
}

pub(crate) fn panel(steps: &[&Step], reach: [f32; 2]) -> Panel {
    Panel {
        curves: steps.iter().map(|s| Curve { name: s.name.clone(), points: s.points.clone() }).collect(),
        x: reach.map(f64::from),
        y: [-0.05, 1.05],
        x_label: "d - z, as a share of the light's depth range".into(),
        y_label: "visibility, 0 in shadow, 1 lit".into(),
    }
}

pub(super) fn figure_3(bench: &Bench<'_>) -> Result<Page> {
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
    page.verdict(steeper(plain.each_ref().map(Step::steepness)));
    page.verdict(attenuation([&plain[2], &attenuated].map(|s| [s.ringing(), s.steepness()])));
    page.verdict(lifted(attenuated.at_zero(), offset.at_zero(), scaled.at_zero()));
    page.verdict(scale_is_steep(attenuated.width(), scaled.width()));
    Ok(page)
}

fn steeper([one, four, sixteen]: [f64; 3]) -> Verdict {
    Verdict::new(
        "More terms make a steeper step",
        [
            more("steepness of 4 terms", four, "that of 1", one),
            more("steepness of 16 terms", sixteen, "that of 4", four),
        ],
    )
}

/// Ringing and steepness without and with attenuation.
fn attenuation([[ringing, steep], [less_ringing, less_steep]]: [[f64; 2]; 2]) -> Verdict {
    Verdict::new(
        "Attenuation suppresses ringing and makes the step less steep",
        [
            less("ringing with attenuation", less_ringing, "half of that without", 0.5 * ringing),
            less("steepness with attenuation", less_steep, "that without", steep),
        ],
    )
}

fn lifted(plain: f64, offset: f64, scaled: f64) -> Verdict {
    Verdict::new(
        "A lit surface is half dark without an offset or a scale, and lit with either",
        [
            at_most("visibility at d = z without", (plain - 0.5).abs(), "0.5 ± 0.02", 0.02),
            at_least("with an offset", offset, "0.99", 0.99),
            at_least("with a scale", scaled, "0.99", 0.99),
        ],
    )
}

fn scale_is_steep(plain: f64, scaled: f64) -> Verdict {
    Verdict::new(
        "A scale makes the transition steeper",
        [less("its width", scaled, "two thirds of that of the plain series", plain * 2.0 / 3.0)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(steeper([1.0, 2.0, 3.0]).outcome(), Holds);
        assert_eq!(steeper([1.0, 3.0, 2.0]).outcome(), Differs);
        assert_eq!(attenuation([[1.0, 9.0], [0.1, 5.0]]).outcome(), Holds);
        assert_eq!(attenuation([[1.0, 9.0], [0.8, 5.0]]).outcome(), Differs);
        assert_eq!(attenuation([[1.0, 5.0], [0.1, 9.0]]).outcome(), Differs);
        assert_eq!(lifted(0.5, 1.0, 1.0).outcome(), Holds);
        assert_eq!(lifted(0.8, 1.0, 1.0).outcome(), Differs);
        assert_eq!(lifted(0.5, 0.9, 1.0).outcome(), Differs);
        assert_eq!(scale_is_steep(0.06, 0.02).outcome(), Holds);
        assert_eq!(scale_is_steep(0.06, 0.05).outcome(), Differs);
    }

    #[test]
    fn curves_are_measured() {
        let step = Step {
            name: "s".into(),
            points: vec![[-0.2, 1.0], [-0.1, 0.8], [0.0, 1.0], [0.1, 0.25], [0.2, 0.0]],
        };
        assert_eq!(step.at_zero(), 1.0);
        assert!((step.steepness() - 7.5).abs() < 1e-9);
        assert!((step.ringing() - 0.2).abs() < 1e-9);
        assert!((step.width() - 0.1).abs() < 1e-9);
        assert_eq!(step.light_behind(), 0.125);
    }
}
