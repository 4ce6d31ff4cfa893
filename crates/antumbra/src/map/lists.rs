//! Lists of the triangles that touch each texel, for [`Caster::Lists`]: drawn once to count them, given
//! entries, drawn again to fill them.
//!
//! [`Caster::Lists`]: crate::technique::Caster::Lists

use super::{
    Capacity, CasterPass, Probe, draw,
    memory::{Lifetime, MemoryItem},
    numbered::{self, ATOMIC, Numbered, UNIFORM},
    pieces::Pieces,
    pipelines::Pipelines,
};
use crate::{
    light::{Size, View},
    shader::{
        self, Composition,
        buffers::{LIST_BINDINGS, SCAN_BINDINGS},
        split::{Split, Splits},
    },
    technique::List,
};
use wgpu::{
    BindGroup, BindGroupLayout, BindingType, Buffer, BufferUsages, CompareFunction, ComputePipeline,
    ShaderStages, Texture, TextureFormat, TextureView,
};

/// Texels across and, at most, down of textures that are arrays, as in `lists.wgsl.in` and `exact.wgsl`.
pub(super) const ROW: u32 = 2048;
/// Texels of an invocation of `scan.wgsl.in`.
const SEGMENT: u32 = 128;
/// Invocations of its workgroups.
const WORKGROUP: u32 = 64;
/// Bytes of the count of a texel.
const COUNT: u64 = 4;
/// Bytes of `ListTotals`.
const TOTALS: u64 = 8;

/// How large a map is.
#[derive(Debug, Clone, Copy)]
pub(super) struct ListSize {
    pub(super) size: Size,
    pub(super) views: u32,
    pub(super) capacity: Capacity,
    /// Whether triangles have records.
    pub(super) cutouts: bool,
}

impl ListSize {
    /// Texels of a view.
    fn texels(&self) -> u64 {
        u64::from(self.size.width) * u64::from(self.size.height)
    }

    /// How counts are split.
    pub(super) fn splits(&self, limits: &wgpu::Limits) -> Splits {
        let max = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        Splits { counts: Split::new(self.texels(), COUNT, max), ..Splits::default() }
    }

    /// Rows of textures of vertices: half of them of records, if there are any.
    pub(super) fn rows(&self) -> u32 {
        self.capacity.rows() * (1 + u32::from(self.cutouts))
    }

    /// Entries of a view.
    fn entries(&self) -> u32 {
        (self.texels() * u64::from(self.capacity.triangles_per_texel)).min(u64::from(u32::MAX)) as u32
    }

    /// Layers of a view's numbers.
    pub(super) fn number_layers(&self) -> u32 {
        self.entries().div_ceil(ROW * ROW)
    }
}

/// Rust side of `ListPass` in `lists.wgsl.in` and `scan.wgsl.in`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ListPass {
    view: u32,
    fills: u32,
    entries: u32,
    triangles: u32,
}

/// Pipelines, buffers and textures of the lists.
#[derive(Debug)]
pub(super) struct Lists {
    numbered: Numbered,
    scan: ComputePipeline,
    extent: ListSize,
    passes: Buffer,
    counts: Pieces,
    marks: Buffer,
    totals: Buffer,
    /// In the order of [`List`], each with a view of all of it.
    textures: [(Texture, TextureView); 3],
    /// Per view: to count, to fill.
    draws: Vec<[BindGroup; 2]>,
    /// Per view.
    scans: Vec<BindGroup>,
}

