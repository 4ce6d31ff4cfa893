//! How exactly a comparison technique stores depth.

use crate::{
    bias::BiasTerms,
    capabilities::Capabilities,
    describe::{
        About, Binding, Description,
        map::{Encode, Map},
        wgsl::{Constant, DepthSpace},
    },
    parameter::{Field, Parameter, choice},
};
use std::borrow::Cow;
use wgpu::TextureFormat;

choice! {
    /// Bits of the stored depth. Fewer than 24 show as bands of acne or detached shadows: the artefacts
    /// that Brabec & Seidel 2001, §6, speak of.
    #[derive(Default)]
    Precision {
        /// A 32-bit float.
        #[default]
        Float32 = "float32",
        /// 2²⁴ − 1 steps, about those of a float near the far plane.
        Bits24 = "24",
        /// 65535 steps.
        Bits16 = "16",
        /// 4095 steps.
        Bits12 = "12",
        /// 255 steps.
        Bits8 = "8",
    }
}

impl Precision {
    /// Steps from the near to the far plane; `None` for floats.
    #[must_use]
    pub fn steps(self) -> Option<u32> {
        match self {
            Self::Float32 => None,
            Self::Bits24 => Some((1 << 24) - 1),
            Self::Bits16 => Some(u32::from(u16::MAX)),
            Self::Bits12 => Some((1 << 12) - 1),
            Self::Bits8 => Some(u32::from(u8::MAX)),
        }
    }

    /// One step as a share of the depth range, 0 for floats.
    pub(crate) fn step(self) -> f32 {
        self.steps().map_or(0.0, |n| 1.0 / n as f32)
    }

    /// Settings that take other ways through shaders than the default; see
    /// [`Technique::variants`](crate::Technique::variants).
    pub const VARIANTS: [&'static str; 1] = ["precision=16"];

    /// The WGSL file behind `reference_depth`.
    pub(crate) fn slot(self) -> &'static str {
        if self.steps().is_none() { "reference_exact" } else { "reference_stepped" }
    }

    /// Numbers that are compiled into that file.
    pub(crate) fn constants(self) -> Vec<Constant> {
        self.steps().map(|n| Constant::Count("reference_steps", n)).into_iter().collect()
    }

    /// Format of four depths in one texel, and what is to be told of it.
    pub(crate) fn rgba(self, device: &Capabilities) -> (TextureFormat, Option<String>) {
        match self {
            Self::Bits8 => (TextureFormat::Rgba8Unorm, None),
            Self::Bits12 | Self::Bits16 => {
                device.norm16("depths", TextureFormat::Rgba16Unorm, TextureFormat::Rgba32Float)
            }
            Self::Bits24 | Self::Float32 => (TextureFormat::Rgba32Float, None),
        }
    }

    /// Its row in a technique's parameter table.
    pub(crate) fn parameter(&mut self) -> Parameter<'_> {
        Parameter::new("precision", "bits", Field::Choice(self), "how exactly depth is stored")
    }
}

impl Description {
    /// Compares the casters' own depth through a comparison sampler: [`Binding::Depth`] and
    /// [`Binding::Compare`], with `reference_depth` of such a precision in the slot `reference`.
    ///
    /// Bias and filter radius are those of a single lookup.
    #[must_use]
    pub fn comparison(
        about: About,
        wgsl: impl Into<Cow<'static, str>>,
        filter: wgpu::FilterMode,
        precision: Precision,
    ) -> Self {
        let (bias, filter_radius_texels) = match filter {
            wgpu::FilterMode::Nearest => (BiasTerms::TEXELS, 0.5),
            wgpu::FilterMode::Linear => (BiasTerms::FOURS, 1.0),
        };
        Self {
            slots: vec![precision.slot()],
            constants: precision.constants(),
            bindings: vec![Binding::Depth, Binding::Compare(filter)],
            depth_space: DepthSpace::Raster,
            depth_quantum: precision.step(),
            bias,
            filter_radius_texels,
            ..Self::new(about, wgsl)
        }
    }

    /// Keeps one map of depths and compares them itself: [`Binding::Map`], with `reference_depth` as in
    /// [`comparison`](Self::comparison). Depth is linear.
    #[must_use]
    pub fn stored_depth(
        about: About,
        wgsl: impl Into<Cow<'static, str>>,
        (name, layers, encode): (&'static str, u32, Encode),
        precision: Precision,
        device: &Capabilities,
    ) -> Self {
        let (format, note) = precision.rgba(device);
        Self {
            maps: vec![Map { layers, ..Map::new(name, format, encode) }],
            bindings: vec![Binding::Map(0)],
            depth_space: DepthSpace::Linear,
            notes: note.into_iter().collect(),
            ..Self::comparison(about, wgsl, wgpu::FilterMode::Nearest, precision)
        }
    }
}

#[cfg(test)]
mod tests {
    /// d ≤ round(n·z)/n, the comparison with a rounded depth, is (ceil(n·d) − ½)/n ≤ z.
    #[test]
    fn a_rounded_comparison_is_an_exact_one_with_another_depth() {
        for n in [255.0_f64, 4095.0] {
            let half = 0.5 / n;
            let mut differences = 0;
            for i in 0..=2000 {
                // Around three steps, off their borders.
                let z = (100.0 + 3.0 * f64::from(i) / 2000.0 + 1e-7) / n;
                for j in 0..=40 {
                    let d = z + half * (f64::from(j) - 20.003) / 7.0;
                    let stored = d <= (z * n).round() / n;
                    let moved = ((d * n).ceil() - 0.5) / n <= z;
                    assert_eq!(stored, moved, "d {d}, z {z}, {n} steps");
                    differences += usize::from(((d * n).ceil() / n <= z) != stored);
                }
            }
            assert!(differences > 1000, "without the half step {differences} answers differ");
        }
    }
}
