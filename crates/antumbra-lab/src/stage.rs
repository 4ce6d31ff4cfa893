//! A scene on the GPU: casters for shadow maps, and the surfaces that a camera sees.
//!
//! The camera's surfaces are drawn once into a few targets (position, facet normal, material), and
//! every technique then shades the same ones. So a technique's lookup is timed alone, and its
//! receiver gradients come from each surface's own plane and the camera's rays: exact, also where
//! neighbouring pixels see different things.

use crate::gpu::Gpu;
use antumbra::{Capacity, CasterPass};
use antumbra_scene::{AlphaMode, Camera, Geometry, Light};
use anyhow::{Result, bail};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3};
use wgpu::{RenderPass, TextureFormat, TextureView};

mod casters;
mod frame;
mod masks;
mod materials;
mod nearest;
mod parts;
mod pipelines;
pub(crate) mod surfaces;

pub use casters::{Casters, ViewMatrices};
pub(crate) use frame::Frame;
use masks::Masks;
use materials::Materials;
use pipelines::{Group, Pipelines};
pub(crate) use pipelines::{fullscreen, fullscreen_into};
pub use surfaces::Surfaces;

/// Normal, texture coordinates, colour of a vertex.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
struct Attributes {
    normal: [f32; 3],
    uv: [f32; 2],
    color: [f32; 4],
}

/// Geometry, materials and pipelines of one scene.
#[derive(Debug)]
pub struct Stage {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// With ranges of indices; opaque ones first.
    groups: Vec<(Group, std::ops::Range<u32>)>,
    materials: Materials,
    /// `None` where lookups cannot ask about cut-outs.
    masks: Option<Masks>,
    pipelines: Pipelines,
    camera_matrix: Mat4,
    frame: Frame,
    frame_buffer: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    surfaces: Surfaces,
    capacity: Capacity,
    /// Of the casters' buffers, as bindings can hold them.
    parts: Vec<antumbra::MeshPart>,
}

