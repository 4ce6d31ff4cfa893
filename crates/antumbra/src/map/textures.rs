//! The textures of a shadow map and the views of their layers and levels.

use super::{DEPTH_FORMAT, Depth, Lifetime, Memory, MemoryItem, Options, brought, uniforms::Uniforms};
use crate::{
    capabilities::Capabilities,
    cast::Targets,
    describe::{Binding, Description, Map, Pass},
    light::Size,
    pass::{self, FilterStep, Holder, Place},
};
use std::ops::Range;
use wgpu::{
    LoadOp, TextureAspect, TextureFormat, TextureUsages, TextureView, TextureViewDescriptor,
    TextureViewDimension,
};

/// One entry of `Description::maps`, allocated.
#[derive(Debug)]
pub(super) struct Kept {
    pub(super) name: &'static str,
    pub(super) layers: u32,
    pub(super) texture: wgpu::Texture,
    /// All layers and levels.
    pub(super) array: TextureView,
    scratch: Option<wgpu::Texture>,
}

impl Kept {
    fn scratch(&self) -> &wgpu::Texture {
        self.scratch.as_ref().unwrap_or(&self.texture)
    }
}

/// Casters' depth, maps and scratch.
#[derive(Debug)]
pub(crate) struct Textures {
    casters: wgpu::Texture,
    /// Layers of it that are the map's.
    caster_layers: Range<u32>,
    /// Whether its depth falls with the distance.
    reversed: bool,
    casters_array: TextureView,
    /// Layers of the casters' depth, which views share unless there is one for each.
    caster_targets: Vec<TextureView>,
    casters_lifetime: Lifetime,
    maps: Vec<Kept>,
    /// The layers of the first map of every view, for casters that are triangles.
    map_targets: Vec<TextureView>,
}

impl Textures {
    /// Casters' depth has all layers if receivers compare it, else those that all views share: one for each caster pass
    /// of a view, at most four.
    pub(super) fn new(
        device: &wgpu::Device,
        capabilities: &Capabilities,
        description: &Description,
        options: &Options,
        depth: Option<&Depth<'_>>,
    ) -> Self {
        let Description { maps, sample_offsets, .. } = description;
        let (compares, casts) = (description.reads_depth(), sample_offsets.len() as u32);
        let usage = TextureUsages::RENDER_ATTACHMENT | TextureUsages::TEXTURE_BINDING;
        let layers = if compares { options.layer_count() } else { casts.min(4) };
        let casters = depth.map(|depth| depth.texture().clone()).unwrap_or_else(|| {
            texture(device, "casters' depth", options.size, layers, 1, DEPTH_FORMAT, usage)
        });
        let caster_layers = depth.map_or(0..layers, Depth::layer_range);
        let reversed = depth.is_some_and(Depth::is_reversed);
        let casters_lifetime = match (depth, compares) {
            (Some(_), _) => Lifetime::Borrowed,
            (None, true) => Lifetime::Kept,
            (None, false) => Lifetime::Transient,
        };
        let caster_targets = caster_layers.clone().map(|layer| one(&casters, layer, 0)).collect();
        let keep = |map: &Map| {
            let levels = pass::levels(map, options.size);
            let layers = map.layers * options.layer_count();
            let written = if map.passes.iter().any(|p| matches!(p, Pass::Sum(_))) {
                TextureUsages::STORAGE_BINDING
            } else {
                TextureUsages::RENDER_ATTACHMENT
            };
            let usage = written | TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_SRC;
            let kept = texture(device, map.name, options.size, layers, levels, map.format, usage);
            let scratch = match pass::scratch_layers(map, capabilities) {
                0 => None,
                layers => Some(texture(device, "filter scratch", options.size, layers, 1, map.format, usage)),
            };
            Kept { name: map.name, layers: map.layers, array: all(&kept), texture: kept, scratch }
        };
        let maps: Vec<Kept> = maps.iter().map(keep).collect();
        let layers = maps.first().map_or(0, |map| map.layers * options.layer_count());
        let map_targets = (0..layers).map(|layer| one(&maps[0].texture, layer, 0)).collect();
        let casters_array = some(&casters, caster_layers.clone(), None);
        Self {
            casters,
            caster_layers,
            reversed,
            casters_array,
            caster_targets,
            casters_lifetime,
            maps,
            map_targets,
        }
    }

    /// All layers of the casters' depth.
    pub(super) fn casters_array(&self) -> &TextureView {
        &self.casters_array
    }

    /// Whether the casters' depth falls with the distance.
    pub(super) fn is_reversed(&self) -> bool {
        self.reversed
    }

    /// Whether the casters' depth is the caller's.
    pub(super) fn is_brought(&self) -> bool {
        self.casters_lifetime == Lifetime::Borrowed
    }

    /// What follows for receivers if it is.
    pub(super) fn bring(&self, description: &mut Description) {
        if self.is_brought() {
            description.bring(brought::quantum(&self.casters), self.reversed);
        }
    }

