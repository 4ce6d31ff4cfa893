//! Casters with holes.

/// How meshes with holes are drawn for one shadow map: made by
/// [`ShadowMap::cutout_caster`](crate::ShadowMap::cutout_caster), taken by [`CasterPass::draw_cutout`](crate::CasterPass::draw_cutout).
#[derive(Debug, Clone)]
pub struct CutoutCaster {
    pub(crate) pipeline: wgpu::RenderPipeline,
}
