//! Convolution shadow maps: expand the shadow test into a Fourier series and filter its basis.
//!
//! The step f(d, z) becomes ½ + Σ 2/c_k · sin(c_k (z − d)), c_k = π(2k − 1), k = 1..M, which
//! separates into functions of d and of z; the 2M functions of z are stored in 8 bits and filtered.
//! The series ramps where the step jumps: surfaces near their caster come out too bright, more so
//! with few terms; an offset of d (or a scale) brings lit surfaces from one half to one. What the truncated series falls
//! short of, or exceeds, in the middle between two steps is divided out, so that light is one and shadow is zero with any
//! number of terms.
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
    /// Attenuation α: term k is weighted by exp(−α (k/M)²) against ringing; below 0 for the one that suits M
    /// ([`alpha`](Csm::alpha)).
    pub attenuation: f32,
    /// How lit surfaces are lifted.
    pub lift: Lift,
    /// Offset in depth ranges; 0 for the [ramp](Csm::ramp) of the series.
    pub offset: f32,
    /// By how much of the depth range a receiver may lie in front of what is stored, above 0. The series steps back
    /// before 1: depths are shrunk so far that no such receiver reaches that step, and not at all where none would.
    pub reach: f32,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Csm {
    fn default() -> Self {
        Self {
            terms: 16,
            storage: Storage::Unorm8,
            attenuation: -1.0,
            lift: Lift::Offset,
            offset: 0.0,
            reach: 1.0,
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

    /// The attenuation α in use. What suits M is ½ (M/16)², at most ½: few terms have no steepness to spare, many ring.
    #[must_use]
    pub fn alpha(&self) -> f32 {
        if self.attenuation >= 0.0 { self.attenuation } else { 0.5 * (self.terms as f32 / 16.0).powi(2).min(1.0) }
    }

    /// exp(−α (k/M)²), k = 1..M.
    fn attenuations(&self) -> impl Iterator<Item = f64> {
        let (m, alpha) = (f64::from(self.terms), f64::from(self.alpha()));
        (1..=self.terms).map(move |k| (-alpha * (f64::from(k) / m).powi(2)).exp())
    }

    /// 2/c_k · attenuation_k, k = 1..M, times what brings the series to 1 at z − d = ½, in the middle between two steps.
    fn weights(&self) -> impl Iterator<Item = f64> {
        let weight = |(k, a): (u32, f64)| 2.0 * a / (PI * (2.0 * f64::from(k) - 1.0));
        let plain = move || (1..=self.terms).zip(self.attenuations()).map(weight);
        // Sines at half a turn and its odd multiples.
        let middle: f64 = plain().enumerate().map(|(k, w)| if k % 2 == 0 { w } else { -w }).sum();
        plain().map(move |w| 0.5 * w / middle)
    }

    /// Width of the series' ramp on the lit side, in depth ranges: the least z − d at which it comes within 1/255 of 1.
    #[must_use]
    pub fn ramp(&self) -> f32 {
        let weights: Vec<f64> = self.weights().collect();
        let short = |t: f64| reference::sum(&weights, t) < 0.5 - 1.0 / 255.0;
        let step = 1.0 / (256.0 * f64::from(self.terms));
        let mut low = 0.0;
        while low < 0.5 && short(low + step) {
            low += step;
        }
        let mut high = (low + step).min(0.5);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if short(middle) { low = middle } else { high = middle }
        }
        high as f32
    }
}

impl Csm {
    /// Factor on all depths, from one half to 1. The square wave behind the series has period 2 and
    /// steps back at z − d = ±1, with the same ramp: a receiver near the light would be dark in front of an empty texel
    /// that is farther away than the ramp, and the offset, leave of the period.
    #[must_use]
    pub fn span(&self) -> f32 {
        ((1.0 - self.ramp() - self.ramp().max(self.lift_offset())) / self.reach).clamp(0.5, 1.0)
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
        let quantisation: f64 =
            self.weights().map(|w| w.abs() * self.rounding() * std::f64::consts::SQRT_2).sum();
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
                Field::Number(&mut self.attenuation, -1.0..=10.0),
                "α of exp(−α (k/M)²): less ringing, wider ramp; below 0 is ½ (M/16)², at most ½",
            ),
            Parameter::new("lift", "", Field::Choice(&mut self.lift), "how lit surfaces are lifted from one half to one"),
            Parameter::new(
                "offset",
                "depth range",
                Field::Number(&mut self.offset, 0.0..=0.5),
                "taken off the receiver's depth; 0 is the width of the ramp on the lit side",
            ),
            Parameter::new(
                "reach",
                "depth range",
                Field::Number(&mut self.reach, 0.01..=1.0),
                "how far receivers may lie in front of what is stored without reaching the series' next step",
            ),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = include_str!("csm.wgsl");
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, self.values(), device);
        let mut weights: Vec<f32> = self.weights().map(|w| w as f32).collect();
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
        [&Filter::VARIANTS[..], &["terms=4", "terms=3,lift=both", "storage=float16", "storage=float32"]].concat()
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
    /// Σ w_k · sin(c_k t): what the series is above one half at z − d = t.
    #[must_use]
    pub fn sum(weights: &[f64], t: f64) -> f64 {
        weights.iter().zip(1..).map(|(w, k)| w * basis(k, t)[0]).sum()
    }
    /// Eq. 13 with attenuation and the middle divided out, unclamped, for one unfiltered caster depth.
    #[must_use]
    pub fn series(csm: &Csm, d: f64, z: f64) -> f64 {
        let sum: f64 = std::iter::zip(1..=csm.terms, csm.weights())
            .map(|(k, w)| {
                let [[sd, cd], [sz, cz]] = [basis(k, d), basis(k, z)];
                w * (cd * sz - sd * cz)
            })
            .sum();
        0.5 + sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ramp_ends_where_the_series_first_reaches_one() {
        for terms in [1, 2, 3, 4, 8, 16, 32] {
            for attenuation in [0.0, 0.5, 1.0, 2.0] {
                let csm = Csm { terms, attenuation, ..Csm::default() };
                let ramp = f64::from(csm.ramp());
                let before = (0..200).map(|i| reference::series(&csm, 0.0, ramp * f64::from(i) / 200.0));
                assert!(before.into_iter().all(|v| v < 1.0 - 1.0 / 255.0), "{terms} {attenuation}");
                let there = reference::series(&csm, 0.0, ramp);
                assert!((there - (1.0 - 1.0 / 255.0)).abs() < 1e-4, "{terms} {attenuation}: {there}");
                // Never wider than half a period of the highest term, where the plain series stops rising.
                let half_period = 1.0 / (2.0 * f64::from(terms));
                assert!(attenuation > 0.0 || ramp < half_period, "{terms}");
            }
        }
    }

    #[test]
    fn the_series_is_one_in_front_and_zero_behind_with_the_right_sign() {
        for terms in [1, 2, 4, 16] {
            for attenuation in [0.0, 1.0] {
                let csm = Csm { terms, attenuation, ..Csm::default() };
                assert!((reference::series(&csm, 0.2, 0.7) - 1.0).abs() < 1e-9, "{terms} {attenuation}");
                assert!(reference::series(&csm, 0.7, 0.2).abs() < 1e-9, "{terms} {attenuation}");
                assert!((reference::series(&csm, 0.4, 0.4) - 0.5).abs() < 1e-9);
                // With the offset a surface that is its own caster is lit.
                assert!(reference::series(&csm, 0.4 - f64::from(csm.ramp()), 0.4) > 0.996);
            }
        }
    }

    #[test]
    fn depths_are_shrunk_only_as_far_as_the_next_step_is_reached() {
        for terms in [1, 2, 4, 16, 32] {
            for reach in [0.3, 0.8, 0.9, 1.0] {
                let csm = Csm { terms, reach, ..Csm::default() };
                let (span, offset) = (f64::from(csm.span()), f64::from(csm.ramp()));
                assert!((0.5..=1.0).contains(&span));
                let room = 1.0 - 2.0 * offset;
                assert_eq!(span == 1.0, room >= f64::from(reach), "{terms} {reach}: {span}");
                // The farthest that is stored, in front of which the receiver lies, and the shadow farthest behind.
                if room >= 0.5 * f64::from(reach) {
                    let lit = reference::series(&csm, -offset, span * f64::from(reach));
                    assert!(lit > 0.95, "{terms} {reach}: {lit}");
                }
            }
        }
    }
}
