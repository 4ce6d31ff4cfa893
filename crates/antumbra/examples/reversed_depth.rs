//! Bring a depth as many renderers keep it: reversed, its far plane infinite, with a projection of the renderer's
//! own, in one layer of an array that holds other lights' too.
//!
//! `cargo run --release -p antumbra --example reversed_depth -- reversed.png`

mod common;

use antumbra::{Bounds, Depth, NoProbe, Pcf, ShadowMap, Size, View};
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

/// Texels along a side of each of the renderer's shadow maps.
const SIDE: u32 = 512;
/// Number of the renderer's shadow maps, and which one is the lamp's.
const LAYERS: [u32; 2] = [4, 2];

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
    let [count, layer] = LAYERS;
    let depths = depths(device, count);

    // The renderer's projection of its lamp: z is 1 at 0.5 units and falls to 0 for ever.
    let lamp = rh::proj::directx::perspective_infinite_reverse(1.3, 1.0, 0.5)
        * rh::view::look_at_mat4(Vec3::new(3.0, 5.0, 1.0), Vec3::ZERO, Vec3::Y);
    let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 1.4, 6.0) };
    let view = View::of_matrix(lamp, &scene, Size::square(SIDE))?;
    let depth = Depth::new(&depths).layers(layer..layer + 1).reversed();
    let mut shadows = ShadowMap::from_depth(device, &Pcf::default(), depth, Size::square(SIDE))?;

    let source = shadows.wgsl(1).after(SHADER);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let cast = caster(device, &module, &matrices);
    let groups = [Some(&matrices), Some(shadows.layout())];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let from_lamp = common::uniform(device, &matrices, lamp);
    let from_camera = common::uniform(device, &matrices, camera());

    let mut encoder = device.create_command_encoder(&Default::default());
    {
        let target = one_layer(&depths, layer);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &target,
                // Nothing is infinitely far away.
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_lamp, &[]);
        mesh.draw(&mut pass);
    }
    shadows.prepare(queue, &[view])?;
    shadows.encode_filter(&mut encoder, &mut NoProbe);

    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        mesh.draw(pass);
    }))
}

/// The renderer's shadow maps.
fn depths(device: &wgpu::Device, layers: u32) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some("depths of all lights"),
        size: wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: layers },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: common::DEPTH,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    })
}

/// One of them.
fn one_layer(depths: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    depths.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

/// The renderer's pipeline for casters: the greater depth is the nearer.
fn caster(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    matrices: &wgpu::BindGroupLayout,
) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        bind_group_layouts: &[Some(matrices)],
        ..Default::default()
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: None,
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 24,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3],
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: common::DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    common::save("reversed_depth", &run(&device, &queue)?)
}
