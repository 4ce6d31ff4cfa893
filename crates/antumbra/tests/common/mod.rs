//! A shadow map over any depth image, asked for its visibility at any point: light space is world
//! space, with x and y in [−1,1] (y up) and depth z in [0,1].

#![allow(dead_code, unreachable_pub, reason = "each test program uses a part")]

use antumbra::{
    Capabilities, CasterMesh, NoProbe, Options, Pipelines, ShadowMap, Size, Technique, View,
    technique::Caster,
};
use antumbra_testing::Gpu;
use glam::{Mat4, Vec2, Vec3, Vec4};
use std::{
    collections::HashMap,
    sync::{Arc, Mutex, OnceLock, PoisonError},
};

/// A point to be asked about.
#[derive(Debug, Clone, Copy)]
pub struct Receiver {
    /// Texture coordinates, y down.
    pub uv: Vec2,
    /// Linear depth.
    pub depth: f32,
    /// Change of uv to the next pixel in x and in y.
    pub footprint: Vec2,
    /// Unit normal.
    pub normal: Vec3,
}

impl Receiver {
    /// A point that faces the light, with a footprint far below a texel.
    pub fn point(u: f32, v: f32, depth: f32) -> Self {
        Self { uv: Vec2::new(u, v), depth, footprint: Vec2::splat(1e-6), normal: Vec3::NEG_Z }
    }
}

/// The view whose light space is world space.
pub fn view(size: Size) -> View {
    View {
        clip_from_world: Mat4::IDENTITY,
        depth_plane: Vec4::Z,
        to_light: Vec4::NEG_Z,
        texel_world: 2.0 / size.width as f32,
        linear_from_clip: [Vec4::Z, Vec4::W],
        depth_world: 1.0,
    }
}

/// A depth texture with `depth(x, y)` in texel (x, y), y down.
pub fn depth_texture(gpu: &Gpu, size: Size, depth: impl Fn(u32, u32) -> f32) -> wgpu::Texture {
    depth_layers(gpu, size, 1, |_, x, y| depth(x, y))
}

/// A depth texture with `depth(layer, x, y)` in texel (x, y) of each layer, y down.
pub fn depth_layers(
    gpu: &Gpu,
    size: Size,
    layers: u32,
    depth: impl Fn(u32, u32, u32) -> f32,
) -> wgpu::Texture {
    let texels: Vec<f32> = (0..layers)
        .flat_map(|layer| (0..size.height).map(move |y| (layer, y)))
        .flat_map(|(layer, y)| (0..size.width).map(move |x| (layer, x, y)))
        .map(|(layer, x, y)| depth(layer, x, y))
        .collect();
    let texture = |format, usage| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("test depth"),
            size: wgpu::Extent3d { width: size.width, height: size.height, depth_or_array_layers: layers },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage,
            view_formats: &[],
        })
    };
    use wgpu::TextureUsages as Usage;
    let source = texture(wgpu::TextureFormat::R32Float, Usage::TEXTURE_BINDING | Usage::COPY_DST);
    let target =
        texture(antumbra::DEPTH_FORMAT, Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC);
    gpu.queue.write_texture(
        source.as_image_copy(),
        bytes_of(&texels),
        wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * size.width),
            rows_per_image: Some(size.height),
        },
        source.size(),
    );
    let pipeline = kept(gpu).depth;
    let one = |texture: &wgpu::Texture, layer| {
        texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2),
            base_array_layer: layer,
            array_layer_count: Some(1),
            ..Default::default()
        })
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for layer in 0..layers {
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&one(&source, layer)),
            }],
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("test depth"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &one(&target, layer),
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
    }
    gpu.queue.submit([encoder.finish()]);
    target
}

/// What all tests of a program share, so that the driver compiles it once.
#[derive(Debug, Clone)]
struct Kept {
    pipelines: Pipelines,
    depth: wgpu::RenderPipeline,
    compute: Arc<Mutex<HashMap<String, wgpu::ComputePipeline>>>,
}

/// Devices of other instances cannot be told apart by comparing them: only the shared one keeps.
fn kept(gpu: &Gpu) -> Kept {
    static SHARED: OnceLock<Kept> = OnceLock::new();
    let make = || Kept {
        pipelines: Pipelines::new(&gpu.device),
        depth: depth_pipeline(gpu),
        compute: Arc::default(),
    };
    let shared = antumbra_testing::gpu().is_some_and(|shared| std::ptr::eq(shared, gpu));
    if shared { SHARED.get_or_init(make).clone() } else { make() }
}

fn depth_pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("test depth"),
        source: wgpu::ShaderSource::Wgsl(include_str!("depth.wgsl").into()),
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("test depth"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: antumbra::DEPTH_FORMAT,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Always),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[],
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A filtered shadow map over that depth.
pub fn shadow_map(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
) -> ShadowMap {
    shadow_map_of(gpu, technique, depth, options, &[view(texels_of(depth))])
}

fn texels_of(depth: &wgpu::Texture) -> Size {
    Size { width: depth.width(), height: depth.height() }
}

