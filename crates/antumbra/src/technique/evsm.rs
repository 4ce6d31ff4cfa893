//! Exponential variance shadow maps: moments of two exponential warps of depth.
//!
//! Chebyshev's bound holds for any rising function of depth. e^(c₊ z') spreads the casters near the
//! receiver and squeezes those far in front of it together, −e^(−c₋ z') does the reverse; the lesser
//! of both bounds bleeds only where casters lie close to the receiver and to each other on both
//! scales. What is left are bright contacts: casters within 1/(2c) of the depth range of their
//! receiver are half lit.
//!
//! # Range and precision
//! z' = 2z − 1 rather than z: on \[−1,1] the squares run from e^(−2c) to e^(2c), so that a format
//! whose exponents reach as far down as up is used at both ends, and a limit c on the exponent gives
//! a steepness of 2c per depth range; on \[0,1] the same format holds half of that. A warp's rounding
//! is relative, so the shift costs no precision. The square must stay finite:
//! c < ½ ln(largest number), 44.3 for 32 bits and 5.545 for 16. Below, e^(−2c) must not be flushed
//! to zero: c < 43.6 for 32 bits; 42 leaves room for the rounding of exp. Sixteen bits have denormal
//! squares near z' = ±1, which [`Evsm::rounding`] takes into account.
//!
//! Lauritzen & McCool 2008, "Layered variance shadow maps", section 5.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    bound,
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Sampling, Values},
    parameter::{Field, Parameter, choice},
};

choice! {
    /// How many moments are kept.
    Moments {
        /// Those of the positive warp: half the memory, bleeds around casters just above receivers.
        Two = "two",
        /// Those of both warps.
        Four = "four",
    }
}

choice! {
    /// What moments are stored in.
    Format {
        /// 32-bit floats.
        Float32 = "float32",
        /// 16-bit floats: half the memory, and exponents up to 5.54.
        Float16 = "float16",
    }
}

impl Format {
    /// Largest exponent whose moments this format holds at every depth.
    #[must_use]
    pub fn limit(self) -> f32 {
        match self {
            Self::Float32 => 42.0,
            Self::Float16 => 5.54,
        }
    }

    /// Relative error of storing a normal number, and absolute error of storing a denormal one. 32
    /// bits are rounded to nearest by arithmetic, 16 by the store, which may truncate.
    fn roundings(self) -> [f32; 2] {
        match self {
            Self::Float32 => [2f32.powi(-24), 0.0],
            Self::Float16 => [2f32.powi(-10), 2f32.powi(-24)],
        }
    }
}

/// Exponential variance shadow maps. 1 filtered lookup; 16 bytes per texel (four 32-bit floats), 8
/// with two moments or 16-bit floats, 4 with both.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Evsm {
    /// Exponent c₊ per half depth range, up to [`Format::limit`]; 0 for 40, or 5.5 with 16 bits.
    pub positive: f32,
    /// Exponent c₋ per half depth range, likewise; 0 for 5. Steeper ones darken lit slopes: the mean of
    /// a concave warp over a slope is below the warp of its middle.
    pub negative: f32,
    /// Moments of one warp or of both.
    pub moments: Moments,
    /// Storage.
    pub format: Format,
    /// Least variance, in squares of the (unwarped) depth range.
    pub least_variance: f32,
    /// Factor of the slope term: the least variance gains ¼(z_x² + z_y²), the variance of the
    /// receiver's plane within a texel, which keeps slopes lit without bias.
    pub slope: f32,
    /// Light-bleeding reduction, 0 to 0.99; 0 is none.
    pub reduction: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Evsm {
    fn default() -> Self {
        Self {
            positive: 0.0,
            negative: 0.0,
            moments: Moments::Four,
            format: Format::Float32,
            least_variance: 1e-6,
            slope: 1.0,
            reduction: 0.0,
            filter: Filter::default(),
        }
    }
}

impl Evsm {
    /// Largest exponent: that of the format, or in a summed-area table 6.9, whose squares, from e^(−2c)
    /// to e^(2c), leave 8 of 48 bits.
    #[must_use]
    pub fn limit(&self) -> f32 {
        match self.filter.sampling {
            Sampling::Summed => 6.9,
            _ => self.format.limit(),
        }
    }

    /// The exponents in use: c₊, c₋.
    #[must_use]
    pub fn exponents(&self) -> [f32; 2] {
        let usual = match (self.filter.sampling, self.format) {
            (Sampling::Summed, _) => [6.9, 5.0],
            (_, Format::Float32) => [40.0, 5.0],
            (_, Format::Float16) => [5.5, 5.0],
        };
        let or = |c: f32, usual| if c > 0.0 { c } else { usual };
        [or(self.positive, usual[0]), or(self.negative, usual[1])]
    }

