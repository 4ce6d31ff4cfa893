//! Bring your own depth: the renderer draws the spot light's depth in a pass of its own, antumbra
//! only filters it and looks it up.
//!
//! `cargo run --release -p antumbra --example own_depth -- lamp.png`

mod common;

use antumbra::{Bounds, Fit, Light, NoProbe, ShadowMap, Size, Vsm};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
const lamp = vec3f(3.0, 5.0, 1.0);
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position, normal);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let to_lamp = normalize(lamp - in.world);
    let cone = smoothstep(cos(0.62), cos(0.55), dot(to_lamp, normalize(lamp)));
    let facing = max(dot(in.normal, to_lamp), 0.0) * cone;
    let lit = shadow_visibility(in.world, in.normal, dpdx(in.world), dpdy(in.world));
    return vec4f(vec3f(0.8, 0.85, 0.9) * 0.15 + vec3f(0.8, 0.7, 0.5) * facing * lit, 1.0);
}";

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-3.0, 6.0, 8.0), Vec3::ZERO, Vec3::Y)
}

/// The picture, rows of RGBA.
pub fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mesh = Mesh::boxes(
        device,
        &[
            (Vec3::new(0.0, -0.1, 0.0), Vec3::new(6.0, 0.1, 6.0)),
            (Vec3::new(0.0, 0.7, 0.0), Vec3::new(0.25, 0.7, 0.25)),
            (Vec3::new(1.2, 0.4, 1.6), Vec3::splat(0.4)),
        ],
    );

    // The renderer's own depth texture; all it needs is TEXTURE_BINDING.
    let depth = common::target(device, 512, 512, common::DEPTH);
    let mut shadows = ShadowMap::from_depth(device, &Vsm::default(), &depth, Size::square(512))?;
    let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 1.4, 6.0) };
    let lamp = Light::Spot {
        position: Vec3::new(3.0, 5.0, 1.0),
        direction: Vec3::new(-3.0, -5.0, -1.0),
        outer_angle: 0.62,
    };
    let view = lamp.view(&Fit {
        casters: scene,
        receivers: scene.corners().collect(),
        size: shadows.size(),
        margin_texels: shadows.margin_texels(),
        lean: shadows.leans(),
    })?;

    let source = shadows.wgsl(1).after(SHADER);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let cast = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let groups = [Some(&matrices), Some(shadows.layout())];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let from_lamp = common::uniform(device, &matrices, view.clip_from_world);
    let from_camera = common::uniform(device, &matrices, camera());

    // The renderer's own depth pass, wherever it is in her frame.
    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let target = depth.create_view(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(common::depth_attachment(&target)),
            ..Default::default()
        });
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_lamp, &[]);
        mesh.draw(&mut pass);
    }
    // Afterwards, instead of `encode`: a probe could time the passes.
    shadows.prepare(queue, &[view])?;
    shadows.encode_filter(&mut encoder, &mut NoProbe);

    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        mesh.draw(pass);
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("own_depth", &run(&device, &queue)?)
}
