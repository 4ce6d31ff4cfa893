//! Exponential shadow maps: keep e^(c z), which filters linearly and needs one channel.
//!
//! A receiver is never in front of the nearest caster, so the step of the shadow test may be
//! replaced by an exponential decay behind it, and e^(−c(d−z)) separates into a factor of the
//! receiver and one of the map. Where the kernel reaches casters behind the receiver the product
//! exceeds one: too bright there, unless the pixel is found out and filtered by other means. It needs
//! no bias on tilted receivers.
//!
//! # Storage
//! e^(c z) and e^(−c d) must both be normal numbers: c up to 87 in 32-bit floats. Filtering the
//! logarithm instead, with the log of the sum of powers in place of every sum, allows 16 bits per
//! texel and any c, for more arithmetic; c then only has to leave the rounding of z invisible.
//!
//! WGSL reads c as `esm_c()`; with logarithms interpolation between texels has it as the constant `level_steepness`, and
//! blur and mips as `combine_steepness`.
//!
//! Annen, Mertens, Seidel, Flerackers, Kautz 2008, "Exponential shadow maps". Logarithms: Salvi
//! 2008, "Rendering filtered shadows with exponential shadow maps".

use super::{About, Binding, Class, Combine, Constant, Description, Encode, Family, Map, Pass, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Sampling, Values},
    parameter::{Field, Parameter, choice},
};
use wgpu::TextureFormat;

choice! {
    /// What a texel holds. Summed-area tables always hold powers, in whole numbers.
    Storage {
        /// e^(c z) in a 32-bit float.
        Powers = "powers",
        /// z in a 32-bit float, filtered logarithmically.
        Log32 = "log32",
        /// z in a 16-bit float, filtered logarithmically: half the memory; rounds z by up to 1/4096.
        LogHalf = "log_half",
        /// z in 16 bits, filtered logarithmically: half the memory; rounds z by 1/131072. Needs
        /// `TEXTURE_FORMAT_16BIT_NORM`, and takes 32-bit floats without.
        Log16 = "log16",
    }
}

choice! {
    /// How pixels are found whose kernel reaches casters behind the receiver [section 3.3].
    Classifier {
        /// Not at all: the product is clamped.
        None = "none",
        /// By a product above 1 + ε. Free; misses those whose product stays below, though a caster lies behind.
        Threshold = "threshold",
        /// By the farthest caster in the kernel, kept in a second map with greatest-value mips (and
        /// widened by the blur's kernel). Misses none that Threshold finds, and finds steep lit surfaces
        /// too; 4 more bytes per texel.
        ZMax = "zmax",
    }
}

choice! {
    /// What is done with those pixels.
    Custom {
        /// Four nearest texels, clamped one by one, then interpolated. Not with summed-area tables.
        Four = "four",
        /// Nothing: lit.
        None = "none",
    }
}

/// Exponential shadow maps. 1 filtered lookup; 4 bytes per texel (one 32-bit float), 2 with 16-bit
/// logarithms. Z-Max adds 4 bytes and 4 lookups, custom filtering 4 lookups where pixels fail.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Esm {
    /// Steepness per depth range, up to [`Esm::steepest`]; 0 for 80, or 72 in a summed-area table.
    pub c: f32,
    /// What a texel holds.
    pub storage: Storage,
    /// How failing pixels are found.
    pub classifier: Classifier,
    /// ε: by how much the product may exceed one before a pixel counts as failing.
    pub epsilon: f32,
    /// For Z-Max: how far a caster may lie behind the receiver before the pixel counts as failing, in depth ranges;
    /// 0 for what a product of 1 + ε allows, the largest offset that misses none. Larger ones spare lit slopes.
    pub offset: f32,
    /// What is done with failing pixels.
    pub custom: Custom,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Esm {
    fn default() -> Self {
        Self {
            c: 0.0,
            storage: Storage::Powers,
            classifier: Classifier::Threshold,
            epsilon: 0.1,
            offset: 0.0,
            custom: Custom::Four,
            filter: Filter::default(),
        }
    }
}

/// Bits of the powers in a summed-area table: four words, less what the sum over a box takes.
const SUMMED_BITS: u32 = 112;

