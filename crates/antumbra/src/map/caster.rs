//! The pass that draws triangles instead of depth.

use super::{DEPTH_FORMAT, cast::MeshPipeline, memory::MemoryItem, pipelines::Pipelines};
use crate::{
    capabilities::Capabilities,
    light::{Size, View},
    shader::{self, Composition, Cutout, TrianglePass, split::Splits},
    technique::Coverage,
};
use std::num::NonZeroU64;
use wgpu::{BindGroup, BindGroupLayout, BufferBindingType, RenderPipeline, TextureFormat};

/// Share of a spot's near distance in front of which casters are cut off.
const LEAST_DISTANCE: f32 = 1.0 / 64.0;

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
        // The apex lies in front of the near plane by the near distance.
        let near = -view.depth_world * view.depth_plane.dot(view.to_light);
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
            near_over_far: view.near_over_far(),
            padding: [0.0; 2],
        }
    }
}

/// 1 for a spot's view, else 0.
pub(super) fn perspective(view: &View) -> u32 {
    u32::from(view.is_perspective())
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
    layout(device, "caster mesh", &[BufferBindingType::Uniform, read, read, BufferBindingType::Uniform])
}

/// Pipeline and views of the pass.
#[derive(Debug)]
pub(super) struct TriangleCaster {
    /// Per pass: under the sun, under a spot.
    pipelines: Vec<[RenderPipeline; 2]>,
    /// Per pass under the sun, where the device can.
    indexed: Vec<Option<RenderPipeline>>,
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
        composition: &Composition,
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
            let shader = shader::triangles(composition, &capabilities, None, pass, &Splits::default());
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
            coverages,
            format,
            size,
            views: buffer,
            stride,
        }
    }

    /// The pipeline, for any pass and view, that leaves out what the caller's WGSL says.
    pub(super) fn cutout(
        &self,
        device: &wgpu::Device,
        composition: &Composition,
        wgsl: &str,
        user: &[&BindGroupLayout],
    ) -> RenderPipeline {
        let (device_can, pass, splits) = (Capabilities::of(device), TrianglePass::Any, Splits::default());
        let shader =
            shader::triangles(composition, &device_can, Some(Cutout { wgsl, by_ray: false }), pass, &splits);
        let own = layout(device, "shadow caster view", &[BufferBindingType::Uniform]);
        compile(device, &shader, self.format, false, &own, user)
    }

    /// What meshes are drawn with in a pass of a view.
    pub(super) fn meshes(&self, (index, view): (usize, &View), pass: usize) -> MeshPipeline<'_> {
        let spot = perspective(view);
        let indexed = self.indexed[pass].as_ref().filter(|_| spot == 0);
        MeshPipeline {
            pipeline: indexed.unwrap_or(&self.pipelines[pass][spot as usize]),
            group: &self.groups[index * self.passes() + pass],
            indexed: indexed.is_some(),
        }
    }

    /// Passes per view: layers of the map.
    pub(super) fn passes(&self) -> usize {
        self.coverages.len()
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
