//! Variance shadow maps: keep the mean and the mean square of depth, bound the lit share.
//!
//! Both moments filter linearly. At lookup the one-sided Chebyshev inequality bounds the share of
//! the kernel that is not in front of the receiver: exact for one flat caster over one flat
//! receiver, too bright ("light bleeding") where casters at several depths overlap in the kernel.
//!
//! Donnelly & Lauritzen 2006, "Variance shadow maps".

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    bound,
    capabilities::Capabilities,
    error::Unsupported,
    filter::{Filter, Values},
    parameter::{Field, Parameter, choice},
};
use wgpu::TextureFormat;

choice! {
    /// What moments are stored in.
    Storage {
        /// 32-bit floats.
        Float32 = "float32",
        /// 16-bit floats: half the memory; squares are rounded by up to 1/1024, so that light bleeds
        /// widely.
        Float16 = "float16",
        /// 16 bits: half the memory; squares are rounded by 1/131072. Needs
        /// `TEXTURE_FORMAT_16BIT_NORM` and `TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES`, and takes
        /// 32-bit floats without.
        Unorm16 = "unorm16",
    }
}

choice! {
    /// Whose slope keeps tilted surfaces from shadowing themselves.
    SlopeOf {
        /// The receiver's, exact at silhouettes, added to the least variance.
        Receiver = "receiver",
        /// The casters', from neighbouring texels, added to the square, as published.
        Caster = "caster",
    }
}

/// Variance shadow maps. 1 filtered lookup; 8 bytes per texel (two 32-bit floats), 4 with 16 bits.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vsm {
    /// Least variance, in squares of the depth range.
    pub least_variance: f32,
    /// Light-bleeding reduction, 0 to 0.99; 0 is the paper.
    pub reduction: f32,
    /// Factor of the slope term ¼(z_x² + z_y²).
    pub slope: f32,
    /// Whose slope.
    pub slope_of: SlopeOf,
    /// What moments are stored in.
    pub storage: Storage,
    /// Blur, mips and sampling.
    pub filter: Filter,
}

impl Default for Vsm {
    fn default() -> Self {
        Self {
            least_variance: 1e-6,
            reduction: 0.0,
            slope: 1.0,
            slope_of: SlopeOf::Receiver,
            storage: Storage::Float32,
            filter: Filter::default(),
        }
    }
}

impl Vsm {
    fn values(&self, device: &Capabilities) -> Values {
        let (format, note) = match self.storage {
            Storage::Float32 => (TextureFormat::Rg32Float, None),
            Storage::Float16 => (TextureFormat::Rg16Float, None),
            Storage::Unorm16 => device.norm16("moments", TextureFormat::Rg16Unorm, TextureFormat::Rg32Float),
        };
        let encode = match self.slope_of {
            SlopeOf::Receiver => Encode::Texel("vsm_encode"),
            SlopeOf::Caster => Encode::Neighbours("vsm_encode_sloped"),
        };
        Values { note, ..Values::new("moments", format, encode) }
    }

    /// Least variance, and share of the mean square beside it, that cover what storage rounds off a
    /// square and off twice a mean. Encoding, both directions of the blur and mips err independently:
    /// four errors add up to two.
    #[must_use]
    pub fn floor(&self) -> [f32; 2] {
        match self.storage {
            Storage::Float32 => [self.least_variance, 0.0],
            // Halves may be truncated: 2⁻¹⁰ of the square, twice that of the mean.
            Storage::Float16 => [self.least_variance, 2.0 * 3.0 * 2f32.powi(-10)],
            Storage::Unorm16 => [self.least_variance.max(2.0 * 3.0 * 0.5 / 65535.0), 0.0],
        }
    }
}

impl Technique for Vsm {
    fn about(&self) -> About {
        About {
            name: "vsm",
            title: "Variance shadow map",
            family: Family::Basis,
            paper: "Donnelly & Lauritzen 2006",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let own = vec![
            bound::least_variance(&mut self.least_variance),
            bound::reduction(&mut self.reduction),
            bound::slope(&mut self.slope),
            Parameter::new("slope_of", "", Field::Choice(&mut self.slope_of), "whose slope"),
            Parameter::new("storage", "", Field::Choice(&mut self.storage), "what moments are stored in"),
        ];
        own.into_iter().chain(self.filter.parameters()).collect()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let [least_variance, rounding] = self.floor();
        let values = self.values(device);
        let wgsl = include_str!("vsm.wgsl");
        let mut described = Description::filtered(self.about(), wgsl, &self.filter, values, device);
        described.constants.push(Constant::Count(
            "vsm_slope_of_receiver",
            u32::from(self.slope_of == SlopeOf::Receiver),
        ));
        described.uniforms = vec![
            ("least_variance", least_variance),
            ("rounding", rounding),
            ("reduction", self.reduction),
            ("slope", self.slope),
        ];
        // Moments are rounded by 6e-8, which a variance near its floor of 1e-6 magnifies.
        described.rounding = 1e-3;
        // What the least variance lets through a tenth of the depth range behind a blocker.
        let least = least_variance.max(rounding);
        described.ringing = (least / (least + 0.01) - self.reduction).max(0.0) / (1.0 - self.reduction);
        Ok(described)
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Filter::VARIANTS[..], &["slope_of=caster", "storage=float16", "storage=unorm16"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The paper's formulas in f64: what the WGSL is tested against.
#[doc(hidden)]
pub mod reference {
    /// Moments of a texel from its own depth and those of its neighbours, as the WGSL takes them:
    /// `depths[1 + dx][1 + dy]`.
    #[must_use]
    pub fn encode(depths: [[f64; 3]; 3], slope: f64) -> [f64; 2] {
        let z = depths[1][1];
        let x = (depths[2][1] - z).abs().min((z - depths[0][1]).abs());
        let y = (depths[1][2] - z).abs().min((z - depths[1][0]).abs());
        [z, z * z + slope * 0.25 * (x * x + y * y)]
    }
    /// Chebyshev bound of moments (μ, E z²) at depth d, floor σ²_min, reduction r.
    #[must_use]
    pub fn bound(d: f64, moments: [f64; 2], least_variance: f64, reduction: f64) -> f64 {
        let variance = (moments[1] - moments[0] * moments[0]).max(least_variance);
        let behind = (d - moments[0]).max(0.0);
        let bound = if behind == 0.0 { 1.0 } else { variance / (variance + behind * behind) };
        ((bound - reduction) / (1.0 - reduction)).clamp(0.0, 1.0)
    }
}
