//! Casters with holes.

use super::{ShadowMap, answer::ask_now};
use crate::{cast::CutoutCaster, error::Unsupported};

impl ShadowMap {
    /// For casters with holes, where the technique's storage is not
    /// [`CasterStorage::Depth`](crate::technique::CasterStorage::Depth): what
    /// [`CasterPass::draw_cutout`](crate::CasterPass::draw_cutout) draws them with, with the caller's own
    /// bindings, described by `layouts`, from group 2 on.
    ///
    /// `wgsl` declares them and defines `caster_covers(triangle: u32, weights: vec3f) -> bool`: whether
    /// a triangle of the mesh, counted from the first index, stops light where its corners have these
    /// weights, 0 to 1, sum 1. It may call `caster_vertex(triangle, corner) -> u32`, the index of a
    /// corner, and samples with explicit levels. It is asked once per texel, at the triangle's point
    /// next to the texel's centre: holes have the map's resolution, edges of their triangles
    /// sub-texel precision, and a texel with holes says nothing about its neighbours.
    ///
    /// Where lookups ask ([`asks_about_cutouts`](Self::asks_about_cutouts)) every texel keeps all triangles
    /// that touch it, holes or not, and receivers see through the holes themselves, at any size of the map.
    /// Then `wgsl` also defines `caster_tag(triangle: u32) -> u32`, any number that `shadow_covers` will need
    /// to know the triangle by, such as its material's, and `caster_covers` tells of the centres of texels
    /// alone.
    ///
    /// `None` if casters are depth.
    ///
    /// # Errors
    /// [`Unsupported::Cutout`]: more bind groups than the device has, or what it says of the shader and the
    /// number of resources. In a browser, where devices answer later, the second goes to the caller's error
    /// scope or handler.
    pub fn cutout_caster(
        &self,
        device: &wgpu::Device,
        wgsl: &str,
        layouts: &[&wgpu::BindGroupLayout],
    ) -> Result<Option<CutoutCaster>, Unsupported> {
        let Some(shader) = self.plan().cutout(wgsl) else { return Ok(None) };
        let technique = self.description().about.name;
        check_groups(device, technique, layouts.len())?;
        match ask_now(device, || self.cast().cutout(device, &shader.text, layouts)) {
            (pipeline, None) => Ok(pipeline.map(|pipeline| CutoutCaster { pipeline })),
            (_, Some(refusal)) => {
                Err(Unsupported::Cutout { technique: technique.into(), reason: refusal.to_string() })
            }
        }
    }
}

/// Groups of the library's own in passes that draw triangles.
const CASTER_GROUPS: usize = 2;

/// Whether a pass for cut-outs may have as many groups of the caller's.
fn check_groups(device: &wgpu::Device, technique: &str, groups: usize) -> Result<(), Unsupported> {
    let (needed, max) = (CASTER_GROUPS + groups, device.limits().max_bind_groups as usize);
    if needed <= max {
        return Ok(());
    }
    let most = max.saturating_sub(CASTER_GROUPS);
    let reason = format!(
        "{needed} bind groups, {groups} of the caller's, where {max} are possible; put what the shader reads into at most {most}"
    );
    Err(Unsupported::Cutout { technique: technique.into(), reason })
}
