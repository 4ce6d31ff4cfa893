//! The targets that hold what the camera sees, and how later passes read them.

use super::{Target, loaded, uniform};
use crate::gpu::Gpu;
use anyhow::Result;
use glam::Vec3;
use wgpu::TextureFormat;

/// Position relative to the eye (w = 1 where there is a surface), facet normal, shading normal and
/// metalness, base colour and roughness.
pub(super) const FORMATS: [TextureFormat; 4] = [
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
    targets: [Target; 4],
    depth: Target,
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
}

impl Surfaces {
    pub(super) fn new(gpu: &Gpu, resolution: [u32; 2], frame: &wgpu::Buffer) -> Self {
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

    /// Positions of what is drawn, relative to the eye; `None` where nothing is. Waits.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read_positions(&self, gpu: &Gpu) -> Result<Vec<Option<Vec3>>> {
        let bytes = gpu.read(self.targets[0].texture())?;
        let number = |b: &[u8]| f32::from_ne_bytes([b[0], b[1], b[2], b[3]]);
        let texels = bytes.chunks_exact(16).map(|texel| [0, 4, 8, 12].map(|at| number(&texel[at..])));
        Ok(texels.map(|[x, y, z, there]| (there != 0.0).then_some(Vec3::new(x, y, z))).collect())
    }

    pub(super) fn begin<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'e> {
        begin(encoder, &self.targets.each_ref(), &self.depth, timestamps)
    }
}

/// A pass with cleared targets and reversed depth.
pub(super) fn begin<'e>(
    encoder: &'e mut wgpu::CommandEncoder,
    targets: &[&Target],
    depth: &Target,
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

/// A cleared colour attachment.
pub(crate) fn overwrite(view: &Target) -> wgpu::RenderPassColorAttachment<'_> {
    wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
            store: wgpu::StoreOp::Store,
        },
    }
}