    /// Relative and absolute error that storage leaves in a variance: that of the stored square and
    /// twice that of the stored mean. Encoding, both directions of the blur and mips err
    /// independently: four errors add up to two. Without it, a square that was rounded down would be
    /// taken for no variance at all, and lit surfaces for shadowed ones.
    #[must_use]
    pub fn rounding(&self) -> [f32; 2] {
        let [relative, absolute] = self.format.roundings();
        [2.0 * 3.0 * relative, 2.0 * absolute]
    }

    fn values(&self) -> Values {
        let [p, n] = self.exponents();
        let positive = [[0.0, p.exp()], [0.0, (2.0 * p).exp()]];
        let negative = [[0.0, -n.exp()], [0.0, (2.0 * n).exp()]];
        let ranges = match self.moments {
            Moments::Two => positive.to_vec(),
            Moments::Four => [positive, negative].concat(),
        };
        let values = Values::new("moments", self.texels(), Encode::Texel("evsm_encode"));
        Values { ranges, bits: 48, ..values }
    }

    fn texels(&self) -> wgpu::TextureFormat {
        use wgpu::TextureFormat as F;
        match (self.moments, self.format) {
            (Moments::Two, Format::Float32) => F::Rg32Float,
            (Moments::Four, Format::Float32) => F::Rgba32Float,
            (Moments::Two, Format::Float16) => F::Rg16Float,
            (Moments::Four, Format::Float16) => F::Rgba16Float,
        }
    }
}

