//! Layered variance shadow maps: moments of depth, interval by interval.
//!
//! The depth range is cut into intervals that overlap a little; for each, depth is stretched to
//! \[0,1], clamped, and two moments are kept. Casters in front of an interval all become 0 in it, so
//! their distances no longer feed the variance that a receiver in the interval sees: light bleeds
//! only where the depths of casters differ within the interval of the receiver.
//!
//! Clamped or not, a warp never swaps two depths, so every interval's Chebyshev bound holds at any
//! receiver. The paper reads the interval that contains the receiver; here the answer is the least
//! of all bounds up to that interval: at least as dark, with no seam where intervals meet (there one
//! bound may be brighter than the next), and never brighter with depth, for ⌈L/2⌉ lookups instead of
//! one. A receiver beyond an interval takes its bound at the interval's end, since light at a depth
//! is no more than light in front of it. The overlap lies beyond that end: without it the casters of
//! a lit slope would be clamped on their far side only, and the slope be darkened along the border.
//!
//! Lauritzen & McCool 2008, "Layered variance shadow maps", section 4.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    bound,
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Values},
    parameter::{Field, Parameter, choice},
};

choice! {
    /// Which intervals bound the lit share.
    Choose {
        /// The least bound of the receiver's interval and of all in front of it.
        Least = "least",
        /// The receiver's interval alone: one lookup, as published. Casters in front of the interval are
        /// clamped to its start, which still shadows.
        Receiver = "receiver",
        /// The same, blended with the interval before across the overlap: no seams.
        Blend = "blend",
    }
}

