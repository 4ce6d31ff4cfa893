//! What any small wgpu program has, and nothing of antumbra's: boxes, a pipeline, an image file.

#![allow(dead_code, unused_imports, unreachable_pub, reason = "each example uses a part")]

use glam::{Mat4, Vec3};
use wgpu::{BindGroup, BindGroupLayout, Device, Queue, RenderPass, TextureFormat};
use wgpu::{TextureUsages, util::DeviceExt};

mod pipelines;

pub use pipelines::{Stages, compute_pipeline, pipeline, pipeline_of, pipeline_of_uvs};

pub const WIDTH: u32 = 640;
pub const HEIGHT: u32 = 480;
pub const COLOR: TextureFormat = TextureFormat::Rgba8Unorm;
pub const DEPTH: TextureFormat = TextureFormat::Depth32Float;

/// A device with what antumbra makes use of, as far as the adapter has it.
pub fn device() -> (Device, Queue) {
    pollster::block_on(async {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let adapter =
            instance.request_adapter(&Default::default()).await.expect("a GPU, or a software driver");
        let wanted = wgpu::Features::FLOAT32_FILTERABLE | wgpu::Features::DEPTH_CLIP_CONTROL;
        let required_features = adapter.features() & wanted;
        adapter
            .request_device(&wgpu::DeviceDescriptor { required_features, ..Default::default() })
            .await
            .expect("a device")
    })
}

/// Triangles with normals.
#[derive(Debug)]
pub struct Mesh {
    vertices: wgpu::Buffer,
    positions: Vec<Vec3>,
}

impl Mesh {
    /// Boxes by centre and half size.
    pub fn boxes(device: &Device, boxes: &[(Vec3, Vec3)]) -> Self {
        let vertices: Vec<[Vec3; 2]> =
            boxes.iter().flat_map(|(centre, half)| cuboid(*centre, *half)).collect();
        Self {
            positions: vertices.iter().map(|[position, _]| *position).collect(),
            vertices: buffer(device, bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
        }
    }

    pub fn triangles(&self) -> u32 {
        self.positions.len() as u32 / 3
    }

    /// Positions alone, and indices, for shaders that read them.
    pub fn storage(&self, device: &Device) -> [wgpu::Buffer; 2] {
        let indices: Vec<u32> = (0..3 * self.triangles()).collect();
        let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDEX;
        [bytemuck::cast_slice(&self.positions), bytemuck::cast_slice(&indices)]
            .map(|bytes| buffer(device, bytes, usage))
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..3 * self.triangles(), 0..1);
    }
}

fn cuboid(centre: Vec3, half: Vec3) -> impl Iterator<Item = [Vec3; 2]> {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    [Vec3::X, Vec3::Y, Vec3::Z, -Vec3::X, -Vec3::Y, -Vec3::Z].into_iter().flat_map(move |n| {
        let s = Vec3::new(n.y, n.z, n.x);
        let t = n.cross(s);
        corners.map(|(a, b)| [centre + half * (n + a * s + b * t), n])
    })
}

pub fn buffer(device: &Device, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor { label: None, contents, usage })
}

/// Layout of one uniform for the vertex and fragment stages.
pub fn uniform_layout(device: &Device) -> BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: None,
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    })
}

/// A uniform that never changes.
pub fn uniform(device: &Device, layout: &BindGroupLayout, matrix: Mat4) -> BindGroup {
    let buffer = buffer(device, bytemuck::bytes_of(&matrix), wgpu::BufferUsages::UNIFORM);
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
    })
}

/// A buffer that compute shaders fill and that can be read.
pub fn storage(device: &Device, size: u64) -> wgpu::Buffer {
    let usage = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    device.create_buffer(&wgpu::BufferDescriptor { label: None, size, usage, mapped_at_creation: false })
}

/// Storage buffers of a compute shader, of which it writes the last.
pub fn storage_group(device: &Device, buffers: &[&wgpu::Buffer]) -> (BindGroupLayout, BindGroup) {
    let last = buffers.len() - 1;
    let entry = |i: usize| wgpu::BindGroupLayoutEntry {
        binding: i as u32,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: i < last },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = (0..=last).map(entry).collect();
    let layout =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries });
    let bound = (0..).zip(buffers);
    let entries: Vec<_> = bound
        .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
        .collect();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (layout, group)
}