impl Stage {
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
    ) -> Result<Self> {
        let limits = gpu.device.limits();
        let [width, height] = resolution;
        let most = limits.max_texture_dimension_2d;
        if !(1..=most).contains(&width) || !(1..=most).contains(&height) {
            bail!("resolution {width}x{height} is not possible; each side must be 1 to {most}");
        }
        if geometry.indices.is_empty() {
            bail!("the scene has no triangles");
        }
        let attributes: Vec<Attributes> = (0..geometry.positions.len())
            .map(|i| Attributes {
                normal: geometry.normals[i].to_array(),
                uv: geometry.uvs[i].to_array(),
                color: geometry.colors[i].to_array(),
            })
            .collect();
        check_buffer(gpu, "vertices", attributes.len(), size_of::<Attributes>())?;
        check_buffer(gpu, "corners of triangles", geometry.indices.len(), size_of::<u32>())?;
        let (frame, camera_matrix) = Frame::new(camera, light, resolution, geometry);
        let materials = Materials::new(gpu, geometry)?;
        let pipelines = Pipelines::new(gpu, &materials.layout, geometry.single_sided);
        use wgpu::BufferUsages as Usage;
        let frame_buffer = gpu.buffer("frame", bytemuck::bytes_of(&frame), Usage::UNIFORM);
        let group = |material: usize| Group {
            material,
            masked: matches!(geometry.materials[material].alpha, AlphaMode::Mask { .. }),
            culled: geometry.single_sided && !geometry.materials[material].double_sided,
        };
        let storage = |label, bytes, usage| gpu.buffer(label, bytes, usage | Usage::STORAGE);
        let stage = Self {
            positions: storage("positions", bytemuck::cast_slice(&geometry.positions), Usage::VERTEX),
            attributes: storage("attributes", bytemuck::cast_slice(&attributes), Usage::VERTEX),
            indices: storage("indices", bytemuck::cast_slice(&geometry.indices), Usage::INDEX),
            groups: geometry.groups.iter().map(|(m, r)| (group(*m), 3 * r.start..3 * r.end)).collect(),
            frame_group: pipelines.uniform_group(gpu, &frame_buffer, size_of::<Frame>()),
            surfaces: Surfaces::new(gpu, resolution, &frame_buffer),
            materials,
            masks: Masks::new(gpu, geometry),
            pipelines,
            camera_matrix,
            frame,
            frame_buffer,
            capacity: capacity(geometry, light),
            parts: parts::parts(&geometry.indices, most_vertices(&limits)),
        };
        gpu.check()?;
        Ok(stage)
    }

    /// World to clip space of the camera, reversed depth, infinite where rays meet in the eye: for fitting
    /// light views.
    #[must_use]
    pub fn camera_matrix(&self) -> Mat4 {
        self.camera_matrix
    }

    /// The camera matrix that [`look`](Self::look) would lead to.
    #[must_use]
    pub fn camera_matrix_of(&self, geometry: &Geometry, camera: &Camera, light: &Light) -> Mat4 {
        Frame::new(camera, light, self.surfaces.resolution(), geometry).1
    }

    /// Moves camera and light. What [`surfaces`](Self::surfaces) holds is then to be drawn anew.
    pub fn look(&mut self, gpu: &Gpu, geometry: &Geometry, camera: &Camera, light: &Light) {
        let (frame, matrix) = Frame::new(camera, light, self.surfaces.resolution(), geometry);
        gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&frame));
        (self.frame, self.camera_matrix) = (frame, matrix);
    }

    /// Moves the points of the picture plane at which surfaces are seen by `offset` pixels, x to the right and
    /// y down, from the pixels' centres.
    pub(crate) fn shift(&self, gpu: &Gpu, offset: Vec2) {
        let frame = self.frame.shifted(offset, self.surfaces.resolution());
        gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&frame));
    }

    /// Memory that a shadow map of this scene needs for triangles. How many of them share a texel is not known
    /// before they are drawn: see [`Contestant::draw_maps`](crate::compare::Contestant::draw_maps).
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.capacity
    }

    /// Replaces it. Maps that turn out too small are allocated anew all the same.
    pub fn set_capacity(&mut self, capacity: Capacity) {
        self.capacity = capacity;
    }

    /// Whether there are cut-outs, and lookups can ask about their holes: for
    /// [`Options::cutouts`](antumbra::Options).
    #[must_use]
    pub fn tells_cutouts(&self) -> bool {
        self.masks.is_some()
    }

    /// What lookups that ask about cut-outs bind.
    pub(crate) fn masks(&self) -> Option<&Masks> {
        self.masks.as_ref()
    }

    /// What the camera sees.
    #[must_use]
    pub fn surfaces(&self) -> &Surfaces {
        &self.surfaces
    }

    /// Draws every caster into a pass of the shadow map that `casters` were made for. Opaque ones first, in one
    /// draw.
    pub fn draw_casters(&self, casters: &Casters, pass: &mut CasterPass<'_>) {
        let (mesh, cutout) = match casters {
            Casters::Depth(matrices) => {
                let index = pass.index();
                return self.draw_depth(matrices, index, pass);
            }
            Casters::Triangles { mesh, cutout } => (mesh, cutout),
        };
        pass.draw_mesh(mesh, ..self.opaque_end() / 3);
        let Some((cutout, attributes)) = cutout else { return };
        pass.set_bind_group(3, attributes, &[]);
        for (group, range) in self.groups.iter().filter(|g| g.0.masked) {
            pass.set_bind_group(2, &self.materials.groups[group.material], &[]);
            pass.draw_cutout(mesh, range.start / 3..range.end / 3, cutout);
        }
    }

    /// Draws their depth, as seen from one of some views, by pipelines of the stage's own.
    pub(crate) fn draw_depth(&self, matrices: &ViewMatrices, index: usize, pass: &mut RenderPass<'_>) {
        let opaque = self.opaque_end();
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        matrices.bind(pass, index);
        if opaque > 0 {
            pass.set_pipeline(&self.pipelines.caster);
            pass.draw_indexed(0..opaque, 0, 0..1);
        }
        pass.set_pipeline(&self.pipelines.masked_caster);
        for (group, range) in self.groups.iter().filter(|g| g.0.masked) {
            pass.set_bind_group(1, &self.materials.groups[group.material], &[]);
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }

    /// The index behind those of opaque triangles, which come first.
    fn opaque_end(&self) -> u32 {
        self.groups.iter().filter(|g| !g.0.masked).map(|g| g.1.end).max().unwrap_or(0)
    }

    /// Draws what the camera sees into [`surfaces`](Self::surfaces).
    pub fn encode_surfaces(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        timestamps: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let mut pass = self.surfaces.begin(encoder, timestamps);
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.set_bind_group(0, &self.frame_group, &[0]);
        for (group, range) in &self.groups {
            pass.set_pipeline(self.pipelines.surface(*group));
            pass.set_bind_group(1, &self.materials.groups[group.material], &[]);
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }

    /// The number of the triangle that the rasteriser shows in each pixel, row by row;
    /// `u32::MAX` for background. For the coverage check; waits.
    ///
    /// # Errors
    /// Too much geometry, as [`Gpu::check`], or if the device is lost.
    pub fn triangle_numbers(&self, gpu: &Gpu, geometry: &Geometry) -> Result<Vec<u32>> {
        check_buffer(gpu, "corners of triangles", geometry.indices.len(), size_of::<Attributes>())?;
        // Without an index buffer the number of a vertex tells its triangle on every device.
        let corner = |i: &u32| *i as usize;
        let positions: Vec<Vec3> = geometry.indices.iter().map(|i| geometry.positions[corner(i)]).collect();
        let attributes: Vec<Attributes> = geometry
            .indices
            .iter()
            .map(|i| Attributes {
                normal: [0.0; 3],
                uv: geometry.uvs[corner(i)].to_array(),
                color: geometry.colors[corner(i)].to_array(),
            })
            .collect();
        let positions = gpu.buffer("corners", bytemuck::cast_slice(&positions), wgpu::BufferUsages::VERTEX);
        let attributes = gpu.buffer("corners", bytemuck::cast_slice(&attributes), wgpu::BufferUsages::VERTEX);
        let size = self.surfaces.resolution();
        let numbers = gpu.target("triangle numbers", size, TextureFormat::R32Uint);
        let depth = gpu.target("depth", size, TextureFormat::Depth32Float);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        {
            let mut pass = surfaces::begin(
                &mut encoder,
                &[&numbers.create_view(&Default::default())],
                &depth.create_view(&Default::default()),
                None,
            );
            pass.set_vertex_buffer(0, positions.slice(..));
            pass.set_vertex_buffer(1, attributes.slice(..));
            pass.set_bind_group(0, &self.frame_group, &[0]);
            for (group, range) in &self.groups {
                pass.set_pipeline(self.pipelines.number(*group));
                pass.set_bind_group(1, &self.materials.groups[group.material], &[]);
                pass.draw(range.clone(), 0..1);
            }
        }
        gpu.finish(encoder)?;
        // The target is cleared to 0, so numbers are stored plus one.
        let bytes = gpu.read(&numbers)?;
        let words = bytes.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]]));
        Ok(words.map(|n| n.wrapping_sub(1)).collect())
    }
}

