//! The passes between casting and lighting, one after the other.

use super::{DEPTH_FORMAT, Pipelines, textures::Textures, uniforms::Uniforms};
use crate::{
    cast::{compute_pass, limit, written},
    light::Size,
    pass::{self, Axis, FilterStep, Holder, Work},
    pipelines::Compiled,
    shader::Composition,
    tile::Tile,
};
use wgpu::TextureFormat;

/// Most colour attachments of a pass, on any device.
const MOST_TARGETS: usize = 8;

/// A step with everything that encoding it takes.
#[derive(Debug)]
pub(super) struct Draw {
    pub(super) label: &'static str,
    run: Compiled,
    work: Work,
    /// Level of its targets.
    mip: u32,
    /// Whether views are parts of its targets.
    tiled: bool,
    bind_group: wgpu::BindGroup,
    targets: Vec<wgpu::TextureView>,
    /// The caster pass that it follows, if not the last.
    pub(super) cast: Option<u32>,
}

/// The view that steps are run for.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run {
    /// Where it lies.
    pub(super) tile: Tile,
    /// Where its uniforms begin.
    pub(super) uniforms: u32,
}

impl Draw {
    /// Binds a step to the textures of one layer of views.
    pub(super) fn new(
        pipelines: &Pipelines,
        textures: &Textures,
        uniforms: &Uniforms,
        composition: &Composition,
        step: &FilterStep,
        layer: u32,
    ) -> Self {
        let format = |holder| match holder {
            Holder::Map(i) | Holder::Scratch(i) => composition.description.maps[i].format,
            Holder::Casters | Holder::Casts { .. } => DEPTH_FORMAT,
        };
        let formats: Vec<TextureFormat> = step.targets.iter().map(|t| format(t.holder)).collect();
        let pipeline = pipelines.get(step, &formats);
        let (source, targets) = (textures.source(step, layer), textures.targets(step, layer));
        let bind_group = pipelines.bind(&pipeline, step, [&source, &targets[0]], uniforms.convert());
        Self {
            label: step.label,
            run: pipeline.run,
            work: step.work,
            mip: step.targets.iter().map(|target| target.mip).max().unwrap_or(0),
            tiled: composition.tiled,
            bind_group,
            targets,
            cast: step.cast(),
        }
    }

    /// Whether a view there has the level that it makes.
    pub(super) fn makes_any_of(&self, tile: &Tile) -> bool {
        self.mip <= tile.coarsest()
    }

    /// Runs it for a view.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        seen: Run,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        match &self.run {
            Compiled::Draw(pipeline) => {
                let attachments: [_; MOST_TARGETS] =
                    std::array::from_fn(|i| self.targets.get(i).map(|t| written(t, !self.tiled)));
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some(self.label),
                    color_attachments: &attachments[..self.targets.len()],
                    depth_stencil_attachment: None,
                    timestamp_writes: timestamps,
                    occlusion_query_set: None,
                    multiview_mask: None,
                });
                if self.tiled {
                    limit(&mut pass, &seen.tile.at_level(self.mip));
                }
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.bind_group, &[seen.uniforms]);
                pass.draw(0..3, 0..1);
            }
            Compiled::Dispatch(pipeline) => {
                let mut pass = compute_pass(encoder, self.label, timestamps);
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.bind_group, &[seen.uniforms]);
                let Size { width, height } = seen.tile.size;
                let lanes = if self.work == Work::Lanes(Axis::Rows) { height } else { width };
                pass.dispatch_workgroups(lanes.div_ceil(pass::WORKGROUP), 1, 1);
            }
        }
    }
}
