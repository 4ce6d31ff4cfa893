//! Makes a shadow map, or says why there can be none.

use super::{
    Capabilities, Options, Pipelines, ShadowMap, Textures, Uniforms,
    answer::{self, Refusal},
    caster::TriangleCaster,
    check,
    draw::Draw,
    lists::{ListSize, Lists},
    ranked::{RankedSize, RankedTriangles},
    receiver,
};
use crate::{
    error::Unsupported,
    light::Size,
    pass,
    technique::{self, Binding, Caster, Technique},
};
use std::sync::atomic::AtomicU32;

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
    /// [`View::clip_from_world`](crate::View::clip_from_world) gives it. `options.size` and `options.views` are taken from the
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
}
