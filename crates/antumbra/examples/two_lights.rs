//! Three shadow maps in one shader and one bind group: a sun with PCF, and two lamps, both with VSM, next to the
//! renderer's own camera.
//!
//! `cargo run --release -p antumbra --example two_lights -- lights.png`

mod common;

use antumbra::{Bounds, CasterPass, Fit, Light, Pcf, Pipelines, ShadowMap, Size, Technique, View, Vsm};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
const red = vec3f(3.0, 4.0, 1.0);
const blue = vec3f(-3.0, 4.0, 2.0);
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position, normal);
}

fn cone(lamp: vec3f, in: Varying) -> f32 {
    let to_lamp = normalize(lamp - in.world);
    return smoothstep(cos(0.7), cos(0.6), dot(to_lamp, normalize(lamp))) * max(dot(in.normal, to_lamp), 0.0);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let p = in.world;
    let n = in.normal;
    let dx = dpdx(p);
    let dy = dpdy(p);
    var light = vec3f(0.1);
    light += vec3f(0.4) * max(dot(n, normalize(vec3f(0.3, 1.0, 0.9))), 0.0) * shadow_visibility(p, n, dx, dy);
    light += vec3f(0.5, 0.15, 0.1) * cone(red, in) * red_visibility(p, n, dx, dy);
    light += vec3f(0.1, 0.15, 0.5) * cone(blue, in) * blue_visibility(p, n, dx, dy);
    return vec4f(light, 1.0);
}";

/// Direction in which the sun shines.
pub const SUN: Vec3 = Vec3::new(-0.3, -1.0, -0.9);
/// Places of the red and the blue lamp.
pub const LAMPS: [Vec3; 2] = [Vec3::new(3.0, 4.0, 1.0), Vec3::new(-3.0, 4.0, 2.0)];

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 7.0, 8.0), Vec3::ZERO, Vec3::Y)
}

/// A light's map with its view, and the pass that draws depth into it.
struct Lit {
    shadows: ShadowMap,
    view: View,
}

impl Lit {
    fn new(
        device: &wgpu::Device,
        technique: &dyn Technique,
        light: Light,
        pipelines: &Pipelines,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let options = antumbra::Options::from(Size::square(512)).pipelines(pipelines);
        let shadows = ShadowMap::new(device, technique, options)?;
        let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 1.4, 6.0) };
        let view = light.view(&Fit {
            casters: scene,
            receivers: scene.corners().collect(),
            size: shadows.size(),
            margin_texels: shadows.margin_texels(),
            lean: shadows.leans(),
        })?;
        Ok(Self { shadows, view })
    }
}

/// The picture, rows of RGBA.
pub fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mesh = Mesh::boxes(
        device,
        &[
            (Vec3::new(0.0, -0.1, 0.0), Vec3::new(6.0, 0.1, 6.0)),
            (Vec3::new(0.0, 0.7, 0.0), Vec3::new(0.25, 0.7, 0.25)),
        ],
    );
    let pipelines = Pipelines::new(device);
    let lamp = |position: Vec3| Light::Spot { position, direction: -position, outer_angle: 0.7 };
    let mut lights = [
        Lit::new(device, &Pcf::default(), Light::Directional { direction: SUN }, &pipelines)?,
        Lit::new(device, &Vsm::default(), lamp(LAMPS[0]), &pipelines)?,
        Lit::new(device, &Vsm::default(), lamp(LAMPS[1]), &pipelines)?,
    ];

    // All three in the renderer's group 1: each takes as many bindings as it has, behind the one before.
    let stages = wgpu::ShaderStages::FRAGMENT;
    let (mut layout, mut entries, mut shader) = (Vec::new(), Vec::new(), SHADER.to_string());
    for (name, lit) in ["shadow", "red", "blue"].into_iter().zip(&lights) {
        let first = layout.len() as u32;
        layout.extend(lit.shadows.layout_entries(first, stages));
        entries.extend(lit.shadows.bind_group_entries(first));
        shader += &lit.shadows.wgsl_at(1, first).named(name)?.text();
    }
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("lights"),
        entries: &layout,
    });
    let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("lights"),
        layout: &layout,
        entries: &entries,
    });
    let source = wgpu::ShaderSource::Wgsl(shader.into());
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let cast = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let receive =
        common::pipeline(device, &module, &[Some(&matrices), Some(&layout)], "vertex", Some("fragment"));
    let from_camera = common::uniform(device, &matrices, camera());

    let mut encoder = device.create_command_encoder(&Default::default());
    for Lit { shadows, view } in &mut lights {
        let from_light = common::uniform(device, &matrices, view.clip_from_world);
        shadows.prepare(queue, &[*view])?;
        shadows.encode(&mut encoder, |pass: &mut CasterPass<'_>| {
            pass.set_pipeline(&cast);
            pass.set_bind_group(0, &from_light, &[]);
            mesh.draw(pass);
        })?;
    }
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, &group, &[]);
        mesh.draw(pass);
    }))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("two_lights", &run(&device, &queue)?)
}
