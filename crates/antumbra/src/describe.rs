//! What a shadow technique is: a trait of five methods, and the data that one of them returns.
//!
//! A [`Technique`] holds no GPU object. [`Technique::describe`] says once, for a device, which texels it keeps
//! ([`Map`]), how they are filtered ([`Pass`]), what its WGSL reads ([`Binding`], [`Uniform`], [`Constant`])
//! and whatever else a [`ShadowMap`](crate::ShadowMap) has to know, as one [`Description`].

use crate::{capabilities::Capabilities, error::Unsupported, parameter::Parameter};
use std::fmt::Debug;

mod description;
pub(crate) mod map;
mod storage;
pub(crate) mod store;
pub(crate) mod wgsl;

pub use description::Description;
pub use map::{Access, Combine, Encode, Map, Pass};
pub use storage::{CasterStorage, Coverage};
pub use wgsl::{Binding, Class, Constant, DepthSpace, Uniform};

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

/// Name and origin of a technique.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct About {
    /// The stem of its files and WGSL functions.
    pub name: &'static str,
    /// Its usual name.
    pub title: &'static str,
    /// Its family.
    pub family: Family,
    /// Who published it.
    pub paper: &'static str,
}

/// A shadow technique: public fields are its settings, [`describe`](Self::describe) says what follows from
/// them on a device.
///
/// # Your own
/// Everything that the library does with a technique follows from its [`Description`]. The presets
/// ([`comparison`](Description::comparison), [`stored_depth`](Description::stored_depth),
/// [`filtered`](Description::filtered), [`triangles`](Description::triangles)) are what most techniques have
/// in common; change the public fields that differ:
///
/// ```
/// use antumbra::{
///     Capabilities, Field, Options, Parameter, Precision, ShaderText, Size, Technique, Unsupported, wgpu,
///     technique::{About, Description, Family},
/// };
///
/// /// The standard shadow map with shadows that are not black.
/// #[derive(Debug, Clone)]
/// struct Pale {
///     darkness: f32,
/// }
///
/// impl Technique for Pale {
///     fn about(&self) -> About {
///         About { name: "pale", title: "Pale shadow map", family: Family::Comparison, paper: "none" }
///     }
///     fn parameters(&mut self) -> Vec<Parameter<'_>> {
///         let field = Field::Number(&mut self.darkness, 0.0..=1.0);
///         vec![Parameter::new("darkness", "", field, "share of the light that shadows take")]
///     }
///     fn describe(&self, _device: &Capabilities) -> Result<Description, Unsupported> {
///         let wgsl = "
///             fn pale_visibility(casters: texture_depth_2d_array, compare: sampler_comparison, uv: vec2f,
///                 view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
///                 let lit = textureSampleCompareLevel(casters, compare, uv, view, depth);
///                 return 1.0 - pale_darkness() * (1.0 - lit);
///             }";
///         let nearest = wgpu::FilterMode::Nearest;
///         let mut described = Description::comparison(self.about(), wgsl, nearest, Precision::Float32);
///         described.uniforms = vec![("darkness", self.darkness)];
///         Ok(described)
///     }
///     fn clone_box(&self) -> Box<dyn Technique> {
///         Box::new(self.clone())
///     }
/// }
///
/// // `ShadowMap::new(&device, &Pale { darkness: 0.7 }, …)` takes it; what it composes needs no device:
/// let options = Options::from(Size::square(1024));
/// let wgsl = ShaderText::receiver(&Pale { darkness: 0.7 }, &Capabilities::full(), &options, 2)?;
/// assert!(wgsl.text().contains("fn shadow_pale_darkness() -> f32"));
/// # Ok::<(), Unsupported>(())
/// ```
///
/// # Its WGSL
/// For a technique named `x` it defines
/// `x_visibility(bindings…, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32`,
/// from 0 (in shadow) to 1 (lit):
/// - `bindings…`, the textures and samplers of [`Description::bindings`];
/// - `uv` in the map, y down; `depth` of the receiver, bias applied, in [`Description::depth_space`];
/// - `plane`, the depth that the receiver's plane gains per unit of `uv` (in the comparison family as
///   [`BiasTerms::receiver_plane`](crate::technique::BiasTerms::receiver_plane) says);
/// - `ddx`, `ddy`, the change of `uv` from this pixel to the next.
///
/// It reads texels where the view's lie, by functions of the file `tile`, which it needs: `tile_size(view) -> vec2f`, texels;
/// `tile_layer(view) -> u32`; `tile_uv(view, uv) -> vec2f` for samplers; `tile_texel(view, texel: vec2i) -> vec2i` for loads. Layer
/// `k` of the `n` that a map has for each view is `tile_layer(view) * n + k`. Without them views cannot be
/// [tiles](crate::Tile), which such maps refuse.
///
/// Functions that composition writes beside it, and that every function may call, read what is set at run
/// time: `x_NAME() -> f32` for each of [`Description::uniforms`], `x_NAME(view: u32) -> f32` for each of
/// [`Description::widths`], in the comparison family `uphill_lean(view: u32) -> vec2f`, the depth that a plane at right
/// angles to parallel light gains per unit of `uv`, and what comes with [`Description::blur`] and with what is kept of
/// casters ([`CasterStorage`]). If there are [classes](Description::classes) it also defines `x_class`, with
/// the same parameters. The first line may be `//! needs a b`: shared files, and slots that
/// [`Description::slots`] fill. What is compared with the casters' own depth goes through `stored_depth` (needs
/// `stored`) or `reference_depth` (needs `reference`), or else maps of [reversed](crate::Depth::reversed) depth are
/// refused. In users' modules all of these names begin with `shadow_`.
pub trait Technique: Debug + Send + Sync {
    /// Returns its name, title, family, paper.
    fn about(&self) -> About;
    /// Returns its settings, in the order in which they should be shown.
    fn parameters(&mut self) -> Vec<Parameter<'_>>;
    /// Describes what it keeps and reads on such a device, with these settings.
    ///
    /// # Errors
    /// [`Unsupported::Feature`] where the device cannot do what it needs.
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported>;
    /// Returns settings that take other ways through its code than the defaults do, each as
    /// [`parse`](crate::technique::parse) reads what follows the dot: what is worth testing.
    fn variants(&self) -> Vec<&'static str> {
        Vec::new()
    }
    /// Returns a copy behind a pointer.
    fn clone_box(&self) -> Box<dyn Technique>;
}

impl Clone for Box<dyn Technique> {
    fn clone(&self) -> Self {
        self.clone_box()
    }
}
