//! The pre-filter settings that every member of the linear-basis family shares.

use crate::{
    capabilities::Capabilities,
    describe::{
        About, Binding, Description,
        map::{Access, Combine, Encode, Map, Pass},
        wgsl::Constant,
    },
    kernel::{Adaptive, Kernel, Weights, Width},
    parameter::{Field, Parameter, choice},
    table::{MAX_SUMMED, Table},
};
use std::borrow::Cow;

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
#[non_exhaustive]
pub struct Values {
    /// Name of the map in memory listings.
    pub name: &'static str,
    /// Storage of a filtered texel.
    pub format: wgpu::TextureFormat,
    /// Array layers per view.
    pub layers: u32,
    /// What makes them from depth.
    pub encode: Encode,
    /// What filtering them means.
    pub combine: Combine,
    /// Both ends of each channel's range, the one that needs finer steps first; for summed-area tables.
    pub ranges: Vec<[f32; 2]>,
    /// Bits of a value that count, for summed-area tables. 8: multiples of 1/255 of the range.
    pub bits: u32,
    /// The stored value that stands for zero, except in summed-area tables.
    pub zero_level: f32,
    /// What is told of the format; a summed-area table does without.
    pub note: Option<String>,
}

impl Values {
    /// One layer of linear values from 0 to 1, of which 24 bits count.
    #[must_use]
    pub fn new(name: &'static str, format: wgpu::TextureFormat, encode: Encode) -> Self {
        Self {
            name,
            format,
            layers: 1,
            encode,
            combine: Combine::Mean,
            ranges: vec![[0.0, 1.0]; format.components().into()],
            bits: 24,
            zero_level: 0.0,
            note: None,
        }
    }
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
    /// Settings that take other ways through shaders than the defaults; see
    /// [`Technique::variants`](crate::Technique::variants).
    pub const VARIANTS: [&'static str; 4] = [
        "sampling=trilinear",
        "sampling=anisotropic",
        "sampling=summed,kernel=5",
        "sampling=nearest,kernel=1",
    ];

    /// The rows of these settings in a technique's parameter table.
    pub fn parameters(&mut self) -> Vec<Parameter<'_>> {
        let (widest, longest) = if self.sampling == Sampling::Summed { (MAX_SUMMED, 0.0) } else { (31, 1e6) };
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
    pub(crate) fn passes(&self, combine: Combine) -> Vec<Pass> {
        let kernel = || match self.width {
            w if w > 0.0 => Kernel::adaptive(self.weights, self.width(), self.sigma),
            _ => Kernel::new(self.weights, self.kernel, self.sigma),
        };
        let blur = (self.kernel > 1).then(|| Pass::Blur(kernel(), combine));
        let mips = matches!(self.sampling, Sampling::Fitted | Sampling::Trilinear | Sampling::Anisotropic);
        blur.into_iter().chain(mips.then_some(Pass::Mips(combine))).collect()
    }

    /// A map that holds such values, with all its passes.
    pub(crate) fn map(&self, values: &Values, device: &Capabilities) -> Map {
        let Values { name, format, layers, encode, zero_level, .. } = *values;
        match self.table(values) {
            Some(table) => Map {
                layers: layers * table.parts(),
                passes: vec![Pass::Sum(table)],
                access: Access::Sums,
                ..Map::new(name, wgpu::TextureFormat::Rgba32Uint, encode)
            },
            None => Map {
                layers,
                passes: self.passes(values.combine),
                access: self.access(values, device),
                zero_level,
                ..Map::new(name, format, encode)
            },
        }
    }

    fn table(&self, values: &Values) -> Option<Table> {
        let ranges = || values.ranges.clone();
        (self.sampling == Sampling::Summed).then(|| match values.bits {
            8 => Table::bytes(ranges()),
            bits => Table::new(ranges(), bits),
        })
    }

    /// How receivers read a map of such values on this device.
    fn access(&self, values: &Values, device: &Capabilities) -> Access {
        match (self.sampling, values.combine) {
            (Sampling::Nearest, _) => Access::Texel,
            (Sampling::Summed, _) => Access::Sums,
            (_, Combine::LogMean(_)) => Access::Powers,
            _ if device.filters(values.format) => Access::Sampler,
            _ => Access::Shader,
        }
    }

