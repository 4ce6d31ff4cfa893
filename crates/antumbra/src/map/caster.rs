//! The pass that draws triangles instead of depth, and the meshes that it draws.

use super::{DEPTH_FORMAT, memory::MemoryItem, pipelines::Pipelines};
use crate::{
    capabilities::Capabilities,
    error::MeshError,
    light::{Size, View},
    shader::{self, TrianglePass},
    technique::{Coverage, Technique},
};
use glam::Mat4;
use std::{
    cell::Cell,
    num::NonZeroU64,
    ops::Range,
    sync::atomic::{AtomicBool, Ordering},
};
use wgpu::{BindGroup, BindGroupLayout, BufferBindingType, RenderPipeline, TextureFormat};

/// Share of a spot's near distance in front of which casters are cut off.
const LEAST_DISTANCE: f32 = 1.0 / 64.0;

/// Most triangles in one draw. Software drivers keep the vertices of a draw, which should fit their
/// caches, and treat all of them as clipped if one is.
const DRAWN_TOGETHER: u32 = 2048;

/// Rust side of `CasterView` in `mesh.wgsl.in`.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct CasterView {
    clip_from_world: [[f32; 4]; 4],
    size: [f32; 2],
    least_distance: f32,
    perspective: u32,
    reach: f32,
    near_over_far: f32,
    padding: [f32; 2],
}

pub(super) const VIEW_BYTES: u64 = size_of::<CasterView>() as u64;

impl CasterView {
    pub(super) fn new(view: &View, size: Size, coverage: Coverage) -> Self {
        // near = far · near_over_far, far − near = depth_world.
        let near = view.depth_world * view.near_over_far / (1.0 - view.near_over_far).max(1e-6);
        let perspective = perspective(view);
        Self {
            clip_from_world: view.clip_from_world.to_cols_array_2d(),
            size: [size.width as f32, size.height as f32],
            least_distance: if perspective == 1 { near * LEAST_DISTANCE } else { f32::MIN },
            perspective,
            reach: match coverage {
                Coverage::Touched => 0.5,
                Coverage::Centre => 0.0,
            },
            near_over_far: view.near_over_far,
            padding: [0.0; 2],
        }
    }
}

/// Triangles that cast shadows for a technique whose caster is not [`Caster::Depth`]: positions and
/// indices that the library's vertex shader reads from storage buffers, so that it sees whole
/// triangles.
///
/// [`Caster::Depth`]: crate::technique::Caster::Depth
#[derive(Debug)]
pub struct CasterMesh {
    place: wgpu::Buffer,
    group: BindGroup,
    indices: wgpu::Buffer,
    triangles: Range<u32>,
}

impl CasterMesh {
    /// Of two buffers with usage `STORAGE`: `positions`, three `f32` each, tightly packed (a vertex
    /// buffer of stride 12); `indices`, with usage `INDEX` too, `u32`, three per triangle, of which the
    /// triangles of the range are drawn. Either winding. Indices must be in range: what lies beyond a buffer
    /// is unspecified.
    ///
    /// # Errors
    /// [`MeshError`]: usage, size against the device's limits, a range beyond the indices.
    pub fn new(
        device: &wgpu::Device,
        positions: &wgpu::Buffer,
        indices: &wgpu::Buffer,
        triangles: Range<u32>,
        world_from_object: Mat4,
    ) -> Result<Self, MeshError> {
        let most = device.limits().max_storage_buffer_binding_size;
        use wgpu::BufferUsages as Usage;
        let needed =
            [("positions", positions, Usage::STORAGE), ("indices", indices, Usage::STORAGE | Usage::INDEX)];
        for (what, buffer, needed) in needed {
            if !buffer.usage().contains(needed) {
                let [found, needed] = [buffer.usage(), needed].map(|usage| format!("{usage:?}"));
                return Err(MeshError::Usage { what, found, needed });
            }
            if !(12..=most).contains(&buffer.size()) {
                return Err(MeshError::Bytes { what, bytes: buffer.size(), max: most });
            }
        }
        // Six vertices per triangle are counted in 32 bits.
        let count = (indices.size() / 12).min(u64::from(u32::MAX / 6)) as u32;
        if triangles.start > triangles.end || triangles.end > count {
            return Err(MeshError::Triangles { start: triangles.start, end: triangles.end, count });
        }
        let place = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("caster mesh"),
            size: size_of::<Mat4>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: true,
        });
        if let Ok(mut bytes) = place.get_mapped_range_mut(..) {
            bytes.copy_from_slice(bytemuck::bytes_of(&world_from_object));
        }
        place.unmap();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("caster mesh"),
            layout: &mesh_layout(device),
            entries: &[bound(0, &place), bound(1, positions), bound(2, indices)],
        });
        Ok(Self { place, group, indices: indices.clone(), triangles })
    }

    /// Moves it.
    pub fn place(&self, queue: &wgpu::Queue, world_from_object: Mat4) {
        queue.write_buffer(&self.place, 0, bytemuck::bytes_of(&world_from_object));
    }

    /// Draws it in the pass that [`ShadowMap::encode`](crate::ShadowMap::encode) hands out for `view`:
    /// three vertices per triangle, six under a spot, whose triangles may have to be cut.
    pub fn draw(&self, view: &View, pass: &mut wgpu::RenderPass<'_>) {
        self.draw_part(view, pass, self.triangles.clone());
    }

    /// Draws some of its triangles, counted from the first index. Leaves out those that
    /// [`new`](Self::new) was not given.
    pub fn draw_part(&self, view: &View, pass: &mut wgpu::RenderPass<'_>, triangles: Range<u32>) {
        let vertices = 3 * (1 + perspective(view));
        let (start, end) = (triangles.start.max(self.triangles.start), triangles.end.min(self.triangles.end));
        if start >= end {
            return;
        }
        pass.set_bind_group(1, &self.group, &[]);
        if DRAWS_INDEXED.get() {
            pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(3 * start..3 * end, 0, start..start + 1);
            return;
        }
        let first = number(vertices / 3 * start..vertices / 3 * end);
        for start in (start..end).step_by(DRAWN_TOGETHER as usize) {
            let end = end.min(start.saturating_add(DRAWN_TOGETHER));
            pass.draw(vertices * start..vertices * end, first..first + 1);
        }
    }
}

