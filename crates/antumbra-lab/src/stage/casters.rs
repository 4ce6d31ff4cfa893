//! How the casters of a stage are drawn for a shadow map: depth, or triangles where it keeps those.

use super::{Stage, loaded_buffer};
use crate::{gpu::Gpu, shaders};
use antumbra::{CasterMesh, ShadowMap, technique::Caster};
use anyhow::Result;
use glam::Mat4;

/// What drawing casters for one shadow map takes.
#[derive(Debug)]
pub enum Casters {
    /// The stage's own pipelines.
    Depth,
    /// The library's.
    Triangles {
        /// All triangles of the stage.
        mesh: CasterMesh,
        /// For masked materials: the pipeline, and normals, texture coordinates and colours of the
        /// vertices. `None` if the scene has none.
        cutout: Option<(wgpu::RenderPipeline, wgpu::BindGroup)>,
    },
}

impl Casters {
    /// For one shadow map.
    ///
    /// # Errors
    /// More geometry than one binding may hold.
    pub fn new(gpu: &Gpu, stage: &Stage, shadows: &ShadowMap) -> Result<Self> {
        if shadows.technique().caster() == Caster::Depth {
            return Ok(Self::Depth);
        }
        let (positions, indices) = (&stage.positions, &stage.indices);
        let mesh = CasterMesh::in_parts(&gpu.device, positions, indices, &stage.parts, Mat4::IDENTITY)?;
        // Large scenes have more attributes than a binding holds, and most of them no cut-outs.
        if !stage.groups.iter().any(|(group, _)| group.masked) {
            return Ok(Self::Triangles { mesh, cutout: None });
        }
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("attributes"),
            entries: &[loaded_buffer(0)],
        });
        let attributes = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("attributes"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: stage.attributes.as_entire_binding() }],
        });
        let pipeline =
            shadows.cutout_caster(&gpu.device, shaders::CUTOUT, &[&stage.materials.layout, &layout])?;
        Ok(Self::Triangles { mesh, cutout: pipeline.map(|pipeline| (pipeline, attributes)) })
    }
}