impl Lists {
    pub(super) fn new(
        device: &wgpu::Device,
        composition: &Composition,
        extent: ListSize,
        pipelines: &Pipelines,
    ) -> Self {
        let draws = (extent.size, extent.views);
        let splits = extent.splits(&device.limits());
        let more = splits.counts.count() as usize - 1;
        let layout = (draw_layout(device, more), splits);
        let numbered = Numbered::new(device, composition, draws, CompareFunction::Always, layout, pipelines);
        let pass = |slot: u32| {
            let (entries, triangles) = (extent.entries(), extent.capacity.triangles);
            ListPass { view: slot / 2, fills: slot % 2, entries, triangles }
        };
        let passes =
            numbered.passes(device, "list passes", &(0..2 * extent.views).map(pass).collect::<Vec<_>>());
        let storage = |label, bytes| {
            let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
            numbered::buffer(device, label, bytes, usage)
        };
        let counts = Pieces::new(device, "list counts", splits.counts, COUNT);
        let marks = storage("list marks", 4 * u64::from(extent.capacity.triangles.div_ceil(32)));
        let totals = storage("list totals", TOTALS * u64::from(extent.views));
        let Size { width, height } = extent.size;
        let layers = [2, extent.number_layers(), 3];
        let rows = extent.entries().div_ceil(ROW).min(ROW);
        let texture = |i: usize, label, width, height, format| {
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: layers[i] * extent.views },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
                view_formats: &[],
            });
            let view = part(&texture, 0, layers[i] * extent.views);
            (texture, view)
        };
        let textures = [
            texture(0, "list ranges", width, height, TextureFormat::R32Uint),
            texture(1, "list numbers", ROW, rows, TextureFormat::R32Uint),
            texture(2, "list corners", ROW, extent.rows(), TextureFormat::Rgba32Float),
        ];
        let scan_layout = scan_layout(device, more);
        let pass =
            |view: u32, fills: u32| numbered.slot(&passes, 2 * view + fills, size_of::<ListPass>() as u64);
        let of_view = |i: usize, view: u32| part(&textures[i].0, view * layers[i], layers[i]);
        let draw = |view: u32, fills: u32| {
            let (numbers, corners) = (of_view(1, view), of_view(2, view));
            let (first, more) = (counts.bindings().take(1), counts.bindings().skip(1));
            let own = [
                marks.as_entire_binding(),
                wgpu::BindingResource::TextureView(&numbers),
                wgpu::BindingResource::TextureView(&corners),
            ];
            let all =
                [numbered.view(view), pass(view, fills)].into_iter().chain(first).chain(own).chain(more);
            numbered::bind(device, numbered.layout(), all)
        };
        let scan = |view: u32| {
            let ranges = of_view(0, view);
            let (first, more) = (counts.bindings().take(1), counts.bindings().skip(1));
            let own = [totals.as_entire_binding(), wgpu::BindingResource::TextureView(&ranges)];
            let all = [pass(view, 0)].into_iter().chain(first).chain(own).chain(more);
            numbered::bind(device, &scan_layout, all)
        };
        Self {
            draws: (0..extent.views).map(|view| [draw(view, 0), draw(view, 1)]).collect(),
            scans: (0..extent.views).map(scan).collect(),
            scan: compile_scan(device, &scan_layout, &splits),
            numbered,
            extent,
            passes,
            counts,
            marks,
            totals,
            textures,
        }
    }

    /// Pipelines and views.
    pub(super) fn numbered(&self) -> &Numbered {
        &self.numbered
    }

    /// Counts, gives entries, fills. `depth` is a target that the passes need and leave alone.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (index, view): (usize, &View),
        depth: &TextureView,
        probe: &mut dyn Probe,
        draw: &mut impl FnMut(&mut CasterPass<'_>),
    ) {
        self.counts.clear(encoder, 0..self.extent.texels());
        encoder.clear_buffer(&self.marks, 0, None);
        encoder.clear_buffer(&self.totals, index as u64 * TOTALS, Some(TOTALS));
        for fills in 0..2 {
            if fills == 1 {
                let timestamps = probe.pass("scan", index);
                let mut pass = draw::compute_pass(encoder, "scan", timestamps);
                pass.set_pipeline(&self.scan);
                pass.set_bind_group(0, &self.scans[index], &[]);
                let groups = self.extent.texels().div_ceil(u64::from(SEGMENT * WORKGROUP));
                pass.dispatch_workgroups(groups as u32, 1, 1);
            }
            self.numbered.draw(encoder, (index, view), &self.draws[index][fills], depth, probe, draw);
        }
    }

    /// The texture that a binding names.
    pub(super) fn texture(&self, list: List) -> (&TextureView, TextureFormat) {
        let (texture, view) = &self.textures[list as usize];
        (view, texture.format())
    }

    /// What [`ShadowMap::list_totals`](super::ShadowMap::list_totals) promises.
    pub(super) fn totals(&self) -> &Buffer {
        &self.totals
    }

    pub(super) fn memory(&self) -> Vec<MemoryItem> {
        let texture = |(name, (texture, _)): (&str, &(Texture, TextureView))| {
            MemoryItem::texture(name, texture, Lifetime::Kept)
        };
        let buffer = |(name, buffer, lifetime): (&str, &Buffer, Lifetime)| MemoryItem {
            lifetime,
            ..MemoryItem::buffer(name, buffer)
        };
        let buffers = [
            ("list marks", &self.marks, Lifetime::Transient),
            ("list totals", &self.totals, Lifetime::Kept),
            ("list views", self.numbered.views(), Lifetime::Kept),
            ("list passes", &self.passes, Lifetime::Kept),
        ];
        let names = ["list ranges", "list numbers", "list corners"];
        let counts = MemoryItem { lifetime: Lifetime::Transient, ..self.counts.memory("list counts") };
        let buffers = [counts].into_iter().chain(buffers.into_iter().map(buffer));
        names.into_iter().zip(&self.textures).map(texture).chain(buffers).collect()
    }

    /// One sentence for `explain`.
    pub(super) fn explain(&self) -> String {
        format!(
            "lists of {} triangles, {} per texel, of {} different ones in each view; list_totals() and triangles_drawn() tell whether that was enough, Options::capacity sets it",
            self.extent.entries(),
            self.extent.capacity.triangles_per_texel,
            self.extent.capacity.triangles
        )
    }
}

