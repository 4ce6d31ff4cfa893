//! Arrays and meshes that are larger than a binding answer what they answer in one piece.

use super::lists::{MAP, TRIANGLES, soup};
use antumbra::{Capacity, CasterMesh, MeshError, MeshPart, Options, ShadowMap, technique};
use antumbra_testing::ask::{Random, Receiver, caster_buffers, view, visibility};
use antumbra_testing::{Gpu, settings};
use glam::{Mat4, Vec2, Vec3};

/// Bytes of a binding: less than the counts, keys or corners of a map, or the positions of its mesh.
const BINDING: u64 = 5120;
const BATCH: usize = 64;

/// Every technique that keeps triangles, on a device with bindings of 5 KiB and on one with plenty.
pub(crate) fn split_buffers_answer_the_same(gpu: &Gpu) {
    let limits = wgpu::Limits {
        max_storage_buffer_binding_size: BINDING,
        max_storage_buffers_per_shader_stage: 16,
        ..wgpu::Limits::default()
    };
    let small = antumbra_testing::gpu_with(antumbra_testing::FEATURES, limits).unwrap();
    let corners: Vec<Vec3> = soup(&mut Random::new(41)).into_flattened();
    let capacity = Capacity { triangles: TRIANGLES, triangles_per_texel: 40 };
    let options = Options::from(MAP).capacity(capacity);
    for spec in settings::keeping_triangles() {
        let technique = technique::parse(spec).unwrap();
        let answers = |gpu: &Gpu, parts: &[MeshPart]| {
            let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options.clone()).unwrap();
            shadows.prepare(&gpu.queue, &[view(MAP)]).unwrap();
            let [positions, indices] = caster_buffers(gpu, &corners);
            let mesh =
                CasterMesh::in_parts(&gpu.device, &positions, &indices, parts, Mat4::IDENTITY).unwrap();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
            gpu.queue.submit([encoder.finish()]);
            let batches = receivers();
            batches.chunks(BATCH).flat_map(|batch| visibility(gpu, &shadows, batch)).collect::<Vec<f32>>()
        };
        let whole = answers(gpu, &[part(0..TRIANGLES)]);
        let split = small.checked(|gpu| answers(gpu, &[part(0..110), part(110..TRIANGLES)]));
        assert_eq!(whole, split, "{spec}");
        let lit = whole.iter().filter(|v| **v > 0.5).count();
        assert!((26..230).contains(&lit), "{spec}: {lit} of {} are lit", whole.len());
    }
    let [positions, indices] = caster_buffers(&small, &corners);
    let whole =
        CasterMesh::new(&small.device, &positions, &indices, 0..TRIANGLES, Mat4::IDENTITY).unwrap_err();
    assert_eq!(whole, MeshError::Bytes { what: "positions", bytes: 36 * 240, max: BINDING });
}

/// Triangles that share no vertex.
fn part(triangles: std::ops::Range<u32>) -> MeshPart {
    MeshPart { vertices: 3 * triangles.start..3 * triangles.end, triangles }
}

fn receivers() -> Vec<Receiver> {
    let mut random = Random::new(42);
    let mut place = || Vec2::new(random.unit(), random.unit());
    (0..4 * BATCH).map(|_| place()).map(|uv| Receiver::point(uv.x, uv.y, 0.5)).collect()
}
