//! The shadow map on the GPU. Only this file and those in `map/` create GPU objects.

use crate::{
    capabilities::Capabilities,
    error::{CasterError, Unsupported},
    light::{Size, View},
    pass,
    shader::{self, Cutout, ShaderText},
    technique::{self, Bias, Binding, Caster, Technique},
};
use glam::Vec2;
use std::sync::atomic::{AtomicU32, Ordering};
use wgpu::TextureFormat;

mod answer;
mod capacity;
mod cast;
mod caster;
mod check;
mod draw;
mod explain;
mod lists;
mod memory;
mod mesh;
mod numbered;
mod pieces;
mod pipelines;
mod ranked;
mod receiver;
mod textures;
mod uniforms;

use answer::Refusal;
pub use capacity::Capacity;
pub(crate) use capacity::splits;
pub use cast::CasterPass;
use cast::Drawn;
use caster::TriangleCaster;
use draw::Draw;
use lists::{ListSize, Lists};
pub use memory::{Lifetime, Memory, MemoryItem};
pub use mesh::{CasterMesh, MeshPart};
use numbered::Numbered;
pub use pipelines::Pipelines;
use ranked::{RankedSize, RankedTriangles};
use textures::Textures;
use uniforms::Uniforms;

/// Format of the depth that casters draw into.
pub const DEPTH_FORMAT: TextureFormat = TextureFormat::Depth32Float;

/// How a [`ShadowMap`] is made. A [`Size`] alone is enough.
#[derive(Debug, Clone)]
pub struct Options {
    /// Texels of each view.
    pub size: Size,
    /// Most views (cascades) at a time, at least 1.
    pub views: u32,
    /// Against shadows of a surface on itself.
    pub bias: Bias,
    /// Share it between maps, so that no shader is compiled twice.
    pub pipelines: Option<Pipelines>,
    /// Memory for triangles, where the technique keeps them by id.
    pub capacity: Capacity,
    /// Whether lookups of techniques that keep triangles by id ask the user's shader about the holes of
    /// cut-outs, where the light's ray meets their triangles ([`ShadowMap::wgsl`]). Else holes are as coarse as
    /// texels. Takes 48 bytes more for each triangle of the capacity. Other techniques ignore it.
    pub cutouts: bool,
}

impl From<Size> for Options {
    fn from(size: Size) -> Self {
        Self {
            size,
            views: 1,
            bias: Bias::Auto,
            pipelines: None,
            capacity: Capacity::default(),
            cutouts: false,
        }
    }
}