impl Esm {
    /// The largest c that this storage holds: 87 where e^c and e^−c must be normal 32-bit floats; 72
    /// in a summed-area table, whose 112 bits then hold e^−c in 8 bits; 1000 for logarithms, where
    /// 16-bit z are wrong by less than one percent of the result.
    #[must_use]
    pub fn steepest(&self) -> f32 {
        match (self.filter.sampling, self.storage) {
            (Sampling::Summed, _) => 72.0,
            (_, Storage::Powers) => 87.0,
            (_, Storage::LogHalf) => 200.0,
            (_, Storage::Log32 | Storage::Log16) => 1000.0,
        }
    }

    /// The c in use.
    #[must_use]
    pub fn steepness(&self) -> f32 {
        if self.c > 0.0 { self.c } else { self.steepest().min(80.0) }
    }

    /// The offset of Z-Max in use.
    #[must_use]
    pub fn allowance(&self) -> f32 {
        if self.offset > 0.0 {
            return self.offset;
        }
        // A product may be too large by what rounds exponents and sums, and a stored depth by its own rounding.
        let stored = match self.storage {
            Storage::LogHalf if self.is_logarithmic() => 1.0 / 4096.0,
            Storage::Log16 if self.is_logarithmic() => 1.0 / 131_072.0,
            _ => 0.0,
        };
        self.epsilon.ln_1p() / self.steepness() - stored - 4e-6 / self.steepness() - 1e-6
    }

    fn is_logarithmic(&self) -> bool {
        self.storage != Storage::Powers && self.filter.sampling != Sampling::Summed
    }

    fn values(&self, device: &Capabilities) -> Values {
        use TextureFormat::{R16Float, R16Unorm, R32Float};
        let (format, note) = match self.storage {
            Storage::Powers | Storage::Log32 => (R32Float, None),
            Storage::LogHalf => (R16Float, None),
            Storage::Log16 => device.norm16("depth", R16Unorm, R32Float),
        };
        let (name, combine) = match self.is_logarithmic() {
            true => ("depth", Combine::LogMean(self.steepness())),
            false => ("exponentials", Combine::Mean),
        };
        // Powers in shares of the greatest: a whole number must not overflow at the far plane.
        let ranges = vec![[0.0, self.steepness().exp()]];
        let values = Values::new(name, format, Encode::Texel("esm_encode"));
        Values { combine, ranges, bits: SUMMED_BITS, note, ..values }
    }

    /// Whether failing pixels are filtered from four texels of the map.
    fn filters_four(&self) -> bool {
        self.custom == Custom::Four && self.filter.sampling != Sampling::Summed
    }

    /// The common file and an ending: how failing pixels are found defines `esm_visibility`.
    fn wgsl(&self) -> &'static str {
        macro_rules! files {
            ($($file:literal),*) => { concat!(include_str!("esm.wgsl"), $(include_str!($file)),*) };
        }
        match (self.classifier, self.filters_four()) {
            (Classifier::Threshold, true) => files!("esm/custom.wgsl", "esm/threshold.wgsl"),
            // A clamp gives what failing pixels get without custom filtering.
            (Classifier::None, _) | (Classifier::Threshold, false) => files!("esm/clamped.wgsl", "esm/threshold.wgsl"),
            (Classifier::ZMax, true) => files!("esm/custom.wgsl", "esm/zmax.wgsl"),
            (Classifier::ZMax, false) => files!("esm/clamped.wgsl", "esm/zmax.wgsl"),
        }
    }

    /// The second map of Z-Max: depth, widened like the first.
    fn farthest(&self) -> Map {
        let mut passes = self.filter.passes(Combine::Greatest);
        if self.filter.sampling == Sampling::Summed {
            passes.push(Pass::Mips(Combine::Greatest));
        }
        let map = Map::new("farthest depth", TextureFormat::R32Float, Encode::Texel("esm_depth"));
        Map { passes, ..map }
    }
}

const FAILED: [Class; 1] = [Class { name: "assumption violated", colour: [224, 32, 32] }];

