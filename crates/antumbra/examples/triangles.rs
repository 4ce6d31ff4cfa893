//! Casters that are triangles: a gate whose bars are finer than the texels of its map, and a box that moves.
//! For techniques that keep triangles: `rgsm`, `spsm`, `dpm`, `exact`.
//!
//! `cargo run --release -p antumbra --example triangles -- gate.png exact`

mod common;

use antumbra::{
    Bounds, Capacity, CasterMesh, Fit, Light, Options, ShadowMap, Size,
    technique::{self, CasterStorage},
};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
@group(2) @binding(0) var<uniform> world_from_object: mat4x4f;
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    let world = world_from_object * vec4f(position, 1.0);
    return Varying(clip_from_world * world, world.xyz, (world_from_object * vec4f(normal, 0.0)).xyz);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let sun = max(dot(in.normal, normalize(vec3f(-0.7, 1.0, 0.25))), 0.0);
    let lit = shadow_visibility(in.world, in.normal, dpdx(in.world), dpdy(in.world));
    return vec4f(vec3f(0.9, 0.85, 0.7) * (0.2 + 0.05 * in.normal.z + 0.8 * sun * lit), 1.0);
}";

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-5.0, 6.0, 9.0), Vec3::new(0.0, 0.5, 0.0), Vec3::Y)
}

/// A floor, and bars of less than half a texel.
fn gate() -> Vec<(Vec3, Vec3)> {
    let bar = |i: i32| (Vec3::new(0.0, 1.0, 0.4 * i as f32), Vec3::new(0.02, 1.0, 0.02));
    let floor = (Vec3::new(0.0, -0.1, 0.0), Vec3::new(6.0, 0.1, 6.0));
    let rail = (Vec3::new(0.0, 2.0, 0.0), Vec3::new(0.1, 0.1, 3.0));
    (-7..=7).map(bar).chain([floor, rail]).collect()
}

/// The picture, rows of RGBA.
pub fn run(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    spec: &str,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let technique = technique::parse(spec)?;
    let meshes = [Mesh::boxes(device, &gate()), Mesh::boxes(device, &[(Vec3::ZERO, Vec3::splat(0.5))])];

    // 1. Each mesh once: positions and indices, for shaders to read. Where it is may change.
    let casters = meshes
        .iter()
        .map(|mesh| {
            let [positions, indices] = mesh.storage(device);
            CasterMesh::new(device, &positions, &indices, 0..mesh.triangles(), Mat4::IDENTITY)
        })
        .collect::<Result<Vec<_>, _>>()?;

    // 2. The map has memory for as many triangles as there are, twice as many under a spot.
    let triangles = meshes.iter().map(Mesh::triangles).sum();
    let capacity = Capacity { triangles, ..Capacity::default() };
    let options = Options::from(Size::square(128)).capacity(capacity);
    let mut shadows = ShadowMap::new(device, technique.as_ref(), options)?;
    if shadows.description().storage == CasterStorage::Depth {
        return Err(format!("{spec} keeps depth: its casters are drawn as in the example hello").into());
    }
    let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 2.1, 6.0) };
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    let (size, margin_texels, lean) = (shadows.size(), shadows.margin_texels(), shadows.leans());
    let view =
        sun.view(&Fit { casters: scene, receivers: scene.corners().collect(), size, margin_texels, lean })?;

    // 3. Each frame: what moved, then all meshes. The pass knows how to draw them.
    let moved = Mat4::from_translation(Vec3::new(-2.5, 0.5, 1.0)) * Mat4::from_rotation_y(0.6);
    casters[1].place(queue, moved);
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.prepare(queue, &[view])?;
    shadows.encode(&mut encoder, |pass| casters.iter().for_each(|mesh| pass.draw_mesh(mesh, ..)))?;
    // What there is no memory for casts no shadow; 0 where triangles are not kept by number.
    if shadows.triangles_drawn() > capacity.triangles {
        return Err(format!("{} triangles were drawn", shadows.triangles_drawn()).into());
    }

    // 4. Receivers are the same as ever.
    let source = shadows.wgsl(1).after(SHADER);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let groups = [Some(&matrices), Some(shadows.layout()), Some(&matrices)];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let group = |matrix| common::uniform(device, &matrices, matrix);
    let (from_camera, places) = (group(camera()), [Mat4::IDENTITY, moved].map(group));
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        for (mesh, place) in meshes.iter().zip(&places) {
            pass.set_bind_group(2, place, &[]);
            mesh.draw(pass);
        }
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    let spec = std::env::args().nth(2).unwrap_or_else(|| "exact".into());
    common::save("triangles", &run(&device, &queue, &spec)?)
}
