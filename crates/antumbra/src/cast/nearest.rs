//! Casters of which each texel keeps the nearest triangle, drawn straight into the technique's only map.

use super::{
    Cast, CasterPass, Plan, Seen, Targets,
    objects::{self, UNIFORM},
    pass::{self, MeshPipeline},
    pipeline::Recipe,
    triangle::{self, Holes, PULLED, TrianglePass, Varyings},
    views::{CasterViews, perspective},
};
use crate::{
    capabilities::Capabilities,
    describe::Coverage,
    error::Unsupported,
    light::View,
    memory::MemoryItem,
    options::{Options, Probe},
    pipelines::Pipelines,
    shader::{Composition, Shader},
    tile::Tile,
};
use wgpu::{
    BindGroup, BindGroupLayout, CommandEncoder, CompareFunction, RenderPipeline, ShaderStages, StoreOp,
    TextureFormat,
};

/// What texels of a triangle share: depth gained per texel, as it is and as packed; packed words.
const VARYINGS: Varyings = &[("slopes", "vec4f"), ("words", "vec4u")];
const NEAREST: &str = include_str!("nearest/nearest.wgsl.in");
const LABEL: &str = "shadow caster view";

/// Layers and texts.
pub(super) struct NearestPlan<'a> {
    pub(super) composition: &'a Composition,
    pub(super) device: &'a Capabilities,
    pub(super) options: &'a Options,
    /// Of each layer of the map.
    pub(super) coverages: &'static [Coverage],
}

impl NearestPlan<'_> {
    fn shader(&self, pass: TrianglePass, holes: Holes<'_>) -> Shader {
        // At centres depth is a plane, which corners tell unless depth may not be unclamped.
        let own_depth = !self.device.clamps_depth() || pass.reaches();
        let depth = if own_depth {
            include_str!("nearest/depth_own.wgsl.in")
        } else {
            include_str!("nearest/depth_interpolated.wgsl.in")
        };
        let entry: &[&str] = match pass {
            TrianglePass::Indexed(_) => &[include_str!("nearest/indexed.wgsl.in")],
            TrianglePass::Any | TrianglePass::Pulled(..) => &[include_str!("nearest/pulled.wgsl.in"), PULLED],
        };
        let texts = [&[NEAREST, depth], entry].concat();
        let text = triangle::compose(pass, holes, self.composition.alone(), VARYINGS, &texts);
        let name = if matches!(holes, Holes::None) { "cast" } else { "cut-out" };
        Shader { pass: name, text, targets: self.format().into_iter().collect() }
    }

    fn format(&self) -> Option<TextureFormat> {
        self.composition.description.maps.first().map(|map| map.format)
    }

    fn can_share_vertices(&self, coverage: Coverage) -> bool {
        match coverage {
            Coverage::Touched => self.device.rasterises_conservatively(),
            Coverage::Centre => self.device.numbers_triangles(),
        }
    }
}