/// Depth with every layer `times` times in a row.
fn repeat_layers(gpu: &Gpu, depth: &wgpu::Texture, times: u32) -> wgpu::Texture {
    let layers = depth.depth_or_array_layers();
    let one = wgpu::Extent3d { depth_or_array_layers: 1, ..depth.size() };
    let repeated = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("test depth"),
        size: wgpu::Extent3d { depth_or_array_layers: layers * times, ..one },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: depth.format(),
        usage: depth.usage() | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let at = |texture, z| wgpu::TexelCopyTextureInfo {
        texture,
        mip_level: 0,
        origin: wgpu::Origin3d { x: 0, y: 0, z },
        aspect: wgpu::TextureAspect::All,
    };
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for layer in 0..layers * times {
        encoder.copy_texture_to_texture(at(depth, layer / times), at(&repeated, layer), one);
    }
    gpu.queue.submit([encoder.finish()]);
    repeated
}

/// The same with those views, one per layer of the depth.
pub fn shadow_map_of(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
    views: &[View],
) -> ShadowMap {
    let options = options.pipelines(&kept(gpu).pipelines);
    let described = technique.describe(&Capabilities::of(&gpu.device)).unwrap();
    if described.caster != Caster::Depth {
        return triangle_map(gpu, technique, depth, options, views);
    }
    // Depth that was made for one caster pass serves all of them.
    let casts = described.sample_offsets.len() as u32;
    let repeated = depth.depth_or_array_layers() == views.len() as u32 && casts > 1;
    let depth = if repeated { repeat_layers(gpu, depth, casts) } else { depth.clone() };
    let mut shadows = ShadowMap::from_depth(&gpu.device, technique, &depth, options).unwrap();
    shadows.prepare(&gpu.queue, views).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode_filter(&mut encoder, &mut NoProbe);
    gpu.queue.submit([encoder.finish()]);
    shadows
}

/// The same for techniques whose casters are triangles: a square of three for every texel of that depth
/// that is not empty, so little smaller than the texel that it touches no other.
fn triangle_map(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
    views: &[View],
) -> ShadowMap {
    const INSET: f32 = 2e-3;
    let size = texels_of(depth);
    let meshes: Vec<CasterMesh> = views
        .iter()
        .enumerate()
        .map(|(layer, view)| {
            let world_from_clip = view.clip_from_world.inverse();
            let mut corners = Vec::new();
            for (i, z) in floats(&gpu.read_texture(depth, layer as u32, 0)).into_iter().enumerate() {
                let (x, y) = ((i as u32 % size.width) as f32, (i as u32 / size.width) as f32);
                let at = |right: f32, down: f32| {
                    let end = |k: f32| k + INSET * (1.0 - 2.0 * k);
                    let u = (x + end(right)) / size.width as f32;
                    let v = (y + end(down)) / size.height as f32;
                    world_from_clip.project_point3(Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, z))
                };
                let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
                // Around a point of the upper side, so that no edge crosses the centre.
                let m = at(0.4, 0.0);
                if z < 1.0 {
                    corners.extend([m, c, d, m, d, b, m, a, c]);
                }
            }
            caster_mesh(gpu, &corners)
        })
        .collect();
    let options = Options { size, views: views.len() as u32, ..options };
    let mut shadows = ShadowMap::new(&gpu.device, technique, options).unwrap();
    shadows.prepare(&gpu.queue, views).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&meshes[pass.index()], ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    shadows
}

/// World-space triangles, three corners each, as casters.
pub fn caster_mesh(gpu: &Gpu, corners: &[Vec3]) -> CasterMesh {
    let [positions, indices] = caster_buffers(gpu, corners);
    CasterMesh::new(&gpu.device, &positions, &indices, 0..corners.len() as u32 / 3, Mat4::IDENTITY).unwrap()
}

/// Their positions and indices.
pub fn caster_buffers(gpu: &Gpu, corners: &[Vec3]) -> [wgpu::Buffer; 2] {
    let buffer = |bytes: &[u8]| {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("test mesh"),
            size: bytes.len().max(36) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        buffer
    };
    let indices: Vec<u32> = (0..corners.len() as u32).collect();
    [buffer(bytemuck::cast_slice(corners)), buffer(bytemuck::cast_slice(&indices))]
}

/// `shadow_visibility` at receivers.
pub fn visibility(gpu: &Gpu, shadows: &ShadowMap, receivers: &[Receiver]) -> Vec<f32> {
    let rows: Vec<[Vec4; 4]> = receivers
        .iter()
        .map(|r| {
            let position = Vec3::new(r.uv.x * 2.0 - 1.0, 1.0 - r.uv.y * 2.0, r.depth);
            let ddx = Vec4::new(2.0 * r.footprint.x, 0.0, 0.0, 0.0);
            let ddy = Vec4::new(0.0, -2.0 * r.footprint.y, 0.0, 0.0);
            [position.extend(0.0), ddx, ddy, r.normal.extend(0.0)]
        })
        .collect();
    let rows: Vec<[f32; 16]> = rows.iter().map(|r| std::array::from_fn(|i| r[i / 4][i % 4])).collect();
    let user = "
        struct Row { position: vec4f, ddx: vec4f, ddy: vec4f, normal: vec4f }
        @group(1) @binding(0) var<storage, read> rows: array<Row>;
        @group(1) @binding(1) var<storage, read_write> results: array<f32>;
        @compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
            if id.x >= arrayLength(&rows) { return; }
            let row = rows[id.x];
            results[id.x] = shadow_visibility(row.position.xyz, row.normal.xyz, row.ddx.xyz, row.ddy.xyz);
        }";
    compute(gpu, shadows, user, bytes_of(rows.as_flattened()), receivers.len(), receivers.len())
}

