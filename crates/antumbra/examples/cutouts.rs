//! Casters with holes: a card that hovers above a floor, with discs cut out by a mask. Where the technique keeps
//! depth the renderer's own fragment shader discards; where it keeps triangles, the library asks the caller's WGSL.
//! Holes are as fine as the map here; `Options::cutouts` has `dpm` and `exact` ask where the light's ray ends.
//!
//! `cargo run --release -p antumbra --example cutouts -- card.png dpm`

mod common;

use antumbra::{
    Bounds, CasterMesh, Fit, Light, LightError, ShadowMap, Size, View,
    technique::{self, CasterStorage},
};
use common::{HEIGHT, WIDTH};
use glam::{Mat4, Vec2, Vec3, camera::rh};

/// What a mask is, for whoever asks it: the renderer's own shaders and the library's. Levels are explicit, since
/// the library asks where derivatives mean nothing.
const MASK: &str = "
@group(2) @binding(0) var mask: texture_2d<f32>;
@group(2) @binding(1) var mask_sampler: sampler;
fn is_solid(uv: vec2f) -> bool {
    return textureSampleLevel(mask, mask_sampler, uv, 0.0).r >= 0.5;
}
";

/// Whether a triangle stops light where its corners have these weights.
const COVERS: &str = "
@group(2) @binding(2) var<storage, read> mask_uvs: array<vec2f>;
fn caster_covers(triangle: u32, weights: vec3f) -> bool {
    let uv = mat3x2f(
        mask_uvs[caster_vertex(triangle, 0u)],
        mask_uvs[caster_vertex(triangle, 1u)],
        mask_uvs[caster_vertex(triangle, 2u)],
    ) * weights;
    return is_solid(uv);
}
";

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) uv: vec2f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) uv: vec2f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position, uv);
}

@fragment fn cut(in: Varying) {
    if !is_solid(in.uv) {
        discard;
    }
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    if !is_solid(in.uv) {
        discard;
    }
    let normal = normalize(cross(down, across));
    let sun = abs(dot(normal, normalize(vec3f(-0.7, 1.0, 0.25))));
    let lit = shadow_visibility(in.world, normal, across, down);
    let albedo = select(vec3f(0.9, 0.85, 0.7), vec3f(0.4, 0.6, 0.3), in.world.y > 1.0);
    return vec4f(albedo * (0.2 + 0.8 * sun * lit), 1.0);
}";

/// Centre and half side of the card.
pub const CARD: (Vec3, f32) = (Vec3::new(0.0, 1.5, 0.0), 2.0);
/// Discs of the mask along a side, and texels of one.
const DISCS: u32 = 4;
const DISC: u32 = 32;

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-5.0, 6.0, 9.0), Vec3::new(0.0, 0.5, 0.0), Vec3::Y)
}

/// A floor, then the card: places and texture coordinates. All of the floor is in the mask's solid corner.
fn vertices() -> (Vec<Vec3>, Vec<Vec2>, Vec<u32>) {
    let corners = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let quad = |centre: Vec3, half: f32| corners.map(|(x, z)| centre + half * Vec3::new(x, 0.0, z));
    let positions = [quad(Vec3::ZERO, 6.0), quad(CARD.0, CARD.1)].concat();
    let card = corners.map(|(x, z)| Vec2::new(0.5 + 0.5 * x, 0.5 + 0.5 * z));
    let indices = [0, 2, 1, 0, 3, 2].into_iter().flat_map(|i| [i, i + 4]);
    let mut indices: Vec<u32> = indices.collect();
    indices.sort_by_key(|i| i / 4);
    (positions, [[Vec2::ZERO; 4], card].concat(), indices)
}

