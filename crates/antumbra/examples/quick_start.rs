//! The code of the README, run: a sun with four cascades over a field of columns.
//!
//! `cargo run --release -p antumbra --example quick_start -- field.png`

mod common;

use antumbra::{Bounds, CameraFit, Cascades, CasterPass, Esm, Light, Options, ShadowMap, Size, glam, wgpu};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

// README
/// Once: a map of any technique, with room for four views, and your shader with what it calls behind it.
fn set_up(
    device: &wgpu::Device,
    my_shader: &str,
) -> Result<(ShadowMap, wgpu::ShaderModule), antumbra::Unsupported> {
    let shadows = ShadowMap::new(device, &Esm::default(), Options::from(Size::square(1024)).views(4))?;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: shadows.wgsl(1).after(my_shader), // calls shadow_visibility(…), which is bound in group 1
    });
    Ok((shadows, module))
}

/// Each frame: where the sun looks from, and what casts. Then, in the pass that shades,
/// `pass.set_bind_group(1, shadows.bind_group(), &[])`.
fn cast(
    shadows: &mut ShadowMap,
    queue: &wgpu::Queue,
    encoder: &mut wgpu::CommandEncoder,
    (camera, scene): (Mat4, Bounds),
    draw_depth: impl FnMut(&mut CasterPass<'_>),
) -> Result<(), Box<dyn std::error::Error>> {
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    let (size, margin_texels, lean) = (shadows.size(), shadows.margin_texels(), shadows.leans());
    let views = sun.views(&CameraFit { camera, scene, size, margin_texels, lean }, Cascades::new(4))?;
    shadows.prepare(queue, &views)?;
    shadows.encode(encoder, draw_depth)?; // your own depth pipeline, with pass.view().clip_from_world
    Ok(())
}
// README

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position, normal);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let sun = max(dot(in.normal, normalize(vec3f(-0.7, 1.0, 0.25))), 0.0);
    let lit = shadow_visibility(in.world, in.normal, dpdx(in.world), dpdy(in.world));
    return vec4f(vec3f(0.9, 0.85, 0.7) * (0.2 + 0.05 * in.normal.z + 0.8 * sun * lit), 1.0);
}";

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 200.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 6.0, 14.0), Vec3::new(0.0, 1.0, 0.0), Vec3::Y)
}

/// The picture, rows of RGBA.
pub fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let column = |i: i32| {
        let place = Vec3::new(4.0 * (i % 5 - 2) as f32, 1.0, -6.0 * (i / 5) as f32);
        (place, Vec3::new(0.4, 1.0, 0.4))
    };
    let ground = (Vec3::new(0.0, -0.5, -30.0), Vec3::new(30.0, 0.5, 50.0));
    let boxes: Vec<_> = (0..50).map(column).chain([ground]).collect();
    let mesh = Mesh::boxes(device, &boxes);
    let scene = Bounds { min: Vec3::new(-30.0, -1.0, -80.0), max: Vec3::new(30.0, 2.0, 20.0) };

    let (mut shadows, module) = set_up(device, SHADER)?;
    let matrices = common::uniform_layout(device);
    let depth = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let groups = [Some(&matrices), Some(shadows.layout())];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let from_camera = common::uniform(device, &matrices, camera());

    let mut encoder = device.create_command_encoder(&Default::default());
    cast(&mut shadows, queue, &mut encoder, (camera(), scene), |pass| {
        let matrix = common::uniform(device, &matrices, pass.view().clip_from_world);
        pass.set_pipeline(&depth);
        pass.set_bind_group(0, &matrix, &[]);
        mesh.draw(pass);
    })?;
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        mesh.draw(pass);
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("quick_start", &run(&device, &queue)?)
}
