//! Moment shadow maps: four moments of depth, and the sharpest bound that they allow.
//!
//! The share of light is what lies at or beyond the receiver in the distribution of depths under the
//! kernel. Of all distributions with the same four moments one has the most light; its share is the
//! answer, so that nothing is shadowed that might be lit. Two casters under the kernel are told
//! exactly; three and more bleed a little, where variance shadow maps bleed with two.
//!
//! # The bound
//! Depths are mapped to z ∈ \[−1,1]; b = E (z, z², z³, z⁴) filters linearly. With
//! x̂ = (1, x, x²) let H = E ẑ ẑᵀ, the Hankel matrix of 1 and b.
//!
//! - *How much can lie at x?* For any q(z) = aᵀ ẑ with q(x) = 1, the share at x is at most
//!   E q² = aᵀ H a. The least such value, by Cauchy and Schwarz at a ∝ c with H c = x̂, is
//!   1/(x̂ᵀ H⁻¹ x̂).
//! - *Which distribution has that much there?* Equality needs c's polynomial to vanish wherever else
//!   there is a share: at its two roots. So there is one distribution of three depths, x and the two
//!   roots, with these moments, and each of its shares is the same formula at its own depth.
//! - *Why is it the brightest?* Let p be the quartic that is 1 at those of the three depths that are
//!   lit, 0 at the others, and touches without crossing at all of them but x. It lies at or above the
//!   step of the shadow test everywhere, so E p bounds the lit share of every distribution; and E p
//!   depends on the moments alone, so it is this distribution's own lit share. (Markov, Krein;
//!   [Peters & Klein 2015, section 3] puts it to use.)
//!
//! x̂ᵀ H⁻¹ x̂ comes from H = L D Lᵀ as a sum of positive terms. The paper's closed form subtracts
//! numbers that nearly cancel where a root is far away; this one does not, and gives no specks.
//!
//! # Bias and storage
//! Of one flat caster H has rank one, so that rounding would decide. The moments are drawn by a
//! little towards those of 1/5 at −1, 3/5 at 0, 1/5 at 1, (0, 2/5, 0, 2/5): of all distributions on
//! \[−1,1] the one whose H has the largest least eigenvalue, 1/5. It lets light of about its own
//! share through, and more just behind casters. With 32 bits the paper takes 3e-7, a few roundings of
//! one texel; blur and interpolation round again, which 3e-6 bears as well.
//!
//! In 16 bits the moments would be too coarse: E z² and E z⁴ say nearly the same. Stored are
//! (1 − T₃(z))/2, (1 − T₄(z))/2, ½ + (√3/2) z − (√12/9) z³ and (z² + z⁴)/2, with the Chebyshev
//! polynomials T: each fills \[0,1], and the matrix, of determinant 4 · 2/√3, is the one that Peters
//! and Klein found by maximising the determinant. Being affine it commutes with filtering.
//!
//! Peters & Klein 2015, "Moment shadow mapping"; Peters, Münstermann, Wetzstein, Klein 2017,
//! "Improved moment shadow maps", for the transform on \[−1,1].

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    bound,
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Values},
    parameter::{Field, Parameter, choice},
};

choice! {
    /// What moments are stored in.
    Format {
        /// 16 bits after the transform; needs `TEXTURE_FORMAT_16BIT_NORM` and
        /// `TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES` (which makes the format renderable), and is 32
        /// bits without.
        Unorm16 = "unorm16",
        /// 32-bit floats.
        Float32 = "float32",
    }
}

/// Moment shadow maps. 1 filtered lookup; 8 bytes per texel (four 16-bit numbers), 16 with 32-bit
/// floats.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Msm {
    /// Storage.
    pub format: Format,
    /// How far moments are drawn towards well-conditioned ones, as a share; 0 for 6e-5 with 16 bits,
    /// 3e-6 with 32.
    pub moment_bias: f32,
    /// Light-bleeding reduction, 0 to 0.99; 0 is none.
    pub reduction: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Msm {
    fn default() -> Self {
        Self { format: Format::Unorm16, moment_bias: 0.0, reduction: 0.0, filter: Filter::default() }
    }
}