impl Options {
    /// The same with room for that many views.
    #[must_use]
    pub fn views(self, views: u32) -> Self {
        Self { views, ..self }
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

/// More views than the map was made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("{given} views for a shadow map that was made for {room}; see Options::views")]
pub struct TooManyViews {
    /// Views given.
    pub given: usize,
    /// Views that there is room for.
    pub room: usize,
}

/// Textures, pipelines and bindings of one technique at one size.
///
/// Each frame: [`prepare`](Self::prepare) with the light's views, [`encode`](Self::encode) with a
/// closure that draws the casters, then bind [`bind_group`](Self::bind_group) wherever a shader
/// made with [`wgsl`](Self::wgsl) calls `shadow_visibility`. Nothing is allocated on the GPU after
/// `new`; nothing is submitted, polled or read back.
#[derive(Debug)]
pub struct ShadowMap {
    technique: Box<dyn Technique>,
    capabilities: Capabilities,
    size: Size,
    room: u32,
    capacity: Capacity,
    /// Whether lookups ask about cut-outs.
    asks: bool,
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
    jitter: Vec<Vec2>,
    /// One per view and caster pass.
    caster_views: Vec<View>,
}

impl ShadowMap {
    /// Allocates everything for casters that are drawn by [`encode`](Self::encode).
    ///
    /// # Errors
    /// [`Unsupported`]: size, number of views, settings, device, or its memory. In a browser, where devices
    /// answer later, a lack of memory goes to the caller's error scope or handler; see
    /// [`new_async`](Self::new_async).
    pub fn new(
        device: &wgpu::Device,
        technique: &dyn Technique,
        options: impl Into<Options>,
    ) -> Result<Self, Unsupported> {
        let options = options.into();
        let (map, refusal) = answer::ask_now(device, || Self::build(device, technique, &options, None));
        map?.unless(refusal)
    }

    /// [`new`](Self::new), which also waits for the answer of devices that do not answer at once: those of
    /// browsers.
    ///
    /// # Errors
    /// [`Unsupported`], a lack of memory in browsers too.
    pub async fn new_async(
        device: &wgpu::Device,
        technique: &dyn Technique,
        options: impl Into<Options>,
    ) -> Result<Self, Unsupported> {
        let options = options.into();
        let (map, refusal) = answer::ask(device, || Self::build(device, technique, &options, None));
        map?.unless(refusal.await)
    }

    /// Reads depth that the caller renders herself: a 2-D texture of any depth format (beside a
    /// stencil, the depth alone is read), one layer per view (and caster pass, in the order of
    /// [`caster_views`](Self::caster_views)), with usage `TEXTURE_BINDING`, z in
    /// `[0,1]` from near to far as
    /// [`View::clip_from_world`] gives it. `options.size` and `options.views` are taken from the
    /// texture. Use [`encode_filter`](Self::encode_filter) instead of `encode`.
    ///
    /// # Errors
    /// [`Unsupported::Depth`] if the texture cannot be read, else as [`new`](Self::new).
    pub fn from_depth(
        device: &wgpu::Device,
        technique: &dyn Technique,
        depth: &wgpu::Texture,
        options: impl Into<Options>,
    ) -> Result<Self, Unsupported> {
        let views = check::depth(depth, technique.jitter().len() as u32)?;
        let size = Size { width: depth.width(), height: depth.height() };
        let options = Options { size, views, ..options.into() };
        let (map, refusal) =
            answer::ask_now(device, || Self::build(device, technique, &options, Some(depth)));
        map?.unless(refusal)
    }

    /// Itself, unless the device refused what it is made of.
    fn unless(self, refusal: Option<Refusal>) -> Result<Self, Unsupported> {
        let technique = self.technique.page().name.to_string();
        match refusal {
            None => Ok(self),
            Some(Refusal::Memory) => {
                let Size { width, height } = self.size;
                let bytes = self.memory().items.iter().map(|item| item.bytes).sum();
                Err(Unsupported::Memory { technique, width, height, views: self.room, bytes })
            }
            Some(Refusal::Invalid(reason)) => Err(Unsupported::Refused { technique, reason }),
        }
    }

    fn build(
        device: &wgpu::Device,
        technique: &dyn Technique,
        options: &Options,
        depth: Option<&wgpu::Texture>,
    ) -> Result<Self, Unsupported> {
        technique::check(technique)?;
        let capabilities = Capabilities::of(device);
        let maps = technique.maps(&capabilities)?;
        check::device(device, technique, &maps, options)?;
        let pipelines = options.pipelines.clone().unwrap_or_else(|| Pipelines::new(device));
        check::caster(technique, &maps, depth)?;
        let triangles = match (technique.caster(), maps.first()) {
            (Caster::Triangles(coverages), Some(map)) => {
                let room = (options.size, options.views);
                Some(TriangleCaster::new(device, technique, coverages, map.format, room, &pipelines))
            }
            _ => None,
        };
        let lists = match technique.caster() {
            Caster::Lists => {
                let Options { size, views, capacity, cutouts, .. } = *options;
                let size = ListSize { size, views, capacity, cutouts };
                check::lists(device, technique, size)?;
                Some(Lists::new(device, technique, size, &pipelines))
            }
            _ => None,
        };
        let ranked = match technique.caster() {
            Caster::Ranked { keeps } => {
                let Options { size, views, capacity, cutouts, .. } = *options;
                let size = RankedSize { size, views, keeps, capacity, cutouts };
                check::ranked(device, technique, size)?;
                Some(RankedTriangles::new(device, technique, size, &pipelines))
            }
            _ => None,
        };
        let compares = technique.bindings().contains(&Binding::Depth);
        let jitter = technique.jitter();
        let casting = (compares, jitter.len() as u32);
        let textures = Textures::new(device, &capabilities, &maps, options, depth, casting);
        options.bias.check()?;
        let uniforms = Uniforms::new(device, technique, &maps, options);
        let steps = pass::plan(technique, &capabilities, &maps, options.size);
        let draws = (0..options.views)
            .map(|view| {
                steps
                    .iter()
                    .map(|step| Draw::new(&pipelines, &textures, &uniforms, &maps, step, view))
                    .collect()
            })
            .collect();
        let (layout, bind_group) = receiver::group(
            device,
            technique,
            &capabilities,
            &textures,
            &uniforms,
            lists.as_ref(),
            ranked.as_ref(),
        );
        Ok(Self {
            technique: technique.boxed(),
            capabilities,
            size: options.size,
            room: options.views,
            capacity: options.capacity,
            asks: technique.caster().keeps_ids() && options.cutouts,
            textures,
            uniforms,
            draws,
            triangles,
            lists,
            ranked,
            drawn: AtomicU32::new(0),
            layout,
            bind_group,
            views: Vec::with_capacity(options.views as usize),
            caster_views: Vec::with_capacity(options.views as usize * jitter.len()),
            jitter,
        })
    }

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
        self.caster_views
            .extend(views.iter().flat_map(|view| self.jitter.iter().map(move |o| jittered(view, *o))));
        self.uniforms.write(queue, views);
        if let Some(triangles) = &self.triangles {
            triangles.write(queue, views);
        }
        if let Some(numbered) = self.numbered() {
            numbered.write(queue, views);
        }
        Ok(())
    }

    /// Draws the casters of every view and filters what they leave. `draw` gets the view, whose
    /// [`clip_from_world`](View::clip_from_world) places the casters, and a pass with a depth
    /// attachment of [`DEPTH_FORMAT`], cleared to 1, and no colour; casters in front of the near plane must be
    /// clamped (`unclipped_depth`) or moved ([`CASTER_WGSL`](crate::CASTER_WGSL)) onto it. A technique that draws them several
    /// times asks for each of [`caster_views`](Self::caster_views). If the technique's
    /// [`caster`](Technique::caster) is not [`Caster::Depth`], the pass has its pipeline and group 0 set, and
    /// `draw`, which is called once per layer of [`Caster::Triangles`], twice for [`Caster::Lists`], calls
    /// [`CasterMesh::draw`].
    ///
    /// # Errors
    /// [`CasterError`] if what was drawn is not what the technique keeps. All passes are encoded
    /// nevertheless, and nothing casts a shadow.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        draw: impl FnMut(&View, &mut CasterPass<'_>),
    ) -> Result<(), CasterError> {
        self.encode_probed(encoder, &mut NoProbe, draw)
    }

