//! How a shadow map is made, and who listens to its passes.

use crate::{bias::Bias, capacity::Capacity, light::Size, pipelines::Pipelines};

/// Format of the depth that casters draw into.
pub const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// How a [`ShadowMap`](crate::ShadowMap) is made. A [`Size`] alone is enough.
#[derive(Debug, Clone)]
pub struct Options {
    /// Texels of each layer, and so of each view that is not [placed](crate::View::at) in a part of one.
    pub size: Size,
    /// Most views (cascades) at a time, of all lights, at least 1.
    pub views: u32,
    /// Most lights at a time, at least 1. With more than one, `shadow_visibility` takes the number of a light first
    /// ([`ShadowMap::prepare_lights`](crate::ShadowMap::prepare_lights)).
    pub lights: u32,
    /// Layers in which views lie as [tiles](crate::Tile); none for a layer for each view.
    pub layers: Option<u32>,
    /// Against shadows of a surface on itself.
    pub bias: Bias,
    /// Share it between maps, so that no shader is compiled twice.
    pub pipelines: Option<Pipelines>,
    /// Memory for triangles, where the technique keeps them by id.
    pub capacity: Capacity,
    /// Whether lookups of techniques that keep triangles by id ask the user's shader about the holes of
    /// cut-outs, where the light's ray meets their triangles ([`ShadowMap::wgsl`](crate::ShadowMap::wgsl)). Else holes are as coarse as
    /// texels. Takes 48 bytes more for each triangle of the capacity. Other techniques ignore it.
    pub cutouts: bool,
    /// Whether views may be warped ([`View::is_warped`](crate::View::is_warped)): maps that are filtered then take a
    /// fifth longer to be made.
    pub warped: bool,
}

impl From<Size> for Options {
    fn from(size: Size) -> Self {
        Self {
            size,
            views: 1,
            lights: 1,
            layers: None,
            bias: Bias::Auto,
            pipelines: None,
            capacity: Capacity::default(),
            cutouts: false,
            warped: false,
        }
    }
}

impl Options {
    /// The same with room for that many views.
    #[must_use]
    pub fn views(self, views: u32) -> Self {
        Self { views, ..self }
    }
    /// The same with room for that many lights.
    #[must_use]
    pub fn lights(self, lights: u32) -> Self {
        Self { lights, ..self }
    }
    /// The same with views in [tiles](crate::Tile) of so many layers.
    #[must_use]
    pub fn tiled(self, layers: u32) -> Self {
        Self { layers: Some(layers), ..self }
    }
    /// Layers of its textures, for each that a technique keeps.
    pub(crate) fn layer_count(&self) -> u32 {
        self.layers.unwrap_or(self.views)
    }
    /// The same with that bias.
    #[must_use]
    pub fn bias(self, bias: Bias) -> Self {
        Self { bias, ..self }
    }
    /// The same with shared pipelines.
    #[must_use]
    pub fn pipelines(self, pipelines: &Pipelines) -> Self {
        Self { pipelines: Some(pipelines.clone()), ..self }
    }
    /// The same with memory for so many triangles.
    #[must_use]
    pub fn capacity(self, capacity: Capacity) -> Self {
        Self { capacity, ..self }
    }
    /// The same for views that may be warped, or that may not.
    #[must_use]
    pub fn warped(self, warped: bool) -> Self {
        Self { warped, ..self }
    }
    /// The same with lookups that ask about cut-outs, or without.
    #[must_use]
    pub fn cutouts(self, cutouts: bool) -> Self {
        Self { cutouts, ..self }
    }
}

/// Hears of every render pass that is encoded; may attach timestamps to it.
pub trait Probe {
    /// Called before the pass `label` (`cast`, `convert`, `blur`, `mips`) of view `view`.
    fn pass(&mut self, label: &'static str, view: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>>;
}

/// A probe that measures nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct NoProbe;

impl Probe for NoProbe {
    fn pass(&mut self, _: &'static str, _: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        None
    }
}
