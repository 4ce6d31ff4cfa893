//! The step of the shadow test as a technique reconstructs it.

use crate::workbench::Workbench;
use antumbra_lab::chart::{Curve, Panel};
use anyhow::Result;

/// Depth of the caster, z, as a share of the light's range.
const CASTER: f32 = 0.5;
/// Receivers along the curve.
const POINTS: u16 = 801;

/// Visibility over d − z, and what can be said of it.
#[derive(Debug, Clone)]
pub(crate) struct Step {
    /// The technique as it was asked for.
    pub(crate) name: String,
    /// d − z and visibility, d − z rising.
    pub(crate) points: Vec<[f64; 2]>,
}

impl Step {
    /// Measures a technique between two values of d − z.
    pub(crate) fn measure(bench: &Workbench<'_>, spec: &str, reach: [f32; 2]) -> Result<Self> {
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
    pub(crate) fn steepness(&self) -> f64 {
        let slope = |p: &[[f64; 2]]| (p[0][1] - p[1][1]) / (p[1][0] - p[0][0]);
        self.points.windows(2).map(slope).fold(f64::NAN, f64::max)
    }

    /// All rises together: a step without ringing only falls.
    pub(crate) fn ringing(&self) -> f64 {
        self.points.windows(2).map(|p| (p[1][1] - p[0][1]).max(0.0)).sum()
    }

    /// How far the depths at which it passes 0.95 and 0.05 lie apart.
    pub(crate) fn width(&self) -> f64 {
        let last = |level: f64| self.points.iter().rev().find(|p| p[1] > level).map_or(f64::NAN, |p| p[0]);
        last(0.05) - last(0.95)
    }

    /// Mean of the visibility that a shadowed receiver gets over the plotted range.
    pub(crate) fn light_behind(&self) -> f64 {
        let behind: Vec<f64> = self.points.iter().filter(|p| p[0] > 0.0).map(|p| p[1]).collect();
        behind.iter().sum::<f64>() / behind.len() as f64
    }
}

/// A plot of several steps between two values of d − z.
pub(crate) fn panel(steps: &[&Step], reach: [f32; 2]) -> Panel {
    Panel {
        curves: steps.iter().map(|s| Curve { name: s.name.clone(), points: s.points.clone() }).collect(),
        x: reach.map(f64::from),
        y: [-0.05, 1.05],
        x_label: "d - z, as a share of the light's depth range".into(),
        y_label: "visibility, 0 in shadow, 1 lit".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
