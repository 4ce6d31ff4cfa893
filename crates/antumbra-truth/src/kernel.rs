//! Filter kernels of a shadow map, as continuous weights in light space.

use crate::TruthError;
use glam::{DVec2, DVec3};

/// A separable filter kernel, one weight per texel along one axis; the same along the other.
///
/// Tap `i` of `n` weighs the texel at offset `i − (n − 1)/2` from the lookup, so an even count is
/// centred between two texels. Between texels a lookup is bilinear: the continuous kernel is the sum
/// of the taps' unit hats, that is, the taps joined by straight lines, falling to zero one texel
/// outside the first and the last. `Kernel::new(vec![1.0])` is a bilinear lookup without a filter.
#[derive(Debug, Clone, PartialEq)]
pub struct Kernel {
    taps: Vec<f64>,
    /// Share of the weight left of each knot: the n + 2 places where two lines meet.
    shares: Vec<f64>,
}

impl Kernel {
    /// Normalises `taps` to the sum 1.
    ///
    /// # Errors
    /// [`TruthError::BadKernel`] when there is no tap, one is negative or not finite, or all are 0.
    pub fn new(taps: Vec<f64>) -> Result<Self, TruthError> {
        let sum: f64 = taps.iter().sum();
        if !(sum > 0.0 && sum.is_finite() && taps.iter().all(|&tap| tap >= 0.0)) {
            return Err(TruthError::BadKernel { taps: taps.len(), sum });
        }
        let taps: Vec<f64> = taps.iter().map(|tap| tap / sum).collect();
        let mut shares = vec![0.0];
        let mut left = 0.0;
        let mut before = 0.0;
        for &tap in taps.iter().chain(&[0.0]) {
            left += 0.5 * (before + tap);
            before = tap;
            shares.push(left);
        }
        Ok(Self { taps, shares })
    }

    /// Weights, summing to 1.
    #[must_use]
    pub fn taps(&self) -> &[f64] {
        &self.taps
    }

    /// Half the width of the continuous kernel, texels: (n + 1)/2.
    #[must_use]
    pub fn reach(&self) -> f64 {
        0.5 * (self.taps.len() as f64 + 1.0)
    }

    /// The offset, in texels, that has the share `share` (0 to 1) of the weight to its left: the
    /// inverse of the kernel's cumulative distribution, which is quadratic between knots.
    #[must_use]
    pub fn offset(&self, share: f64) -> f64 {
        let last = self.taps.len();
        let piece = self.shares.partition_point(|&s| s <= share).clamp(1, last + 1) - 1;
        let tap = |knot: usize| knot.checked_sub(1).and_then(|i| self.taps.get(i)).copied().unwrap_or(0.0);
        let (from, to) = (tap(piece), tap(piece + 1));
        // from·x + (to − from)·x²/2 = rest, in the form that does not cancel.
        let rest = (share - self.shares[piece]).max(0.0);
        let root = (from * from + 2.0 * (to - from) * rest).max(0.0).sqrt();
        let x = if from + root > 0.0 { 2.0 * rest / (from + root) } else { 0.0 };
        piece as f64 + x.min(1.0) - self.reach()
    }

    /// Where sample `index` of the pixel with this `scramble` lies, in texels right and down.
    ///
    /// Samples follow the Sobol' (0,2)-sequence, whose first 4ᵏ points fill every 2ᵏ × 2ᵏ grid (and
    /// every other elementary grid) evenly, scrambled by an exclusive or that keeps this property.
    pub(crate) fn sample(&self, index: u32, scramble: [u32; 2]) -> DVec2 {
        let unit = |bits: u32| (f64::from(bits) + 0.5) / 4_294_967_296.0;
        let x = index.reverse_bits() ^ scramble[0];
        let y = second_sobol(index) ^ scramble[1];
        DVec2::new(self.offset(unit(x)), self.offset(unit(y)))
    }
}

