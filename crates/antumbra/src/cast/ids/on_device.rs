//! What a plan of a store that keeps triangles by id is on the GPU.

use super::{FIRST, IdPlan, VERTICES};
use crate::{
    cast::{
        Array, Cast, CasterPass, Image, Owner, Seen, Site, Step, Store, Targets,
        arrays::{Storage, called},
        objects::{self, OF_VIEW},
        pass::{self, MeshPipeline},
        pieces::Pieces,
        pipeline::Recipe,
        split::Split,
        triangle::{Holes, TrianglePass},
        views::{CasterViews, perspective},
    },
    describe::Coverage,
    light::{Size, View},
    memory::{Lifetime, MemoryItem},
    options::Probe,
    pipelines::Pipelines,
    tile::Tile,
};
use std::ops::Deref;
use wgpu::{
    BindGroup, BindGroupLayout, BindingResource, BindingType, Buffer, CommandEncoder, CompareFunction,
    ComputePipeline, RenderPipeline, ShaderStages, StoreOp, Texture, TextureFormat, TextureView,
};

/// Rust side of `CasterStep`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct CasterStep {
    view: u32,
    triangles: u32,
    words: [u32; 2],
}

/// What a step does, bound for each layer.
#[derive(Debug)]
enum Bound {
    Draw(Vec<BindGroup>),
    Compute { label: &'static str, pipeline: ComputePipeline, texels: u32, groups: Vec<BindGroup> },
}

/// A store's pipelines, buffers and textures.
#[derive(Debug)]
pub(super) struct IdCast {
    name: &'static str,
    size: Size,
    /// Under the sun, under a spot.
    pipelines: [RenderPipeline; 2],
    /// Group 0 of draws.
    layout: BindGroupLayout,
    depth: CompareFunction,
    views: CasterViews,
    steps: Vec<Bound>,
    uniforms: Buffer,
    /// From one of the uniforms to the next; how many of them a step has.
    stride: u64,
    most_views: u32,
    allocated: Allocated,
    totals: Option<usize>,
    explanation: String,
}

/// Arrays and images, allocated.
#[derive(Debug)]
struct Allocated {
    arrays: Vec<(Array, Pieces)>,
    images: Vec<(Image, Texture, TextureView)>,
}

/// What a step binds in group 0: types, and which arrays and images behind view and step.
struct Entries {
    types: Vec<(ShaderStages, BindingType)>,
    arrays: Vec<usize>,
    images: Vec<usize>,
}

impl Allocated {
    fn new(device: &wgpu::Device, storage: &Storage, name: &str, layers: u32) -> Self {
        let array = |(array, split): &(Array, Split)| {
            let label = format!("{name} {}", array.title);
            (array.clone(), Pieces::new(device, &label, *split, array.element.bytes()))
        };
        Self {
            arrays: storage.arrays.iter().map(array).collect(),
            images: storage.images.iter().map(|i| image(device, i, layers)).collect(),
        }
    }

    fn entries<P: Deref<Target = dyn Store>>(&self, plan: &IdPlan<'_, P>, step: &Step) -> Entries {
        let (text, draws) = (plan.called_by(step), matches!(step, Step::Draw { .. }));
        let (both, alone) = match draws {
            true => (ShaderStages::VERTEX_FRAGMENT, ShaderStages::FRAGMENT),
            false => (ShaderStages::COMPUTE, ShaderStages::COMPUTE),
        };
        let by_vertices = plan.site.device.stores_from_vertices() && draws;
        let mut types = vec![(both, OF_VIEW); FIRST as usize];
        let mut arrays = Vec::new();
        for (i, (array, pieces)) in self.arrays.iter().enumerate() {
            if called(array.name, &text) {
                let stage = if by_vertices && array.name == VERTICES { ShaderStages::VERTEX } else { alone };
                types.extend(pieces.bindings().map(|_| (stage, objects::storage(false))));
                arrays.push(i);
            }
        }
        let stored = BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: TextureFormat::R32Uint,
            view_dimension: wgpu::TextureViewDimension::D2Array,
        };
        let images: Vec<usize> =
            (0..self.images.len()).filter(|i| called(self.images[*i].0.name, &text)).collect();
        types.extend(images.iter().map(|_| (alone, stored)));
        Entries { types, arrays, images }
    }