/// A square texture with these texels.
pub fn texture(
    device: &Device,
    queue: &Queue,
    side: u32,
    format: TextureFormat,
    bytes: &[u8],
) -> wgpu::Texture {
    let descriptor = wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: TextureUsages::TEXTURE_BINDING | TextureUsages::COPY_DST,
        view_formats: &[],
    };
    device.create_texture_with_data(queue, &descriptor, wgpu::util::TextureDataOrder::LayerMajor, bytes)
}

/// A mask, a sampler for it, and the texture coordinates of a mesh's vertices, for fragment shaders.
pub fn mask_group(device: &Device, mask: &wgpu::Texture, uvs: &wgpu::Buffer) -> (BindGroupLayout, BindGroup) {
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let buffer = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: true },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    let entries: Vec<_> = (0..)
        .zip([texture, sampler, buffer])
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        })
        .collect();
    let layout =
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries });
    let view = mask.create_view(&Default::default());
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        mag_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    });
    let resources = [
        wgpu::BindingResource::TextureView(&view),
        wgpu::BindingResource::Sampler(&sampler),
        uvs.as_entire_binding(),
    ];
    let entries: Vec<_> =
        (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: None,
        layout: &layout,
        entries: &entries,
    });
    (layout, group)
}

pub fn target(device: &Device, width: u32, height: u32, format: TextureFormat) -> wgpu::Texture {
    let usage = if format == COLOR { TextureUsages::COPY_SRC } else { TextureUsages::TEXTURE_BINDING };
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

/// Draws what `draw` draws into a texture of [`WIDTH`] × [`HEIGHT`] pixels, sky where nothing is.
pub fn draw(
    device: &Device,
    encoder: &mut wgpu::CommandEncoder,
    color: &wgpu::TextureView,
    draw: impl FnOnce(&mut RenderPass<'_>),
) {
    let depth = target(device, WIDTH, HEIGHT, DEPTH);
    let sky = wgpu::Color { r: 0.55, g: 0.65, b: 0.8, a: 1.0 };
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(sky), store: wgpu::StoreOp::Store },
        })],
        depth_stencil_attachment: Some(depth_attachment(&depth.create_view(&Default::default()))),
        ..Default::default()
    });
    draw(&mut pass);
}

/// What [`draw`] draws, as rows of RGBA.
pub fn render(
    device: &Device,
    queue: &Queue,
    mut encoder: wgpu::CommandEncoder,
    draw_all: impl FnOnce(&mut RenderPass<'_>),
) -> Vec<u8> {
    let color = target(device, WIDTH, HEIGHT, COLOR);
    draw(device, &mut encoder, &color.create_view(&Default::default()), draw_all);
    let pixels = storage(device, u64::from(4 * WIDTH * HEIGHT));
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &pixels,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * WIDTH),
                rows_per_image: None,
            },
        },
        color.size(),
    );
    read(device, queue, encoder, &pixels)
}

/// What a buffer holds when all of that is done.
pub fn read(
    device: &Device,
    queue: &Queue,
    mut encoder: wgpu::CommandEncoder,
    buffer: &wgpu::Buffer,
) -> Vec<u8> {
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: buffer.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    encoder.copy_buffer_to_buffer(buffer, 0, &staging, 0, buffer.size());
    queue.submit([encoder.finish()]);
    staging.slice(..).map_async(wgpu::MapMode::Read, |result| result.expect("a buffer to read"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device to answer");
    staging.slice(..).get_mapped_range().expect("a mapped buffer").to_vec()
}

/// Clears to the far plane.
pub fn depth_attachment(view: &wgpu::TextureView) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
        stencil_ops: None,
    }
}

/// Writes the picture to the path given as the program's argument, or to `target/<name>.png`.
pub fn save(name: &str, picture: &[u8]) -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).unwrap_or_else(|| format!("target/{name}.png"));
    let file = std::io::BufWriter::new(std::fs::File::create(&path)?);
    let mut encoder = png::Encoder::new(file, WIDTH, HEIGHT);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header()?.write_image_data(picture)?;
    println!("{path}");
    Ok(())
}
