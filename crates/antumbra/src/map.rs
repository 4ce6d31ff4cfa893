//! The shadow map on the GPU: what is allocated, encoded and bound. Only `map/`, `cast/` and `pipelines.rs` create GPU objects.

use crate::{
    capabilities::Capabilities,
    capacity::Capacity,
    cast::{self, Cast, Plan},
    describe::{Description, Technique},
    light::{Size, View},
    memory::{Lifetime, Memory, MemoryItem},
    options::{DEPTH_FORMAT, NoProbe, Options, Probe},
    pipelines::Pipelines,
    shader::{Composition, ShaderText},
    tile::Tile,
};
use std::sync::atomic::{AtomicU32, Ordering};

mod adjust;
mod answer;
mod brought;
mod build;
mod check;
mod compile;
mod cutout;
mod draw;
mod encode;
mod explain;
mod prepare;
mod receiver;
mod textures;
mod uniforms;

pub use brought::Depth;
use draw::Draw;
pub use prepare::PrepareError;
use receiver::Samplers;
use textures::Textures;
use uniforms::Uniforms;

/// Textures, pipelines and bindings of one technique at one size.
///
/// Each frame: [`prepare`](Self::prepare) with the light's views, [`encode`](Self::encode) with a
/// closure that draws the casters, then bind [`bind_group`](Self::bind_group) wherever a shader
/// made with [`wgsl`](Self::wgsl) calls `shadow_visibility`. Nothing is allocated on the GPU after
/// `new`; nothing is submitted, polled or read back.
#[derive(Debug)]
pub struct ShadowMap {
    technique: Box<dyn Technique>,
    composition: Composition,
    capabilities: Capabilities,
    options: Options,
    textures: Textures,
    uniforms: Uniforms,
    /// Of each layer.
    draws: Vec<Vec<Draw>>,
    /// What the casters leave, beside depth and maps.
    cast: Box<dyn Cast>,
    /// Ids that the last casters took.
    drawn: AtomicU32,
    samplers: Samplers,
    layout: wgpu::BindGroupLayout,
    bind_group: wgpu::BindGroup,
    views: Vec<View>,
    /// Where the views lie, and those of a frame that is not taken yet.
    tiles: Vec<Tile>,
    next_tiles: Vec<Tile>,
    /// One per view and caster pass.
    caster_views: Vec<View>,
}

impl ShadowMap {
    /// Two `u32` per layer, which is a view's unless views are tiles, usage `COPY_SRC`, for techniques whose storage is
    /// [`CasterStorage::ABuffer`](crate::technique::CasterStorage::ABuffer): entries that the casters of the last
    /// [`encode`](Self::encode) needed, of the `width · height` times [`Capacity::triangles_per_texel`] that
    /// there is memory for; length of the longest list.
    #[must_use]
    pub fn abuffer_totals(&self) -> Option<&wgpu::Buffer> {
        self.cast.totals()
    }

    /// Ids that the last [`encode`](Self::encode) gave to triangles in the view with most, where the technique
    /// [keeps them by id](crate::technique::CasterStorage::keeps_ids): one for each triangle that was drawn, two
    /// under a spot, which may cut it in two, and those of triangles before the first that was drawn. What is
    /// beyond [`Capacity::triangles`] casts no shadow. Else 0.
    #[must_use]
    pub fn triangles_drawn(&self) -> u32 {
        self.drawn.load(Ordering::Relaxed)
    }

    /// The views that [`encode`](Self::encode) asks the casters for, in order: those of
    /// [`prepare`](Self::prepare), or several for each of them, shifted by fractions of a texel
    /// ([`Description::sample_offsets`]).
    #[must_use]
    pub fn caster_views(&self) -> &[View] {
        &self.caster_views
    }

    /// The views of the last [`prepare`](Self::prepare).
    #[must_use]
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// Whether its lookups ask about cut-outs: [`Options::cutouts`], where the technique keeps triangles by id.
    #[must_use]
    pub fn asks_about_cutouts(&self) -> bool {
        self.composition.asks
    }

    /// Layout of [`bind_group`](Self::bind_group), visible to fragment and compute shaders.
    #[must_use]
    pub fn layout(&self) -> &wgpu::BindGroupLayout {
        &self.layout
    }

