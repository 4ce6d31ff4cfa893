//! Small statistics that verdicts need.

use serde::{Deserialize, Serialize};

/// A number that would come out a little differently another time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// The number.
    pub value: f64,
    /// It is surely not below this.
    pub low: f64,
    /// It is surely not above this.
    pub high: f64,
}

impl Measured {
    /// A number that comes out the same every time, such as a picture's error.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, low: value, high: value }
    }

    /// The median, with the order statistics between which the true median lies in 95 of 100 cases or
    /// more; of fewer than six samples, all that there are.
    #[must_use]
    pub fn median(samples: &[f64]) -> Self {
        let mut sorted = samples.to_vec();
        sorted.sort_by(f64::total_cmp);
        let at = |i: usize| sorted.get(i).copied().unwrap_or(f64::NAN);
        let outer = outside(sorted.len());
        Self { value: at(sorted.len() / 2), low: at(outer), high: at(sorted.len().saturating_sub(outer + 1)) }
    }

    /// The median of the quotients of two frames' times, each of both frames in one round.
    #[must_use]
    pub fn ratio(above: &[f64], below: &[f64]) -> Self {
        Self::median(&above.iter().zip(below).map(|(a, b)| a / b).collect::<Vec<f64>>())
    }
}

/// How many of n samples may be left out on either side so that the rest spans the true median in 95 of
/// 100 cases: each sample is on either side of it as a coin falls.
fn outside(n: usize) -> usize {
    let (mut tail, mut ways, mut outer) = (0.0, 0.5_f64.powi(n as i32), 0);
    while 2 * outer + 2 < n {
        tail += ways;
        if 2.0 * tail > 0.05 {
            break;
        }
        ways *= (n - outer) as f64 / (outer + 1) as f64;
        outer += 1;
    }
    outer.saturating_sub(1)
}

/// The one with the smallest value.
pub(crate) fn smallest(of: impl IntoIterator<Item = Measured>) -> Option<Measured> {
    of.into_iter().reduce(|a, b| if b.value < a.value { b } else { a })
}

/// The one with the largest value.
pub(crate) fn largest(of: impl IntoIterator<Item = Measured>) -> Option<Measured> {
    of.into_iter().reduce(|a, b| if b.value > a.value { b } else { a })
}

/// Spearman's rank correlation; `None` for fewer than two pairs or where one side is constant.
pub(crate) fn rank_correlation(a: &[f64], b: &[f64]) -> Option<f64> {
    if a.len() != b.len() || a.len() < 2 || a.iter().chain(b).any(|v| !v.is_finite()) {
        return None;
    }
    let (a, b) = (ranks(a), ranks(b));
    let mean = (a.len() as f64 - 1.0) / 2.0;
    let product =
        |x: &[f64], y: &[f64]| -> f64 { x.iter().zip(y).map(|(x, y)| (x - mean) * (y - mean)).sum() };
    let spread = (product(&a, &a) * product(&b, &b)).sqrt();
    (spread > 0.0).then(|| product(&a, &b) / spread)
}

/// Places from 0; equal values share the mean of theirs.
fn ranks(values: &[f64]) -> Vec<f64> {
    let below = |v: f64| values.iter().filter(|w| **w < v).count() as f64;
    let equal = |v: f64| values.iter().filter(|w| **w == v).count() as f64;
    values.iter().map(|v| below(*v) + (equal(*v) - 1.0) / 2.0).collect()
}

/// The smallest quotient of neighbours in any of the sequences: above 1 if all rise.
pub(crate) fn steps<const N: usize>(sequences: impl Iterator<Item = [f64; N]>) -> Option<f64> {
    let quotients = |s: [f64; N]| s.windows(2).map(|pair| pair[1] / pair[0]).collect::<Vec<f64>>();
    // A missing number makes the whole unknown.
    sequences.flat_map(quotients).reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.min(b) })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_median_comes_with_what_it_may_be() {
        let nine: Vec<f64> = (1..=9).rev().map(f64::from).collect();
        // Of nine, the second to the eighth: 96.1 of 100.
        assert_eq!(Measured::median(&nine), Measured { value: 5.0, low: 2.0, high: 8.0 });
        assert_eq!(Measured::median(&[3.0, 1.0, 2.0]), Measured { value: 2.0, low: 1.0, high: 3.0 });
        assert_eq!(Measured::ratio(&[2.0, 6.0, 3.0], &[1.0, 2.0, 2.0]).value, 2.0);
        assert_eq!([5, 6, 8, 9, 11, 12, 15].map(outside), [0, 0, 0, 1, 1, 2, 3]);
        assert!(Measured::median(&[]).value.is_nan());
    }

    #[test]
    fn correlation_is_of_order_alone() {
        assert_eq!(rank_correlation(&[1.0, 2.0, 9.0], &[10.0, 11.0, 12.0]), Some(1.0));
        assert_eq!(rank_correlation(&[1.0, 2.0, 9.0], &[3.0, 2.0, 1.0]), Some(-1.0));
        assert_eq!(rank_correlation(&[1.0, 1.0], &[3.0, 2.0]), None);
        assert_eq!(rank_correlation(&[1.0], &[3.0]), None);
        assert_eq!(rank_correlation(&[1.0, f64::NAN], &[3.0, 2.0]), None);
    }

    #[test]
    fn the_smallest_step_of_all_sequences_is_found() {
        assert_eq!(steps([[1.0, 2.0, 3.0], [2.0, 8.0, 16.0]].into_iter()), Some(1.5));
        assert_eq!(steps([[2.0, 1.0]].into_iter()), Some(0.5));
        assert!(steps([[2.0, f64::NAN]].into_iter()).is_some_and(f64::is_nan));
        assert_eq!(steps(std::iter::empty::<[f64; 2]>()), None);
    }
}
