//! What a shadow technique is, as a description, and the list of all of them.
//!
//! A [`Technique`] holds no GPU object: it says which texels it keeps ([`Map`]), how they are
//! filtered ([`Pass`]), what its WGSL function reads ([`Binding`], [`Uniform`]) and what its
//! settings are ([`Parameter`]). [`ShadowMap`](crate::ShadowMap) does the rest. To add one, write
//! `technique/x.rs` and `technique/x.wgsl` and add a line to the list at the end of this file.

use crate::{
    capabilities::Capabilities,
    error::{SettingError, Unsupported},
    kernel::Kernel,
    parameter::Parameter,
    table::Table,
};
use glam::Vec2;
use std::fmt::Debug;

pub use crate::{
    bias::{Bias, BiasTerms},
    kernel::{Adaptive, Width},
};

/// How a technique gets from depth to visibility.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Family {
    /// Keeps depth; compares many texels at lookup and averages the answers.
    Comparison,
    /// Keeps functions of depth that may be filtered before lookup.
    Basis,
    /// Keeps triangles; reconstructs the edge at lookup.
    Geometry,
}

impl Family {
    /// `comparison`, `basis` or `geometry`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Comparison => "comparison",
            Self::Basis => "basis",
            Self::Geometry => "geometry",
        }
    }
}

/// Who a technique is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Page {
    /// The stem of its files and WGSL functions.
    pub name: &'static str,
    /// Its usual name.
    pub title: &'static str,
    /// Its family.
    pub family: Family,
    /// Who published it.
    pub paper: &'static str,
}

/// What the casters' pass leaves for a technique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Caster {
    /// Depth, drawn by the renderer's own pipelines; maps are encoded from it.
    Depth,
    /// The nearest triangle of each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the
    /// library's pipelines straight into the only one of [`Technique::maps`], one layer per entry. The
    /// technique's WGSL, or one of its [parts](Technique::parts), defines
    /// `packing_triangle(corners: mat3x3f, slope: vec2f) -> vec4u`, what all texels of a triangle
    /// share; `packing_slope(words: vec4u) -> vec2f`, its slope as decoded; and `packing_texel(shared:
    /// vec4u, corners: mat3x3f, distances: vec3f, centre: vec2f, size: vec2f, anchor: vec3f,
    /// slope: vec2f, alone: bool) -> vec4u`, what a texel stores. All zeros are an empty texel.
    Triangles(&'static [Coverage]),
    /// All triangles that touch each texel, drawn from [`CasterMesh`](crate::CasterMesh)es by the
    /// library's pipelines: [`Binding::List`]. They are drawn twice, to count and to fill the lists, so
    /// that the closure of [`ShadowMap::encode`](crate::ShadowMap::encode) must draw the same in the
    /// same order both times. What exceeds the map's [`Capacity`](crate::Capacity) is left out.
    Lists,
    /// Some of the triangles that touch each texel, drawn once from
    /// [`CasterMesh`](crate::CasterMesh)es by the library's pipelines: [`Binding::Ranked`]. They are those
    /// that show their far side to the light, and then those that show the near one, from the light on.
    /// Sides are told by winding: where all triangles of an object are wound the wrong way around they are
    /// swapped, which does no harm. Beside them the depth of the texels' centres ([`Binding::Depth`]).
    Ranked {
        /// Triangles per texel, at least 1.
        keeps: u32,
    },
}

impl Caster {
    /// Whether it keeps triangles by id, for which a map needs [`Capacity`](crate::Capacity).
    #[must_use]
    pub fn keeps_ids(self) -> bool {
        match self {
            Self::Depth | Self::Triangles(_) => false,
            Self::Lists | Self::Ranked { .. } => true,
        }
    }
}

/// A buffer that [`Caster::Ranked`] leaves. The technique's WGSL reads it through a function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ranked {
    /// `shadow_key(i: u32) -> u32`: of each texel the keys of its triangles, as in `key.wgsl`, the
    /// greatest first, 0 where there are fewer; with `shadow_key_bits() -> u32`, the bits of a triangle's id
    /// in them, and `shadow_near_over_far(view: u32) -> f32`, 1 for the sun, which makes depth linear.
    /// Those of texel (x, y) begin at `keeps` · ((view · height + y) · width + x).
    Keys,
    /// `shadow_corner(view: u32, triangle: u32, corner: u32) -> vec3f`: x and y in texels of the map, y down,
    /// z the depth as rasterised.
    Corners,
}