    /// What `shadow_visibility` reads. Stays the same for the life of the map.
    #[must_use]
    pub fn bind_group(&self) -> &wgpu::BindGroup {
        &self.bind_group
    }

    /// `shadow_visibility(position, normal, ddx, ddy) -> f32` with all it needs, bound in `group`: the share of
    /// the light, 0 to 1, that reaches a position in world space; 1 outside every view. `normal` is that
    /// of the facet, of unit length, either side, not interpolated or bumped; `ddx` and `ddy` are the change of
    /// position from this pixel to the next. What has no surface, such as fog, passes the direction
    /// towards the light, and zeros. Where the map has [room for several lights](Options::lights) the number of one comes
    /// first: `shadow_visibility(light, position, normal, ddx, ddy)`; a light without views, or with a number that no light
    /// has, lights everything.
    ///
    /// If it [asks about cut-outs](Self::asks_about_cutouts) the user's shader defines
    /// `shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool`, with her own bindings: whether a
    /// triangle that [`cutout_caster`](Self::cutout_caster) drew stops light where its corners have these
    /// weights, 0 to 1, sum 1. `triangle` is counted from the first index of its mesh, `tag` is what her
    /// `caster_tag` said of it.
    #[must_use]
    pub fn wgsl(&self, group: u32) -> ShaderText {
        self.wgsl_at(group, 0)
    }

    /// [`wgsl`](Self::wgsl) for [`bind_group_entries`](Self::bind_group_entries) that begin at `@binding(first)`.
    #[must_use]
    pub fn wgsl_at(&self, group: u32, first: u32) -> ShaderText {
        self.composition.receiver(|group, first| self.plan().lookups(group, first), (group, first))
    }

    /// What its store is planned like.
    pub(crate) fn plan(&self) -> Box<dyn Plan + '_> {
        cast::plan(&self.composition, &self.capabilities, &self.options)
    }

    /// What the casters leave on the GPU.
    pub(crate) fn cast(&self) -> &dyn Cast {
        self.cast.as_ref()
    }

    /// Memory for triangles that it was made with.
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.options.capacity
    }

    /// The technique that it was made for.
    #[must_use]
    pub fn technique(&self) -> &dyn Technique {
        self.technique.as_ref()
    }

    /// What the technique said of itself on this device, once: what everything here is made from.
    #[must_use]
    pub fn description(&self) -> &Description {
        &self.composition.description
    }

    /// Where the views of the last [`prepare`](Self::prepare) lie.
    #[must_use]
    pub fn tiles(&self) -> &[Tile] {
        &self.tiles
    }

    /// Texels of each layer, and of each view that has one of its own.
    #[must_use]
    pub fn size(&self) -> Size {
        self.options.size
    }

    /// Whether a view's depth should lean ([`Fit::lean`](crate::Fit)).
    #[must_use]
    pub fn leans(&self) -> bool {
        self.description().leans()
    }

    /// Free texels that a view should leave on each side ([`Fit::margin_texels`](crate::Fit)).
    #[must_use]
    pub fn margin_texels(&self) -> f32 {
        self.description().margin_texels()
    }

    /// Entry `index` of [`Description::maps`] as allocated, for debug views: what lies in layer `l` of the map starts at
    /// layer `l · layers`. Usages `TEXTURE_BINDING` and `COPY_SRC`. `None` if the technique keeps fewer.
    #[must_use]
    pub fn map_texture(&self, index: usize) -> Option<&wgpu::Texture> {
        self.textures.maps().get(index).map(|map| &map.texture)
    }

    /// Names of the passes between casting and lighting, in order, for each view: what
    /// [`Probe::pass`] hears after `cast`.
    #[must_use]
    pub fn passes(&self) -> Vec<&'static str> {
        let filters = self.draws.first().into_iter().flatten().map(|draw| draw.label);
        self.cast.passes().into_iter().chain(filters).collect()
    }

    /// Every texture and buffer that was allocated, mips included.
    #[must_use]
    pub fn memory(&self) -> Memory {
        let mut memory = self.textures.memory(&self.uniforms);
        memory.items.extend(self.cast.memory());
        memory
    }

    /// Which formats and paths were chosen on this device, one sentence each.
    #[must_use]
    pub fn explain(&self) -> Vec<String> {
        explain::lines(self.description(), &self.capabilities, &self.options, self.cast.explain())
    }
}
