//! A technique with its settings on a device, as data.

use super::{
    About, Binding, CasterStorage, Class, Constant, DepthSpace, Family, Uniform,
    map::{Encode, Map},
};
use crate::{
    bias::BiasTerms,
    error::DescriptionError,
    kernel::{Adaptive, Width},
};
use glam::Vec2;
use std::borrow::Cow;

/// Everything that follows from a technique and its settings on a device.
///
/// It is plain data: take a preset, or [`new`](Self::new), and change its fields.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Description {
    /// What it describes.
    pub about: About,
    /// The technique's WGSL: the file beside the Rust file.
    pub wgsl: Cow<'static, str>,
    /// Files that fill the slots which the WGSL, or what it needs, leaves open, such as the lookup that the
    /// sampling setting chooses: `lookup_fitted` fills `lookup`.
    pub slots: Vec<&'static str>,
    /// Numbers that are compiled into the WGSL.
    pub constants: Vec<Constant>,
    /// Numbers that are set at run time, which the WGSL reads as `x_name() -> f32`.
    pub uniforms: Vec<Uniform>,
    /// Kernel widths in texels, which the WGSL reads as `x_name(view: u32) -> f32`: each view has its own.
    pub widths: Vec<(&'static str, Width)>,
    /// The blur of the maps, if the WGSL asks `shadow_blur(view: u32) -> f32` for its variance in a
    /// view, in squares of texels.
    pub blur: Option<Adaptive>,
    /// What is kept of the casters.
    pub storage: CasterStorage,
    /// Where within a texel the casters are sampled: one caster pass per view for each offset, in texels
    /// from the centre, y down. Several passes fill the channels of the first map in turn, layer by
    /// layer, each with what the encode function makes of its depth.
    pub sample_offsets: Vec<Vec2>,
    /// The textures that it keeps; none where receivers compare the casters' own depth.
    pub maps: Vec<Map>,
    /// What the visibility function reads, in parameter order.
    pub bindings: Vec<Binding>,
    /// The depth that the visibility function compares.
    pub depth_space: DepthSpace,
    /// Step in which depth is stored, as a share of the depth range; 0 for floats.
    pub depth_quantum: f32,
    /// What [`Bias::Auto`](crate::technique::Bias::Auto) stands for.
    pub bias: BiasTerms,
    /// Half the width of the kernel: how far outside a point's own texel a lookup may read, in
    /// texels. Views leave that much margin.
    pub filter_radius_texels: f32,
    /// Kinds of pixels that it tells apart. If there are any, the WGSL also defines `x_class`, with
    /// the parameters of `x_visibility`, which returns 0 (none of them) or 1 + the index here, and
    /// [`ShadowMap::wgsl`](crate::ShadowMap::wgsl) gives `shadow_class`.
    pub classes: &'static [Class],
    /// Largest error that ringing and quantisation leave where the shadow test is clear-cut: the
    /// visibility deep behind a full blocker is at most this, in the open at least one minus this.
    pub ringing: f32,
    /// How far behind a blocker that fills the kernel its shadow may not be complete yet, nor light in front of
    /// it, as a share of the depth range: where the shadow test is clear-cut begins there.
    pub ramp: f32,
    /// Largest change of the visibility where what is stored and filtered changes by the last bits of 32-bit
    /// floats, as between filters that sum in another order. Where variances are small, moments magnify it.
    pub rounding: f32,
    /// Whether the visibility never rises with the receiver's depth, up to ringing. It may where a technique
    /// chooses between several ways to answer by depth.
    pub monotonic: bool,
    /// Texture fetches of the visibility function for a pixel that its filters do not stretch; an
    /// interpolated one counts once. What a pixel costs on hardware that is bound by them.
    pub fetches: u32,
    /// What it does otherwise than set because the device cannot, one sentence each, for
    /// [`ShadowMap::explain`](crate::ShadowMap::explain).
    pub notes: Vec<String>,
}

