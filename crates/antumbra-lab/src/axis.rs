//! One axis of a plot: where values lie, and the round ones that are written beside it.

/// Spread from which a logarithmic axis shows more than a linear one.
const LOG_FROM: f64 = 4.0;

/// Maps values to positions, linearly or logarithmically.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis {
    low: f64,
    high: f64,
    log: bool,
    ends: [f64; 2],
}

impl Axis {
    /// A linear axis from `low` to `high`, in that order, between the positions `ends`.
    pub(crate) fn linear([low, high]: [f64; 2], ends: [f64; 2]) -> Self {
        Self { low, high, log: false, ends }
    }

    /// An axis that shows all `values` between the positions `ends`; logarithmic if they are
    /// positive and far apart, else from 0.
    pub(crate) fn new(values: Vec<f64>, ends: [f64; 2]) -> Self {
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        if values.is_empty() || high <= 0.0 {
            return Self { low: 0.0, high: 1.0, log: false, ends };
        }
        let log = low > 0.0 && high / low > LOG_FROM;
        let (low, high) = if log { (low / 1.25, high * 1.25) } else { (0.0, high * 1.12) };
        Self { low, high, log, ends }
    }

    pub(crate) fn is_log(&self) -> bool {
        self.log
    }

    /// Position of a value.
    pub(crate) fn place(&self, value: f64) -> f64 {
        let t = if self.log {
            (value / self.low).ln() / (self.high / self.low).ln()
        } else {
            (value - self.low) / (self.high - self.low)
        };
        self.ends[0] + t * (self.ends[1] - self.ends[0])
    }

    /// Positions and texts at round values.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        let values = if self.log { self.log_ticks() } else { self.linear_ticks() };
        values.into_iter().map(|v| (self.place(v), text(v))).collect()
    }

    /// 1, 2 and 5 times powers of ten; over more than two decades the powers only.
    fn log_ticks(&self) -> Vec<f64> {
        let decades = self.low.log10().floor() as i32..=self.high.log10().ceil() as i32;
        let steps: &[f64] = if self.high / self.low > 100.0 { &[1.0] } else { &[1.0, 2.0, 5.0] };
        let all = decades.flat_map(|d| steps.iter().map(move |s| s * 10_f64.powi(d)));
        all.filter(|v| (self.low..=self.high).contains(v)).collect()
    }

    fn linear_ticks(&self) -> Vec<f64> {
        let rough = (self.high - self.low) / 5.0;
        let power = 10_f64.powf(rough.log10().floor());
        let step =
            [1.0, 2.0, 5.0, 10.0].into_iter().map(|s| s * power).find(|s| *s >= rough).unwrap_or(rough);
        // Ends that are round but for rounding count.
        let [first, last] =
            [(self.low / step - 1e-6).ceil(), (self.high / step + 1e-6).floor()].map(|n| n as i64);
        (first..=last).map(|i| i as f64 * step).collect()
    }
}

/// As short as a round value can be written.
fn text(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_values_get_a_linear_axis_from_zero() {
        let axis = Axis::new(vec![1.0, 2.0], [0.0, 100.0]);
        assert!(!axis.is_log());
        let texts: Vec<String> = axis.ticks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(texts, ["0", "0.5", "1", "1.5", "2"]);
        assert_eq!(axis.place(0.0), 0.0);
    }

    #[test]
    fn far_values_get_a_logarithmic_axis() {
        let axis = Axis::new(vec![0.01, 0.2], [0.0, 100.0]);
        assert!(axis.is_log());
        let texts: Vec<String> = axis.ticks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(texts, ["0.01", "0.02", "0.05", "0.1", "0.2"]);
        assert!((axis.place((0.01_f64 * 0.2).sqrt()) - 50.0).abs() < 1e-9);
    }

    #[test]
    fn a_linear_axis_has_ticks_at_round_values_on_both_sides_of_zero() {
        let axis = Axis::linear([-0.1, 0.25], [10.0, 80.0]);
        let texts: Vec<String> = axis.ticks().into_iter().map(|(_, text)| text).collect();
        assert_eq!(texts, ["-0.1", "0", "0.1", "0.2"]);
        assert!((axis.place(0.0) - 30.0).abs() < 1e-9);
    }

    #[test]
    fn no_values_and_zeros_make_an_axis() {
        for values in [vec![], vec![0.0], vec![0.0, 3.0]] {
            let axis = Axis::new(values, [0.0, 1.0]);
            assert!(axis.ticks().iter().all(|(at, _)| at.is_finite()));
        }
    }
}
