//! The targets that hold what the camera sees, and how later passes read them.

use crate::{
    Gpu,
    layout::{loaded, overwrite, uniform},
};
use wgpu::{TextureFormat, TextureView};

/// Position relative to the eye (w = 1 where there is a surface), facet normal, shading normal and
/// metalness, base colour and roughness.
pub(crate) const FORMATS: [TextureFormat; 4] = [
    TextureFormat::Rgba32Float,
    TextureFormat::Rgba32Float,
    TextureFormat::Rgba16Float,
    TextureFormat::Rgba8UnormSrgb,
];

/// A texture for each of position, facet, shading normal and base colour, one for depth, and the
/// bind group of full-screen passes.
#[derive(Debug)]
pub struct Surfaces {
    resolution: [u32; 2],
    targets: [TextureView; 4],
    depth: TextureView,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
}

impl Surfaces {
    pub(crate) fn new(gpu: &Gpu, resolution: [u32; 2], frame: &wgpu::Buffer) -> Self {
        let view = |label, format| gpu.target(label, resolution, format).create_view(&Default::default());
        let targets = FORMATS.map(|format| view("surfaces", format));
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("surfaces"),
            entries: &[uniform(0), loaded(1), loaded(2), loaded(3), loaded(4)],
        });
        let entry = |binding, resource| wgpu::BindGroupEntry { binding, resource };
        let texture = |i: usize| entry(i as u32 + 1, wgpu::BindingResource::TextureView(&targets[i]));
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("surfaces"),
            layout: &layout,
            entries: &[entry(0, frame.as_entire_binding()), texture(0), texture(1), texture(2), texture(3)],
        });
        Self { resolution, depth: view("depth", TextureFormat::Depth32Float), targets, layout, group }
    }

    /// Pixels across and down.
    #[must_use]
    pub fn resolution(&self) -> [u32; 2] {
        self.resolution
    }

    /// Positions of what is drawn, relative to the eye, four floats a pixel: w = 1 where there is a surface.
    #[must_use]
    pub fn positions(&self) -> &wgpu::Texture {
        self.targets[0].texture()
    }

    pub(crate) fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'e> {
        begin(encoder, &self.targets.each_ref(), &self.depth, timestamps)
    }
}

/// A pass with cleared targets and reversed depth.
pub(crate) fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    targets: &[&TextureView],
    depth: &TextureView,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::RenderPass<'e> {
    let attachments: Vec<_> = targets.iter().map(|t| Some(overwrite(t))).collect();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("surfaces"),
        color_attachments: &attachments,
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: timestamps,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