    /// [`encode`](Self::encode) with a probe in every pass.
    ///
    /// # Errors
    /// As `encode`.
    pub fn encode_probed(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        probe: &mut dyn Probe,
        mut draw: impl FnMut(&View, &mut CasterPass<'_>),
    ) -> Result<(), CasterError> {
        let mut drawn = Drawn::default();
        let mut draw = |view: &View, pass: &mut CasterPass<'_>| {
            draw(view, pass);
            drawn.add(pass);
        };
        let last = self.jitter.len() - 1;
        self.drawn.store(0, Ordering::Relaxed);
        for view in 0..self.views.len() {
            let (depth, seen) = (self.textures.caster_target(view, 0), (view, &self.views[view]));
            if let Some(lists) = &self.lists {
                lists.encode(encoder, seen, depth, probe, &mut draw);
            }
            if let Some(ranked) = &self.ranked {
                ranked.encode(encoder, seen, depth, probe, &mut draw);
            }
            if self.numbered().is_some() {
                self.drawn.fetch_max(caster::numbered(), Ordering::Relaxed);
                continue;
            }
            for cast in 0..=last {
                for layer in 0..self.triangles.as_ref().map_or(1, TriangleCaster::passes) {
                    self.encode_cast(encoder, (view, cast, layer), probe, &mut draw);
                }
                let follows = |draw: &Draw| draw.cast.map_or(last, |c| c as usize) == cast;
                self.encode_view_filter(encoder, view, follows, probe);
            }
        }
        drawn.check(self.technique.as_ref())
    }