    pub(super) fn maps(&self) -> &[Kept] {
        &self.maps
    }

    /// What a step reads, for one layer of views: layers of one level as an array, or the casters' depth.
    pub(super) fn source(&self, step: &FilterStep, of_views: u32) -> TextureView {
        let Place { holder, layer, mip } = step.source;
        let array = |texture, first, layers| some(texture, first..first + layers, Some(mip));
        let Range { start, end } = self.caster_layers;
        let layers = step.source_layers;
        match holder {
            // All share one layer unless receivers compare it or it is the caller's.
            Holder::Casters => array(&self.casters, (start + of_views).min(end - 1), 1),
            Holder::Casts { first, of, .. } => {
                let own = self.casters_lifetime == Lifetime::Borrowed;
                array(&self.casters, start + if own { of_views * of + first } else { 0 }, layers)
            }
            Holder::Map(i) => array(&self.maps[i].texture, of_views * self.maps[i].layers + layer, layers),
            Holder::Scratch(i) => array(self.maps[i].scratch(), layer, layers),
        }
    }

    /// What a step writes, for one layer of views.
    pub(super) fn targets(&self, step: &FilterStep, of_views: u32) -> Vec<TextureView> {
        let target = |place: &Place| match place.holder {
            Holder::Casters | Holder::Casts { .. } => {
                self.caster_target(of_views as usize, 0, true).0.clone()
            }
            Holder::Map(i) => {
                one(&self.maps[i].texture, of_views * self.maps[i].layers + place.layer, place.mip)
            }
            Holder::Scratch(i) => one(self.maps[i].scratch(), place.layer, 0),
        };
        step.targets.iter().map(target).collect()
    }

    pub(super) fn memory(&self, uniforms: &Uniforms) -> Memory {
        let mut items = vec![MemoryItem::texture("casters' depth", &self.casters, self.casters_lifetime)];
        for map in &self.maps {
            items.push(MemoryItem::texture(map.name, &map.texture, Lifetime::Kept));
            items.extend(
                map.scratch.iter().map(|s| MemoryItem::texture("filter scratch", s, Lifetime::Transient)),
            );
        }
        items.extend(uniforms.memory());
        Memory { items }
    }
}

impl Targets for Textures {
    fn map_target(&self, layer: usize, of_map: usize) -> &TextureView {
        &self.map_targets[layer * self.maps[0].layers as usize + of_map]
    }

    fn caster_target(&self, layer: usize, cast: usize, first: bool) -> (&TextureView, LoadOp<f32>) {
        let transient = self.casters_lifetime == Lifetime::Transient;
        // Four passes are converted together.
        let target = &self.caster_targets[if transient { cast } else { layer } % self.caster_targets.len()];
        (target, if transient || first { LoadOp::Clear(1.0) } else { LoadOp::Load })
    }
}

fn texture(
    device: &wgpu::Device,
    label: &str,
    size: Size,
    layers: u32,
    mip_level_count: u32,
    format: TextureFormat,
    usage: TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size.width, height: size.height, depth_or_array_layers: layers },
        mip_level_count,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}

fn one(texture: &wgpu::Texture, layer: u32, mip: u32) -> TextureView {
    texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        base_mip_level: mip,
        mip_level_count: Some(1),
        aspect: aspect(texture),
        ..Default::default()
    })
}

fn all(texture: &wgpu::Texture) -> TextureView {
    some(texture, 0..texture.depth_or_array_layers(), None)
}

/// Layers as an array, of one level or of all.
fn some(texture: &wgpu::Texture, layers: Range<u32>, mip: Option<u32>) -> TextureView {
    texture.create_view(&TextureViewDescriptor {
        dimension: Some(TextureViewDimension::D2Array),
        base_array_layer: layers.start,
        array_layer_count: Some(layers.end - layers.start),
        base_mip_level: mip.unwrap_or(0),
        mip_level_count: mip.map(|_| 1),
        aspect: aspect(texture),
        ..Default::default()
    })
}

fn aspect(texture: &wgpu::Texture) -> TextureAspect {
    if texture.format().has_depth_aspect() { TextureAspect::DepthOnly } else { TextureAspect::All }
}

/// The sampler of a binding (an unused one for textures).
pub(super) fn sampler(
    device: &wgpu::Device,
    binding: Binding,
    filterable: bool,
    reversed: bool,
) -> wgpu::Sampler {
    let (filter, compare) = match binding {
        Binding::Compare(filter) => (filter, Some(brought::comparison(reversed))),
        _ if filterable => (wgpu::FilterMode::Linear, None),
        _ => (wgpu::FilterMode::Nearest, None),
    };
    let mipmap_filter = match (filter, compare) {
        (wgpu::FilterMode::Linear, None) => wgpu::MipmapFilterMode::Linear,
        _ => wgpu::MipmapFilterMode::Nearest,
    };
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadow map"),
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter,
        compare,
        ..Default::default()
    })
}
