//! The shadow map on the GPU. Only this file and those in `map/` create GPU objects.

use crate::{
    capabilities::Capabilities,
    describe::{Description, Technique},
    light::{Size, View},
    shader::{Composition, MapSize, ShaderText},
};
use glam::Vec2;
use std::sync::atomic::{AtomicU32, Ordering};
use wgpu::TextureFormat;

mod answer;
mod build;
mod capacity;
mod cast;
mod caster;
mod check;
mod cutout;
mod draw;
mod encode;
mod explain;
mod lists;
mod memory;
mod mesh;
mod numbered;
mod options;
mod pieces;
mod pipelines;
mod ranked;
mod receiver;
mod textures;
mod uniforms;

pub use capacity::Capacity;
pub(crate) use capacity::splits;
pub use cast::CasterPass;
use caster::TriangleCaster;
pub use cutout::CutoutCaster;
use draw::Draw;
use lists::Lists;
pub use memory::{Lifetime, Memory, MemoryItem};
pub use mesh::{CasterMesh, MeshPart};
pub use options::{NoProbe, Options, Probe, TooManyViews};
pub use pipelines::Pipelines;
use ranked::RankedTriangles;
use textures::Textures;
use uniforms::Uniforms;

/// Format of the depth that casters draw into.
pub const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

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
    size: Size,
    room: u32,
    capacity: Capacity,
    textures: Textures,
    uniforms: Uniforms,
    draws: Vec<Vec<Draw>>,
    /// For techniques whose casters are triangles.
    triangles: Option<TriangleCaster>,
    /// For those that keep all of them.
    lists: Option<Lists>,
    /// For those that keep the first ones by rank.
    ranked: Option<RankedTriangles>,
    /// Triangles that they were given.
    drawn: AtomicU32,
    layout: wgpu::BindGroupLayout,
    bind_group: wgpu::BindGroup,
    views: Vec<View>,
    /// One per view and caster pass.
    caster_views: Vec<View>,
}

impl ShadowMap {
    /// Takes the light's views for this frame, nearest first; the first that contains a receiver
    /// is the one that shades it. Without any everything is lit.
    ///
    /// Writes buffers through the queue: what is submitted next sees what was written last, so two cameras
    /// or two lights in one submission take two maps.
    ///
    /// # Errors
    /// [`TooManyViews`], and then the previous views stay.
    pub fn prepare(&mut self, queue: &wgpu::Queue, views: &[View]) -> Result<(), TooManyViews> {
        if views.len() > self.room as usize {
            return Err(TooManyViews { given: views.len(), room: self.room as usize });
        }
        self.views.clear();
        self.views.extend_from_slice(views);
        self.caster_views.clear();
        let jittered = |view: &View, offset: Vec2| view.jittered(self.size, offset);
        let offsets = &self.composition.description.sample_offsets;
        self.caster_views
            .extend(views.iter().flat_map(|view| offsets.iter().map(move |o| jittered(view, *o))));
        self.uniforms.write(queue, views);
        if let Some(triangles) = &self.triangles {
            triangles.write(queue, views);
        }
        if let Some(numbered) = self.numbered() {
            numbered.write(queue, views);
        }
        Ok(())
    }

    /// Two `u32` per view, usage `COPY_SRC`, for techniques whose caster is [`Caster::Lists`](crate::technique::Caster::Lists): entries
    /// that the casters of the last [`encode`](Self::encode) needed, of the `width · height` times
    /// [`Capacity::triangles_per_texel`] that there is memory for; length of the longest list.
    #[must_use]
    pub fn list_totals(&self) -> Option<&wgpu::Buffer> {
        self.lists.as_ref().map(Lists::totals)
    }

    /// Numbers that the last [`encode`](Self::encode) gave to triangles in the view with most, for
    /// techniques whose caster is [`Caster::Lists`](crate::technique::Caster::Lists) or [`Caster::Ranked`](crate::technique::Caster::Ranked): one for each triangle that was
    /// drawn, two under a spot, which may cut it in two, and those of triangles before the first that was
    /// drawn. What is beyond [`Capacity::triangles`] casts no shadow. Else 0.
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
    /// towards the light, and zeros.
    ///
    /// If it [asks about cut-outs](Self::asks_about_cutouts) the user's shader defines
    /// `shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool`, with her own bindings: whether a
    /// triangle that [`cutout_caster`](Self::cutout_caster) drew stops light where its corners have these
    /// weights, 0 to 1, sum 1. `triangle` is counted from the first index of its mesh, `tag` is what her
    /// `caster_tag` said of it.
    #[must_use]
    pub fn wgsl(&self, group: u32) -> ShaderText {
        let size = MapSize {
            views: self.room,
            capacity: self.capacity,
            splits: self.ranked.as_ref().map(RankedTriangles::splits).unwrap_or_default(),
        };
        self.composition.receiver(size, group)
    }

    /// Memory for triangles that it was made with.
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.capacity
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

    /// Texels of each view.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Free texels that a view should leave on each side ([`Fit::margin_texels`](crate::Fit)).
    #[must_use]
    pub fn margin_texels(&self) -> f32 {
        self.description().margin_texels()
    }

    /// Entry `index` of [`Description::maps`] as allocated, for debug views: view `v` starts at layer
    /// `v · layers`. Usages `TEXTURE_BINDING` and `COPY_SRC`. `None` if the technique keeps fewer.
    #[must_use]
    pub fn map_texture(&self, index: usize) -> Option<&wgpu::Texture> {
        self.textures.maps().get(index).map(|map| &map.texture)
    }

    /// Names of the passes between casting and lighting, in order, for each view: what
    /// [`Probe::pass`] hears after `cast`.
    #[must_use]
    pub fn passes(&self) -> Vec<&'static str> {
        if self.lists.is_some() {
            return vec!["scan", "cast"];
        }
        self.draws.first().map(|view| view.iter().map(|draw| draw.label).collect()).unwrap_or_default()
    }

    /// Every texture and buffer that was allocated, mips included.
    #[must_use]
    pub fn memory(&self) -> Memory {
        let mut memory = self.textures.memory(&self.uniforms);
        memory.items.extend(self.triangles.as_ref().map(TriangleCaster::memory));
        memory.items.extend(self.lists.iter().flat_map(Lists::memory));
        memory.items.extend(self.ranked.iter().flat_map(RankedTriangles::memory));
        memory
    }

    /// Which formats and paths were chosen on this device, one sentence each.
    #[must_use]
    pub fn explain(&self) -> Vec<String> {
        let triangles = self.lists.as_ref().map(Lists::explain);
        let triangles = triangles.or_else(|| self.ranked.as_ref().map(RankedTriangles::explain));
        explain::lines(self.description(), &self.capabilities, triangles)
    }
}
