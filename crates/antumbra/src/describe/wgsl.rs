//! What a technique's WGSL reads: bindings, uniforms, constants.

/// A texture or sampler that the technique's WGSL function takes, in parameter order.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Binding {
    /// `texture_depth_2d_array`: the depth of the casters, one layer per view, as rasterised.
    Depth,
    /// `sampler_comparison`, less-or-equal: one texel, or four with bilinear weights.
    Compare(wgpu::FilterMode),
    /// Entry of [`Description::maps`](super::Description::maps); view `v` starts at layer `v · layers`. A
    /// `LookupMap`: `texture_2d_array<f32>`, or `<u32>` for summed-area tables.
    Map(usize),
    /// `sampler` for the maps: clamped, linear where the device can filter them.
    Sampler,
}

/// A number that is set at run time, `(name, value)`: a member of the uniform structs, which the WGSL of a
/// technique named `x` reads as `x_name() -> f32`.
pub type Uniform = (&'static str, f32);

/// A number that is compiled in: the one-line `const NAME…;` of the technique's WGSL is replaced.
#[derive(Debug, Clone, PartialEq)]
pub enum Constant {
    /// `const NAME: u32 = …;`
    Count(&'static str, u32),
    /// `const NAME: f32 = …;`
    Number(&'static str, f32),
    /// `const NAME = array<f32, n>(…);`
    Array(&'static str, Vec<f32>),
}

impl Constant {
    /// What it is declared as.
    #[must_use]
    pub fn name(&self) -> &'static str {
        let (Self::Count(name, _) | Self::Number(name, _) | Self::Array(name, _)) = self;
        name
    }

    /// Its declaration with the value.
    pub(crate) fn declaration(&self) -> String {
        match self {
            Self::Count(name, n) => format!("const {name}: u32 = {n}u;"),
            Self::Number(name, x) => format!("const {name}: f32 = {x:?};"),
            Self::Array(name, values) => {
                let list: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
                format!("const {name} = array<f32, {}>({});", values.len(), list.join(", "))
            }
        }
    }
}

/// A kind of pixel that a technique tells apart, for debug views.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Class {
    /// What such pixels are.
    pub name: &'static str,
    /// Their colour in debug views, sRGB.
    pub colour: [u8; 3],
}

/// The depth that a technique's visibility function receives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DepthSpace {
    /// What the rasteriser stores: projected depth. For comparing with [`Binding::Depth`].
    Raster,
    /// Linear in `[0,1]` from near to far. For everything encoded from [`Map`](super::Map)s.
    Linear,
}
