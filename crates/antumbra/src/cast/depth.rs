//! Casters that leave depth, by the renderer's own pipelines.

use super::{Cast, CasterPass, Plan, Seen, Targets, pass};
use crate::{error::Unsupported, options::Probe, pipelines::Pipelines, shader::Shader};
use wgpu::{BindGroupLayout, CommandEncoder, RenderPipeline, StoreOp};

/// Nothing is allocated beside the depth, which the map has in any case.
#[derive(Debug)]
pub(super) struct DepthPlan;

#[derive(Debug)]
struct DepthCast;

impl Plan for DepthPlan {
    fn check(&self) -> Result<(), Unsupported> {
        Ok(())
    }
    fn shaders(&self) -> Vec<Shader> {
        Vec::new()
    }
    fn cutout(&self, _: &str) -> Option<Shader> {
        None
    }
    fn build(&self, _: &wgpu::Device, _: &Pipelines) -> Box<dyn Cast> {
        Box::new(DepthCast)
    }
}

impl Cast for DepthCast {
    fn encode(
        &self,
        encoder: &mut CommandEncoder,
        seen: Seen<'_>,
        targets: &dyn Targets,
        probe: &mut dyn Probe,
        draw: &mut dyn FnMut(&mut CasterPass<'_>),
    ) {
        let depth = (targets.caster_target(seen.layer(), seen.cast, seen.first), StoreOp::Store);
        let pass = pass::begin(encoder, None, depth, probe.pass("cast", seen.view));
        draw(&mut CasterPass::new(pass, seen, None));
    }
    fn cutout(&self, _: &wgpu::Device, _: &str, _: &[&BindGroupLayout]) -> Option<RenderPipeline> {
        None
    }
}