thread_local! {
    /// The first number that no triangle of the pass has which this thread records. Lists tell
    /// triangles of all meshes apart by numbers, and draws know neither one another nor their map.
    static NEXT_NUMBER: Cell<u32> = const { Cell::new(0) };
    /// Whether the pass that this thread records has a pipeline whose vertices are shared.
    static DRAWS_INDEXED: Cell<bool> = const { Cell::new(false) };
}

/// Tells draws that follow what the pipeline wants.
pub(super) fn draw_indexed(indexed: bool) {
    DRAWS_INDEXED.set(indexed);
}

/// Begins to number triangles from 0.
pub(super) fn number_anew() {
    draw_indexed(false);
    NEXT_NUMBER.set(0);
}

/// Numbers given since.
pub(super) fn numbered() -> u32 {
    NEXT_NUMBER.get()
}

/// What is added to those indices, so that no triangle before has the same number.
fn number(indices: Range<u32>) -> u32 {
    let first = NEXT_NUMBER.get().max(indices.start) - indices.start;
    NEXT_NUMBER.set(first.saturating_add(indices.end));
    first.min(u32::MAX - 1)
}

fn bound(binding: u32, buffer: &wgpu::Buffer) -> wgpu::BindGroupEntry<'_> {
    wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() }
}

/// 1 for a spot's view, else 0.
pub(super) fn perspective(view: &View) -> u32 {
    u32::from(view.near_over_far < 1.0)
}

fn layout(device: &wgpu::Device, label: &str, types: &[BufferBindingType]) -> BindGroupLayout {
    let entry = |(i, ty): (usize, &BufferBindingType)| wgpu::BindGroupLayoutEntry {
        binding: i as u32,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer { ty: *ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    };
    let entries: Vec<_> = types.iter().enumerate().map(entry).collect();
    device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries: &entries })
}

pub(super) fn mesh_layout(device: &wgpu::Device) -> BindGroupLayout {
    let read = BufferBindingType::Storage { read_only: true };
    layout(device, "caster mesh", &[BufferBindingType::Uniform, read, read])
}

/// Pipeline and views of the pass.
#[derive(Debug)]
pub(super) struct TriangleCaster {
    /// Per pass: under the sun, under a spot.
    pipelines: Vec<[RenderPipeline; 2]>,
    /// Per pass under the sun, where the device can.
    indexed: Vec<Option<RenderPipeline>>,
    /// Whether pipelines for cut-outs were asked for, which do not share vertices: then none does.
    pulls: AtomicBool,
    /// For any pass and view.
    general: RenderPipeline,
    coverages: &'static [Coverage],
    format: TextureFormat,
    size: Size,
    views: wgpu::Buffer,
    stride: u64,
    /// Per view and pass.
    groups: Vec<BindGroup>,
}