/// Second coordinate of the Sobol' sequence.
fn second_sobol(index: u32) -> u32 {
    let (mut rest, mut direction, mut bits) = (index, 1_u32 << 31, 0);
    while rest != 0 {
        if rest & 1 == 1 {
            bits ^= direction;
        }
        rest >>= 1;
        direction ^= direction >> 1;
    }
    bits
}

/// Two words that differ from pixel to pixel without pattern.
pub(crate) fn scramble(pixel: usize) -> [u32; 2] {
    let mix = |seed: u64| {
        // The finaliser of splitmix64.
        let z = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    };
    let word = mix(pixel as u64 + 1);
    [word as u32, (word >> 32) as u32]
}

/// How a light view's map lies in the world: the displacement of one texel step, to be given for
/// the map whose filter is to be judged.
///
/// For a directional light both vectors are perpendicular to the light and measure the map's plane
/// itself. For a spot they are perpendicular to its axis and measure the plane at distance 1 from
/// the apex.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TexelAxes {
    /// One texel to the right, world units.
    pub right_per_texel: DVec3,
    /// One texel down, world units.
    pub down_per_texel: DVec3,
}

/// Which map shades a point in the world: one for all, or one of several cascades.
pub trait MapTexels: Sync {
    /// How the texels of that map lie.
    fn axes(&self, point: DVec3) -> TexelAxes;
}

impl MapTexels for TexelAxes {
    fn axes(&self, _: DVec3) -> TexelAxes {
        *self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn kernels() -> Vec<Kernel> {
        let taps: [&[f64]; 5] =
            [&[1.0], &[1.0, 1.0], &[1.0, 4.0, 6.0, 4.0, 1.0], &[0.0, 2.0, 0.0, 0.0, 1.0], &[1.0; 9]];
        taps.map(|taps| Kernel::new(taps.to_vec()).unwrap()).to_vec()
    }

    /// The continuous kernel straight from its definition.
    fn weight(kernel: &Kernel, x: f64) -> f64 {
        let middle = 0.5 * (kernel.taps().len() as f64 - 1.0);
        let hats = kernel.taps().iter().enumerate();
        hats.map(|(i, tap)| tap * (1.0 - (x - (i as f64 - middle)).abs()).max(0.0)).sum()
    }

    #[test]
    fn offsets_invert_the_cumulative_weight() {
        for kernel in kernels() {
            let steps = 20_000;
            let width = 2.0 * kernel.reach() / f64::from(steps);
            let mut share = 0.0;
            for step in 0..steps {
                let x = -kernel.reach() + width * (f64::from(step) + 0.5);
                share += 0.5 * width * weight(&kernel, x);
                if weight(&kernel, x) > 1e-3 {
                    assert!((kernel.offset(share) - x).abs() < 1e-3, "{kernel:?} at {x}");
                }
                share += 0.5 * width * weight(&kernel, x);
            }
            assert!((share - 1.0).abs() < 1e-6);
            assert!(kernel.offset(0.0) >= -kernel.reach() && kernel.offset(1.0) <= kernel.reach());
        }
    }

    #[test]
    fn samples_fill_grids_evenly() {
        for scramble in [[0, 0], scramble(17), scramble(0)] {
            let unit = |bits: u32, cells: u32| ((u64::from(bits) * u64::from(cells)) >> 32) as u32;
            for (count, columns, rows) in [(64, 8, 8), (256, 16, 16), (256, 64, 4), (64, 2, 32)] {
                let mut cells: Vec<u32> = (0..count)
                    .map(|i: u32| {
                        let x = unit(i.reverse_bits() ^ scramble[0], columns);
                        let y = unit(second_sobol(i) ^ scramble[1], rows);
                        y * columns + x
                    })
                    .collect();
                cells.sort_unstable();
                assert!(cells.into_iter().eq(0..count), "{columns}×{rows}");
            }
        }
    }

    #[test]
    fn refuses_weights_without_a_mean() {
        for taps in [vec![], vec![0.0], vec![1.0, -0.5], vec![f64::NAN], vec![f64::INFINITY]] {
            assert!(matches!(Kernel::new(taps), Err(TruthError::BadKernel { .. })));
        }
    }
}
