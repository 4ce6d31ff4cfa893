//! The passes between casting and lighting, one after the other.

use super::{
    DEPTH_FORMAT,
    pipelines::{Pipelines, Run},
    textures::{self, Textures},
    uniforms::Uniforms,
};
use crate::{
    describe::Map,
    pass::{self, Slot, Step, Work},
};
use wgpu::TextureFormat;

/// Most colour attachments of a pass, on any device.
const MOST_TARGETS: usize = 8;

/// A step with everything that encoding it takes.
#[derive(Debug)]
pub(super) struct Draw {
    pub(super) label: &'static str,
    run: Run,
    /// Workgroups, if it dispatches.
    groups: u32,
    bind_group: wgpu::BindGroup,
    targets: Vec<wgpu::TextureView>,
    /// The caster pass that it follows, if not the last.
    pub(super) cast: Option<u32>,
}

impl Draw {
    /// Binds a step to the textures of one view.
    pub(super) fn new(
        pipelines: &Pipelines,
        textures: &Textures,
        uniforms: &Uniforms,
        maps: &[Map],
        step: &Step,
        view: u32,
    ) -> Self {
        let format = |slot| match slot {
            Slot::Map(i) | Slot::Scratch(i) => maps[i].format,
            Slot::Casters | Slot::Casts { .. } => DEPTH_FORMAT,
        };
        let formats: Vec<TextureFormat> = step.targets.iter().map(|t| format(t.slot)).collect();
        let pipeline = pipelines.get(step, &formats);
        let (source, targets) = (textures.source(step, view), textures.targets(step, view));
        let bind_group = pipelines.bind(&pipeline, step, [&source, &targets[0]], uniforms.convert(view));
        let groups = match step.work {
            Work::Draw => 0,
            Work::Lanes(lanes) => lanes.div_ceil(pass::WORKGROUP),
        };
        Self { label: step.label, run: pipeline.run, groups, bind_group, targets, cast: step.cast() }
    }

    /// Runs it.
    pub(super) fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        match &self.run {
            Run::Draw(pipeline) => {
                let attachments: [_; MOST_TARGETS] =
                    std::array::from_fn(|i| self.targets.get(i).map(|t| textures::written(t)));
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    label: Some(self.label),
                    color_attachments: &attachments[..self.targets.len()],
                    depth_stencil_attachment: None,
                    timestamp_writes: timestamps,
                    occlusion_query_set: None,
                    multiview_mask: None,
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.bind_group, &[]);
                pass.draw(0..3, 0..1);
            }
            Run::Dispatch(pipeline) => {
                let mut pass = compute_pass(encoder, self.label, timestamps);
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.bind_group, &[]);
                pass.dispatch_workgroups(self.groups, 1, 1);
            }
        }
    }
}

/// Begins a compute pass with the timestamps of a render pass.
pub(crate) fn compute_pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
) -> wgpu::ComputePass<'a> {
    encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some(label),
        timestamp_writes: timestamps.map(|t| wgpu::ComputePassTimestampWrites {
            query_set: t.query_set,
            beginning_of_pass_write_index: t.beginning_of_pass_write_index,
            end_of_pass_write_index: t.end_of_pass_write_index,
        }),
    })
}
