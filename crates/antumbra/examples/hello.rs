//! The smallest integration: boxes on a floor, one sun, one shadow map.
//!
//! `cargo run --release -p antumbra --example hello -- hello.png`
//!
//! Numbered comments mark what antumbra asks for; `common` is any wgpu program.

mod common;

use antumbra::{Bounds, Esm, Fit, Light, ShadowMap, Size};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

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
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-5.0, 6.0, 9.0), Vec3::new(0.0, 0.5, 0.0), Vec3::Y)
}

/// The picture, rows of RGBA.
pub fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mesh = Mesh::boxes(
        device,
        &[
            (Vec3::new(0.0, -0.1, 0.0), Vec3::new(6.0, 0.1, 6.0)),
            (Vec3::new(-2.0, 0.5, 1.0), Vec3::splat(0.5)),
            (Vec3::new(0.5, 1.0, 0.0), Vec3::new(0.4, 1.0, 0.4)),
            (Vec3::new(2.5, 1.2, 2.0), Vec3::new(0.8, 0.1, 0.8)),
        ],
    );

    // 1. A shadow map of any technique, and where its light looks from.
    let mut shadows = ShadowMap::new(device, &Esm::default(), Size::square(1024))?;
    let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 2.0, 6.0) };
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    let view = sun.view(&Fit {
        casters: scene,
        receivers: scene.corners().collect(),
        size: shadows.size(),
        margin_texels: shadows.margin_texels(),
        lean: shadows.leans(),
    })?;

    // 2. Your shader, then what it calls: `shadow_visibility`, bound in group 1.
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: shadows.wgsl(1).after(SHADER),
    });
    let matrices = common::uniform_layout(device);
    let cast = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let groups = [Some(&matrices), Some(shadows.layout())];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let from_sun = common::uniform(device, &matrices, view.clip_from_world);
    let from_camera = common::uniform(device, &matrices, camera());

    // 3. Each frame: the views, then the casters' depth as each view sees it.
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.prepare(queue, &[view])?;
    shadows.encode(&mut encoder, |pass| {
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_sun, &[]);
        mesh.draw(pass);
    })?;

    // 4. Receivers bind one group.
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        mesh.draw(pass);
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("hello", &run(&device, &queue)?)
}