/// A texture that [`Caster::Lists`] leaves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum List {
    /// `texture_2d_array<u32>`: of each texel the first entry of its list in layer 2·view, the one
    /// behind its last in the next layer.
    Ranges,
    /// `texture_2d_array<u32>`: entry i, the number of a triangle, in texel (i mod 2048, ⌊i / 2048⌋ mod
    /// 2048) of layer ⌊i / 2048²⌋ of the view's, all of which have as many.
    Numbers,
    /// `texture_2d_array<f32>`: corner c of triangle n in texel (n mod 2048, ⌊n / 2048⌋) of layer
    /// 3·view + c: x and y in texels of the map, y down, z the depth as rasterised.
    Corners,
}

/// Which texels a triangle is drawn to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coverage {
    /// All that it touches: conservative rasterisation.
    Touched,
    /// Those whose centre it covers, as rasterisers do.
    Centre,
}

/// One texture array that a technique keeps per view.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// Name in memory listings.
    pub name: &'static str,
    /// Storage; must be a colour format that can be rendered to, or, for summed-area tables, one
    /// that compute shaders can store.
    pub format: wgpu::TextureFormat,
    /// Array layers per view.
    pub layers: u32,
    /// What makes texels from depth.
    pub encode: Encode,
    /// What happens between casting and lighting, in order.
    pub passes: Vec<Pass>,
}

impl Map {
    /// Whether shaders read whole numbers from it.
    pub(crate) fn holds_integers(&self) -> bool {
        self.format.sample_type(None, None) == Some(wgpu::TextureSampleType::Uint)
    }
}

/// The WGSL function that makes layer `layer` of a [`Map`] from linear depth.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encode {
    /// `(depth: f32, layer: u32, settings…) -> vec4f`: a texel depends on its own depth alone. A blur
    /// that follows runs its rows on the encoded depths, without storing them first.
    Texel(&'static str),
    /// `(depths: mat3x3f, layer: u32, settings…) -> vec4f`: `depths[1][1]` is the texel itself,
    /// `depths[1 + dx][1 + dy]` its neighbour. What is not read is not fetched.
    Neighbours(&'static str),
}

/// A step of the pre-filter.
#[derive(Debug, Clone, PartialEq)]
pub enum Pass {
    /// Separable convolution of every layer, edge texels repeated.
    Blur(Kernel, Combine),
    /// The full mip chain, each level from 2×2 texels of the one above.
    Mips(Combine),
    /// A summed-area table in whole numbers: no other pass beside it.
    Sum(Table),
}

/// How a filter puts texels together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Combine {
    /// Weighted mean.
    Mean,
    /// The greatest of all whose weight is not zero.
    Greatest,
    /// 1/c · log of the weighted mean of e^(c·texel): filters logarithms as if they were the powers.
    LogMean(f32),
}

/// A texture or sampler that the technique's WGSL function takes, in parameter order, or a buffer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Binding {
    /// `texture_depth_2d_array`: the depth of the casters, one layer per view, as rasterised.
    Depth,
    /// `sampler_comparison`, less-or-equal: one texel, or four with bilinear weights.
    Compare(wgpu::FilterMode),
    /// Entry of [`Technique::maps`]; view `v` starts at layer `v · layers`. A `LookupMap`:
    /// `texture_2d_array<f32>`, or `<u32>` for summed-area tables.
    Map(usize),
    /// A texture of the lists of [`Caster::Lists`].
    List(List),
    /// A buffer of [`Caster::Ranked`]; no parameter.
    Ranked(Ranked),
    /// `sampler` for the maps: clamped, linear where the device can filter them.
    Sampler,
}

