//! Shadow maps over depth textures, whatever casters leave.

use super::{depth::repeat_layers, floats, kept, view};
use crate::Gpu;
use antumbra::{
    Capabilities, CasterMesh, NoProbe, Options, ShadowMap, Size, Technique, View, technique::CasterStorage,
};
use glam::{Mat4, Vec3};

/// A filtered shadow map over that depth.
pub fn shadow_map(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
) -> ShadowMap {
    shadow_map_of(gpu, technique, depth, options, &[view(texels_of(depth))])
}

fn texels_of(depth: &wgpu::Texture) -> Size {
    Size { width: depth.width(), height: depth.height() }
}

/// The same with those views, one per layer of the depth.
pub fn shadow_map_of(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
    views: &[View],
) -> ShadowMap {
    let options = options.pipelines(&kept(gpu).pipelines);
    let described = technique.describe(&Capabilities::of(&gpu.device)).unwrap();
    if described.storage != CasterStorage::Depth {
        return triangle_map(gpu, technique, depth, options, views);
    }
    // Depth that was made for one caster pass serves all of them.
    let casts = described.sample_offsets.len() as u32;
    let repeated = depth.depth_or_array_layers() == views.len() as u32 && casts > 1;
    let depth = if repeated { repeat_layers(gpu, depth, casts) } else { depth.clone() };
    let mut shadows = ShadowMap::from_depth(&gpu.device, technique, &depth, options).unwrap();
    shadows.prepare(&gpu.queue, views).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode_filter(&mut encoder, &mut NoProbe);
    gpu.queue.submit([encoder.finish()]);
    shadows
}

/// The same for techniques whose casters are triangles: a square of three for every texel of that depth
/// that is not empty, so little smaller than the texel that it touches no other.
fn triangle_map(
    gpu: &Gpu,
    technique: &dyn Technique,
    depth: &wgpu::Texture,
    options: Options,
    views: &[View],
) -> ShadowMap {
    const INSET: f32 = 2e-3;
    let size = texels_of(depth);
    let meshes: Vec<CasterMesh> = views
        .iter()
        .enumerate()
        .map(|(layer, view)| {
            let world_from_clip = view.clip_from_world.inverse();
            let mut corners = Vec::new();
            for (i, z) in floats(&gpu.read_texture(depth, layer as u32, 0)).into_iter().enumerate() {
                let (x, y) = ((i as u32 % size.width) as f32, (i as u32 / size.width) as f32);
                let at = |right: f32, down: f32| {
                    let end = |k: f32| k + INSET * (1.0 - 2.0 * k);
                    let u = (x + end(right)) / size.width as f32;
                    let v = (y + end(down)) / size.height as f32;
                    world_from_clip.project_point3(Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, z))
                };
                let [a, b, c, d] = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
                // Around a point of the upper side, so that no edge crosses the centre.
                let m = at(0.4, 0.0);
                if z < 1.0 {
                    corners.extend([m, c, d, m, d, b, m, a, c]);
                }
            }
            caster_mesh(gpu, &corners)
        })
        .collect();
    let options = Options { size, views: views.len() as u32, ..options };
    let mut shadows = ShadowMap::new(&gpu.device, technique, options).unwrap();
    shadows.prepare(&gpu.queue, views).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&meshes[pass.index()], ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    shadows
}

/// World-space triangles, three corners each, as casters.
pub fn caster_mesh(gpu: &Gpu, corners: &[Vec3]) -> CasterMesh {
    let [positions, indices] = caster_buffers(gpu, corners);
    CasterMesh::new(&gpu.device, &positions, &indices, 0..corners.len() as u32 / 3, Mat4::IDENTITY).unwrap()
}

/// Their positions and indices.
pub fn caster_buffers(gpu: &Gpu, corners: &[Vec3]) -> [wgpu::Buffer; 2] {
    let buffer = |bytes: &[u8]| {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("test mesh"),
            size: bytes.len().max(36) as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        gpu.queue.write_buffer(&buffer, 0, bytes);
        buffer
    };
    let indices: Vec<u32> = (0..corners.len() as u32).collect();
    [buffer(bytemuck::cast_slice(corners)), buffer(bytemuck::cast_slice(&indices))]
}
