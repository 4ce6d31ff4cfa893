//! From a scene's data to buffers, textures and pipelines.

use super::{Attributes, Frame, GpuScene, Group, Masks, Materials, Pipelines, parts};
use crate::{Gpu, RenderError, Surfaces};
use antumbra::Capacity;
use antumbra_scene::{AlphaMode, Camera, Geometry, Light};
use glam::Vec3;
use wgpu::BufferUsages as Usage;

impl GpuScene {
    /// Uploads a scene and prepares the pictures of one camera under one light.
    ///
    /// # Errors
    /// Resolution of zero or beyond the device's limit, too much geometry; as [`Gpu::check`].
    pub fn new(
        gpu: &Gpu,
        geometry: &Geometry,
        camera: &Camera,
        light: &Light,
        resolution: [u32; 2],
    ) -> Result<Self, RenderError> {
        check(gpu, geometry, resolution)?;
        let attributes = attributes(geometry);
        let (frame, camera_matrix) = Frame::new(camera, light, resolution, geometry);
        let materials = Materials::new(gpu, geometry)?;
        let pipelines = Pipelines::new(gpu, &materials.layout, geometry.single_sided);
        let frame_buffer = gpu.buffer("frame", bytemuck::bytes_of(&frame), Usage::UNIFORM);
        let group = |material: usize| Group {
            material,
            masked: matches!(geometry.materials[material].alpha, AlphaMode::Mask { .. }),
            culled: geometry.single_sided && !geometry.materials[material].double_sided,
        };
        let (masks, coarse_cutouts) =
            Masks::new(gpu, geometry).map_or_else(|coarse| (None, Some(coarse)), |masks| (masks, None));
        let storage = |label, bytes, usage| gpu.buffer(label, bytes, usage | Usage::STORAGE);
        let scene = Self {
            positions: storage("positions", bytemuck::cast_slice(&geometry.positions), Usage::VERTEX),
            attributes: storage("attributes", bytemuck::cast_slice(&attributes), Usage::VERTEX),
            indices: storage("indices", bytemuck::cast_slice(&geometry.indices), Usage::INDEX),
            groups: geometry.groups.iter().map(|(m, r)| (group(*m), 3 * r.start..3 * r.end)).collect(),
            frame_group: pipelines.uniform_group(gpu, &frame_buffer, size_of::<Frame>()),
            surfaces: Surfaces::new(gpu, resolution, &frame_buffer),
            materials,
            masks,
            coarse_cutouts,
            pipelines,
            camera_matrix,
            frame,
            frame_buffer,
            capacity: capacity(geometry, light),
            parts: parts::parts(&geometry.indices, max_vertices(&gpu.device.limits())),
        };
        gpu.check()?;
        Ok(scene)
    }
}

/// Whether the device can hold picture and geometry.
fn check(gpu: &Gpu, geometry: &Geometry, [width, height]: [u32; 2]) -> Result<(), RenderError> {
    let max = gpu.device.limits().max_texture_dimension_2d;
    if !(1..=max).contains(&width) || !(1..=max).contains(&height) {
        return Err(RenderError::Resolution { width, height, max });
    }
    if geometry.indices.is_empty() {
        return Err(RenderError::NoTriangles);
    }
    check_buffer(gpu, "vertices", geometry.positions.len(), size_of::<Attributes>())?;
    check_buffer(gpu, "corners of triangles", geometry.indices.len(), size_of::<u32>())
}

/// Whether a buffer of `count` things of `size` bytes is possible.
pub(super) fn check_buffer(
    gpu: &Gpu,
    what: &'static str,
    count: usize,
    size: usize,
) -> Result<(), RenderError> {
    let (bytes, max) = (count as u64 * size as u64, gpu.device.limits().max_buffer_size);
    if bytes > max {
        let adapter = gpu.info.name.clone();
        return Err(RenderError::Buffer { what, count, bytes, adapter, max });
    }
    Ok(())
}

/// What vertices have beside their positions.
fn attributes(geometry: &Geometry) -> Vec<Attributes> {
    let attribute = |i: usize| Attributes {
        normal: geometry.normals[i].to_array(),
        uv: geometry.uvs[i].to_array(),
        color: geometry.colors[i].to_array(),
    };
    (0..geometry.positions.len()).map(attribute).collect()
}

/// Vertices that one binding holds wherever it begins.
fn max_vertices(limits: &wgpu::Limits) -> u32 {
    let bytes = limits.max_storage_buffer_binding_size / size_of::<Vec3>() as u64;
    u32::try_from(bytes).unwrap_or(u32::MAX).saturating_sub(limits.min_storage_buffer_offset_alignment / 4)
}

/// Memory for all triangles; those under a spot may be cut in two.
fn capacity(geometry: &Geometry, light: &Light) -> Capacity {
    let pieces = match light {
        Light::Directional { .. } => 1,
        Light::Spot { .. } => 2,
    };
    let triangles = pieces * geometry.triangle_count();
    let triangles = triangles.clamp(1, Capacity::MAX_TRIANGLES as usize) as u32;
    Capacity { triangles, ..Capacity::default() }
}
