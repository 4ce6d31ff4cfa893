//! Convolution shadow maps: expand the shadow test into a Fourier series and filter its basis.
//!
//! The step f(d, z) becomes ½ + Σ 2/c_k · sin(c_k (z − d)), c_k = π(2k − 1), k = 1..M, which
//! separates into functions of d and of z; the 2M functions of z are stored in 8 bits and filtered.
//! The series ramps where the step jumps: surfaces near their caster come out too bright, more so
//! with few terms; an offset of d (or a scale) brings lit surfaces from one half to one.
//!
//! Annen, Mertens, Bekaert, Seidel, Kautz 2007, "Convolution shadow maps". Eq. 11 there has the
//! sign of d − z reversed; this is Eq. 13 and 14.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Values},
    parameter::{Field, Parameter, choice},
};
use std::f64::consts::PI;

choice! {
    /// How lit surfaces are lifted from one half to one [section 3.2.2].
    Lift {
        /// Subtract [`Csm::offset`] from the receiver's depth; keeps the convolution.
        Offset = "offset",
        /// Multiply the result by two; steeper, brings aliasing back.
        Scale = "scale",
        /// Both.
        Both = "both",
        /// Neither: lit surfaces come out half lit. For figures.
        None = "none",
    }
}

choice! {
    /// What coefficients are stored in.
    Storage {
        /// 8 bits, as in the paper.
        Unorm8 = "unorm8",
        /// 16-bit floats: twice the memory, to see that 8 bits suffice.
        Float16 = "float16",
        /// 32-bit floats: four times the memory.
        Float32 = "float32",
    }
}

/// Convolution shadow maps. ⌈M/2⌉ filtered lookups; 4·⌈M/2⌉ bytes per texel.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Csm {
    /// Terms of the series, M, 1 to 32; the paper has up to 16.
    pub terms: u32,
    /// What coefficients are stored in.
    pub storage: Storage,
    /// Attenuation α: term k is weighted by exp(−α (k/M)²) against ringing.
    pub attenuation: f32,
    /// How lit surfaces are lifted.
    pub lift: Lift,
    /// Offset in depth ranges; 0 for the half width of the attenuated series' ramp.
    pub offset: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Csm {
    fn default() -> Self {
        Self {
            terms: 16,
            storage: Storage::Unorm8,
            attenuation: 1.0,
            lift: Lift::Offset,
            offset: 0.0,
            filter: Filter::default(),
        }
    }
}

impl Csm {
    fn layers(&self) -> u32 {
        self.terms.div_ceil(2)
    }

    fn values(&self) -> Values {
        use wgpu::TextureFormat as F;
        let (format, bits) = match self.storage {
            Storage::Unorm8 => (F::Rgba8Unorm, 8),
            Storage::Float16 => (F::Rgba16Float, 11),
            Storage::Float32 => (F::Rgba32Float, 24),
        };
        // Coefficients from −1 to 1 are stored from 0 to 1.
        let values = Values::new("basis", format, Encode::Texel("csm_encode"));
        Values { layers: self.layers(), bits, zero_level: 0.5, ..values }
    }

    /// Largest error of a stored coefficient, which lies in \[−1,1].
    fn rounding(&self) -> f64 {
        match self.storage {
            Storage::Unorm8 => 1.0 / 255.0,
            Storage::Float16 => 2f64.powi(-10),
            Storage::Float32 => 2f64.powi(-20),
        }
    }

    /// exp(−α (k/M)²), k = 1..M.
    fn attenuations(&self) -> impl Iterator<Item = f64> {
        let (m, alpha) = (f64::from(self.terms), f64::from(self.attenuation));
        (1..=self.terms).map(move |k| (-alpha * (f64::from(k) / m).powi(2)).exp())
    }

    /// Half the width of the series' ramp, in depth ranges: the smallest t > 0 at which
    /// ½ + Σ 2/c_k · attenuation_k · sin(c_k t) stops rising. 1/(2M) without attenuation.
    #[must_use]
    pub fn ramp(&self) -> f32 {
        let slope = |t: f64| -> f64 {
            self.attenuations().enumerate().map(|(k, a)| a * (PI * (2.0 * k as f64 + 1.0) * t).cos()).sum()
        };
        let step = 1.0 / (64.0 * f64::from(self.terms));
        let mut low = 0.0;
        while low < 0.5 && slope(low + step) > 0.0 {
            low += step;
        }
        let mut high = (low + step).min(0.5);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if slope(middle) > 0.0 { low = middle } else { high = middle }
        }
        high as f32
    }
}

impl Csm {
    /// Factor on all depths, at least one half. The square wave behind the series has period 2 and
    /// steps back at z − d = ±1, with the same ramp: without room for it (and for the offset) a
    /// receiver near the light would be dark in front of an empty texel. The paper, whose depth
    /// range is not fitted this tightly, has no such factor.
    #[must_use]
    pub fn span(&self) -> f32 {
        (1.0 - self.ramp() - self.ramp().max(self.lift_offset())).max(0.5)
    }