    /// What a step binds for views in a layer, behind `own`: all of its arrays, the layer's part of its images.
    fn bind(
        &self,
        device: &wgpu::Device,
        (label, layout): (&str, &BindGroupLayout),
        own: [BindingResource<'_>; FIRST as usize],
        (entries, layer): (&Entries, u32),
    ) -> BindGroup {
        let part = |i: &usize| {
            let (image, texture, _) = &self.images[*i];
            array_view(texture, layer * image.layers, image.layers)
        };
        let parts: Vec<TextureView> = entries.images.iter().map(part).collect();
        let buffers = entries.arrays.iter().flat_map(|i| self.arrays[*i].1.bindings());
        let textures = parts.iter().map(BindingResource::TextureView);
        objects::bind(device, label, layout, own.into_iter().chain(buffers).chain(textures))
    }
}

/// A uniform for each step and view, one step's views behind the other's.
fn uniforms(device: &wgpu::Device, steps: &[Step], site: &Site<'_>) -> (Buffer, u64) {
    let of = |step: &Step, view| {
        let (Step::Draw { words } | Step::Compute { words, .. }) = *step;
        CasterStep { view, triangles: site.capacity.triangles, words }
    };
    let all: Vec<CasterStep> =
        steps.iter().flat_map(|step| (0..site.views).map(move |view| of(step, view))).collect();
    objects::uniforms(device, "caster steps", &all)
}

impl IdCast {
    pub(super) fn new<P: Deref<Target = dyn Store>>(
        plan: &IdPlan<'_, P>,
        device: &wgpu::Device,
        pipelines: &Pipelines,
    ) -> Self {
        let (store, site) = (&plan.store, &plan.site);
        let (name, steps) = (store.name(), store.steps(site));
        let views = CasterViews::new(device, (site.size, site.views), &[Coverage::Touched]);
        let allocated = Allocated::new(device, &plan.storage, name, site.layers);
        let depth = if store.keeps_depth() { CompareFunction::Less } else { CompareFunction::Always };
        let drawn = allocated.entries(plan, &Step::Draw { words: [0; 2] });
        let layout = objects::layout(device, name, &drawn.types);
        let compiled = |spot| {
            let text = plan.draw_text(TrianglePass::Pulled(Coverage::Touched, spot), Holes::None);
            pipelines.caster(&text, &[], |device| recipe(&text, &layout, &[], depth).compile(device))
        };
        let (uniforms, stride) = uniforms(device, &steps, site);
        let bound = |step: &Step| {
            let entries = allocated.entries(plan, step);
            let layout = objects::layout(device, name, &entries.types);
            let group = |layer: u32| {
                let own = [views.binding(0, 0), objects::element::<CasterStep>(&uniforms, 0, stride)];
                allocated.bind(device, (name, &layout), own, (&entries, layer))
            };
            let groups = (0..site.layers).map(group).collect();
            match step {
                Step::Draw { .. } => Bound::Draw(groups),
                Step::Compute { label, wgsl, texels, .. } => Bound::Compute {
                    label,
                    pipeline: compute_pipeline(device, label, &layout, &plan.compute_text(wgsl)),
                    texels: *texels,
                    groups,
                },
            }
        };
        let total = |name| allocated.arrays.iter().position(|(array, _)| array.name == name);
        Self {
            name,
            size: site.size,
            pipelines: [compiled(false), compiled(true)],
            steps: steps.iter().map(bound).collect(),
            totals: store.totals().and_then(total),
            explanation: store.explain(site),
            layout,
            depth,
            views,
            uniforms,
            stride,
            most_views: site.views,
            allocated,
        }
    }
}

impl IdCast {
    /// Dynamic offsets of what a step knows of a view and of itself.
    fn offsets(&self, step: usize, view: usize) -> [u32; FIRST as usize] {
        let index = step as u64 * u64::from(self.most_views) + view as u64;
        [self.views.offset(view), (index * self.stride) as u32]
    }
}

fn recipe<'a>(
    shader: &'a str,
    own: &'a BindGroupLayout,
    user: &'a [&'a BindGroupLayout],
    depth: CompareFunction,
) -> Recipe<'a> {
    Recipe { shader, own, user, target: None, depth, unclipped_depth: false, conservative: false }
}

fn compute_pipeline(
    device: &wgpu::Device,
    label: &str,
    layout: &BindGroupLayout,
    text: &str,
) -> ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some(label),
        layout: Some(&objects::pipeline_layout(device, label, &[layout])),
        module: &objects::module(device, label, text),
        entry_point: Some("compute"),
        compilation_options: Default::default(),
        cache: None,
    })
}

