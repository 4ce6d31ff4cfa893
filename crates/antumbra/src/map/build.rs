//! Makes a shadow map, or says why there can be none.

use super::{
    Capabilities, Depth, Options, Pipelines, ShadowMap, Textures, Uniforms,
    answer::{self, Refusal},
    brought, check,
    draw::Draw,
    receiver::Samplers,
};
use crate::{
    cast,
    describe::{Description, Technique},
    error::Unsupported,
    light::Size,
    pass,
    shader::Composition,
    technique,
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

    /// Reads depth that the caller renders herself: a texture, or some of its layers and reversed depth
    /// ([`Depth`]). There is one layer per view (and caster pass, in the order of
    /// [`caster_views`](Self::caster_views)), and z is what
    /// [`View::clip_from_world`](crate::View::clip_from_world) gives. `options.size` and `options.views`, or `options.layers` if
    /// views are tiles, are taken from the texture. Use [`encode_filter`](Self::encode_filter) instead of `encode`.
    ///
    /// # Errors
    /// [`Unsupported::Depth`] if the texture cannot be read, else as [`new`](Self::new).
    pub fn from_depth<'a>(
        device: &wgpu::Device,
        technique: &dyn Technique,
        depth: impl Into<Depth<'a>>,
        options: impl Into<Options>,
    ) -> Result<Self, Unsupported> {
        let (depth, options) = (depth.into(), options.into());
        let (map, refusal) =
            answer::ask_now(device, || Self::build(device, technique, &options, Some(&depth)));
        map?.unless(refusal)
    }

    /// Itself, unless the device refused what it is made of.
    fn unless(self, refusal: Option<Refusal>) -> Result<Self, Unsupported> {
        let technique = self.technique.about().name.to_string();
        match refusal {
            None => Ok(self),
            Some(Refusal::Memory) => {
                let Size { width, height } = self.options.size;
                let bytes = self.memory().items.iter().map(|item| item.bytes).sum();
                Err(Unsupported::Memory { technique, width, height, views: self.options.views, bytes })
            }
            Some(Refusal::Invalid(reason)) => Err(Unsupported::Refused { technique, reason }),
        }
    }

    fn build(
        device: &wgpu::Device,
        technique: &dyn Technique,
        options: &Options,
        depth: Option<&Depth<'_>>,
    ) -> Result<Self, Unsupported> {
        technique::check(technique)?;
        options.bias.check()?;
        let capabilities = Capabilities::of(device);
        let mut description = technique.describe(&capabilities)?;
        let options = &match depth {
            Some(depth) => bring(options, depth, &mut description)?,
            None => options.clone(),
        };
        let composition = Composition::new(description, options)?;
        if depth.is_some_and(Depth::is_reversed) {
            composition.takes_reversed_depth()?;
        }
        let description = &composition.description;
        check::device(device, description, options)?;
        let pipelines = options.pipelines.clone().unwrap_or_else(|| Pipelines::new(device));
        check::caster(description, depth)?;
        let plan = cast::plan(&composition, &capabilities, options);
        plan.check()?;
        let cast = plan.build(device, &pipelines);
        drop(plan);
        let textures = Textures::new(device, &capabilities, description, options, depth);
        let uniforms = Uniforms::new(device, description, options);
        let steps = pass::filter_steps(&composition, &capabilities, options.size);
        let draw = |layer, step| Draw::new(&pipelines, &textures, &uniforms, &composition, step, layer);
        let draws = (0..options.layer_count())
            .map(|layer| steps.iter().map(|step| draw(layer, step)).collect())
            .collect();
        let samplers = Samplers::new(device, description, &capabilities, &textures);
        let resources = samplers.resources(description, &textures, &uniforms, cast.as_ref());
        let (layout, bind_group) = Samplers::group(device, resources);
        let casts = description.sample_offsets.len();
        Ok(Self {
            technique: technique.clone_box(),
            composition,
            capabilities,
            options: options.clone(),
            textures,
            uniforms,
            draws,
            cast,
            drawn: AtomicU32::new(0),
            samplers,
            layout,
            bind_group,
            views: Vec::with_capacity(options.views as usize),
            tiles: Vec::with_capacity(options.views as usize),
            next_tiles: Vec::with_capacity(options.views as usize),
            caster_views: Vec::with_capacity(options.views as usize * casts),
        })
    }
}

/// Options of a map that reads this depth, and what follows from it for the description.
fn bring(options: &Options, depth: &Depth<'_>, described: &mut Description) -> Result<Options, Unsupported> {
    let (size, layers) = depth.check(described.sample_offsets.len() as u32)?;
    described.bring(brought::quantum(depth.texture()), depth.is_reversed());
    Ok(match options.layers {
        None => Options { size, views: layers, ..options.clone() },
        Some(_) => Options { size, layers: Some(layers), ..options.clone() },
    })
}