/// Layered variance shadow maps. ⌈L/2⌉ filtered lookups at most; 16·⌈L/2⌉ bytes per texel (four
/// 32-bit floats for two intervals).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lvsm {
    /// Intervals of the depth range, L, 2 to 8.
    pub intervals: u32,
    /// How far an interval reaches beyond its ends, as a share of its length, 0 to 1.
    pub overlap: f32,
    /// Least variance, in squares of the depth range.
    pub least_variance: f32,
    /// Factor of the slope term: the least variance gains ¼(z_x² + z_y²), the variance of the
    /// receiver's plane within a texel, which keeps slopes lit without bias.
    pub slope: f32,
    /// Light-bleeding reduction, 0 to 0.99; 0 is none.
    pub reduction: f32,
    /// Which intervals bound the lit share.
    pub choose: Choose,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Lvsm {
    fn default() -> Self {
        Self {
            intervals: 4,
            overlap: 0.1,
            least_variance: 1e-6,
            slope: 1.0,
            reduction: 0.0,
            choose: Choose::Least,
            filter: Filter::default(),
        }
    }
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

impl Lvsm {
    fn values(&self) -> Values {
        let values = Values::new("moments", FORMAT, Encode::Texel("lvsm_encode"));
        Values { layers: self.intervals.div_ceil(2), ..values }
    }

    /// With one interval alone: what the least variance lets through at its start, where a caster is
    /// clamped to the overlap's beginning.
    fn leak(&self) -> f32 {
        let apart = self.overlap / self.intervals as f32;
        let bound = self.least_variance / (self.least_variance + apart * apart).max(1e-12);
        match self.choose {
            Choose::Least => 0.0,
            Choose::Receiver | Choose::Blend => (bound - self.reduction).max(0.0) / (1.0 - self.reduction),
        }
    }
}

impl Technique for Lvsm {
    fn about(&self) -> About {
        About {
            name: "lvsm",
            title: "Layered variance shadow map",
            family: Family::Basis,
            paper: "Lauritzen & McCool 2008",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let own = vec![
            Parameter::new(
                "intervals",
                "",
                Field::Count(&mut self.intervals, 2..=8),
                "parts of the depth range, L; two per lookup",
            ),
            Parameter::new(
                "overlap",
                "interval",
                Field::Number(&mut self.overlap, 0.0..=1.0),
                "how far an interval reaches beyond its ends",
            ),
            bound::least_variance(&mut self.least_variance),
            bound::slope(&mut self.slope),
            Parameter::new("choose", "", Field::Choice(&mut self.choose), "which intervals bound the lit share"),
            bound::reduction(&mut self.reduction),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = match self.choose {
            Choose::Least => concat!(include_str!("lvsm.wgsl"), include_str!("lvsm/least.wgsl")),
            Choose::Receiver => {
                concat!(include_str!("lvsm.wgsl"), include_str!("lvsm/pick.wgsl"), include_str!("lvsm/receiver.wgsl"))
            }
            Choose::Blend => {
                concat!(include_str!("lvsm.wgsl"), include_str!("lvsm/pick.wgsl"), include_str!("lvsm/blend.wgsl"))
            }
        };
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, self.values(), device);
        described.constants.push(Constant::Count("lvsm_intervals", self.intervals));
        described.uniforms = vec![
            ("overlap", self.overlap),
            ("least_variance", self.least_variance),
            ("slope", self.slope),
            ("reduction", self.reduction),
        ];
        // Moments are rounded by 6e-8, which a variance near its floor of 1e-6 magnifies.
        described.rounding = 1e-3;
        described.ringing = self.leak();
        // Another interval may have a brighter bound.
        described.monotonic = self.choose == Choose::Least;
        // Those of a pixel in the last interval.
        described.fetches *= match self.choose {
            Choose::Least => self.intervals.div_ceil(2),
            Choose::Receiver => 1,
            Choose::Blend => 2,
        };
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &["intervals=7,overlap=0", "choose=receiver", "choose=blend"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    use super::Lvsm;

    /// Both ends of interval i, overlaps included.
    #[must_use]
    pub fn ends(lvsm: &Lvsm, i: u32) -> [f64; 2] {
        let (count, overlap) = (f64::from(lvsm.intervals), f64::from(lvsm.overlap));
        [(f64::from(i) - overlap) / count, (f64::from(i) + 1.0 + overlap) / count]
    }
    /// Depth within interval i, clamped to \[0,1].
    #[must_use]
    pub fn warp(lvsm: &Lvsm, depth: f64, i: u32) -> f64 {
        let [low, high] = ends(lvsm, i);
        ((depth - low) / (high - low)).clamp(0.0, 1.0)
    }
    /// Chebyshev bound of interval i at a linear depth.
    #[must_use]
    pub fn bound(lvsm: &Lvsm, depth: f64, moments: [f64; 2], i: u32) -> f64 {
        let [low, high] = ends(lvsm, i);
        let least = f64::from(lvsm.least_variance) / (high - low).powi(2);
        let variance = (moments[1] - moments[0] * moments[0]).max(least);
        let end = f64::from(i + 1) / f64::from(lvsm.intervals);
        let behind = (warp(lvsm, depth.min(end), i) - moments[0]).max(0.0);
        if behind == 0.0 { 1.0 } else { variance / (variance + behind * behind) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn intervals_cover_the_range_and_overlap() {
        for intervals in 2..=8 {
            let lvsm = Lvsm { intervals, ..Lvsm::default() };
            assert!(reference::ends(&lvsm, 0)[0] <= 0.0 && reference::ends(&lvsm, intervals - 1)[1] >= 1.0);
            for i in 1..intervals {
                let (before, after) = (reference::ends(&lvsm, i - 1), reference::ends(&lvsm, i));
                let expected = 2.0 * f64::from(lvsm.overlap) / f64::from(intervals);
                assert!((before[1] - after[0] - expected).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn casters_in_front_of_an_interval_do_not_bleed_into_it() {
        // Half of the kernel at each of two depths, receiver behind both.
        let bleeding = |near: f64, far: f64, depth: f64| {
            let lvsm = Lvsm::default();
            let bound = |i| {
                let [a, b] = [near, far].map(|z| reference::warp(&lvsm, z, i));
                reference::bound(&lvsm, depth, [0.5 * (a + b), 0.5 * (a * a + b * b)], i)
            };
            (0..lvsm.intervals).map(bound).fold(1.0, f64::min)
        };
        assert!(bleeding(0.1, 0.6, 0.9) < 1e-3);
        assert!(bleeding(0.55, 0.66, 0.68) > 0.3, "within one interval they do");
    }
}