impl Msm {
    /// The bias in use.
    #[must_use]
    pub fn bias_share(&self) -> f32 {
        match self.format {
            _ if self.moment_bias > 0.0 => self.moment_bias,
            Format::Unorm16 => 6e-5,
            Format::Float32 => 3e-6,
        }
    }

    fn values(&self, device: &Capabilities) -> Values {
        use wgpu::TextureFormat::{Rgba16Unorm, Rgba32Float};
        let (format, note) = match self.format {
            Format::Unorm16 => device.norm16("moments", Rgba16Unorm, Rgba32Float),
            Format::Float32 => (Rgba32Float, None),
        };
        let (low, bits) = match self.format {
            Format::Unorm16 => (0.0, 16),
            Format::Float32 => (-1.0, 24),
        };
        let values = Values::new("moments", format, Encode::Texel("msm_encode"));
        Values { ranges: vec![[low, 1.0]; 4], bits, note, ..values }
    }

    /// What the bias lets through a tenth of the depth range behind a blocker, and as much again for
    /// rounding, which the bias is chosen to match.
    fn leak(&self) -> f32 {
        let leak = |i: i32| {
            let z = f64::from(i) / 64.0;
            reference::bound(z + 0.1, reference::moments(z), f64::from(self.bias_share()))
        };
        let most = (0..=57).map(leak).fold(0.0, f64::max);
        (2.0 * most as f32 - self.reduction).max(0.0) / (1.0 - self.reduction)
    }
}

