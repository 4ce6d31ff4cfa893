//! The pipelines that draw geometry.

use super::Attributes;
use crate::{
    Gpu,
    layout::{Offset, uniform_entry},
    shaders, surfaces,
};
use antumbra::Capabilities;
use wgpu::{BindGroupLayout, RenderPipeline, TextureFormat, VertexFormat};

/// Pipelines for casters and for what the camera sees. No caster is culled, as for rays.
#[derive(Debug)]
pub(super) struct Pipelines {
    pub(super) uniform: BindGroupLayout,
    pub(super) caster: RenderPipeline,
    pub(super) masked_caster: RenderPipeline,
    /// Pipelines for triangles that a camera sees from both sides.
    seen: Seen,
    /// Pipelines for triangles that it sees from their front, if there are any.
    culled: Option<Seen>,
}

/// Pipelines for what the camera sees.
#[derive(Debug)]
struct Seen {
    surface: RenderPipeline,
    masked_surface: RenderPipeline,
    id: RenderPipeline,
    masked_id: RenderPipeline,
}

/// What one draw of the camera's pass shows.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group {
    /// Index into the geometry's materials.
    pub(super) material: usize,
    pub(super) masked: bool,
    /// Whether only fronts are seen.
    pub(super) culled: bool,
}

impl Pipelines {
    fn seen(&self, group: Group) -> &Seen {
        self.culled.as_ref().filter(|_| group.culled).unwrap_or(&self.seen)
    }

    pub(super) fn surface(&self, group: Group) -> &RenderPipeline {
        let seen = self.seen(group);
        if group.masked { &seen.masked_surface } else { &seen.surface }
    }

    pub(super) fn id(&self, group: Group) -> &RenderPipeline {
        let seen = self.seen(group);
        if group.masked { &seen.masked_id } else { &seen.id }
    }
}

/// What differs between the pipelines.
struct Recipe<'a> {
    layout: &'a wgpu::PipelineLayout,
    /// 1: positions alone; 2: with attributes.
    vertex_buffers: usize,
    module: &'a wgpu::ShaderModule,
    vertex: &'a str,
    fragment: Option<&'a str>,
    formats: &'a [TextureFormat],
    compare: wgpu::CompareFunction,
    unclipped_depth: bool,
    cull_mode: Option<wgpu::Face>,
}

impl Pipelines {
    /// `culls` asks for pipelines that show fronts alone.
    pub(super) fn new(gpu: &Gpu, material: &BindGroupLayout, culls: bool) -> Self {
        let uniform = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("uniform"),
            entries: &[uniform_entry(0, Offset::Dynamic)],
        });
        let layout = |groups: &[Option<&BindGroupLayout>]| {
            gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("geometry"),
                bind_group_layouts: groups,
                immediate_size: 0,
            })
        };
        let (bare, full) = (layout(&[Some(&uniform)]), layout(&[Some(&uniform), Some(material)]));
        let surfaces = wgsl(gpu, "surfaces", &[shaders::SURFACES]);
        let caster = wgsl(gpu, "caster", &[shaders::CASTER, antumbra::CASTER_WGSL]);
        let clamps = Capabilities::of(&gpu.device).clamps_depth();
        let cast = |vertex, fragment: Option<&'static str>| Recipe {
            layout: if fragment.is_some() { &full } else { &bare },
            vertex_buffers: if fragment.is_some() { 2 } else { 1 },
            module: &caster,
            vertex,
            fragment,
            formats: &[],
            compare: wgpu::CompareFunction::Less,
            unclipped_depth: clamps,
            cull_mode: None,
        };
        let see = |fragment, formats, cull_mode| Recipe {
            layout: &full,
            vertex_buffers: 2,
            module: &surfaces,
            vertex: "surface_vertex",
            fragment: Some(fragment),
            formats,
            compare: wgpu::CompareFunction::Greater,
            unclipped_depth: false,
            cull_mode,
        };
        let [plain, masked] =
            if clamps { ["clamped", "masked_clamped"] } else { ["pancaked", "masked_pancaked"] };
        let make = |recipe: Recipe<'_>| pipeline(gpu, &recipe);
        let seen = |cull| Seen {
            surface: make(see("surface", &surfaces::FORMATS, cull)),
            masked_surface: make(see("masked_surface", &surfaces::FORMATS, cull)),
            id: make(see("triangle_id", &[TextureFormat::R32Uint], cull)),
            masked_id: make(see("masked_triangle_id", &[TextureFormat::R32Uint], cull)),
        };
        Self {
            caster: make(cast(plain, None)),
            masked_caster: make(cast(masked, Some("cutout"))),
            seen: seen(None),
            culled: culls.then(|| seen(Some(wgpu::Face::Back))),
            uniform,
        }
    }

    /// What pipelines bind as group 0: `bytes` of a buffer, from an offset that is set with the group.
    pub(super) fn uniform_group(&self, gpu: &Gpu, buffer: &wgpu::Buffer, bytes: usize) -> wgpu::BindGroup {
        let size = std::num::NonZeroU64::new(bytes as u64);
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("uniform"),
            layout: &self.uniform,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding { buffer, offset: 0, size }),
            }],
        })
    }
}

fn wgsl(gpu: &Gpu, label: &str, parts: &[&str]) -> wgpu::ShaderModule {
    gpu.shader(label, wgpu::ShaderSource::Wgsl(parts.concat().into()))
}

fn pipeline(gpu: &Gpu, recipe: &Recipe<'_>) -> RenderPipeline {
    let attribute =
        |shader_location, offset, format| wgpu::VertexAttribute { format, offset, shader_location };
    let positions = [attribute(0, 0, VertexFormat::Float32x3)];
    let attributes = [
        attribute(1, 0, VertexFormat::Float32x3),
        attribute(2, 12, VertexFormat::Float32x2),
        attribute(3, 20, VertexFormat::Float32x4),
    ];
    let buffer = |array_stride, attributes| {
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    };
    let buffers = [buffer(12, &positions), buffer(size_of::<Attributes>() as u64, &attributes)];
    let targets: Vec<_> = recipe.formats.iter().map(|f| Some(wgpu::ColorTargetState::from(*f))).collect();
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(recipe.fragment.unwrap_or(recipe.vertex)),
        layout: Some(recipe.layout),
        vertex: wgpu::VertexState {
            module: recipe.module,
            entry_point: Some(recipe.vertex),
            compilation_options: Default::default(),
            buffers: &buffers[..recipe.vertex_buffers],
        },
        primitive: wgpu::PrimitiveState {
            unclipped_depth: recipe.unclipped_depth,
            cull_mode: recipe.cull_mode,
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: antumbra::DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(recipe.compare),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: recipe.fragment.map(|entry| wgpu::FragmentState {
            module: recipe.module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}