impl TriangleCaster {
    pub(super) fn new(
        device: &wgpu::Device,
        technique: &dyn Technique,
        coverages: &'static [Coverage],
        format: TextureFormat,
        (size, views): (Size, u32),
        pipelines: &Pipelines,
    ) -> Self {
        let stride =
            VIEW_BYTES.next_multiple_of(u64::from(device.limits().min_uniform_buffer_offset_alignment));
        let slots = views * coverages.len() as u32;
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("shadow caster views"),
            size: u64::from(slots) * stride,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = layout(device, "shadow caster view", &[BufferBindingType::Uniform]);
        let group = |slot: u32| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("shadow caster view"),
                layout: &layout,
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer: &buffer,
                        offset: u64::from(slot) * stride,
                        size: NonZeroU64::new(VIEW_BYTES),
                    }),
                }],
            })
        };
        let capabilities = Capabilities::of(device);
        let compiled = |pass| {
            let shader = shader::triangles(technique, &capabilities, None, pass);
            let conservative = pass == TrianglePass::Indexed(Coverage::Touched);
            pipelines.caster(&shader, &[format], |device| {
                compile(device, &shader, format, conservative, &layout, &[])
            })
        };
        let kinds =
            |coverage: &Coverage| [false, true].map(|spot| compiled(TrianglePass::Pulled(*coverage, spot)));
        let indexed = |coverage: &Coverage| {
            let can = match coverage {
                Coverage::Touched => capabilities.rasterises_conservatively(),
                Coverage::Centre => capabilities.numbers_triangles(),
            };
            // Software drivers shade vertices as fast as fragments, of which there are more.
            let software = device.adapter_info().device_type == wgpu::DeviceType::Cpu;
            (can && !software).then(|| compiled(TrianglePass::Indexed(*coverage)))
        };
        Self {
            groups: (0..slots).map(group).collect(),
            pipelines: coverages.iter().map(kinds).collect(),
            indexed: coverages.iter().map(indexed).collect(),
            pulls: AtomicBool::new(false),
            general: compiled(TrianglePass::Any),
            coverages,
            format,
            size,
            views: buffer,
            stride,
        }
    }

    /// The pipeline that leaves out what the caller's WGSL says. From now on all pipelines pull vertices.
    pub(super) fn cutout(
        &self,
        device: &wgpu::Device,
        technique: &dyn Technique,
        wgsl: &str,
        user: &[&BindGroupLayout],
    ) -> RenderPipeline {
        let shader = shader::triangles(technique, &Capabilities::of(device), Some(wgsl), TrianglePass::Any);
        let own = layout(device, "shadow caster view", &[BufferBindingType::Uniform]);
        self.pulls.store(true, Ordering::Relaxed);
        compile(device, &shader, self.format, false, &own, user)
    }

    /// The pipeline of a pass for a view of this kind, which the draws that follow are for.
    pub(super) fn pipeline(&self, view: &View, pass: usize) -> &RenderPipeline {
        let shared = perspective(view) == 0 && !self.pulls.load(Ordering::Relaxed);
        let indexed = self.indexed[pass].as_ref().filter(|_| shared);
        draw_indexed(indexed.is_some());
        indexed.unwrap_or(&self.pipelines[pass][perspective(view) as usize])
    }

    /// A pipeline for any pass and view, which the draws that follow are for.
    pub(super) fn general(&self) -> &RenderPipeline {
        draw_indexed(false);
        &self.general
    }

    /// Passes per view: layers of the map.
    pub(super) fn passes(&self) -> usize {
        self.coverages.len()
    }

    /// What a pass binds in group 0.
    pub(super) fn group(&self, view: usize, pass: usize) -> &BindGroup {
        &self.groups[view * self.passes() + pass]
    }

    pub(super) fn write(&self, queue: &wgpu::Queue, views: &[View]) {
        for (i, view) in views.iter().enumerate() {
            for (pass, coverage) in self.coverages.iter().enumerate() {
                let bytes = CasterView::new(view, self.size, *coverage);
                let slot = (i * self.passes() + pass) as u64;
                queue.write_buffer(&self.views, slot * self.stride, bytemuck::bytes_of(&bytes));
            }
        }
    }

    pub(super) fn memory(&self) -> MemoryItem {
        MemoryItem::buffer("caster views", &self.views)
    }
}

fn compile(
    device: &wgpu::Device,
    shader: &str,
    format: TextureFormat,
    conservative: bool,
    view: &BindGroupLayout,
    user: &[&BindGroupLayout],
) -> RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("shadow triangles"),
        source: wgpu::ShaderSource::Wgsl(shader.into()),
    });
    let mesh = mesh_layout(device);
    let groups: Vec<_> = [view, &mesh].into_iter().chain(user.iter().copied()).map(Some).collect();
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("shadow triangles"),
        bind_group_layouts: &groups,
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow triangles"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState {
            unclipped_depth: Capabilities::of(device).clamps_depth(),
            conservative,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(format.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
