//! From surfaces to visibility, and from visibility to a picture.

use crate::{
    gpu::Gpu,
    plane::Plane,
    shaders,
    stage::{Stage, fullscreen, surfaces::overwrite},
};
use antumbra::ShadowMap;
use anyhow::Result;
use wgpu::TextureFormat;

mod pictures;

pub use pictures::Pictures;

/// The full-screen pass that asks a shadow map about every surface.
#[derive(Debug)]
pub struct Lookup {
    pipeline: wgpu::RenderPipeline,
    /// Whether it asks about cut-outs.
    asks: bool,
}

impl Lookup {
    /// For the visibility in one shadow map; 1 where there is no surface.
    #[must_use]
    pub fn new(gpu: &Gpu, stage: &Stage, shadows: &ShadowMap) -> Self {
        Self::asking(gpu, stage, shadows, shaders::VISIBILITY)
    }

    /// For the numbers of [`shares`](crate::classes::shares), if the technique has classes.
    #[must_use]
    pub fn classes(gpu: &Gpu, stage: &Stage, shadows: &ShadowMap) -> Option<Self> {
        let any = !shadows.technique().classes().is_empty();
        any.then(|| Self::asking(gpu, stage, shadows, shaders::CLASS))
    }

    fn asking(gpu: &Gpu, stage: &Stage, shadows: &ShadowMap, question: &str) -> Self {
        let masks = stage.masks().filter(|_| shadows.asks_about_cutouts());
        let covers = if masks.is_some() { shaders::COVERS } else { "" };
        let source = shadows.wgsl(1).after(&[question, covers].concat());
        let mut groups = vec![&stage.surfaces().layout, shadows.layout()];
        groups.extend(masks.map(|masks| &masks.layout));
        let pipeline = fullscreen(gpu, "lookup", source, &groups, TextureFormat::R32Float);
        Self { pipeline, asks: masks.is_some() }
    }

    /// Everything lit: what the pass costs without any lookup.
    #[must_use]
    pub fn unshadowed(gpu: &Gpu, stage: &Stage) -> Self {
        let source = wgpu::ShaderSource::Wgsl(shaders::UNSHADOWED.into());
        Self {
            pipeline: fullscreen(
                gpu,
                "unshadowed",
                source,
                &[&stage.surfaces().layout],
                TextureFormat::R32Float,
            ),
            asks: false,
        }
    }
}

/// The visibility buffer: linear, one 32-bit channel.
#[derive(Debug)]
pub struct Lighting {
    visibility: wgpu::Texture,
    visibility_view: wgpu::TextureView,
}

impl Lighting {
    /// Targets of the stage's resolution.
    #[must_use]
    pub fn new(gpu: &Gpu, stage: &Stage) -> Self {
        let size = stage.surfaces().resolution();
        let visibility = gpu.target("visibility", size, TextureFormat::R32Float);
        let visibility_view = visibility.create_view(&Default::default());
        Self { visibility, visibility_view }
    }

    /// Fills the visibility buffer; `shadows` is `None` for [`Lookup::unshadowed`].
    pub fn encode_lookup(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        lookup: &Lookup,
        shadows: Option<&ShadowMap>,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("lookup"),
            color_attachments: &[Some(overwrite(&self.visibility_view))],
            timestamp_writes: timestamps,
            ..Default::default()
        });
        pass.set_pipeline(&lookup.pipeline);
        pass.set_bind_group(0, &stage.surfaces().group, &[]);
        if let Some(shadows) = shadows {
            pass.set_bind_group(1, shadows.bind_group(), &[]);
        }
        if let Some(masks) = stage.masks().filter(|_| lookup.asks) {
            pass.set_bind_group(2, &masks.group, &[]);
        }
        pass.draw(0..3, 0..1);
    }

    /// The visibility buffer. Waits.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read_visibility(&self, gpu: &Gpu) -> Result<Plane> {
        let bytes = gpu.read(&self.visibility)?;
        let values = bytes.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
        Ok(Plane::new(self.visibility.width(), self.visibility.height(), values)?)
    }

    /// Replaces the visibility buffer, for pictures of a truth.
    pub fn write_visibility(&self, gpu: &Gpu, plane: &Plane) {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * plane.width),
            rows_per_image: None,
        };
        let texels = bytemuck::cast_slice(&plane.values);
        gpu.queue.write_texture(self.visibility.as_image_copy(), texels, layout, self.visibility.size());
    }
}
