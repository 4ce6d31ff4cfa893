//! From surfaces to visibility, and from visibility to a picture.

use crate::{
    Gpu, GpuScene,
    layout::{fullscreen, overwrite},
    shaders,
};
use antumbra::ShadowMap;
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
    /// Asks for the visibility in one shadow map; 1 where there is no surface.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: &GpuScene, shadows: &ShadowMap) -> Self {
        Self::asking(gpu, scene, shadows, shaders::VISIBILITY)
    }

    /// Asks for the class of every surface, if the technique has classes: 0 for none, else 1 + the index of
    /// its class, or a negative number where there is no surface.
    #[must_use]
    pub fn classes(gpu: &Gpu, scene: &GpuScene, shadows: &ShadowMap) -> Option<Self> {
        let any = !shadows.description().classes.is_empty();
        any.then(|| Self::asking(gpu, scene, shadows, shaders::CLASS))
    }

    fn asking(gpu: &Gpu, scene: &GpuScene, shadows: &ShadowMap, question: &str) -> Self {
        let masks = scene.masks().filter(|_| shadows.asks_about_cutouts());
        let covers = if masks.is_some() { shaders::COVERS } else { "" };
        let source = shadows.wgsl(1).after(&[question, covers].concat());
        let mut groups = vec![&scene.surfaces().layout, shadows.layout()];
        groups.extend(masks.map(|masks| &masks.layout));
        let pipeline = fullscreen(gpu, "lookup", source, &groups, TextureFormat::R32Float);
        Self { pipeline, asks: masks.is_some() }
    }

    /// Everything lit: what the pass costs without any lookup.
    #[must_use]
    pub fn unshadowed(gpu: &Gpu, scene: &GpuScene) -> Self {
        let source = wgpu::ShaderSource::Wgsl(shaders::UNSHADOWED.into());
        Self {
            pipeline: fullscreen(
                gpu,
                "unshadowed",
                source,
                &[&scene.surfaces().layout],
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
    /// Targets of the scene's resolution.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: &GpuScene) -> Self {
        let size = scene.surfaces().resolution();
        let visibility = gpu.target("visibility", size, TextureFormat::R32Float);
        let visibility_view = visibility.create_view(&Default::default());
        Self { visibility, visibility_view }
    }

    /// Fills the visibility buffer; `shadows` is `None` for [`Lookup::unshadowed`].
    pub fn encode_lookup(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
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
        pass.set_bind_group(0, &scene.surfaces().group, &[]);
        if let Some(shadows) = shadows {
            pass.set_bind_group(1, shadows.bind_group(), &[]);
        }
        if let Some(masks) = scene.masks().filter(|_| lookup.asks) {
            pass.set_bind_group(2, &masks.group, &[]);
        }
        pass.draw(0..3, 0..1);
    }

    /// The visibility buffer: one float a pixel, 1 lit.
    #[must_use]
    pub fn visibility(&self) -> &wgpu::Texture {
        &self.visibility
    }

    /// Replaces the visibility buffer, for pictures of a truth: one value for each of its pixels, row by row.
    pub fn write_visibility(&self, gpu: &Gpu, values: &[f32]) {
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(4 * self.visibility.width()),
            rows_per_image: None,
        };
        let texels = bytemuck::cast_slice(values);
        gpu.queue.write_texture(self.visibility.as_image_copy(), texels, layout, self.visibility.size());
    }
}
