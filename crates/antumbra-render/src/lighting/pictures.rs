//! Pictures from visibility.
//!
//! Visibility is asked once per pixel, and its edges are what pictures are compared by. Everything else would
//! shimmer beside it with one sample per pixel, and drown it on textures: the light of the sun and all other
//! light are means of several passes, each with the camera's picture plane moved by a part of a pixel.

use super::Lighting;
use crate::{
    Gpu, GpuScene, RenderError,
    layout::{fullscreen, fullscreen_into, loaded, overwrite},
    shaders,
};
use glam::Vec2;
use wgpu::{LoadOp, TextureFormat, TextureView};

/// Samples of a pixel, offsets from its centre: the usual pattern of eight, each alone in its row and column.
const OFFSETS: [[f32; 2]; 8] =
    [[1., -3.], [-1., 3.], [5., 1.], [-3., -5.], [-5., 5.], [-7., -1.], [3., 7.], [7., -7.]];
// What `share` in light.wgsl says.
const _: () = assert!(OFFSETS.len() == 8);
/// Parts of a pixel that offsets are counted in.
const PARTS: f32 = 16.0;
/// Format of the light's textures, in which sums of samples are blended.
const FORMAT: TextureFormat = TextureFormat::Rgba16Float;

/// The light that a scene's surfaces reflect, and the picture that it makes with a visibility buffer.
#[derive(Debug)]
pub struct Pictures {
    picture: wgpu::Texture,
    view: TextureView,
    shade: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
}

impl Pictures {
    /// Draws the scene as its camera and light are now, once per sample. What its
    /// [`surfaces`](GpuScene::surfaces) hold is then to be drawn anew.
    ///
    /// # Errors
    /// As [`Gpu::check`].
    pub fn new(gpu: &Gpu, scene: &GpuScene, lighting: &Lighting) -> Result<Self, RenderError> {
        let size = scene.surfaces().resolution();
        let target = |label, format| gpu.target(label, size, format);
        let terms =
            ["sun", "other light"].map(|label| target(label, FORMAT).create_view(&Default::default()));
        draw(gpu, scene, &terms)?;
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("picture"),
            entries: &[loaded(0), loaded(1), loaded(2)],
        });
        let texture = |binding, view| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(view),
        };
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("picture"),
            layout: &layout,
            entries: &[texture(0, &lighting.visibility_view), texture(1, &terms[0]), texture(2, &terms[1])],
        });
        let source = wgpu::ShaderSource::Wgsl(shaders::PICTURE.into());
        let picture = target("picture", TextureFormat::Rgba8UnormSrgb);
        Ok(Self {
            view: picture.create_view(&Default::default()),
            shade: fullscreen(gpu, "picture", source, &[&layout], picture.format()),
            picture,
            group,
        })
    }

    /// Shades the picture with what is in the visibility buffer.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(overwrite(&self.view))],
            ..Default::default()
        });
        pass.set_pipeline(&self.shade);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// The picture: sRGB colour with alpha, four bytes a pixel.
    #[must_use]
    pub fn picture(&self) -> &wgpu::Texture {
        &self.picture
    }
}

/// Fills both textures of light.
fn draw(gpu: &Gpu, scene: &GpuScene, terms: &[TextureView; 2]) -> Result<(), RenderError> {
    let pipeline = pipeline(gpu, scene);
    for (i, offset) in OFFSETS.iter().enumerate() {
        scene.shift(gpu, Vec2::from(*offset) / PARTS);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        scene.encode_surfaces(&mut encoder, None);
        let load = if i == 0 { LoadOp::Clear(wgpu::Color::TRANSPARENT) } else { LoadOp::Load };
        let ops = wgpu::Operations { load, store: wgpu::StoreOp::Store };
        let targets = terms.each_ref().map(|view| {
            Some(wgpu::RenderPassColorAttachment { view, depth_slice: None, resolve_target: None, ops })
        });
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("light"),
                color_attachments: &targets,
                ..Default::default()
            });
            pass.set_pipeline(&pipeline);
            pass.set_bind_group(0, &scene.surfaces().group, &[]);
            pass.draw(0..3, 0..1);
        }
        gpu.submit(encoder)?;
    }
    scene.shift(gpu, Vec2::ZERO);
    Ok(())
}

/// The pass that adds a sample's share of the light.
fn pipeline(gpu: &Gpu, scene: &GpuScene) -> wgpu::RenderPipeline {
    let source = wgpu::ShaderSource::Wgsl(shaders::LIGHT.into());
    let sum = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::One,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    let added = wgpu::ColorTargetState {
        format: FORMAT,
        blend: Some(wgpu::BlendState { color: sum, alpha: sum }),
        write_mask: wgpu::ColorWrites::ALL,
    };
    let targets = [Some(added.clone()), Some(added)];
    fullscreen_into(gpu, "light", source, &[&scene.surfaces().layout], &targets)
}
