//! The pre-filter settings that every member of the linear-basis family shares.

use crate::{
    capabilities::Capabilities,
    kernel::{Adaptive, Kernel, Weights, Width},
    parameter::{Field, Parameter, choice},
    table::{MOST_SUMMED, Table},
    technique::{Combine, Constant, Encode, Map, Pass},
};

choice! {
    /// How a receiver reads a filtered map.
    Sampling {
        /// One texel.
        Nearest = "nearest",
        /// Four texels of the finest level.
        Bilinear = "bilinear",
        /// Two mip levels chosen by what the pixel's footprint covers beyond the blur, in area: nothing is
        /// filtered twice, and little across a stretched footprint. One lookup.
        Fitted = "fitted",
        /// Two mip levels chosen by the longer side of the pixel's footprint, as samplers do and papers
        /// assume: blurs shadows away where the ground is seen at a grazing angle.
        Trilinear = "trilinear",
        /// Several trilinear lookups along the longer side of the footprint.
        Anisotropic = "anisotropic",
        /// A box in a summed-area table, as wide as the kernel or, where that is more, as the
        /// footprint. Instead of blur and mips; 16 bytes per table and texel.
        Summed = "summed",
    }
}

/// What a map holds, before filters act on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// Storage of a filtered texel.
    pub format: wgpu::TextureFormat,
    /// Array layers per view.
    pub layers: u32,
    /// Both ends of each channel's range, the one that needs finer steps first.
    pub ranges: Vec<[f32; 2]>,
    /// Bits of a value that count, for summed-area tables. 8: multiples of 1/255 of the range.
    pub bits: u32,
}

/// Blur, mips and sampling, in the order in which they act.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Filter {
    /// Width of the blur in texels, odd, 1 (none) to 31; of the box with [`Sampling::Summed`], to 255.
    pub kernel: u32,
    /// Width of the blur in world units (under a spot, at unit distance), the same in every view and
    /// cascade as long as it is no more than `kernel` texels; 0 for `kernel` texels. Texels alone with
    /// [`Sampling::Summed`].
    pub width: f32,
    /// Shape of the blur.
    pub weights: Weights,
    /// Standard deviation of the Gaussian in texels, 0 for [`Kernel::usual_sigma`].
    pub sigma: f32,
    /// How receivers read the map; mips are built only if it uses them.
    pub sampling: Sampling,
    /// Most lookups along the footprint with anisotropic sampling, 1 to 16.
    pub anisotropy: u32,
}

impl Default for Filter {
    fn default() -> Self {
        Self {
            kernel: 3,
            width: 0.0,
            weights: Weights::Gaussian,
            sigma: 0.0,
            sampling: Sampling::Fitted,
            anisotropy: 16,
        }
    }
}