    /// The WGSL files behind `lookup_filtered`, for a map of such values on this device.
    pub(crate) fn slots(&self, values: &Values, device: &Capabilities) -> Vec<&'static str> {
        let lookup = match self.sampling {
            Sampling::Nearest => "lookup_nearest",
            Sampling::Bilinear => "lookup_bilinear",
            Sampling::Fitted => "lookup_fitted",
            Sampling::Trilinear => "lookup_trilinear",
            Sampling::Anisotropic => "lookup_anisotropic",
            Sampling::Summed => "lookup_summed",
        };
        let below = match self.access(values, device) {
            Access::Texel => None,
            Access::Sums => self.table(values).map(|table| table.arithmetic()),
            Access::Powers => Some("level_logarithmic"),
            Access::Sampler => Some("level_hardware"),
            Access::Shader => Some("level_manual"),
        };
        let blur = match (self.sampling, self.adapted()) {
            (Sampling::Fitted, None) => Some("blur_fixed"),
            (Sampling::Fitted, Some(_)) => Some("blur_adaptive"),
            _ => None,
        };
        [Some(lookup), below, blur].into_iter().flatten().collect()
    }

    /// Numbers that are compiled into those files.
    pub(crate) fn constants(&self, values: &Values) -> Vec<Constant> {
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
        if let (Combine::LogMean(c), false) = (values.combine, self.sampling == Sampling::Nearest) {
            constants.push(Constant::Number("level_steepness", c));
        }
        if self.sampling == Sampling::Fitted && self.adapted().is_none() {
            // The same for texels of all sizes.
            constants.push(Constant::Number("blur_everywhere", self.blur().variance(1.0)));
        }
        if self.sampling == Sampling::Anisotropic {
            constants.push(Constant::Count("lookup_most_taps", self.anisotropy));
        }
        constants
    }

    fn blur(&self) -> Adaptive {
        Adaptive { width: self.width(), weights: self.weights, sigma_texels: self.sigma }
    }

    /// The blur, if lookups ask for its variance in each view.
    pub(crate) fn adapted(&self) -> Option<Adaptive> {
        let asks = self.sampling == Sampling::Fitted && self.width > 0.0 && self.kernel > 1;
        asks.then(|| self.blur())
    }

    /// Texture fetches behind one `lookup_filtered` whose footprint is not stretched.
    pub(crate) fn fetches(&self, values: &Values) -> u32 {
        self.table(values).map_or(1, |table| 16 * table.parts())
    }

    /// What is to be told of these settings and such values.
    pub(crate) fn notes(&self, values: Values) -> Vec<String> {
        match self.sampling {
            Sampling::Summed => Vec::new(),
            Sampling::Anisotropic => {
                let by_loop = "anisotropic lookups by a loop in the shader, the same on every driver, not by the sampler";
                values.note.into_iter().chain([by_loop.into()]).collect()
            }
            _ => values.note.into_iter().collect(),
        }
    }

    /// Width of the blur in each view.
    pub(crate) fn width(&self) -> Width {
        Width { texels: self.kernel as f32, world: self.width }
    }

    /// Half the width of the blur and of a bilinear lookup, in texels.
    pub(crate) fn filter_radius_texels(&self) -> f32 {
        self.kernel as f32 / 2.0 + 0.5
    }
}

impl Description {
    /// Keeps one map of such values that is filtered before receivers read it: [`Binding::Map`] and
    /// [`Binding::Sampler`], with `lookup_filtered` as set in the slot `lookup`.
    #[must_use]
    pub fn filtered(
        about: About,
        wgsl: impl Into<Cow<'static, str>>,
        filter: &Filter,
        values: Values,
        device: &Capabilities,
    ) -> Self {
        Self {
            slots: filter.slots(&values, device),
            constants: filter.constants(&values),
            blur: filter.adapted(),
            bindings: vec![Binding::Map(0), Binding::Sampler],
            filter_radius_texels: filter.filter_radius_texels(),
            fetches: filter.fetches(&values),
            maps: vec![filter.map(&values, device)],
            notes: filter.notes(values),
            ..Self::new(about, wgsl)
        }
    }
}
