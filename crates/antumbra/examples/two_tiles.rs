//! Two lamps in one shadow map: each in a tile of its only layer, a large one and a small one, told apart by number.
//!
//! `cargo run --release -p antumbra --example two_tiles -- tiles.png`

mod common;

use antumbra::{Bounds, CasterPass, Fit, Light, Options, Placed, ShadowMap, Size, Tile, Vsm};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

const SHADER: &str = "
@group(0) @binding(0) var<uniform> clip_from_world: mat4x4f;
const lamps = array(vec3f(3.0, 4.0, 1.0), vec3f(-3.0, 4.0, 2.0));
const colours = array(vec3f(0.6, 0.2, 0.15), vec3f(0.15, 0.2, 0.6));
struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    return Varying(clip_from_world * vec4f(position, 1.0), position, normal);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    var light = vec3f(0.1);
    let dx = dpdx(in.world);
    let dy = dpdy(in.world);
    for (var i = 0u; i < 2u; i += 1u) {
        let to_lamp = normalize(lamps[i] - in.world);
        let cone = smoothstep(cos(0.7), cos(0.6), dot(to_lamp, normalize(lamps[i])));
        let lit = shadow_visibility(i, in.world, in.normal, dx, dy);
        light += colours[i] * cone * max(dot(in.normal, to_lamp), 0.0) * lit;
    }
    return vec4f(light, 1.0);
}";

/// Places of the red and the blue lamp.
pub const LAMPS: [Vec3; 2] = [Vec3::new(3.0, 4.0, 1.0), Vec3::new(-3.0, 4.0, 2.0)];
/// Texels of the layer.
const LAYER: Size = Size { width: 768, height: 512 };
/// Where they lie: the larger one for the lamp that matters more. Vsm has mip levels, so each begins at a multiple of
/// its side.
const TILES: [Tile; 2] = [
    Tile { layer: 0, origin: [0, 0], size: Size::square(512) },
    Tile { layer: 0, origin: [512, 0], size: Size::square(256) },
];

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 7.0, 8.0), Vec3::ZERO, Vec3::Y)
}

/// What a lamp sees of the scene, in its tile.
fn seen(position: Vec3, tile: Tile, margin_texels: f32) -> Result<Placed, antumbra::LightError> {
    let lamp = Light::Spot { position, direction: -position, outer_angle: 0.7 };
    let casters = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 1.4, 6.0) };
    let receivers = casters.corners().collect();
    Ok(lamp.view(&Fit { casters, receivers, size: tile.size, margin_texels, lean: false })?.at(tile))
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
    // Once: room for two views of two lights, in one layer.
    let options = Options::from(LAYER).views(2).lights(2).tiled(1);
    let mut shadows = ShadowMap::new(device, &Vsm::default(), options)?;
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: shadows.wgsl(1).after(SHADER),
    });
    let matrices = common::uniform_layout(device);
    let cast = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let receive = common::pipeline(
        device,
        &module,
        &[Some(&matrices), Some(shadows.layout())],
        "vertex",
        Some("fragment"),
    );
    let from_camera = common::uniform(device, &matrices, camera());

    // Each frame: what each lamp sees, and where it lies, which may be elsewhere in the next.
    let margin_texels = shadows.margin_texels();
    let red = seen(LAMPS[0], TILES[0], margin_texels)?;
    let blue = seen(LAMPS[1], TILES[1], margin_texels)?;
    shadows.prepare_lights(queue, &[&[red], &[blue]])?;
    let from_lamps = [red, blue].map(|lamp| common::uniform(device, &matrices, lamp.view.clip_from_world));
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass: &mut CasterPass<'_>| {
        let lamp = pass.index();
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_lamps[lamp], &[]);
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
    common::save("two_tiles", &run(&device, &queue)?)
}
