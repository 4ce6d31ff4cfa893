//! What any small wgpu program has, and nothing of antumbra's: boxes, a pipeline, an image file.

#![allow(dead_code, unreachable_pub, reason = "each example uses a part")]

use glam::{Mat4, Vec3};
use wgpu::{BindGroup, BindGroupLayout, Device, Queue, RenderPass, RenderPipeline, TextureFormat};
use wgpu::{TextureUsages, util::DeviceExt};

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
    count: u32,
}

impl Mesh {
    /// Boxes by centre and half size.
    pub fn boxes(device: &Device, boxes: &[(Vec3, Vec3)]) -> Self {
        let vertices: Vec<[Vec3; 2]> =
            boxes.iter().flat_map(|(centre, half)| cuboid(*centre, *half)).collect();
        Self {
            count: vertices.len() as u32,
            vertices: buffer(device, bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
        }
    }

    pub fn draw(&self, pass: &mut RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.vertices.slice(..));
        pass.draw(0..self.count, 0..1);
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

/// A pipeline for [`Mesh`] with these bind groups: with a fragment stage into [`COLOR`], or depth
/// alone; casters should be clamped to the depth range where the device can.
pub fn pipeline(
    device: &Device,
    module: &wgpu::ShaderModule,
    groups: &[Option<&BindGroupLayout>],
    vertex: &str,
    fragment: Option<&str>,
) -> RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: groups,
        ..Default::default()
    });
    let targets = [Some(COLOR.into())];
    let clamps = device.features().contains(wgpu::Features::DEPTH_CLIP_CONTROL);
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(vertex),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 24,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
            })],
        },
        primitive: wgpu::PrimitiveState {
            cull_mode: Some(wgpu::Face::Back),
            unclipped_depth: clamps && fragment.is_none(),
            ..Default::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: Default::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
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

/// What `draw` draws, as rows of RGBA: [`WIDTH`] × [`HEIGHT`], sky where nothing is.
pub fn render(
    device: &Device,
    queue: &Queue,
    mut encoder: wgpu::CommandEncoder,
    draw: impl FnOnce(&mut RenderPass<'_>),
) -> Vec<u8> {
    let color = target(device, WIDTH, HEIGHT, COLOR);
    let depth = target(device, WIDTH, HEIGHT, DEPTH);
    {
        let sky = wgpu::Color { r: 0.55, g: 0.65, b: 0.8, a: 1.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color.create_view(&Default::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(sky), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(depth_attachment(&depth.create_view(&Default::default()))),
            ..Default::default()
        });
        draw(&mut pass);
    }
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: u64::from(4 * WIDTH * HEIGHT),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        color.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &staging,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * WIDTH),
                rows_per_image: None,
            },
        },
        color.size(),
    );
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
