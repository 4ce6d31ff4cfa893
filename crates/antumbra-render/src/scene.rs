//! A scene on the GPU: casters for shadow maps, and the surfaces that a camera sees.
//!
//! The camera's surfaces are drawn once into a few targets (position, facet normal, material), and
//! every technique then shades the same ones. So a technique's lookup is timed alone, and its
//! receiver gradients come from each surface's own plane and the camera's rays: exact, also where
//! neighbouring pixels see different things.

use crate::{Gpu, RenderError, Surfaces, surfaces};
use antumbra::{Capacity, CasterPass};
use antumbra_scene::{Camera, Geometry, Light};
use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3};
use wgpu::{RenderPass, TextureFormat};

mod casters;
mod frame;
mod masks;
mod materials;
mod nearest;
mod parts;
mod pipelines;
mod upload;

pub use casters::{Casters, ViewMatrices};
use frame::Frame;
pub use masks::CoarseCutouts;
use masks::Masks;
use materials::Materials;
use pipelines::{Group, Pipelines};

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
pub struct GpuScene {
    positions: wgpu::Buffer,
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    /// Draws with their ranges of indices; opaque draws first.
    groups: Vec<(Group, std::ops::Range<u32>)>,
    materials: Materials,
    /// `None` where lookups cannot ask about cut-outs.
    masks: Option<Masks>,
    coarse_cutouts: Option<CoarseCutouts>,
    pipelines: Pipelines,
    camera_matrix: Mat4,
    frame: Frame,
    frame_buffer: wgpu::Buffer,
    frame_group: wgpu::BindGroup,
    surfaces: Surfaces,
    capacity: Capacity,
    /// Parts of the casters' buffers, as bindings can hold them.
    parts: Vec<antumbra::MeshPart>,
}

impl GpuScene {
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

    /// Moves the points of the picture plane at which surfaces are seen by `offset` pixels, x to the right
    /// and y down, from the pixels' centres.
    pub(crate) fn shift(&self, gpu: &Gpu, offset: Vec2) {
        let frame = self.frame.shifted(offset, self.surfaces.resolution());
        gpu.queue.write_buffer(&self.frame_buffer, 0, bytemuck::bytes_of(&frame));
    }

    /// Memory that a shadow map of this scene needs for triangles. How many of them share a texel is not
    /// known before they are drawn.
    #[must_use]
    pub fn capacity(&self) -> Capacity {
        self.capacity
    }

    /// Replaces the capacity that shadow maps of this scene are given.
    pub fn set_capacity(&mut self, capacity: Capacity) {
        self.capacity = capacity;
    }

    /// Whether there are cut-outs, and lookups can ask about their holes: for
    /// [`Options::cutouts`](antumbra::Options).
    #[must_use]
    pub fn tells_cutouts(&self) -> bool {
        self.masks.is_some()
    }

    /// Why lookups cannot ask about the holes of cut-outs although there are some.
    #[must_use]
    pub fn coarse_cutouts(&self) -> Option<&CoarseCutouts> {
        self.coarse_cutouts.as_ref()
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

    /// Draws every caster into a pass of the shadow map that `casters` were made for. Opaque ones first, in
    /// one draw.
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

    /// Draws the depth of every caster, as seen from one of some views, by pipelines of the scene's own.
    pub fn draw_depth(&self, matrices: &ViewMatrices, index: usize, pass: &mut RenderPass<'_>) {
        let opaque = self.opaque_end();
        self.bind_vertices(pass);
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

    /// End of the indices of opaque triangles, which come first.
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
        self.bind_vertices(&mut pass);
        pass.set_bind_group(0, &self.frame_group, &[0]);
        for (group, range) in &self.groups {
            pass.set_pipeline(self.pipelines.surface(*group));
            pass.set_bind_group(1, &self.materials.groups[group.material], &[]);
            pass.draw_indexed(range.clone(), 0, 0..1);
        }
    }

    fn bind_vertices(&self, pass: &mut RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.attributes.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
    }

    /// Draws the id of the triangle that the rasteriser shows in each pixel, plus one; 0 is background.
    /// Returns the target, words of 32 bits. Its vertices are uploaded for this call.
    ///
    /// # Errors
    /// Too much geometry.
    pub fn encode_triangle_ids(
        &self,
        gpu: &Gpu,
        geometry: &Geometry,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<wgpu::Texture, RenderError> {
        upload::check_buffer(gpu, "corners of triangles", geometry.indices.len(), size_of::<Attributes>())?;
        // Without an index buffer the number of a vertex tells its triangle on every device.
        let corners = || geometry.indices.iter().map(|i| *i as usize);
        let positions: Vec<Vec3> = corners().map(|i| geometry.positions[i]).collect();
        let attribute = |i: usize| Attributes {
            normal: [0.0; 3],
            uv: geometry.uvs[i].to_array(),
            color: geometry.colors[i].to_array(),
        };
        let attributes: Vec<Attributes> = corners().map(attribute).collect();
        let positions = gpu.buffer("corners", bytemuck::cast_slice(&positions), wgpu::BufferUsages::VERTEX);
        let attributes = gpu.buffer("corners", bytemuck::cast_slice(&attributes), wgpu::BufferUsages::VERTEX);
        let size = self.surfaces.resolution();
        let ids = gpu.target("triangle ids", size, TextureFormat::R32Uint);
        let depth = gpu.target("depth", size, TextureFormat::Depth32Float);
        let [ids_view, depth_view] = [&ids, &depth].map(|t| t.create_view(&Default::default()));
        let mut pass = surfaces::begin(encoder, &[&ids_view], &depth_view, None);
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.set_vertex_buffer(1, attributes.slice(..));
        pass.set_bind_group(0, &self.frame_group, &[0]);
        for (group, range) in &self.groups {
            pass.set_pipeline(self.pipelines.id(*group));
            pass.set_bind_group(1, &self.materials.groups[group.material], &[]);
            pass.draw(range.clone(), 0..1);
        }
        drop(pass);
        Ok(ids)
    }
}

#[cfg(test)]
mod tests;