/// A texture with all its layers.
fn image(device: &wgpu::Device, image: &Image, of_views: u32) -> (Image, Texture, TextureView) {
    let Image { title, size: [width, height], layers, .. } = *image;
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some(title),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: layers * of_views },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: TextureFormat::R32Uint,
        usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    let all = array_view(&texture, 0, layers * of_views);
    (image.clone(), texture, all)
}

/// Some layers of a texture.
fn array_view(texture: &Texture, base_array_layer: u32, layers: u32) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_array_layer,
        array_layer_count: Some(layers),
        ..Default::default()
    })
}

impl Cast for IdCast {
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
        for (array, pieces) in self.allocated.arrays.iter().filter(|(array, _)| array.cleared) {
            let owner = match array.owner {
                Owner::View => seen.view,
                // Views before have left theirs there.
                Owner::Layer if !seen.first => continue,
                Owner::Layer => seen.layer(),
                Owner::Shared => 0,
            };
            let first = owner as u64 * array.length;
            pieces.clear(encoder, first..first + array.length);
        }
        let writes = self.depth != CompareFunction::Always;
        for (number, step) in self.steps.iter().enumerate() {
            let offsets = self.offsets(number, seen.view);
            match step {
                Bound::Draw(groups) => {
                    let store = if writes { StoreOp::Store } else { StoreOp::Discard };
                    let depth = (targets.caster_target(seen.layer(), 0, seen.first), store);
                    let pass = pass::begin(encoder, None, depth, probe.pass("cast", seen.view));
                    let pipeline = &self.pipelines[perspective(seen.from) as usize];
                    let group = &groups[seen.layer()];
                    let meshes = MeshPipeline { pipeline, group, offsets: &offsets, indexed: false };
                    draw(&mut CasterPass::new(pass, seen, Some(meshes)));
                }
                Bound::Compute { label, pipeline, texels, groups } => {
                    let mut pass = pass::compute_pass(encoder, label, probe.pass(label, seen.view));
                    pass.set_pipeline(pipeline);
                    pass.set_bind_group(0, &groups[seen.layer()], &offsets);
                    let Size { width, height } = seen.tile.size;
                    let all = u64::from(width) * u64::from(height);
                    pass.dispatch_workgroups(all.div_ceil(u64::from(*texels)) as u32, 1, 1);
                }
            }
        }
    }

    fn bindings(&self) -> Vec<(BindingType, BindingResource<'_>)> {
        let read = self.allocated.arrays.iter().filter(|(array, _)| array.looked_up);
        let buffers = read.flat_map(|(_, pieces)| pieces.bindings()).map(|b| (objects::storage(true), b));
        let texture = BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Uint,
            view_dimension: wgpu::TextureViewDimension::D2Array,
            multisampled: false,
        };
        let textures =
            self.allocated.images.iter().map(|(.., all)| (texture, BindingResource::TextureView(all)));
        buffers.chain(textures).collect()
    }

    fn cutout(
        &self,
        device: &wgpu::Device,
        shader: &str,
        user: &[&BindGroupLayout],
    ) -> Option<RenderPipeline> {
        Some(recipe(shader, &self.layout, user, self.depth).compile(device))
    }

    fn totals(&self) -> Option<&Buffer> {
        self.totals.and_then(|i| self.allocated.arrays[i].1.first())
    }

    fn passes(&self) -> Vec<&'static str> {
        let after = self.steps.iter().skip(1).map(|step| match step {
            Bound::Draw(_) => "cast",
            Bound::Compute { label, .. } => label,
        });
        after.collect()
    }

    fn explain(&self) -> Option<String> {
        Some(self.explanation.clone())
    }

    fn memory(&self) -> Vec<MemoryItem> {
        let name = |title| format!("{} {title}", self.name);
        let texels = u64::from(self.size.width) * u64::from(self.size.height);
        let images = self
            .allocated
            .images
            .iter()
            .map(|(image, texture, _)| MemoryItem::texture(&name(image.title), texture, Lifetime::Kept));
        let arrays = self.allocated.arrays.iter().map(|(array, pieces)| {
            let shared = array.owner == Owner::Shared;
            let lifetime = if shared { Lifetime::Transient } else { Lifetime::Kept };
            let item = MemoryItem { lifetime, ..pieces.memory(&name(array.title)) };
            if array.length % texels == 0 { item.texels(self.size) } else { item }
        });
        let uniforms =
            [self.views.memory(&name("views")), MemoryItem::buffer(&name("steps"), &self.uniforms)];
        images.chain(arrays).chain(uniforms).collect()
    }
}