impl Plan for NearestPlan<'_> {
    fn check(&self) -> Result<(), Unsupported> {
        Ok(())
    }

    fn shaders(&self) -> Vec<Shader> {
        let pulled =
            self.coverages.iter().flat_map(|c| [false, true].map(|spot| TrianglePass::Pulled(*c, spot)));
        let shared = self.coverages.iter().filter(|c| self.can_share_vertices(**c));
        let passes = pulled.chain(shared.map(|c| TrianglePass::Indexed(*c)));
        passes.map(|pass| self.shader(pass, Holes::None)).collect()
    }

    fn cutout(&self, wgsl: &str) -> Option<Shader> {
        Some(self.shader(TrianglePass::Any, Holes::ByTexel(wgsl)))
    }

    fn build(&self, device: &wgpu::Device, pipelines: &Pipelines) -> Box<dyn Cast> {
        let Options { size, views, .. } = *self.options;
        let layout = objects::layout(device, LABEL, &[(ShaderStages::VERTEX_FRAGMENT, UNIFORM)]);
        let caster_views = CasterViews::new(device, (size, views), self.coverages);
        let group = |index: usize| {
            let (view, coverage) = (index / self.coverages.len(), index % self.coverages.len());
            objects::bind(device, LABEL, &layout, [caster_views.binding(view, coverage)])
        };
        let unclipped_depth = self.device.clamps_depth();
        let compiled = |pass| {
            let Shader { text, targets, .. } = self.shader(pass, Holes::None);
            let recipe = Recipe {
                shader: &text,
                own: &layout,
                user: &[],
                target: targets.first().copied(),
                depth: CompareFunction::Less,
                unclipped_depth,
                conservative: pass == TrianglePass::Indexed(Coverage::Touched),
            };
            pipelines.caster(&text, &targets, |device| recipe.compile(device))
        };
        // Software drivers shade vertices as fast as fragments, of which there are more.
        let software = device.adapter_info().device_type == wgpu::DeviceType::Cpu;
        let shared = |c: &Coverage| !software && self.can_share_vertices(*c);
        let indexed = |c: &Coverage| shared(c).then(|| compiled(TrianglePass::Indexed(*c)));
        let pulled = |c: &Coverage| [false, true].map(|spot| compiled(TrianglePass::Pulled(*c, spot)));
        Box::new(NearestCast {
            groups: (0..views as usize * self.coverages.len()).map(group).collect(),
            pulled: self.coverages.iter().map(pulled).collect(),
            indexed: self.coverages.iter().map(indexed).collect(),
            format: self.format(),
            views: caster_views,
            unclipped_depth,
            layout,
        })
    }
}

/// Pipelines and views.
#[derive(Debug)]
struct NearestCast {
    /// For each layer: under the sun, under a spot.
    pulled: Vec<[RenderPipeline; 2]>,
    /// For each layer under the sun, where the device can.
    indexed: Vec<Option<RenderPipeline>>,
    /// For each view and layer.
    groups: Vec<BindGroup>,
    format: Option<TextureFormat>,
    views: CasterViews,
    unclipped_depth: bool,
    layout: BindGroupLayout,
}

impl NearestCast {
    /// What meshes are drawn with in a layer of a view.
    fn meshes(&self, seen: Seen<'_>, layer: usize) -> MeshPipeline<'_> {
        let spot = perspective(seen.from);
        let indexed = self.indexed[layer].as_ref().filter(|_| spot == 0);
        MeshPipeline {
            pipeline: indexed.unwrap_or(&self.pulled[layer][spot as usize]),
            group: &self.groups[seen.view * self.pulled.len() + layer],
            offsets: &[],
            indexed: indexed.is_some(),
        }
    }
}

impl Cast for NearestCast {
    fn write(&self, queue: &wgpu::Queue, views: &[View], tiles: &[Tile]) {
        self.views.write(queue, views, tiles);
    }

    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        seen: Seen<'_>,
        targets: &dyn Targets,
        probe: &mut dyn Probe,
        draw: &mut dyn FnMut(&mut CasterPass<'_>),
    ) {
        for layer in 0..self.pulled.len() {
            let target = pass::written(targets.map_target(seen.layer(), layer), seen.first);
            let depth = (targets.caster_target(seen.layer(), seen.cast, seen.first), StoreOp::Store);
            let pass = pass::begin(encoder, Some(target), depth, probe.pass("cast", seen.view));
            draw(&mut CasterPass::new(pass, seen, Some(self.meshes(seen, layer))));
        }
    }

    fn cutout(
        &self,
        device: &wgpu::Device,
        shader: &str,
        user: &[&BindGroupLayout],
    ) -> Option<RenderPipeline> {
        let recipe = Recipe {
            shader,
            own: &self.layout,
            user,
            target: self.format,
            depth: CompareFunction::Less,
            unclipped_depth: self.unclipped_depth,
            conservative: false,
        };
        Some(recipe.compile(device))
    }

    fn memory(&self) -> Vec<MemoryItem> {
        vec![self.views.memory("caster views")]
    }
}