    /// What casters that number triangles have in common.
    fn numbered(&self) -> Option<&Numbered> {
        let lists = self.lists.as_ref().map(Lists::numbered);
        lists.or_else(|| self.ranked.as_ref().map(RankedTriangles::numbered))
    }

    /// Filters depth that the caller has rendered ([`from_depth`](Self::from_depth)).
    pub fn encode_filter(&self, encoder: &mut wgpu::CommandEncoder, probe: &mut dyn Probe) {
        for view in 0..self.views.len() {
            self.encode_view_filter(encoder, view, |_| true, probe);
        }
    }

    fn encode_cast(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (view, cast, layer): (usize, usize, usize),
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&View, &mut CasterPass<'_>),
    ) {
        let target = self.triangles.is_some().then(|| self.textures.map_target(view, layer));
        let target = target.map(textures::written);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow cast"),
            color_attachments: if target.is_some() { std::slice::from_ref(&target) } else { &[] },
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: self.textures.caster_target(view, cast),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: probe.pass("cast", view),
            occlusion_query_set: None,
            multiview_mask: None,
        });
        if let Some(triangles) = &self.triangles {
            pass.set_pipeline(triangles.pipeline(&self.views[view], layer));
            pass.set_bind_group(0, triangles.group(view, layer), &[]);
        }
        let mut pass = CasterPass::new(pass, self.triangles.is_some());
        draw(&self.caster_views[view * self.jitter.len() + cast], &mut pass);
    }

    /// For casters with holes, where the technique's caster is not [`Caster::Depth`]: the pipeline to
    /// set in the closure of [`encode`](Self::encode) before such meshes are drawn, with the caller's
    /// own bindings, described by `layouts`, from group 2 on.
    ///
    /// `wgsl` declares them and defines `caster_covers(triangle: u32, weights: vec3f) -> bool`: whether
    /// a triangle of the mesh, counted from the first index, stops light where its corners have these
    /// weights, 0 to 1, sum 1. It may call `caster_vertex(triangle, corner) -> u32`, the index of a
    /// corner, and samples with explicit levels. It is asked once per texel, at the triangle's point
    /// next to the texel's centre: holes have the map's resolution, edges of their triangles
    /// sub-texel precision, and a texel with holes says nothing about its neighbours.
    ///
    /// Where lookups ask ([`asks_about_cutouts`](Self::asks_about_cutouts)) every texel keeps all triangles that
    /// touch it, holes or not, and receivers see through the holes themselves, at any size of the map. Then
    /// `wgsl` also defines `caster_tag(triangle: u32) -> u32`, any number that `shadow_covers` will need to know the
    /// triangle by, such as its material's, and `caster_covers` tells of the centres of texels alone.
    ///
    /// `None` if casters are depth.
    ///
    /// # Errors
    /// [`Unsupported::Cutout`]: more bind groups than the device has, or what it says of the shader and the
    /// number of resources. In a browser, where devices answer later, the second goes to the caller's error
    /// scope or handler.
    pub fn cutout_caster(
        &self,
        device: &wgpu::Device,
        wgsl: &str,
        layouts: &[&wgpu::BindGroupLayout],
    ) -> Result<Option<wgpu::RenderPipeline>, Unsupported> {
        let technique = self.technique.as_ref();
        if technique.caster() == Caster::Depth {
            return Ok(None);
        }
        check::cutout(device, technique, layouts.len())?;
        let (pipeline, refusal) = answer::ask_now(device, || {
            let triangles = self.triangles.as_ref().map(|t| t.cutout(device, technique, wgsl, layouts));
            let cutout = Cutout { wgsl, by_ray: self.asks };
            triangles.or_else(|| self.numbered().map(|n| n.cutout(device, technique, cutout, layouts)))
        });
        refusal.map_or(Ok(pipeline), |refusal| {
            let technique = technique.page().name.into();
            Err(Unsupported::Cutout { technique, reason: refusal.to_string() })
        })
    }

    /// A pipeline to return to after that one, in the closure of [`encode`](Self::encode). Slower than the
    /// one that is set when the closure is called: better draw meshes without holes first. `None` if
    /// casters are depth.
    #[must_use]
    pub fn triangle_caster(&self, view: &View) -> Option<&wgpu::RenderPipeline> {
        let numbered = self.numbered().map(|n| n.pipeline(view));
        self.triangles.as_ref().map(TriangleCaster::general).or(numbered)
    }

    /// Two `u32` per view, usage `COPY_SRC`, for techniques whose caster is [`Caster::Lists`]: entries
    /// that the casters of the last [`encode`](Self::encode) needed, of the `width · height` times
    /// [`Capacity::triangles_per_texel`] that there is memory for; length of the longest list.
    #[must_use]
    pub fn list_totals(&self) -> Option<&wgpu::Buffer> {
        self.lists.as_ref().map(Lists::totals)
    }

    /// Numbers that the last [`encode`](Self::encode) gave to triangles in the view with most, for
    /// techniques whose caster is [`Caster::Lists`] or [`Caster::Ranked`]: one for each triangle that was
    /// drawn, two under a spot, which may cut it in two, and those of triangles before the first that was
    /// drawn. What is beyond [`Capacity::triangles`] casts no shadow. Else 0.
    #[must_use]
    pub fn triangles_drawn(&self) -> u32 {
        self.drawn.load(Ordering::Relaxed)
    }

    fn encode_view_filter(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: usize,
        now: impl Fn(&Draw) -> bool,
        probe: &mut dyn Probe,
    ) {
        for draw in self.draws[view].iter().filter(|draw| now(draw)) {
            draw.encode(encoder, probe.pass(draw.label, view));
        }
    }

    /// The views that [`encode`](Self::encode) asks the casters for, in order: those of
    /// [`prepare`](Self::prepare), or several for each of them, shifted by fractions of a texel
    /// ([`Technique::jitter`]).
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
        self.asks
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
        let size = shader::MapSize {
            views: self.room,
            capacity: self.capacity,
            splits: self.ranked.as_ref().map(RankedTriangles::splits).unwrap_or_default(),
            asks: self.asks,
        };
        shader::receiver(self.technique.as_ref(), &self.capabilities, size, group)
    }

    /// Memory for triangles that it was made with.
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.capacity
    }

    /// What `shadow_visibility` is made from.
    #[must_use]
    pub fn technique(&self) -> &dyn Technique {
        self.technique.as_ref()
    }

    /// Texels of each view.
    #[must_use]
    pub fn size(&self) -> Size {
        self.size
    }

    /// Free texels that a view should leave on each side ([`Fit::margin_texels`](crate::Fit)).
    #[must_use]
    pub fn margin_texels(&self) -> f32 {
        self.technique.reach_texels().ceil() + 1.0
    }

    /// Entry `index` of [`Technique::maps`] as allocated, for debug views: view `v` starts at layer
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
        explain::lines(self.technique.as_ref(), &self.capabilities, &self.textures, triangles)
    }
}
