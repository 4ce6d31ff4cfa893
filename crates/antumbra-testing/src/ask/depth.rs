//! Depth textures of any content.

use super::{bytes_of, kept};
use crate::Gpu;
use antumbra::Size;

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
    use wgpu::TextureUsages as Usage;
    let usage = Usage::TEXTURE_BINDING | Usage::RENDER_ATTACHMENT | Usage::COPY_SRC;
    let target = texture(gpu, size, layers, antumbra::DEPTH_FORMAT, usage);
    draw(gpu, &Painter::new(gpu, size, layers, depth), &target);
    target
}

/// Draws numbers as depth, each texel where it lies in the target.
#[derive(Debug)]
pub struct Painter {
    pipeline: wgpu::RenderPipeline,
    /// Of each layer of numbers.
    groups: Vec<wgpu::BindGroup>,
}

impl Painter {
    /// Of `depth(layer, x, y)`.
    pub fn new(gpu: &Gpu, size: Size, layers: u32, depth: impl Fn(u32, u32, u32) -> f32) -> Self {
        let texels: Vec<f32> = (0..layers)
            .flat_map(|layer| (0..size.height).map(move |y| (layer, y)))
            .flat_map(|(layer, y)| (0..size.width).map(move |x| (layer, x, y)))
            .map(|(layer, x, y)| depth(layer, x, y))
            .collect();
        use wgpu::TextureUsages as Usage;
        let usage = Usage::TEXTURE_BINDING | Usage::COPY_DST;
        let source = texture(gpu, size, layers, wgpu::TextureFormat::R32Float, usage);
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
        let group = |layer| {
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: None,
                layout: &pipeline.get_bind_group_layout(0),
                entries: &[wgpu::BindGroupEntry {
                    binding: 0,
                    resource: wgpu::BindingResource::TextureView(&one(&source, layer)),
                }],
            })
        };
        Self { groups: (0..layers).map(group).collect(), pipeline }
    }

    /// Draws a layer.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, layer: usize) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.groups[layer], &[]);
        pass.draw(0..3, 0..1);
    }
}

fn one(texture: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

fn texture(
    gpu: &Gpu,
    size: Size,
    layers: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
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
}

/// Draws every layer of a texture.
fn draw(gpu: &Gpu, painter: &Painter, target: &wgpu::Texture) {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for layer in 0..target.depth_or_array_layers() {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("test depth"),
            color_attachments: &[],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &one(target, layer),
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
        painter.draw(&mut pass, layer as usize);
    }
    gpu.queue.submit([encoder.finish()]);
}

/// Depth with every layer `times` times in a row.
pub(super) fn repeat_layers(gpu: &Gpu, depth: &wgpu::Texture, times: u32) -> wgpu::Texture {
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

/// Draws a texture of floats as depth.
pub(super) fn pipeline(gpu: &Gpu) -> wgpu::RenderPipeline {
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
