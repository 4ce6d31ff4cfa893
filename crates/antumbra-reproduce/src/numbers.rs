//! Small statistics that verdicts need.

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