impl Description {
    /// Casters leave depth, nothing is kept of it or read, and one fetch is counted.
    #[must_use]
    pub fn new(about: About, wgsl: impl Into<Cow<'static, str>>) -> Self {
        Self {
            about,
            wgsl: wgsl.into(),
            slots: Vec::new(),
            constants: Vec::new(),
            uniforms: Vec::new(),
            widths: Vec::new(),
            blur: None,
            storage: CasterStorage::Depth,
            sample_offsets: vec![Vec2::ZERO],
            maps: Vec::new(),
            bindings: Vec::new(),
            depth_space: DepthSpace::Linear,
            depth_quantum: 0.0,
            bias: BiasTerms::NONE,
            filter_radius_texels: 0.5,
            classes: &[],
            ringing: 0.0,
            ramp: 0.0,
            rounding: 1e-4,
            monotonic: true,
            fetches: 1,
            notes: Vec::new(),
        }
    }

    /// Keeps triangles in that way, and reads them: a map of whole numbers, or what a store keeps by id. Depth is
    /// projected, in which triangles are planes under any light.
    #[must_use]
    pub fn triangles(about: About, wgsl: impl Into<Cow<'static, str>>, storage: CasterStorage) -> Self {
        let kept = Self { storage, depth_space: DepthSpace::Raster, ..Self::new(about, wgsl) };
        match storage {
            CasterStorage::Depth => Self { bindings: vec![Binding::Depth], ..kept },
            CasterStorage::NearestTriangle(layers) => {
                let encode = Encode::Texel("packing_texel");
                let map = Map::new("triangles", wgpu::TextureFormat::Rgba32Uint, encode);
                Self {
                    maps: vec![Map { layers: layers.len() as u32, ..map }],
                    bindings: vec![Binding::Map(0)],
                    bias: BiasTerms { constant_texels: 0.05, slope_texels: 0.05, ..BiasTerms::NONE },
                    ..kept
                }
            }
            // Distance of 32-bit floats below 1, where a spot's projected depths crowd.
            _ => Self { bias: BiasTerms::RAYS, depth_quantum: f32::EPSILON / 2.0, ..kept },
        }
    }

    /// Free texels that a view should leave on each side.
    #[must_use]
    pub fn margin_texels(&self) -> f32 {
        self.filter_radius_texels.ceil() + 1.0
    }

    /// Whether a view's depth should lean: where depth is filtered, or has steps. Comparisons of floats gain nothing, and
    /// those of several texels at once are coarser where depth leans.
    #[must_use]
    pub fn leans(&self) -> bool {
        self.about.family == Family::Basis || self.depth_quantum > 0.0
    }

    /// Whether receivers compare the casters' own depth.
    pub(crate) fn reads_depth(&self) -> bool {
        self.bindings.contains(&Binding::Depth)
    }

    /// Receivers compare depth that a renderer brings, in steps of `quantum`, whose ends may be reversed.
    pub(crate) fn bring(&mut self, quantum: f32, reversed: bool) {
        if self.depth_space == DepthSpace::Raster {
            self.depth_quantum = self.depth_quantum.max(quantum);
            self.slots.extend(reversed.then_some("stored_reversed"));
        }
    }

    /// Whether its parts agree.
    pub(crate) fn check(&self) -> Result<(), DescriptionError> {
        if self.sample_offsets.is_empty() {
            return Err(DescriptionError::SampleOffsets);
        }
        let maps = self.maps.len();
        for binding in &self.bindings {
            match *binding {
                Binding::Map(index) if index >= maps => return Err(DescriptionError::Map { index, maps }),
                Binding::Map(_) | Binding::Depth | Binding::Compare(_) | Binding::Sampler => {}
            }
        }
        self.check_storage()?;
        // Four passes share a layer.
        let (passes, layers) = (self.sample_offsets.len(), self.maps.first().map_or(0, |map| map.layers));
        if passes > 1 && passes.div_ceil(4) > layers as usize {
            return Err(DescriptionError::Layers { passes, layers });
        }
        Ok(())
    }

    /// Whether what is kept of casters is drawn and stored as it can be.
    fn check_storage(&self) -> Result<(), DescriptionError> {
        let passes = self.sample_offsets.len();
        if self.storage != CasterStorage::Depth && passes > 1 {
            return Err(DescriptionError::Passes { passes });
        }
        match (self.storage, self.maps.as_slice()) {
            (CasterStorage::NearestTriangle(coverages), maps) if !matches!(maps, [map] if map.layers as usize == coverages.len()) => {
                Err(DescriptionError::Nearest { layers: coverages.len() })
            }
            _ => Ok(()),
        }
    }
}