/// Runs `main` of a compute shader that may call everything in `shadows.wgsl(0)`: `input` at
/// group 1 binding 0, `outputs` floats at binding 1, `invocations` in groups of 64.
pub fn compute(
    gpu: &Gpu,
    shadows: &ShadowMap,
    user: &str,
    input: &[u8],
    outputs: usize,
    invocations: usize,
) -> Vec<f32> {
    use wgpu::BufferUsages as Usage;
    let device = &gpu.device;
    let buffer = |size: usize, usage| {
        device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: size as u64,
            usage,
            mapped_at_creation: false,
        })
    };
    let source = buffer(input.len(), Usage::STORAGE | Usage::COPY_DST);
    let target = buffer(4 * outputs, Usage::STORAGE | Usage::COPY_SRC);
    gpu.queue.write_buffer(&source, 0, input);
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
        label: None,
        entries: &[entry(0, true), entry(1, false)],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: None,
        bind_group_layouts: &[Some(shadows.layout()), Some(&own)],
        immediate_size: 0,
    });
    let compile = || {
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: None,
            source: shadows.wgsl(0).after(user),
        });
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&layout),
            module: &module,
            entry_point: Some("main"),
            compilation_options: Default::default(),
            cache: None,
        })
    };
    let text = format!("{user}{}", shadows.wgsl(0).text());
    let made = kept(gpu).compute;
    let pipeline =
        made.lock().unwrap_or_else(PoisonError::into_inner).entry(text).or_insert_with(compile).clone();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &own,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: source.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: target.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, shadows.bind_group(), &[]);
        pass.set_bind_group(1, &group, &[]);
        pass.dispatch_workgroups(invocations.div_ceil(64) as u32, 1, 1);
    }
    gpu.queue.submit([encoder.finish()]);
    floats(&gpu.read_buffer(&target))
}

/// Bytes of floats.
pub fn bytes_of(values: &[f32]) -> &[u8] {
    bytemuck::cast_slice(values)
}

/// Floats of bytes.
pub fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect()
}

fn words(bytes: &[u8]) -> impl Iterator<Item = u16> {
    bytes.chunks_exact(2).map(|b| u16::from_ne_bytes([b[0], b[1]]))
}

/// Value of a finite 16-bit float.
fn from_half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    let size = match exponent {
        0 => fraction * 2f64.powi(-14),
        _ => (1.0 + fraction) * 2f64.powi(exponent - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// Texels of one layer and level of a map, up to four channels, in f64.
pub fn texels(gpu: &Gpu, texture: &wgpu::Texture, layer: u32, mip: u32) -> Vec<[f64; 4]> {
    let bytes = gpu.read_texture(texture, layer, mip);
    let pack = |values: &[f64], channels: usize| -> Vec<[f64; 4]> {
        values
            .chunks_exact(channels)
            .map(|c| std::array::from_fn(|i| c.get(i).copied().unwrap_or(0.0)))
            .collect()
    };
    let wide = || floats(&bytes).into_iter().map(f64::from).collect::<Vec<f64>>();
    let halves = || words(&bytes).map(from_half).collect::<Vec<f64>>();
    let shares = || words(&bytes).map(|w| f64::from(w) / 65535.0).collect::<Vec<f64>>();
    use wgpu::TextureFormat as F;
    match texture.format() {
        F::Rgba8Unorm => pack(&bytes.iter().map(|b| f64::from(*b) / 255.0).collect::<Vec<f64>>(), 4),
        F::R16Unorm => pack(&shares(), 1),
        F::Rg16Unorm => pack(&shares(), 2),
        F::Rgba16Unorm => pack(&shares(), 4),
        F::R16Float => pack(&halves(), 1),
        F::Rg16Float => pack(&halves(), 2),
        F::Rgba16Float => pack(&halves(), 4),
        F::R32Float => pack(&wide(), 1),
        F::Rg32Float => pack(&wide(), 2),
        F::Rgba32Float => pack(&wide(), 4),
        format => panic!("teach this test to read {format:?}"),
    }
}

/// Reproducible random numbers (xorshift).
#[derive(Debug)]
pub struct Random(u64);

impl Random {
    /// A sequence of its own for each seed.
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    /// Uniform in [0,1).
    pub fn unit(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 40) as f32 / (1u64 << 24) as f32
    }

    /// Uniform in [low,high).
    pub fn range(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }
}