/// One byte a texel: 0 within the discs.
fn mask(device: &wgpu::Device, queue: &wgpu::Queue) -> wgpu::Texture {
    let side = DISCS * DISC;
    let texel = |i: u32| {
        let from = |k: u32| (k % DISC) as f32 + 0.5 - 0.5 * DISC as f32;
        let hole = from(i % side).hypot(from(i / side)) < 0.35 * DISC as f32;
        if hole { 0 } else { u8::MAX }
    };
    let bytes: Vec<u8> = (0..side * side).map(texel).collect();
    common::texture(device, queue, side, wgpu::TextureFormat::R8Unorm, &bytes)
}

/// The picture, rows of RGBA.
pub fn run(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    spec: &str,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let ([positions, uvs, indices], triangles) = buffers(device);
    let mask = mask(device, queue);
    let (holes, cut) = common::mask_group(device, &mask, &uvs);

    let technique = technique::parse(spec)?;
    let mut shadows = ShadowMap::new(device, technique.as_ref(), Size::square(1024))?;
    let view = sun(&shadows)?;

    let source = shadows.wgsl(1).after(&format!("{MASK}{SHADER}"));
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let groups = [Some(&matrices), Some(shadows.layout()), Some(&holes)];
    let cast = common::pipeline_of_uvs(device, &module, &[Some(&matrices), None, Some(&holes)], "cut", false);
    let receive = common::pipeline_of_uvs(device, &module, &groups, "fragment", true);
    let from_camera = common::uniform(device, &matrices, camera());
    let draw = |pass: &mut wgpu::RenderPass<'_>| {
        pass.set_vertex_buffer(0, positions.slice(..));
        pass.set_vertex_buffer(1, uvs.slice(..));
        pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.draw_indexed(0..3 * triangles, 0, 0..1);
    };

    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.prepare(queue, &[view])?;
    if shadows.description().storage == CasterStorage::Depth {
        shadows.encode(&mut encoder, |pass| {
            let matrix = common::uniform(device, &matrices, pass.view().clip_from_world);
            pass.set_pipeline(&cast);
            pass.set_bind_group(0, &matrix, &[]);
            pass.set_bind_group(2, &cut, &[]);
            draw(pass);
        })?;
    } else {
        // Made once. It has groups 0 and 1 to itself: whatever the mask needs is bound from group 2 on.
        let mesh = CasterMesh::new(device, &positions, &indices, 0..triangles, Mat4::IDENTITY)?;
        let with_holes = shadows.cutout_caster(device, &format!("{MASK}{COVERS}"), &[&holes])?;
        shadows.encode(&mut encoder, |pass| {
            pass.draw_mesh(&mesh, ..2);
            if let Some(with_holes) = &with_holes {
                pass.set_bind_group(2, &cut, &[]);
                pass.draw_cutout(&mesh, 2.., with_holes);
            }
        })?;
    }

    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        pass.set_bind_group(2, &cut, &[]);
        draw(pass);
    }))
}

/// Positions, texture coordinates and indices for vertex stages and for casters that read them, and the number of
/// triangles.
fn buffers(device: &wgpu::Device) -> ([wgpu::Buffer; 3], u32) {
    use wgpu::BufferUsages as Usage;
    let (positions, uvs, indices) = vertices();
    let vertex = Usage::STORAGE | Usage::VERTEX;
    let buffers = [
        common::buffer(device, bytemuck::cast_slice(&positions), vertex),
        common::buffer(device, bytemuck::cast_slice(&uvs), vertex),
        common::buffer(device, bytemuck::cast_slice(&indices), Usage::INDEX | Usage::STORAGE),
    ];
    (buffers, indices.len() as u32 / 3)
}

/// The sun's view of the whole scene.
fn sun(shadows: &ShadowMap) -> Result<View, LightError> {
    let scene = Bounds { min: Vec3::new(-6.0, 0.0, -6.0), max: Vec3::new(6.0, 1.5, 6.0) };
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
    let spec = std::env::args().nth(2).unwrap_or_else(|| "pcf".into());
    common::save("cutouts", &run(&device, &queue, &spec)?)
}
