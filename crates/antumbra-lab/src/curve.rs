//! The shadow test as a technique approximates it: visibility against how far a receiver lies behind
//! its caster [Annen et al. 2007, figure 3; Annen et al. 2008, figure 2].

use crate::{
    gpu::{Gpu, Wait},
    shaders,
};
use antumbra::{
    Capabilities, CasterMesh, DEPTH_FORMAT, Options, ShadowMap, Size, Technique, View,
    technique::{self, Bias, CasterStorage},
};
use anyhow::{Context, Result, bail};
use glam::{Mat4, Vec4};

/// Room for the widest kernel on both sides of the middle.
const SIZE: Size = Size::square(64);

/// What `shadow_visibility` answers in the middle of a map whose every texel holds the linear depth
/// `caster`, for receivers at the linear depths `receivers` that face the light, without bias. All
/// depths are shares of the light's range, 0 to 1; so are the answers, 0 in shadow, 1 lit.
///
/// # Errors
/// Settings that the device cannot do, naming the technique; a lost device.
pub fn visibility(gpu: &Gpu, technique: &dyn Technique, caster: f32, receivers: &[f32]) -> Result<Vec<f32>> {
    let questions: Vec<[f32; 2]> = receivers.iter().map(|depth| [0.0, *depth]).collect();
    answers(gpu, technique, [caster, 1.0], SIZE.width, &questions)
}

/// What `shadow_visibility` answers across the edge of a caster that covers the left half of the map's
/// texels at depth ¼ and leaves the others at 1, for receivers at the depth `receiver`. `positions` are in texels from the edge, to the right, and
/// at most 16 each way. Answers are 0 in shadow, 1 lit.
///
/// # Errors
/// As [`visibility`]; a technique that keeps triangles, which has no texels to filter.
pub fn edge(gpu: &Gpu, technique: &dyn Technique, receiver: f32, positions: &[f32]) -> Result<Vec<f32>> {
    beside(gpu, technique, [0.25, 1.0, receiver], positions)
}

/// The same for a caster at the first of three depths, beside texels that hold the second (1 if they are empty), and
/// receivers at the third.
///
/// # Errors
/// As [`edge`].
pub fn beside(
    gpu: &Gpu,
    technique: &dyn Technique,
    [caster, rest, receiver]: [f32; 3],
    positions: &[f32],
) -> Result<Vec<f32>> {
    let texel = 2.0 / SIZE.width as f32;
    let device = Capabilities::of(&gpu.device);
    if technique.describe(&device)?.storage != CasterStorage::Depth {
        bail!("{} keeps triangles and filters no texels", technique::spec(technique));
    }
    if let Some(far) = positions.iter().find(|p| !(-16.0..=16.0).contains(*p)) {
        bail!("a position {far} texels from the edge: allowed are −16 to 16");
    }
    let questions: Vec<[f32; 2]> = positions.iter().map(|p| [p * texel, receiver]).collect();
    answers(gpu, technique, [caster, rest], SIZE.width / 2, &questions)
}

/// Answers to questions (position across the map from −1 to 1, depth) where the caster covers so many
/// columns of texels from the left, and another depth the rest.
fn answers(
    gpu: &Gpu,
    technique: &dyn Technique,
    [caster, rest]: [f32; 2],
    columns: u32,
    questions: &[[f32; 2]],
) -> Result<Vec<f32>> {
    let options = Options::from(SIZE).bias(Bias::NONE);
    let mut shadows =
        ShadowMap::new(&gpu.device, technique, options).with_context(|| technique::spec(technique))?;
    shadows.prepare(&gpu.queue, &[view()])?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    match shadows.description().storage {
        CasterStorage::Depth => {
            // An empty texel holds 1 as it is.
            let flats = [(caster, 0..columns), (rest, columns..SIZE.width)];
            let flats = flats.map(|(depth, columns)| (flat(gpu, depth), columns));
            shadows.encode(&mut encoder, |pass| {
                for (flat, columns) in flats.iter().filter(|(_, columns)| !columns.is_empty()) {
                    pass.set_pipeline(flat);
                    pass.set_scissor_rect(columns.start, 0, columns.end - columns.start, SIZE.height);
                    pass.draw(0..3, 0..1);
                }
            })?;
        }
        _ => {
            let triangle = triangle(gpu, caster)?;
            shadows.encode(&mut encoder, |pass| pass.draw_mesh(&triangle, ..))?;
        }
    }
    let answers = ask(gpu, &shadows, questions, &mut encoder);
    gpu.finish(encoder).with_context(|| technique::spec(technique))?;
    let bytes = gpu.map(&answers)?;
    Ok(bytemuck::pod_collect_to_vec(&bytes[..4 * questions.len()]))
}