/// Vertices that one binding holds wherever it begins.
fn most_vertices(limits: &wgpu::Limits) -> u32 {
    let bytes = limits.max_storage_buffer_binding_size / size_of::<Vec3>() as u64;
    u32::try_from(bytes).unwrap_or(u32::MAX).saturating_sub(limits.min_storage_buffer_offset_alignment / 4)
}

/// Of all triangles; those under a spot may be cut in two.
fn capacity(geometry: &Geometry, light: &Light) -> Capacity {
    let pieces = match light {
        Light::Directional { .. } => 1,
        Light::Spot { .. } => 2,
    };
    let triangles = pieces * geometry.triangle_count();
    let triangles = triangles.clamp(1, Capacity::MAX_TRIANGLES as usize) as u32;
    Capacity { triangles, ..Capacity::default() }
}

/// Whether a buffer of `count` things of `size` bytes is possible.
fn check_buffer(gpu: &Gpu, what: &str, count: usize, size: usize) -> Result<()> {
    let (bytes, most) = (count as u64 * size as u64, gpu.device.limits().max_buffer_size);
    if bytes > most {
        bail!("{count} {what} need a buffer of {bytes} bytes; {} allows {most}", gpu.info.name);
    }
    Ok(())
}

/// Layout entry of a texture that is loaded, not sampled.
pub(crate) fn loaded(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    }
}

/// Layout entry of a buffer that is read.
pub(crate) fn loaded_buffer(binding: u32) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only: true },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    }
}

/// Layout entry of a uniform buffer.
pub(crate) fn uniform(binding: u32) -> wgpu::BindGroupLayoutEntry {
    uniform_entry(binding, Offset::Fixed)
}

/// Whether a bind group's offset into its buffer is given when it is set.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Offset {
    Fixed,
    Dynamic,
}

fn uniform_entry(binding: u32, offset: Offset) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: offset == Offset::Dynamic,
            min_binding_size: None,
        },
        count: None,
    }
}

pub(crate) type Target = TextureView;

#[cfg(test)]
mod tests;
