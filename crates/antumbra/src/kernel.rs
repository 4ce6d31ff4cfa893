//! Separable filter kernels: one-dimensional weights at texel spacing.

use crate::parameter::choice;

choice! {
    /// Shape of a kernel.
    Weights {
        /// The sampled Gaussian with σ as set.
        Gaussian = "gaussian",
        /// All weights equal.
        Box = "box",
    }
}

/// Symmetric weights that sum to one; tap `i` of `n` lies at `i − (n−1)/2` texels.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel {
    /// One weight per texel, at least one.
    pub taps: Vec<f32>,
}

impl Kernel {
    /// A kernel of `width` texels. `sigma_texels` 0 chooses [`Kernel::usual_sigma`]; boxes ignore it.
    #[must_use]
    pub fn new(weights: Weights, width: u32, sigma_texels: f32) -> Self {
        let sigma = match sigma_texels {
            s if s > 0.0 => f64::from(s),
            _ => Self::usual_sigma(width),
        };
        let centre = (f64::from(width) - 1.0) / 2.0;
        let raw: Vec<f64> = (0..width.max(1))
            .map(|i| match weights {
                Weights::Box => 1.0,
                Weights::Gaussian => (-(f64::from(i) - centre).powi(2) / (2.0 * sigma * sigma)).exp(),
            })
            .collect();
        let sum: f64 = raw.iter().sum();
        Self { taps: raw.iter().map(|w| (w / sum) as f32).collect() }
    }

    /// Distance from the centre in texels, and weight, of each tap.
    pub(crate) fn offsets(&self) -> impl Iterator<Item = (f32, f32)> {
        let centre = (self.taps.len() as f32 - 1.0) / 2.0;
        self.taps.iter().enumerate().map(move |(i, weight)| (i as f32 - centre, *weight))
    }

    /// σ in texels that makes good use of `width` taps: 0.15 · width + 0.35 (0.8 for three, 1.1 for
    /// five, 1.4 for seven), the customary rule of image libraries.
    #[must_use]
    pub fn usual_sigma(width: u32) -> f64 {
        0.15 * f64::from(width) + 0.35
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_sum_to_one_and_are_symmetric() {
        for weights in [Weights::Gaussian, Weights::Box] {
            for width in 1..32 {
                let taps = Kernel::new(weights, width, 0.0).taps;
                assert_eq!(taps.len(), width as usize);
                assert!((taps.iter().sum::<f32>() - 1.0).abs() < 1e-6);
                assert!(taps.iter().eq(taps.iter().rev()));
                assert!(taps[0] <= taps[taps.len() / 2]);
            }
        }
    }

    #[test]
    fn a_narrow_gaussian_is_one_tap_and_a_wide_one_is_a_box() {
        assert!(Kernel::new(Weights::Gaussian, 5, 0.1).taps[2] > 0.999);
        assert!((Kernel::new(Weights::Gaussian, 5, 1e4).taps[0] - 0.2).abs() < 1e-4);
    }
}
