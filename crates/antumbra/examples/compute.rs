//! Visibility asked by a compute shader, where there is no surface: fog above a yard, seen from the sky.
//!
//! `cargo run --release -p antumbra --example compute -- fog.png`

mod common;

use antumbra::{Bounds, Evsm, Fit, Light, ShadowMap, Size};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, Vec4};

/// Light that the fog above each pixel scatters. It has no surface: its normal is the direction towards the
/// light, which no bias moves anything along, and its position does not change from pixel to pixel.
const SHADER: &str = "
const to_sun = vec3f(-0.7, 1.0, 0.25);
const steps = 32u;
@group(0) @binding(0) var<storage, read_write> picture: array<u32>;

@compute @workgroup_size(8, 8) fn compute(@builtin(global_invocation_id) id: vec3u) {
    let ground = vec2f(16.0, 12.0) * (vec2f(id.xy) / vec2f(640.0, 480.0) - 0.5);
    var light = 0.0;
    for (var i = 0u; i < steps; i += 1u) {
        let position = vec3f(ground.x, 2.0 * (f32(i) + 0.5) / f32(steps), ground.y);
        light += shadow_visibility(position, normalize(to_sun), vec3f(0.0), vec3f(0.0));
    }
    let fog = light / f32(steps);
    picture[id.y * 640u + id.x] = pack4x8unorm(vec4f(mix(vec3f(0.1, 0.1, 0.2), vec3f(0.9, 0.85, 0.7), fog), 1.0));
}";

const CASTER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
@vertex fn vertex(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return clip_from_world * vec4f(position, 1.0);
}";

/// World to clip space: from straight above, without perspective.
pub fn camera() -> Mat4 {
    let rows = [Vec4::X / 8.0, Vec4::NEG_Z / 6.0, Vec4::NEG_Y / 10.0 + Vec4::W, Vec4::W];
    Mat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
}

/// The picture, rows of RGBA.
pub fn run(device: &wgpu::Device, queue: &wgpu::Queue) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mesh = Mesh::boxes(
        device,
        &[
            (Vec3::new(-3.0, 1.0, 1.0), Vec3::new(0.5, 1.0, 0.5)),
            (Vec3::new(1.5, 1.9, -1.0), Vec3::new(1.5, 0.1, 1.5)),
        ],
    );
    let scene = Bounds { min: Vec3::new(-8.0, 0.0, -6.0), max: Vec3::new(8.0, 2.0, 6.0) };
    let mut shadows = ShadowMap::new(device, &Evsm::default(), Size::square(512))?;
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    let view = sun.view(&Fit {
        casters: scene,
        receivers: scene.corners().collect(),
        size: shadows.size(),
        margin_texels: shadows.margin_texels(),
        lean: shadows.leans(),
    })?;

    let matrices = common::uniform_layout(device);
    let caster = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(CASTER.into()),
    });
    let cast = common::pipeline(device, &caster, &[Some(&matrices)], "vertex", None);
    let from_sun = common::uniform(device, &matrices, view.clip_from_world);
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.prepare(queue, &[view])?;
    shadows.encode(&mut encoder, |pass| {
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_sun, &[]);
        mesh.draw(pass);
    })?;

    // The map's layout and bind group are visible to compute shaders too.
    let picture = common::storage(device, u64::from(4 * WIDTH * HEIGHT));
    let (layout, own) = common::storage_group(device, &[&picture]);
    let fog = common::compute_pipeline(
        device,
        shadows.wgsl(1).after(SHADER),
        &[Some(&layout), Some(shadows.layout())],
    );
    {
        let mut pass = encoder.begin_compute_pass(&Default::default());
        pass.set_pipeline(&fog);
        pass.set_bind_group(0, &own, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        pass.dispatch_workgroups(WIDTH / 8, HEIGHT / 8, 1);
    }
    Ok(common::read(device, queue, encoder, &picture))
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("compute", &run(&device, &queue)?)
}
