//! What the page does.

use crate::common::{self, COLOR, HEIGHT, Mesh, WIDTH};
use antumbra::{Bounds, Capabilities, Evsm, Fit, Light, ShadowMap, Size};
use glam::{Mat4, Vec3, camera::rh};
use std::error::Error;
use wasm_bindgen::JsCast;

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

/// Shows a sentence below the canvas.
pub(crate) fn say(sentence: &str) {
    let document = web_sys::window().and_then(|window| window.document());
    if let Some(place) = document.and_then(|document| document.get_element_by_id("says")) {
        place.set_text_content(Some(sentence));
    }
}

/// Draws one picture.
pub(crate) async fn run() -> Result<(), Box<dyn Error>> {
    let document = web_sys::window().and_then(|window| window.document()).ok_or("no document")?;
    let canvas = document.get_element_by_id("canvas").ok_or("no element with the id canvas")?;
    let canvas = canvas.dyn_into::<web_sys::HtmlCanvasElement>().map_err(|_| "#canvas is no canvas")?;

    // No call blocks: adapter, device and shadow map are waited for.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::BROWSER_WEBGPU,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let surface = instance.create_surface(wgpu::SurfaceTarget::Canvas(canvas))?;
    let wanted = wgpu::RequestAdapterOptions { compatible_surface: Some(&surface), ..Default::default() };
    let adapter = instance.request_adapter(&wanted).await?;
    let required_features = adapter.features() & Capabilities::OPTIONAL_FEATURES;
    let wanted = wgpu::DeviceDescriptor { required_features, ..Default::default() };
    let (device, queue) = adapter.request_device(&wanted).await?;
    let config = surface.get_default_config(&adapter, WIDTH, HEIGHT).ok_or("no surface for this adapter")?;
    surface.configure(&device, &wgpu::SurfaceConfiguration { format: COLOR, ..config });

    let mut shadows = ShadowMap::new_async(&device, &Evsm::default(), Size::square(1024)).await?;
    draw(&device, &queue, &surface, &mut shadows)?;
    say(&shadows.explain().join("; "));
    Ok(())
}

fn draw(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    surface: &wgpu::Surface<'_>,
    shadows: &mut ShadowMap,
) -> Result<(), Box<dyn Error>> {
    let mesh = Mesh::boxes(
        device,
        &[
            (Vec3::new(0.0, -0.1, 0.0), Vec3::new(6.0, 0.1, 6.0)),
            (Vec3::new(-2.0, 0.5, 1.0), Vec3::splat(0.5)),
            (Vec3::new(0.5, 1.0, 0.0), Vec3::new(0.4, 1.0, 0.4)),
            (Vec3::new(2.5, 1.2, 2.0), Vec3::new(0.8, 0.1, 0.8)),
        ],
    );
    let scene = Bounds { min: Vec3::new(-6.0, -0.2, -6.0), max: Vec3::new(6.0, 2.0, 6.0) };
    let sun = Light::Directional { direction: Vec3::new(0.7, -1.0, -0.25) };
    let (size, margin_texels, lean) = (shadows.size(), shadows.margin_texels(), shadows.leans());
    let view =
        sun.view(&Fit { casters: scene, receivers: scene.corners().collect(), size, margin_texels, lean })?;
    let camera = rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 100.0)
        * rh::view::look_at_mat4(Vec3::new(-5.0, 6.0, 9.0), Vec3::new(0.0, 0.5, 0.0), Vec3::Y);

    let source = shadows.wgsl(1).after(SHADER);
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
    let matrices = common::uniform_layout(device);
    let cast = common::pipeline(device, &module, &[Some(&matrices)], "vertex", None);
    let groups = [Some(&matrices), Some(shadows.layout())];
    let receive = common::pipeline(device, &module, &groups, "vertex", Some("fragment"));
    let group = |matrix: Mat4| common::uniform(device, &matrices, matrix);
    let [from_sun, from_camera] = [view.clip_from_world, camera].map(group);

    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.prepare(queue, &[view])?;
    shadows.encode(&mut encoder, |pass| {
        pass.set_pipeline(&cast);
        pass.set_bind_group(0, &from_sun, &[]);
        mesh.draw(pass);
    })?;
    let wgpu::CurrentSurfaceTexture::Success(frame) = surface.get_current_texture() else {
        return Err("the canvas has no texture to draw into".into());
    };
    common::draw(device, &mut encoder, &frame.texture.create_view(&Default::default()), |pass| {
        pass.set_pipeline(&receive);
        pass.set_bind_group(0, &from_camera, &[]);
        pass.set_bind_group(1, shadows.bind_group(), &[]);
        mesh.draw(pass);
    });
    queue.submit([encoder.finish()]);
    queue.present(frame);
    Ok(())
}