impl Filter {
    /// The rows of these settings in a technique's parameter table.
    pub fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let (widest, longest) =
            if self.sampling == Sampling::Summed { (MOST_SUMMED, 0.0) } else { (31, 1e6) };
        vec![
            Parameter::new(
                "kernel",
                "texels",
                Field::Odd(&mut self.kernel, 1..=widest),
                "width of the blur, 1 is none; up to 255, and a box, with sampling=summed",
            ),
            Parameter::new(
                "width",
                "world units",
                Field::Number(&mut self.width, 0.0..=longest),
                "width of the blur in the world, at most `kernel` texels; 0: `kernel` texels; not with sampling=summed",
            ),
            Parameter::new("weights", "", Field::Choice(&mut self.weights), "shape of the blur"),
            Parameter::new(
                "sigma",
                "texels",
                Field::Number(&mut self.sigma, 0.0..=31.0),
                "standard deviation of the Gaussian; 0 is 0.15·kernel + 0.35",
            ),
            Parameter::new("sampling", "", Field::Choice(&mut self.sampling), "how receivers read the map"),
            Parameter::new(
                "anisotropy",
                "lookups",
                Field::Count(&mut self.anisotropy, 1..=16),
                "most trilinear lookups along a stretched footprint; only with sampling=anisotropic",
            ),
        ]
    }

    /// The blur and mips that these settings ask for.
    #[must_use]
    pub fn passes(&self, combine: Combine) -> Vec<Pass> {
        let kernel = || match self.width {
            w if w > 0.0 => Kernel::adaptive(self.weights, self.width(), self.sigma),
            _ => Kernel::new(self.weights, self.kernel, self.sigma),
        };
        let blur = (self.kernel > 1).then(|| Pass::Blur(kernel(), combine));
        let mips = matches!(self.sampling, Sampling::Fitted | Sampling::Trilinear | Sampling::Anisotropic);
        blur.into_iter().chain(mips.then_some(Pass::Mips(combine))).collect()
    }

    /// A map that holds such values, with all its passes.
    #[must_use]
    pub fn map(&self, name: &'static str, encode: Encode, values: Values, combine: Combine) -> Map {
        let Values { format, layers, .. } = values;
        match self.table(&values) {
            Some(table) => Map {
                name,
                format: wgpu::TextureFormat::Rgba32Uint,
                layers: layers * table.parts(),
                encode,
                passes: vec![Pass::Sum(table)],
            },
            None => Map { name, format, layers, encode, passes: self.passes(combine) },
        }
    }

    fn table(&self, values: &Values) -> Option<Table> {
        let ranges = || values.ranges.clone();
        (self.sampling == Sampling::Summed).then(|| match values.bits {
            8 => Table::bytes(ranges()),
            bits => Table::new(ranges(), bits),
        })
    }

    /// The WGSL files behind `lookup_filtered`, for a map of such values on this device.
    #[must_use]
    pub fn parts(&self, device: &Capabilities, values: &Values, combine: Combine) -> Vec<&'static str> {
        let lookup = match self.sampling {
            Sampling::Nearest => return vec!["lookup_nearest"],
            Sampling::Bilinear => "lookup_bilinear",
            Sampling::Fitted => "lookup_fitted",
            Sampling::Trilinear => "lookup_trilinear",
            Sampling::Anisotropic => "lookup_anisotropic",
            Sampling::Summed => "lookup_summed",
        };
        let blur = if self.adapted().is_some() { "blur_adaptive" } else { "blur_fixed" };
        let below = match (self.table(values), combine) {
            (Some(table), _) => table.arithmetic(),
            (None, Combine::LogMean(_)) => "level_logarithmic",
            (None, _) if device.filters(values.format) => "level_hardware",
            (None, _) => "level_manual",
        };
        vec![lookup, below, blur]
    }

    /// Compile-time settings of those files.
    #[must_use]
    pub fn constants(&self, values: &Values, combine: Combine) -> Vec<Constant> {
        if let Some(table) = self.table(values) {
            let [low, range] = table.scale();
            return vec![
                Constant::Number("words_top", table.top()),
                Constant::Count("lookup_parts", table.parts()),
                Constant::Number("lookup_kernel", self.kernel as f32),
                Constant::Array("lookup_low", low),
                Constant::Array("lookup_range", range),
            ];
        }
        let mut constants = Vec::new();
        if let (Combine::LogMean(c), false) = (combine, self.sampling == Sampling::Nearest) {
            constants.push(Constant::Number("level_steepness", c));
        }
        if self.sampling == Sampling::Fitted {
            constants.push(match self.adapted() {
                Some(_) => Constant::Count("blur_layers", values.layers),
                // The same for texels of all sizes.
                None => Constant::Number("blur_everywhere", self.blur().variance(1.0)),
            });
        }
        if self.sampling == Sampling::Anisotropic {
            constants.push(Constant::Count("lookup_most_taps", self.anisotropy));
        }
        constants
    }

    fn blur(&self) -> Adaptive {
        Adaptive { width: self.width(), weights: self.weights, sigma_texels: self.sigma }
    }

    /// See [`Technique::blur`](crate::Technique::blur).
    #[must_use]
    pub fn adapted(&self) -> Option<Adaptive> {
        let asks = self.sampling == Sampling::Fitted && self.width > 0.0 && self.kernel > 1;
        asks.then(|| self.blur())
    }

    /// Texture lookups behind one `lookup_filtered` whose footprint is not stretched.
    #[must_use]
    pub fn lookups(&self, values: &Values) -> u32 {
        self.table(values).map_or(1, |table| 16 * table.parts())
    }

    /// What to tell of a map of values in a 16-bit format that such a device cannot render to, if that
    /// format is asked for; a table does without.
    pub(crate) fn told_of_norm16(
        &self,
        device: &Capabilities,
        what: &str,
        format: Option<wgpu::TextureFormat>,
    ) -> Option<String> {
        let missing = format.filter(|f| self.sampling != Sampling::Summed && !device.renders(*f))?;
        Some(format!(
            "{what} in 32 bits instead of 16, twice the memory: {missing:?} cannot be rendered to without TEXTURE_FORMAT_16BIT_NORM and TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES"
        ))
    }

    /// Width of the blur in each view.
    #[must_use]
    pub fn width(&self) -> Width {
        Width { texels: self.kernel as f32, world: self.width }
    }

    /// See [`Technique::reach_texels`](crate::Technique::reach_texels).
    #[must_use]
    pub fn reach_texels(&self) -> f32 {
        self.kernel as f32 / 2.0 + 0.5
    }
}