    /// What is taken off the receiver's depth.
    fn lift_offset(&self) -> f32 {
        match self.lift {
            Lift::Offset | Lift::Both if self.offset > 0.0 => self.offset,
            Lift::Offset | Lift::Both => self.ramp(),
            Lift::Scale | Lift::None => 0.0,
        }
    }

    /// Factor of the sum of the series.
    fn scale(&self) -> f32 {
        if matches!(self.lift, Lift::Scale | Lift::Both) { 2.0 } else { 1.0 }
    }

    /// Overshoot of the series beyond its ramps, and the rounding of every term.
    fn ringing(&self) -> f32 {
        // With very few terms the ramps meet, and the farthest lit receivers are on the second one.
        let start = f64::from(self.ramp());
        let end = (1.0 - start).max(f64::from(self.span() + self.lift_offset()));
        let overshoot = (0..=1024)
            .map(|i| start + (end - start) * f64::from(i) / 1024.0)
            .map(|t| (reference::series(self, 0.0, t) - 1.0).abs())
            .fold(0.0, f64::max);
        let quantisation: f64 = (1..=self.terms)
            .zip(self.attenuations())
            .map(|(k, a)| 2.0 * a / (PI * (2.0 * f64::from(k) - 1.0)) * self.rounding() * std::f64::consts::SQRT_2)
            .sum();
        ((overshoot + quantisation) * f64::from(self.scale())) as f32
    }
}

impl Technique for Csm {
    fn about(&self) -> About {
        About {
            name: "csm",
            title: "Convolution shadow map",
            family: Family::Basis,
            paper: "Annen et al. 2007",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let own = vec![
            Parameter::new("terms", "", Field::Count(&mut self.terms, 1..=32), "terms of the Fourier series, M"),
            Parameter::new("storage", "", Field::Choice(&mut self.storage), "what coefficients are stored in"),
            Parameter::new(
                "attenuation",
                "",
                Field::Number(&mut self.attenuation, 0.0..=10.0),
                "α of exp(−α (k/M)²): less ringing, wider ramp",
            ),
            Parameter::new("lift", "", Field::Choice(&mut self.lift), "how lit surfaces are lifted from one half to one"),
            Parameter::new(
                "offset",
                "depth range",
                Field::Number(&mut self.offset, 0.0..=0.5),
                "taken off the receiver's depth; 0 is the half width of the ramp",
            ),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = include_str!("csm.wgsl");
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, self.values(), device);
        let mut weights: Vec<f32> = self
            .attenuations()
            .enumerate()
            .map(|(k, a)| (2.0 * a / (PI * (2.0 * k as f64 + 1.0))) as f32)
            .collect();
        weights.resize(2 * self.layers() as usize, 0.0);
        described
            .constants
            .extend([Constant::Count("csm_terms", self.terms), Constant::Array("csm_weights", weights)]);
        described.uniforms =
            vec![("span", self.span()), ("offset", self.lift_offset()), ("scale", self.scale())];
        described.ringing = self.ringing();
        // Lifted by its own half ramp, the series is at one end of the ramp where both depths are equal.
        described.ramp = 2.0 * self.lift_offset() / self.span();
        described.fetches *= self.layers();
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &["terms=4", "terms=1,lift=both", "storage=float16", "storage=float32"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    use super::{Csm, PI};

    /// (sin c_k z, cos c_k z).
    #[must_use]
    pub fn basis(k: u32, z: f64) -> [f64; 2] {
        let angle = PI * (2.0 * f64::from(k) - 1.0) * z;
        [angle.sin(), angle.cos()]
    }
    /// Eq. 13 with attenuation, unclamped, for one unfiltered caster depth.
    #[must_use]
    pub fn series(csm: &Csm, d: f64, z: f64) -> f64 {
        let sum: f64 = std::iter::zip(1..=csm.terms, csm.attenuations())
            .map(|(k, a)| {
                let [[sd, cd], [sz, cz]] = [basis(k, d), basis(k, z)];
                2.0 * a / (PI * (2.0 * f64::from(k) - 1.0)) * (cd * sz - sd * cz)
            })
            .sum();
        0.5 + sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_is_half_a_period_of_the_highest_term_without_attenuation() {
        for terms in 1..=16 {
            let csm = Csm { terms, attenuation: 0.0, ..Csm::default() };
            assert!((csm.ramp() - 1.0 / (2.0 * terms as f32)).abs() < 1e-5, "{terms}: {}", csm.ramp());
            let softer = Csm { attenuation: 2.0, ..csm };
            assert!(softer.ramp() >= csm.ramp());
        }
    }

    #[test]
    fn the_series_is_one_in_front_and_zero_behind_with_the_right_sign() {
        let csm = Csm::default();
        assert!((reference::series(&csm, 0.3, 0.7) - 1.0).abs() < 0.05);
        assert!(reference::series(&csm, 0.7, 0.3).abs() < 0.05);
        assert!((reference::series(&csm, 0.4, 0.4) - 0.5).abs() < 1e-9);
        // With the offset a surface that is its own caster is lit.
        assert!(reference::series(&csm, 0.4 - f64::from(csm.ramp()), 0.4) > 0.97);
    }
}
