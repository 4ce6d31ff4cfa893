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

/// How wide a kernel is: so many texels everywhere, or as many as fill a length of the world in a view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Width {
    /// Texels; the most, if `world` is set. At least 1.
    pub texels: f32,
    /// World units (under a spot, at unit distance along its axis); 0 for `texels` in every view.
    pub world: f32,
}

impl Width {
    /// Texels in a view whose texels have this size.
    #[must_use]
    pub fn in_texels(&self, texel_world: f32) -> f32 {
        if self.world > 0.0 { (self.world / texel_world).max(1.0).min(self.texels) } else { self.texels }
    }
}

/// Symmetric weights that sum to one; tap `i` of `n` lies at `i − (n−1)/2` texels.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel {
    /// One weight per texel, at least one.
    pub taps: Vec<f32>,
    /// How it adapts to each view, if it does; `taps` are then its widest form.
    pub adaptive: Option<Adaptive>,
}

/// A kernel whose width depends on the view.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Adaptive {
    /// Its width.
    pub width: Width,
    /// Its shape.
    pub weights: Weights,
    /// Standard deviation of the widest Gaussian in texels, narrower ones in proportion; 0 for
    /// [`Kernel::usual_sigma`].
    pub sigma_texels: f32,
}

/// Weights on each side of an adaptive kernel, the middle one included.
pub(crate) const MOST_SIDE: usize = 16;

impl Adaptive {
    /// The weights from the middle outwards in a view whose texels have this size, and how many texels
    /// they reach. Taps that a fractional width covers in part count in part, so that the kernel does
    /// not jump when the texels' size changes.
    pub(crate) fn side(&self, texel_world: f32) -> ([f32; MOST_SIDE], u32) {
        let width = self.width.in_texels(texel_world);
        let sigma = match self.sigma_texels {
            s if s > 0.0 => f64::from(s * width / self.width.texels),
            _ => Kernel::usual_sigma(width),
        };
        let mut side: [f64; MOST_SIDE] = std::array::from_fn(|i| {
            let covered = ((f64::from(width) + 1.0) / 2.0 - i as f64).clamp(0.0, 1.0);
            covered * self.weights.at(i as f64, sigma)
        });
        let sum = 2.0 * side.iter().sum::<f64>() - side[0];
        side.iter_mut().for_each(|w| *w /= sum);
        (side.map(|w| w as f32), side.iter().rposition(|w| *w > 0.0).unwrap_or(0) as u32)
    }

    /// Variance in such a view, in squares of texels.
    pub(crate) fn variance(&self, texel_world: f32) -> f32 {
        let (side, _) = self.side(texel_world);
        (0u8..).zip(side).map(|(i, weight)| 2.0 * f32::from(i) * f32::from(i) * weight).sum()
    }
}

impl Weights {
    /// Before normalisation, at a distance from the middle; both in texels.
    fn at(self, distance: f64, sigma: f64) -> f64 {
        match self {
            Self::Box => 1.0,
            Self::Gaussian => (-distance.powi(2) / (2.0 * sigma * sigma)).exp(),
        }
    }
}

impl Kernel {
    /// A kernel of `width` texels. `sigma_texels` 0 chooses [`Kernel::usual_sigma`]; boxes ignore it.
    #[must_use]
    pub fn new(weights: Weights, width: u32, sigma_texels: f32) -> Self {
        let sigma = match sigma_texels {
            s if s > 0.0 => f64::from(s),
            _ => Self::usual_sigma(width as f32),
        };
        let centre = (f64::from(width) - 1.0) / 2.0;
        let raw: Vec<f64> = (0..width.max(1)).map(|i| weights.at(f64::from(i) - centre, sigma)).collect();
        let sum: f64 = raw.iter().sum();
        Self { taps: raw.iter().map(|w| (w / sum) as f32).collect(), adaptive: None }
    }

    /// A kernel as wide as `width` is in each view.
    #[must_use]
    pub fn adaptive(weights: Weights, width: Width, sigma_texels: f32) -> Self {
        let adaptive = Some(Adaptive { width, weights, sigma_texels });
        Self { adaptive, ..Self::new(weights, width.texels as u32, sigma_texels) }
    }

    /// Distance from the centre in texels, and weight, of each tap.
    pub(crate) fn offsets(&self) -> impl Iterator<Item = (f32, f32)> {
        let centre = (self.taps.len() as f32 - 1.0) / 2.0;
        self.taps.iter().enumerate().map(move |(i, weight)| (i as f32 - centre, *weight))
    }

    /// σ in texels that makes good use of `width` taps: 0.15 · width + 0.35 (0.8 for three, 1.1 for
    /// five, 1.4 for seven), the customary rule of image libraries.
    #[must_use]
    pub fn usual_sigma(width: f32) -> f64 {
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
    fn an_adaptive_kernel_is_the_fixed_one_at_whole_widths_and_does_not_jump_between() {
        for weights in [Weights::Gaussian, Weights::Box] {
            let adaptive =
                |width| Adaptive { width: Width { texels: 31.0, world: width }, weights, sigma_texels: 0.0 };
            for width in (1..32).step_by(2) {
                let fixed = Kernel::new(weights, width, 0.0).taps;
                let (side, reach) = adaptive(width as f32).side(1.0);
                assert_eq!(reach, width / 2);
                let middle = width as usize / 2;
                for i in 0..=middle {
                    assert!((side[i] - fixed[middle + i]).abs() < 1e-6, "{width} {i}");
                }
            }
            // The same length in texels half as large; no more than the most.
            assert_eq!(adaptive(3.5).side(0.5), adaptive(7.0).side(1.0));
            assert_eq!(adaptive(100.0).side(1.0), adaptive(31.0).side(1.0));
            assert_eq!(adaptive(0.1).side(1.0).1, 0);
            for step in 10..300 {
                let [a, b] = [step, step + 1].map(|s| adaptive(s as f32 / 10.0).side(1.0).0);
                let change: f32 = a.iter().zip(b).map(|(a, b)| (a - b).abs()).sum();
                assert!(change < 0.2, "{weights:?} {step}: {change}");
            }
        }
    }

    #[test]
    fn variances_are_those_of_the_weights() {
        for width in (1..32).step_by(2) {
            for (weights, sigma_texels) in
                [(Weights::Gaussian, 0.0), (Weights::Gaussian, 2.5), (Weights::Box, 0.0)]
            {
                let taps = Kernel::new(weights, width, sigma_texels);
                let expected: f32 = taps.offsets().map(|(d, weight)| d * d * weight).sum();
                for world in [0.0, width as f32 / 8.0] {
                    let width = Width { texels: width as f32, world };
                    let found = Adaptive { width, weights, sigma_texels }.variance(0.125);
                    assert!(
                        (found - expected).abs() < 1e-5 * expected.max(1.0),
                        "{width:?}: {found} {expected}"
                    );
                }
            }
            let width = width as f32;
            let narrower = Width { texels: 31.0, world: width };
            let found = Adaptive { width: narrower, weights: Weights::Box, sigma_texels: 0.0 }.variance(1.0);
            assert!((found - (width * width - 1.0) / 12.0).abs() < 1e-5 * width * width, "{width}: {found}");
        }
    }

    #[test]
    fn a_narrow_gaussian_is_one_tap_and_a_wide_one_is_a_box() {
        assert!(Kernel::new(Weights::Gaussian, 5, 0.1).taps[2] > 0.999);
        assert!((Kernel::new(Weights::Gaussian, 5, 1e4).taps[0] - 0.2).abs() < 1e-4);
    }
}