impl Technique for Evsm {
    fn about(&self) -> About {
        About {
            name: "evsm",
            title: "Exponential variance shadow map",
            family: Family::Basis,
            paper: "Lauritzen & McCool 2008",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let limit = self.limit();
        let own = vec![
            Parameter::new(
                "positive",
                "1/half depth range",
                Field::Number(&mut self.positive, 0.0..=limit),
                "exponent of e^(c z'); 0 is 40, or 5.5 with format=float16, 6.9 with sampling=summed",
            ),
            Parameter::new(
                "negative",
                "1/half depth range",
                Field::Number(&mut self.negative, 0.0..=limit),
                "exponent of −e^(−c z'); 0 is 5, more darkens steep slopes; only with moments=four",
            ),
            Parameter::new("moments", "", Field::Choice(&mut self.moments), "two per warp: the positive one, or both"),
            Parameter::new(
                "format",
                "",
                Field::Choice(&mut self.format),
                "storage; exponents are at most 42 in float32, 5.54 in float16",
            ),
            bound::least_variance(&mut self.least_variance),
            bound::slope(&mut self.slope),
            bound::reduction(&mut self.reduction),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = include_str!("evsm.wgsl");
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, self.values(), device);
        let warps = match self.moments {
            Moments::Two => 1,
            Moments::Four => 2,
        };
        described.constants.push(Constant::Count("evsm_warps", warps));
        let ([positive, negative], [rounding, denormal]) = (self.exponents(), self.rounding());
        described.uniforms = vec![
            ("positive", positive),
            ("negative", negative),
            ("least_variance", self.least_variance),
            ("rounding", rounding),
            ("denormal", denormal),
            ("slope", self.slope),
            ("reduction", self.reduction),
        ];
        // Moments are rounded by 6e-8, which a variance near its floor of 1e-6 magnifies.
        described.rounding = 1e-3;
        // What the least variance lets through a tenth of the depth range behind a blocker.
        let least = (4.0 * positive * positive * self.least_variance).max(rounding);
        let behind = (0.2 * positive).exp() - 1.0;
        let bound = least / (least + behind * behind);
        described.ringing = (bound - self.reduction).max(0.0) / (1.0 - self.reduction);
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &["moments=two", "format=float16"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    use super::Evsm;

    /// e^(c₊ z') and −e^(−c₋ z') of a linear depth.
    #[must_use]
    pub fn warp(depth: f64, exponents: [f64; 2]) -> [f64; 2] {
        let z = 2.0 * depth - 1.0;
        [(exponents[0] * z).exp(), -(-exponents[1] * z).exp()]
    }
    /// Mean and mean square of each warp, of one depth.
    #[must_use]
    pub fn encode(depth: f64, exponents: [f64; 2]) -> [f64; 4] {
        let [p, n] = warp(depth, exponents);
        [p, p * p, n, n * n]
    }
    /// Chebyshev bound of each warp, before the light-bleeding reduction.
    #[must_use]
    pub fn bounds(evsm: &Evsm, depth: f64, moments: [f64; 4]) -> [f64; 2] {
        let c = evsm.exponents().map(f64::from);
        let w = warp(depth, c);
        std::array::from_fn(|i| {
            let (mean, square) = (moments[2 * i], moments[2 * i + 1]);
            // dw/dz = 2 c |w|.
            let flat = w[i].abs().min(mean.abs());
            let slope = 2.0 * c[i] * flat;
            let [relative, absolute] = evsm.rounding().map(f64::from);
            let least = (f64::from(evsm.least_variance) * slope * slope).max(relative * flat * flat) + absolute;
            let variance = (square - mean * mean).max(least);
            let behind = (w[i] - mean).max(0.0);
            if behind == 0.0 { 1.0 } else { variance / (variance + behind * behind) }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A 16-bit float's value.
    fn from_half(bits: u16) -> f64 {
        let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
        let size = match exponent {
            0 => fraction * 2f64.powi(-14),
            31 if fraction == 0.0 => f64::INFINITY,
            31 => f64::NAN,
            _ => (1.0 + fraction) * 2f64.powi(exponent - 15),
        };
        if bits >> 15 == 1 { -size } else { size }
    }

    /// The nearest 16-bit float, ties to even, as a number.
    fn half(value: f64) -> f64 {
        let size = value.abs();
        let step = 2f64.powi((size.log2().floor() as i32).clamp(-14, 15) - 10);
        let rounded = (size / step).round_ties_even() * step;
        (if rounded > 65504.0 { f64::INFINITY } else { rounded }).copysign(value)
    }

    /// All that lie between zero and one.
    fn half_depths() -> impl Iterator<Item = f64> {
        (0..=0x3c00).map(from_half)
    }

    #[test]
    fn halves_are_converted() {
        for bits in 0..=u16::MAX {
            let value = from_half(bits);
            assert!(half(value) == value || value.is_nan(), "{bits:#x}: {value} becomes {}", half(value));
        }
        assert_eq!([half(65519.0), half(65520.0), half(1.0 + 2f64.powi(-11))], [65504.0, f64::INFINITY, 1.0]);
        assert_eq!([half(2f64.powi(-25)), half(1.5 * 2f64.powi(-25))], [0.0, 2f64.powi(-24)]);
    }

    /// Whether both moments of both warps survive storage over the whole depth range.
    fn holds(c: f64, mut store: impl FnMut(f64) -> f64) -> bool {
        half_depths().all(|depth| {
            let stored = reference::encode(depth, [c; 2]).map(&mut store);
            stored.iter().all(|m| m.is_finite() && *m != 0.0)
        })
    }

    #[test]
    fn the_largest_exponents_keep_all_moments_finite_and_nonzero() {
        let normal = |m: f64| if (m as f32).is_normal() { f64::from(m as f32) } else { f64::NAN };
        assert!(holds(f64::from(Format::Float32.limit()), normal));
        assert!(!holds(43.7, normal), "e^(−2c) is denormal, which GPUs flush to zero");
        assert!(holds(f64::from(Format::Float16.limit()), half));
        assert!(!holds(5.55, half), "e^(2c) overflows");
    }

    #[test]
    fn half_moments_leave_no_more_variance_than_the_floor() {
        let evsm = Evsm { format: Format::Float16, positive: 5.54, negative: 5.54, ..Evsm::default() };
        let [relative, absolute] = evsm.rounding().map(f64::from);
        let exceeds = |relative: f64, absolute: f64| {
            half_depths().any(|depth| {
                let m = reference::encode(depth, [5.54; 2]).map(half);
                let noise = |i: usize| (m[i + 1] - m[i] * m[i]).abs() - relative * m[i] * m[i];
                noise(0).max(noise(2)) > absolute
            })
        };
        assert!(!exceeds(relative, absolute));
        assert!(exceeds(0.1 * relative, absolute));
        assert!(exceeds(0.25 * relative, 0.0));
    }

    #[test]
    fn exponents_above_the_format_are_refused() {
        let refused = |spec: &str| {
            let technique = crate::technique::parse(spec);
            technique.and_then(|t| crate::technique::check(t.as_ref()))
        };
        refused("evsm.format=float16").unwrap();
        refused("evsm.positive=42,negative=42").unwrap();
        refused("evsm.format=float16,positive=5.54,negative=5.54").unwrap();
        // Before or after the format: either way it is told.
        for spec in ["evsm.positive=40,format=float16", "evsm.format=float16,positive=40"] {
            let message = refused(spec).unwrap_err().to_string();
            assert_eq!(message, "evsm.positive = 40 is out of range; allowed: 0 to 5.54");
        }
        assert!(refused("evsm.negative=42.1").is_err());
    }
}