/// Some layers of a texture.
fn part(texture: &Texture, base_array_layer: u32, layers: u32) -> TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2Array),
        base_array_layer,
        array_layer_count: Some(layers),
        ..Default::default()
    })
}

fn stored(format: TextureFormat) -> BindingType {
    BindingType::StorageTexture {
        access: wgpu::StorageTextureAccess::WriteOnly,
        format,
        view_dimension: wgpu::TextureViewDimension::D2Array,
    }
}

/// With so many further buffers of counts.
fn draw_layout(device: &wgpu::Device, more: usize) -> BindGroupLayout {
    let fragment = |ty| (ShaderStages::FRAGMENT, ty);
    let own: [_; LIST_BINDINGS as usize] = [
        (ShaderStages::VERTEX_FRAGMENT, UNIFORM),
        fragment(UNIFORM),
        fragment(ATOMIC),
        fragment(ATOMIC),
        fragment(stored(TextureFormat::R32Uint)),
        fragment(stored(TextureFormat::Rgba32Float)),
    ];
    numbered::layout(device, &[&own[..], &vec![fragment(ATOMIC); more]].concat())
}

/// With so many further buffers of counts.
fn scan_layout(device: &wgpu::Device, more: usize) -> BindGroupLayout {
    let own: [_; SCAN_BINDINGS as usize] = [UNIFORM, ATOMIC, ATOMIC, stored(TextureFormat::R32Uint)];
    let all = own.into_iter().chain(std::iter::repeat_n(ATOMIC, more));
    numbered::layout(device, &all.map(|ty| (ShaderStages::COMPUTE, ty)).collect::<Vec<_>>())
}

fn compile_scan(device: &wgpu::Device, layout: &BindGroupLayout, splits: &Splits) -> ComputePipeline {
    device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("scan"),
        layout: Some(&numbered::pipeline_layout(device, &[Some(layout)])),
        module: &numbered::module(device, &shader::scan(splits)),
        entry_point: Some("compute"),
        compilation_options: Default::default(),
        cache: None,
    })
}