/// A run-time setting of the WGSL functions: `(name, value)`. Becomes a member of the uniform
/// struct and an argument, in this order, of `x_visibility` and of the encode function.
pub type Uniform = (&'static str, f32);

/// A compile-time setting: the one-line `const NAME…;` of the technique's WGSL is replaced.
#[derive(Debug, Clone, PartialEq)]
pub enum Constant {
    /// `const NAME: u32 = …;`
    Count(&'static str, u32),
    /// `const NAME: f32 = …;`
    Number(&'static str, f32),
    /// `const NAME = array<f32, n>(…);`
    Array(&'static str, Vec<f32>),
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
    /// Linear in `[0,1]` from near to far. For everything encoded from [`Map`]s.
    Linear,
}

/// A shadow technique, described. Public fields are its settings; no GPU object inside.
///
/// Its WGSL defines, for a technique named `x`,
/// `x_visibility(bindings…, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f,
/// ddy: vec2f, uniforms…, widths…) -> f32`: `uv` in the map, y down; `depth` of the receiver, bias applied,
/// in [`Technique::depth_space`]; `plane`, the depth that the receiver's plane gains per unit of
/// `uv` (as [`BiasTerms::receiver_plane`] says in the comparison family); `ddx`, `ddy`, the change of `uv` from this pixel to the next. The result is 0 (in shadow)
/// to 1 (lit).
pub trait Technique: Debug + Send + Sync {
    /// Name, title, family, paper.
    fn page(&self) -> Page;
    /// The settings, in the order in which they should be shown.
    fn parameters(&mut self) -> Vec<Parameter<'_>>;
    /// Where within a texel the casters are sampled: one caster pass per view for each offset, in texels
    /// from the centre, y down. Several passes fill the channels of the first map in turn, layer by
    /// layer, each with what the encode function makes of its depth.
    fn jitter(&self) -> Vec<Vec2> {
        vec![Vec2::ZERO]
    }
    /// The textures it keeps on such a device; none for the comparison family, which keeps depth.
    ///
    /// # Errors
    /// [`Unsupported::Feature`] where no format will do.
    fn maps(&self, device: &Capabilities) -> Result<Vec<Map>, Unsupported>;
    /// What it does otherwise than set because such a device cannot, one sentence each, for
    /// [`ShadowMap::explain`](crate::ShadowMap::explain).
    fn fallbacks(&self, _device: &Capabilities) -> Vec<String> {
        Vec::new()
    }
    /// What its casters leave.
    fn caster(&self) -> Caster {
        Caster::Depth
    }
    /// What its visibility function reads, in parameter order.
    fn bindings(&self) -> Vec<Binding>;
    /// Its WGSL: the file beside the Rust file.
    fn wgsl(&self) -> &'static str;
    /// Run-time settings of its WGSL functions.
    fn uniforms(&self) -> Vec<Uniform> {
        Vec::new()
    }
    /// Kernel widths that its visibility function takes, after the uniforms, in texels of the view.
    fn widths(&self) -> Vec<(&'static str, Width)> {
        Vec::new()
    }
    /// The blur of its maps, if its WGSL asks `shadow_blur(view: u32) -> f32` for that one's variance in a
    /// view, in squares of texels.
    fn blur(&self) -> Option<Adaptive> {
        None
    }
    /// Compile-time settings of its WGSL.
    fn constants(&self) -> Vec<Constant> {
        Vec::new()
    }
    /// Shared WGSL that its own file leaves open, such as the lookup that its sampling setting
    /// chooses: stems of files in `shader/`.
    fn parts(&self, _device: &Capabilities) -> Vec<&'static str> {
        Vec::new()
    }
    /// Kinds of pixels that it tells apart. If there are any, its WGSL also defines `x_class`, with
    /// the arguments of `x_visibility`, which returns 0 (none of them) or 1 + the index here, and
    /// [`ShadowMap::wgsl`](crate::ShadowMap::wgsl) gives `shadow_class`.
    fn classes(&self) -> &'static [Class] {
        &[]
    }
    /// What [`Bias::Auto`] stands for.
    fn bias(&self) -> BiasTerms {
        BiasTerms::NONE
    }
    /// Steps in which it stores depth, as a share of the depth range; 0 for floats.
    fn depth_step(&self) -> f32 {
        0.0
    }
    /// The depth that it compares.
    fn depth_space(&self) -> DepthSpace {
        DepthSpace::Linear
    }
    /// Half the width of its kernel: how far outside a point's own texel a lookup may read, in
    /// texels. Views leave that much margin.
    fn reach_texels(&self) -> f32;
    /// Largest error that ringing and quantisation leave where the shadow test is clear-cut: the
    /// visibility deep behind a full blocker is at most this, in the open at least one minus this.
    fn ripple(&self) -> f32 {
        0.0
    }
    /// The stored value that stands for zero in entry `map` of [`maps`](Self::maps), for debug views:
    /// ½ where signed numbers are kept in an unsigned format.
    fn stored_zero(&self, _map: usize) -> f32 {
        0.0
    }
    /// Texture lookups of its visibility function for a pixel that its filters do not stretch; an
    /// interpolated one counts once. What a pixel costs on hardware that is bound by them.
    fn lookups(&self) -> u32;
    /// A copy behind a pointer.
    fn boxed(&self) -> Box<dyn Technique>;
}

impl Clone for Box<dyn Technique> {
    fn clone(&self) -> Self {
        self.boxed()
    }
}

/// Checks every setting of a technique.
///
/// # Errors
/// The first [`SettingError::OutOfRange`].
pub fn check(technique: &dyn Technique) -> Result<(), SettingError> {
    let name = technique.page().name;
    technique.boxed().parameters().iter().try_for_each(|p| p.check(name))
}

/// Sets one parameter by name.
///
/// # Errors
/// [`SettingError::UnknownParameter`], [`SettingError::OutOfRange`].
pub fn set(technique: &mut dyn Technique, name: &str, value: &str) -> Result<(), SettingError> {
    let page = technique.page();
    let mut parameters = technique.parameters();
    match parameters.iter_mut().find(|p| p.name == name) {
        Some(parameter) => parameter.set(page.name, value),
        None => Err(SettingError::UnknownParameter {
            technique: page.name.into(),
            name: name.into(),
            known: parameters.iter().map(|p| p.name.into()).collect(),
        }),
    }
}

/// Reads `name` or `name.parameter=value,parameter=value`, starting from the defaults.
///
/// # Errors
/// [`SettingError`]: unknown name or parameter, value out of range, syntax.
pub fn parse(spec: &str) -> Result<Box<dyn Technique>, SettingError> {
    let (name, settings) = spec.split_once('.').unwrap_or((spec, ""));
    let Some(mut technique) = all().into_iter().find(|t| t.page().name == name) else {
        let known = all().iter().map(|t| t.page().name.to_string()).collect();
        return Err(SettingError::UnknownTechnique { name: name.into(), known });
    };
    for setting in settings.split(',').filter(|s| !s.is_empty()) {
        let (key, value) = setting.split_once('=').ok_or_else(|| SettingError::Syntax {
            spec: spec.into(),
            reason: format!("'{setting}' has no '='"),
        })?;
        set(technique.as_mut(), key.trim(), value.trim())?;
    }
    Ok(technique)
}

/// The text that [`parse`] would read to get this technique: its name and what differs from the
/// defaults.
#[must_use]
pub fn spec(technique: &dyn Technique) -> String {
    let name = technique.page().name;
    let mut plain = parse(name).unwrap_or_else(|_| technique.boxed());
    let plain: Vec<String> = plain.parameters().iter().map(Parameter::value).collect();
    let mut this = technique.boxed();
    let changed: Vec<String> = std::iter::zip(this.parameters(), plain)
        .filter(|(p, default)| p.value() != *default)
        .map(|(p, _)| format!("{}={}", p.name, p.value()))
        .collect();
    if changed.is_empty() { name.to_string() } else { format!("{name}.{}", changed.join(",")) }
}

/// Declares the modules and [`all`]: one line per technique.
macro_rules! techniques {
    ($($module:ident :: $name:ident),+ $(,)?) => {
        $(pub mod $module; pub use $module::$name;)+

        /// Every technique with its default settings, in the order in which tables list them.
        #[must_use]
        pub fn all() -> Vec<Box<dyn Technique>> {
            vec![$(Box::new($name::default())),+]
        }
    };
}

techniques! {
    hard::Hard,
    pcf::Pcf,
    poisson::Poisson,
    bicubic::Bicubic,
    footprint::Footprint,
    packed::Packed,
    stratified::Stratified,
    vsm::Vsm,
    csm::Csm,
    esm::Esm,
    evsm::Evsm,
    msm::Msm,
    lvsm::Lvsm,
    rgsm::Rgsm,
    spsm::Spsm,
    dpm::Dpm,
    exact::Exact,
}