impl Technique for Esm {
    fn about(&self) -> About {
        About {
            name: "esm",
            title: "Exponential shadow map",
            family: Family::Basis,
            paper: "Annen et al. 2008",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let steepest = self.steepest();
        let own = vec![
            Parameter::new(
                "c",
                "1/depth range",
                Field::Number(&mut self.c, 0.0..=steepest),
                "steepness of the decay behind a caster; 0 is 80, or 72 with sampling=summed",
            ),
            Parameter::new(
                "storage",
                "",
                Field::Choice(&mut self.storage),
                "e^(c z), or z filtered logarithmically; c is at most 87 for powers, 72 summed, 200 for log_half, else 1000",
            ),
            Parameter::new(
                "classifier",
                "",
                Field::Choice(&mut self.classifier),
                "how pixels are found whose kernel reaches casters behind the receiver",
            ),
            Parameter::new(
                "epsilon",
                "",
                Field::Number(&mut self.epsilon, 0.0..=10.0),
                "a result above 1 + ε fails",
            ),
            Parameter::new(
                "offset",
                "depth range",
                Field::Number(&mut self.offset, 0.0..=1.0),
                "casters behind by no more do not fail; 0 is what a result of 1 + ε allows; only with classifier=zmax",
            ),
            Parameter::new("custom", "", Field::Choice(&mut self.custom), "how failing pixels are filtered"),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let values = self.values(device);
        let mut described = Description::filtered(self.about(), self.wgsl(), &self.filter, values, device);
        described.constants.push(Constant::Count("esm_logarithms", u32::from(self.is_logarithmic())));
        described.uniforms =
            vec![("c", self.steepness()), ("epsilon", self.epsilon), ("offset", self.allowance())];
        // Where a thousandth of the light is left.
        described.ramp = 7.0 / self.steepness();
        if self.classifier != Classifier::None {
            described.classes = &FAILED;
            // Pixels that fail are answered in another way.
            described.monotonic = !self.filters_four();
            if self.custom == Custom::Four && !self.filters_four() {
                let note = "no custom filtering: a summed-area table has no texels to clamp one by one";
                described.notes.push(note.into());
            }
        }
        if self.classifier == Classifier::ZMax {
            described.maps.push(self.farthest());
            described.bindings.push(Binding::Map(1));
            // Where no pixel fails: custom filtering takes four more.
            described.fetches += 4;
            if !self.filters_four() {
                // Pixels are lit beside deeper casters, whatever the depth.
                described.ramp = 1.0;
            }
        }
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &[
            "classifier=none",
            "classifier=zmax,custom=none",
            "storage=log32,classifier=zmax",
            "storage=log32",
            "storage=log_half",
            "storage=log16",
        ]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    /// e^(c z).
    #[must_use]
    pub fn encode(z: f64, c: f64) -> f64 {
        (c * z).exp()
    }
    /// e^(−c d) · B, unclamped.
    #[must_use]
    pub fn ratio(d: f64, filtered: f64, c: f64) -> f64 {
        (-c * d).exp() * filtered
    }
    /// The logarithm over c of the weighted mean of powers.
    #[must_use]
    pub fn log_mean(depths: &[(f64, f64)], c: f64) -> f64 {
        depths.iter().map(|(weight, z)| weight * (c * z).exp()).sum::<f64>().ln() / c
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_exponent_keeps_both_factors_normal() {
        let normal = |c: f32| c.exp().is_finite() && (-c).exp() >= f32::MIN_POSITIVE;
        assert!(normal(Esm::default().steepest()));
        // e^88 still fits, but e^−88 is denormal, which GPUs flush to zero: everything would be black.
        assert!(!normal(88.0));
        assert!(!89f32.exp().is_finite());
    }

    #[test]
    fn the_largest_exponent_in_a_table_keeps_eight_bits() {
        let mut esm = Esm::default();
        esm.filter.sampling = Sampling::Summed;
        let bits = |c: f32| f64::from(SUMMED_BITS) - f64::from(c) / std::f64::consts::LN_2;
        assert!(bits(esm.steepest()) >= 8.0 && bits(esm.steepest() + 1.0) < 8.0);
    }

    #[test]
    fn steepness_above_what_storage_holds_is_refused() {
        let check = |spec: &str| crate::technique::parse(spec).map(|_| ()).map_err(|e| e.to_string());
        check("esm.c=87").unwrap();
        check("esm.storage=log16,c=1000").unwrap();
        check("esm.sampling=summed").unwrap();
        assert_eq!(check("esm.c=88").unwrap_err(), "esm.c = 88 is out of range; allowed: 0 to 87");
        assert!(check("esm.sampling=summed,c=80").unwrap_err().ends_with("allowed: 0 to 72"));
        assert!(check("esm.storage=log_half,c=201").is_err());
        assert!(check("esm.epsilon=-0.1").is_err());
    }
}
