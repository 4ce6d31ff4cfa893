//! How the casters of a scene are drawn for a shadow map: depth, or triangles where it keeps those.

use super::GpuScene;
use crate::{Gpu, RenderError, layout::loaded_buffer, shaders};
use antumbra::{CasterMesh, CutoutCaster, ShadowMap, View, technique::CasterStorage};
use glam::Mat4;

/// What drawing casters for one shadow map takes.
#[derive(Debug)]
pub enum Casters {
    /// The scene's own pipelines, and what they know of the map's caster views.
    Depth(ViewMatrices),
    /// The library's.
    Triangles {
        /// All triangles of the scene.
        mesh: CasterMesh,
        /// How masked materials are drawn, and normals, texture coordinates and colours of the
        /// vertices. `None` if the scene has none.
        cutout: Option<(CutoutCaster, wgpu::BindGroup)>,
    },
}

impl Casters {
    /// Prepares the casters of one shadow map and its views, if it has any yet.
    ///
    /// # Errors
    /// More geometry than one binding may hold.
    pub fn new(gpu: &Gpu, scene: &GpuScene, shadows: &ShadowMap) -> Result<Self, RenderError> {
        if shadows.description().storage == CasterStorage::Depth {
            return Ok(Self::Depth(ViewMatrices::new(gpu, scene, shadows.caster_views())));
        }
        let (positions, indices) = (&scene.positions, &scene.indices);
        let mesh = CasterMesh::in_parts(&gpu.device, positions, indices, &scene.parts, Mat4::IDENTITY)?;
        // Large scenes have more attributes than a binding holds, and most of them no cut-outs.
        if !scene.groups.iter().any(|(group, _)| group.masked) {
            return Ok(Self::Triangles { mesh, cutout: None });
        }
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("attributes"),
            entries: &[loaded_buffer(0)],
        });
        let attributes = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("attributes"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: scene.attributes.as_entire_binding() }],
        });
        let cutout =
            shadows.cutout_caster(&gpu.device, shaders::CUTOUT, &[&scene.materials.layout, &layout])?;
        Ok(Self::Triangles { mesh, cutout: cutout.map(|cutout| (cutout, attributes)) })
    }

    /// Takes the views that the map was given anew.
    pub fn set_views(&mut self, gpu: &Gpu, scene: &GpuScene, shadows: &ShadowMap) {
        if let Self::Depth(matrices) = self {
            *matrices = ViewMatrices::new(gpu, scene, shadows.caster_views());
        }
    }
}

/// Matrices of some views, for the scene's pipelines that draw depth.
#[derive(Debug)]
pub struct ViewMatrices {
    group: wgpu::BindGroup,
    /// Bytes from one matrix to the next.
    stride: u32,
}

impl ViewMatrices {
    /// Uploads the matrices that place a scene on such views.
    #[must_use]
    pub fn new(gpu: &Gpu, scene: &GpuScene, views: &[View]) -> Self {
        const BYTES: usize = size_of::<Mat4>();
        let stride = BYTES.next_multiple_of(gpu.device.limits().min_uniform_buffer_offset_alignment as usize);
        let mut bytes = vec![0; views.len().max(1) * stride];
        for (slot, view) in bytes.chunks_exact_mut(stride).zip(views) {
            slot[..BYTES].copy_from_slice(bytemuck::bytes_of(&view.clip_from_world.to_cols_array()));
        }
        let buffer = gpu.buffer("views", &bytes, wgpu::BufferUsages::UNIFORM);
        Self { group: scene.pipelines.uniform_group(gpu, &buffer, BYTES), stride: stride as u32 }
    }

    /// Binds the matrix of view `index` for the pipelines.
    pub(super) fn bind(&self, pass: &mut wgpu::RenderPass<'_>, index: usize) {
        pass.set_bind_group(0, &self.group, &[index as u32 * self.stride]);
    }
}
