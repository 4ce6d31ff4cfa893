//! Casters that are skinned: a column that two bones bend. A compute shader moves its vertices once; the depth
//! pass, the library's pass for triangles and the camera's all read where it put them.
//!
//! `cargo run --release -p antumbra --example skinning -- bent.png spsm`

mod common;

use antumbra::{
    Bounds, CasterMesh, Fit, Light, LightError, ShadowMap, Size, View,
    technique::{self, CasterStorage},
};
use common::{HEIGHT, WIDTH};
use glam::{Mat4, Vec3, Vec4, camera::rh};

/// Where bones put a vertex. Positions are three floats each, tightly packed, as casters of triangles want.
const SKIN: &str = "
@group(0) @binding(0) var<storage, read> rest: array<vec4f>; // place, weight of the second bone
@group(0) @binding(1) var<storage, read> bones: array<mat4x4f>;
@group(0) @binding(2) var<storage, read_write> positions: array<f32>;

@compute @workgroup_size(64) fn compute(@builtin(global_invocation_id) id: vec3u) {
    let i = id.x;
    if i >= arrayLength(&rest) {
        return;
    }
    let place = vec4f(rest[i].xyz, 1.0);
    let skinned = mix((bones[0] * place).xyz, (bones[1] * place).xyz, rest[i].w);
    for (var k = 0u; k < 3u; k += 1u) {
        positions[3u * i + k] = skinned[k];
    }
}";

/// Skinned triangles have no normals of their own here: the facet's is what shadows want anyway.
const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f }

@vertex fn vertex(@location(0) position: vec3f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    let normal = normalize(cross(down, across));
    let sun = max(dot(normal, normalize(vec3f(-0.7, 1.0, 0.25))), 0.0);
    let lit = shadow_visibility(in.world, normal, across, down);
    return vec4f(vec3f(0.9, 0.85, 0.7) * (0.2 + 0.05 * normal.z + 0.8 * sun * lit), 1.0);
}";

/// Rings of the column.
const RINGS: u32 = 24;

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-5.0, 6.0, 9.0), Vec3::new(0.0, 0.5, 0.0), Vec3::Y)
}

/// At rest: a ground that the second bone does not move, and an upright column that it does, the more the
/// higher. Vertices and indices.
fn rest() -> (Vec<Vec4>, Vec<u32>) {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let ground = corners.map(|(x, z)| Vec4::new(6.0 * x, 0.0, 6.0 * z, 0.0));
    let ring = |i: u32| {
        let height = i as f32 / RINGS as f32;
        let weight = (2.0 * height - 0.5).clamp(0.0, 1.0);
        corners.map(|(x, z)| Vec4::new(0.3 * x, 4.0 * height, 0.3 * z, weight))
    };
    let side = |i: u32| {
        (0..4).flat_map(move |k| {
            let [a, b] = [k, (k + 1) % 4].map(|corner| 4 + 4 * i + corner);
            [a, b, a + 4, b, b + 4, a + 4]
        })
    };
    let lid = 4 + 4 * RINGS;
    let quad = |first: u32| [0, 2, 1, 0, 3, 2].map(|i| first + i);
    let indices = quad(0).into_iter().chain(quad(lid)).chain((0..RINGS).flat_map(side)).collect();
    (ground.into_iter().chain((0..=RINGS).flat_map(ring)).collect(), indices)
}

/// A pipeline for vertices that are positions alone, with a colour if there is a fragment stage.
fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    groups: &[Option<&wgpu::BindGroupLayout>],
    fragment: Option<&str>,
) -> wgpu::RenderPipeline {
    let attributes = wgpu::vertex_attr_array![0 => Float32x3];
    common::pipeline_of(device, module, groups, common::Stages::of("vertex", fragment), &[&attributes])
}

/// The picture, rows of RGBA.
pub fn run(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    spec: &str,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    use wgpu::BufferUsages as Usage;
    let (vertices, indices) = rest();
    let (count, triangles) = (vertices.len() as u32, indices.len() as u32 / 3);
    // What the skin reads, and what it writes: vertices for the camera, storage for casters that are triangles.
    let rest = common::buffer(device, bytemuck::cast_slice(&vertices), Usage::STORAGE);
    let bones = common::buffer(device, bytemuck::cast_slice(&[Mat4::IDENTITY, knee()]), Usage::STORAGE);
    let positions = positions(device, count);
    let indices = common::buffer(device, bytemuck::cast_slice(&indices), Usage::INDEX | Usage::STORAGE);
    let (layout, group) = common::storage_group(device, &[&rest, &bones, &positions]);
    let skin = common::compute_pipeline(device, wgpu::ShaderSource::Wgsl(SKIN.into()), &[Some(&layout)]);

    let technique = technique::parse(spec)?;
    let mut shadows = ShadowMap::new(device, technique.as_ref(), Size::square(1024))?;
    let view = sun(&shadows)?;

    let source = shadows.wgsl(1).after(SHADER);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let own = [Some(&matrices)];
    let both = [Some(&matrices), Some(shadows.layout())];
    let cast = pipeline(device, &module, &own, None);
    let receive = pipeline(device, &module, &both, Some("fragment"));
    let draw = |pass: &mut wgpu::RenderPass<'_>| {
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..3 * triangles, 0, 0..1);
    };

    // Each frame: bones, then skin, then whatever reads the positions.
    let mut encoder = device.create_command_encoder(&Default::default());
    bend(&mut encoder, &skin, &group, count);
    shadows.prepare(queue, &[view])?;
    if shadows.description().storage == CasterStorage::Depth {
        shadows.encode(&mut encoder, |pass| {
            let matrix = common::uniform(device, &matrices, pass.view().clip_from_world);
            pass.set_pipeline(&cast);
            pass.set_bind_group(0, &matrix, &[]);
            draw(pass);
        })?;
    } else {
        // Made once: it reads the buffer anew each time.
        let mesh = CasterMesh::new(device, &positions, &indices, 0..triangles, Mat4::IDENTITY)?;
        shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..))?;
    }

    let from_camera = common::uniform(device, &matrices, camera());
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        draw(pass);
    }))
}

/// The bone below the knee, bent.
fn knee() -> Mat4 {
    let knee = Vec3::new(0.0, 2.0, 0.0);
    Mat4::from_translation(knee) * Mat4::from_rotation_x(0.9) * Mat4::from_translation(-knee)
}

/// Room for so many positions that the skin writes.
fn positions(device: &wgpu::Device, count: u32) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size: 12 * u64::from(count),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX,
        mapped_at_creation: false,
    })
}

/// Puts so many vertices where their bones are.
fn bend(
    encoder: &mut wgpu::CommandEncoder,
    skin: &wgpu::ComputePipeline,
    group: &wgpu::BindGroup,
    count: u32,
) {
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(skin);
    pass.set_bind_group(0, group, &[]);
    pass.dispatch_workgroups(count.div_ceil(64), 1, 1);
}

/// The sun's view of the whole scene.
fn sun(shadows: &ShadowMap) -> Result<View, LightError> {
    let scene = Bounds { min: Vec3::new(-6.0, 0.0, -6.0), max: Vec3::new(6.0, 4.0, 6.0) };
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    sun.view(&Fit {
        casters: scene,
        receivers: scene.corners().collect(),
        size: shadows.size(),
        margin_texels: shadows.margin_texels(),
        lean: shadows.leans(),
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    let spec = std::env::args().nth(2).unwrap_or_else(|| "vsm".into());
    common::save("skinning", &run(&device, &queue, &spec)?)
}