/// A view whose light space is world space: x and y in [−1,1] (y up), depth z in [0,1].
fn view() -> View {
    View {
        clip_from_world: Mat4::IDENTITY,
        depth_plane: Vec4::Z,
        to_light: Vec4::NEG_Z,
        texel_world: 2.0 / SIZE.width as f32,
        linear_from_clip: [Vec4::Z, Vec4::W],
        depth_world: 1.0,
    }
}

/// The same caster as a mesh: one triangle, whose edges are outside.
fn triangle(gpu: &Gpu, depth: f32) -> Result<CasterMesh> {
    let positions = [-1.5, -1.5, depth, 4.5, -1.5, depth, -1.5, 4.5, depth];
    let buffer =
        |label, bytes| gpu.buffer(label, bytes, wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDEX);
    let positions = buffer("flat caster", bytemuck::cast_slice(&positions));
    let indices = buffer("flat caster", bytemuck::cast_slice(&[0u32, 1, 2]));
    Ok(CasterMesh::new(&gpu.device, &positions, &indices, 0..1, Mat4::IDENTITY)?)
}

/// Draws a caster parallel to the map over all of it.
fn flat(gpu: &Gpu, depth: f32) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(shaders::FLAT_CASTER.into());
    let module = gpu.shader("flat caster", source);
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("flat caster"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions {
                constants: &[("depth", f64::from(depth))],
                ..Default::default()
            },
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::LessEqual),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

/// Encodes one question per receiver; the answers lie in the buffer once the encoder has run.
fn ask(
    gpu: &Gpu,
    shadows: &ShadowMap,
    receivers: &[[f32; 2]],
    encoder: &mut wgpu::CommandEncoder,
) -> wgpu::Buffer {
    use wgpu::BufferUsages as Usage;
    let source = gpu.buffer("receivers", bytemuck::cast_slice(receivers), Usage::STORAGE);
    let buffer = |usage| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("answers"),
            size: source.size(),
            usage,
            mapped_at_creation: false,
        })
    };
    let target = buffer(Usage::STORAGE | Usage::COPY_SRC);
    let answers = buffer(Usage::MAP_READ | Usage::COPY_DST);
    let (pipeline, layout) = question(gpu, shadows);
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("curve"),
        layout: &layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: source.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: target.as_entire_binding() },
        ],
    });
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, shadows.bind_group(), &[]);
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups(receivers.len().div_ceil(64) as u32, 1, 1);
    }
    encoder.copy_buffer_to_buffer(&target, 0, &answers, 0, target.size());
    answers
}

/// The pipeline that asks a map, and the layout of its own group: questions and answers.
fn question(gpu: &Gpu, shadows: &ShadowMap) -> (wgpu::ComputePipeline, wgpu::BindGroupLayout) {
    let device = &gpu.device;
    let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let own = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("curve"),
        entries: &[entry(0, true), entry(1, false)],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("curve"),
        bind_group_layouts: &[Some(shadows.layout()), Some(&own)],
        immediate_size: 0,
    });
    let module = gpu.shader("curve", shadows.wgsl(0).after(shaders::CURVE));
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("curve"),
        layout: Some(&layout),
        module: &module,
        entry_point: Some("main"),
        compilation_options: Default::default(),
        cache: None,
    });
    (pipeline, own)
}