impl Technique for Msm {
    fn about(&self) -> About {
        About {
            name: "msm",
            title: "Moment shadow map",
            family: Family::Basis,
            paper: "Peters & Klein 2015",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let own = vec![
            Parameter::new(
                "format",
                "",
                Field::Choice(&mut self.format),
                "storage; unorm16 becomes float32 where it cannot be rendered to",
            ),
            Parameter::new(
                "moment_bias",
                "",
                Field::Number(&mut self.moment_bias, 0.0..=0.1),
                "share of well-conditioned moments mixed in; 0 is 6e-5 with unorm16, 3e-6 with float32",
            ),
            bound::reduction(&mut self.reduction),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let (wgsl, values) = (include_str!("msm.wgsl"), self.values(device));
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, values, device);
        let transformed = u32::from(self.format == Format::Unorm16);
        described.constants.push(Constant::Count("msm_transformed", transformed));
        described.uniforms = vec![("moment_bias", self.bias_share()), ("reduction", self.reduction)];
        // Moments are rounded by 6e-8, which a moment bias of 3e-6 magnifies.
        described.rounding = 5e-3;
        described.ringing = self.leak();
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &["format=float32"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    /// (z, z², z³, z⁴) of z = 2 · linear depth − 1.
    #[must_use]
    pub fn moments(depth: f64) -> [f64; 4] {
        let z = 2.0 * depth - 1.0;
        [z, z.powi(2), z.powi(3), z.powi(4)]
    }
    /// Rows of the matrix of the transform for 16 bits.
    #[must_use]
    pub fn transform() -> [[f64; 4]; 4] {
        let r = 3f64.sqrt();
        [[1.5, 0.0, -2.0, 0.0], [0.0, 4.0, 0.0, -4.0], [r / 2.0, 0.0, -2.0 * r / 9.0, 0.0], [0.0, 0.5, 0.0, 0.5]]
    }
    /// What is added after it.
    pub const SHIFT: [f64; 4] = [0.5, 0.0, 0.5, 0.0];
    /// Rows of its inverse.
    #[must_use]
    pub fn inverse() -> [[f64; 4]; 4] {
        let r = 3f64.sqrt();
        [[-1.0 / 3.0, 0.0, r, 0.0], [0.0, 0.125, 0.0, 1.0], [-0.75, 0.0, 0.75 * r, 0.0], [0.0, -0.125, 0.0, 1.0]]
    }
    /// Matrix times vector.
    #[must_use]
    pub fn apply(matrix: [[f64; 4]; 4], v: [f64; 4]) -> [f64; 4] {
        matrix.map(|row| std::iter::zip(row, v).map(|(a, b)| a * b).sum())
    }
    /// Moments drawn towards (0, 2/5, 0, 2/5) by a share.
    #[must_use]
    pub fn biased(b: [f64; 4], share: f64) -> [f64; 4] {
        let safe = [0.0, 0.4, 0.0, 0.4];
        std::array::from_fn(|i| b[i] + share * (safe[i] - b[i]))
    }
    /// The other two depths, in z and in order, of the distribution of three that has moments b and
    /// a share at x: roots of c for H c = (1, x, x²), by Cramer's rule.
    #[must_use]
    pub fn others(x: f64, b: [f64; 4]) -> [f64; 2] {
        let h = [[1.0, b[0], b[1]], [b[0], b[1], b[2]], [b[1], b[2], b[3]]];
        let v = [1.0, x, x * x];
        let determinant = |m: [[f64; 3]; 3]| -> f64 {
            (0..3)
                .map(|i| {
                    let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                    m[0][i] * (m[1][j] * m[2][k] - m[1][k] * m[2][j])
                })
                .sum()
        };
        // Up to the determinant of H, which moves no root.
        let [c0, c1, c2] = std::array::from_fn(|column| {
            determinant(std::array::from_fn(|i| {
                std::array::from_fn(|j| if j == column { v[i] } else { h[i][j] })
            }))
        });
        let root = (c1 * c1 - 4.0 * c0 * c2).max(0.0).sqrt();
        let q = -0.5 * (c1 + root.copysign(c1));
        let roots = [q / c2, c0 / q];
        [roots[0].min(roots[1]), roots[0].max(roots[1])]
    }
    /// Share at depth x of a distribution on x, y and z with these moments: the mean of the parabola
    /// that is 1 at x and 0 at the others.
    #[must_use]
    pub fn share(x: f64, [y, z]: [f64; 2], b: [f64; 4]) -> f64 {
        (b[1] - (y + z) * b[0] + y * z) / ((x - y) * (x - z))
    }
    /// Upper bound of the lit share at a linear depth, before the light-bleeding reduction.
    #[must_use]
    pub fn bound(depth: f64, moments: [f64; 4], bias: f64) -> f64 {
        let (x, b) = (2.0 * depth - 1.0, biased(moments, bias));
        let [near, far] = others(x, b);
        if x <= near {
            1.0
        } else if x <= far {
            1.0 - share(near, [x, far], b)
        } else {
            share(x, [near, far], b)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::reference::*;

    /// Reproducible numbers in \[0,1).
    fn numbers() -> impl Iterator<Item = f64> {
        let mut state = 1u64;
        std::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 40) as f64 / (1u64 << 24) as f64
        })
    }

    /// A thousand times five depths, with a receiver.
    fn trials() -> Vec<(f64, Vec<f64>)> {
        let mut numbers = numbers();
        let mut take = |n: usize| numbers.by_ref().take(n).collect::<Vec<f64>>();
        (0..1000).map(|_| (take(1)[0], take(5))).collect()
    }

    fn mean(depths: &[f64]) -> [f64; 4] {
        std::array::from_fn(|i| depths.iter().map(|z| moments(*z)[i]).sum::<f64>() / depths.len() as f64)
    }

    #[test]
    fn three_depths_have_the_moments() {
        for (receiver, depths) in trials() {
            let (x, b) = (2.0 * receiver - 1.0, mean(&depths));
            let [near, far] = others(x, b);
            let points = [x, near, far];
            let shares = [share(x, [near, far], b), share(near, [x, far], b), share(far, [x, near], b)];
            for (power, expected) in [1.0].into_iter().chain(b).enumerate() {
                let terms = std::iter::zip(points, shares).map(|(x, s)| s * x.powi(power as i32));
                // A root far away is a large number times a small one.
                let size = 1.0 + near.abs().max(far.abs()).powi(power as i32);
                assert!((terms.sum::<f64>() - expected).abs() < 1e-9 * size, "power {power} of {points:?}");
            }
            assert!(shares.iter().all(|s| (-1e-9..=1.0 + 1e-9).contains(s)), "{shares:?}");
        }
    }

    #[test]
    fn nothing_lit_is_shadowed_and_two_casters_are_exact() {
        let lit = |receiver: f64, depths: &[f64]| {
            depths.iter().filter(|z| **z >= receiver).count() as f64 / depths.len() as f64
        };
        let mut too_dark = 0;
        for (receiver, depths) in trials() {
            let found = bound(receiver, mean(&depths), 0.0);
            assert!(found >= lit(receiver, &depths) - 1e-9, "{found} at {receiver} of {depths:?}");
            // Negative control: moments of other depths.
            too_dark += usize::from(bound(receiver, mean(&depths[..3]), 0.0) < lit(receiver, &depths));
        }
        assert!(too_dark > 100, "{too_dark}");
        let two = [0.2, 0.2, 0.7];
        assert!((bound(0.7, mean(&two), 1e-9) - 1.0 / 3.0).abs() < 1e-3);
        assert!(bound(0.9, mean(&two), 1e-9) < 1e-3);
    }

    #[test]
    fn the_transform_has_its_inverse() {
        for i in 0..4 {
            let unit = std::array::from_fn(|j| f64::from(u8::from(i == j)));
            let back = apply(inverse(), apply(transform(), unit));
            assert!(std::iter::zip(back, unit).all(|(b, u)| (b - u).abs() < 1e-12), "{back:?}");
        }
    }

    fn stored(depth: f64) -> [f64; 4] {
        let t = apply(transform(), moments(depth));
        std::array::from_fn(|i| t[i] + SHIFT[i])
    }

    #[test]
    fn every_channel_fills_its_range() {
        for channel in 0..4 {
            let values = || (0..=4096).map(|i| stored(f64::from(i) / 4096.0)[channel]);
            let (low, high) = (values().fold(1.0, f64::min), values().fold(0.0, f64::max));
            assert!((-1e-9..1e-6).contains(&low) && (1.0 - 1e-6..1.0 + 1e-9).contains(&high), "{low}, {high}");
        }
    }

    #[test]
    fn quantised_moments_serve_better_transformed() {
        let round = |v: f64| (v * 65535.0).round() / 65535.0;
        let transformed = |depth: f64| {
            let t = stored(depth).map(round);
            apply(inverse(), std::array::from_fn(|i| t[i] - SHIFT[i]))
        };
        let naive = |depth: f64| {
            let b = moments(depth);
            [0, 1, 2, 3].map(|i| if i % 2 == 0 { 2.0 * round(0.5 + 0.5 * b[i]) - 1.0 } else { round(b[i]) })
        };
        // Of one caster at every depth, and of pairs: whether rounded moments, with the bias, are still
        // moments of anything (H is positive definite).
        let lost = |store: &dyn Fn(f64) -> [f64; 4]| {
            let lone = (0..=1000).map(|i| [f64::from(i) / 1000.0; 2]);
            let pairs = trials().into_iter().map(|(_, z)| [z[0], z[1]]);
            let mean = |z: [f64; 2]| {
                let [a, b] = z.map(store);
                std::array::from_fn(|i| 0.5 * (a[i] + b[i]))
            };
            let definite = |b: [f64; 4]| {
                let pivot = b[1] - b[0] * b[0];
                pivot > 0.0 && (b[3] - b[1] * b[1]) * pivot > (b[2] - b[0] * b[1]).powi(2)
            };
            lone.chain(pairs).filter(|z| !definite(biased(mean(*z), 6e-5))).count()
        };
        assert_eq!(lost(&transformed), 0);
        assert!(lost(&naive) > 5, "{}", lost(&naive));
    }

    #[test]
    fn the_bias_has_the_largest_least_eigenvalue() {
        // Odd moments are zero by symmetry, E z⁴ is largest as E z² = m: the mass m is at ±1.
        let least = |m: f64| (0.5 * (1.0 + m) - (0.25 * (1.0 - m).powi(2) + m * m).sqrt()).min(m);
        assert!((least(0.4) - 0.2).abs() < 1e-12);
        assert!((0..=1000).all(|i| least(f64::from(i) / 1000.0) <= 0.2 + 1e-12));
    }
}
