//! `shadow_visibility` inside a larger shader: a long street under three cascades, fog, a specular
//! highlight; any two techniques side by side, whatever their casters leave.
//!
//! `cargo run --release -p antumbra --example own_shader -- street.png hard csm.terms=8`

mod common;

use antumbra::{
    Bounds, CASTER_WGSL, CameraFit, Capabilities, Cascades, CasterMesh, Light, Options, ShadowMap, Size,
    technique::{self, CasterStorage},
};
use common::{HEIGHT, Mesh, WIDTH};
use glam::{Mat4, Vec3, camera::rh};

/// The caller's own: it may branch around the lookup, since that samples explicit levels only.
/// Derivatives are taken before, where control flow is uniform.
const SHADER: &str = "
struct Camera { clip_from_world: mat4x4f }
@group(0) @binding(0) var<uniform> camera: Camera;
const eye = vec3f(0.0, 4.0, 12.0);
const towards_sun = vec3f(0.64, 0.64, 0.43);

struct Varying { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }

@vertex fn vertex(@location(0) position: vec3f, @location(1) normal: vec3f) -> Varying {
    return Varying(camera.clip_from_world * vec4f(position, 1.0), position, normal);
}

@fragment fn fragment(in: Varying) -> @location(0) vec4f {
    let across = dpdx(in.world);
    let down = dpdy(in.world);
    let tile = floor(in.world + 0.01);
    let checker = abs(tile.x + tile.y + tile.z) % 2.0;
    let albedo = mix(vec3f(0.55, 0.5, 0.45), vec3f(0.75, 0.72, 0.68), checker);
    let facing = dot(in.normal, towards_sun);
    let to_eye = normalize(eye - in.world);
    var light = mix(vec3f(0.1, 0.1, 0.12), vec3f(0.2, 0.23, 0.3), 0.5 + 0.5 * in.normal.y);
    if facing > 0.0 {
        let half_way = normalize(to_eye + towards_sun);
        let shine = 0.3 * pow(max(dot(in.normal, half_way), 0.0), 40.0);
        light += (facing + shine) * vec3f(1.0, 0.95, 0.8) * shadow_visibility(in.world, in.normal, across, down);
    }
    let fog = 1.0 - exp(-0.008 * distance(eye, in.world));
    return vec4f(mix(albedo * light, vec3f(0.55, 0.65, 0.8), fog), 1.0);
}";

/// Casters in front of a view's near plane must still cast: by depth clamping, or moved onto it.
const CASTER: &str = "
struct View { clip_from_world: mat4x4f }
@group(0) @binding(0) var<uniform> view: View;
@vertex fn clamped(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return view.clip_from_world * vec4f(position, 1.0);
}
@vertex fn pancaked(@location(0) position: vec3f) -> @builtin(position) vec4f {
    return caster_pancaked(view.clip_from_world, position);
}
";

/// World to clip space.
pub fn camera() -> Mat4 {
    rh::proj::directx::perspective(0.8, WIDTH as f32 / HEIGHT as f32, 0.1, 200.0)
        * rh::view::look_at_mat4(Vec3::new(0.0, 4.0, 12.0), Vec3::new(0.0, 1.0, 0.0), Vec3::Y)
}

/// Ground, and two rows of towers that throw shadows to the left, one in each half of the picture.
fn street() -> Vec<(Vec3, Vec3)> {
    let tower = |i: i32| {
        let (row, height) = (i % 2, 1.5 + 0.5 * (i / 2 % 3) as f32);
        let x = if row == 0 { -1.2 } else { 4.0 };
        (Vec3::new(x, height, 4.0 - 5.0 * (i / 2) as f32), Vec3::new(0.5, height, 0.5))
    };
    let ground = (Vec3::new(0.0, -0.5, -30.0), Vec3::new(20.0, 0.5, 50.0));
    (0..28).map(tower).chain([ground]).collect()
}

/// The picture, rows of RGBA: the first technique on the left, the second on the right.
pub fn run(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    specs: [&str; 2],
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let mesh = Mesh::boxes(device, &street());
    let sun = Light::Directional { direction: -Vec3::new(0.64, 0.64, 0.43) };
    let uniforms = common::uniform_layout(device);
    let caster = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: None,
        source: wgpu::ShaderSource::Wgsl(format!("{CASTER}{CASTER_WGSL}").into()),
    });
    let entry = if Capabilities::of(device).clamps_depth() { "clamped" } else { "pancaked" };
    let cast = common::pipeline(device, &caster, &[Some(&uniforms)], entry, None);

    let [positions, indices] = mesh.storage(device);
    let triangles = CasterMesh::new(device, &positions, &indices, 0..mesh.triangles(), Mat4::IDENTITY)?;

    let mut encoder = device.create_command_encoder(&Default::default());
    let mut halves = Vec::new();
    for spec in specs {
        let technique = technique::parse(spec)?;
        let mut shadows =
            ShadowMap::new(device, technique.as_ref(), Options::from(Size::square(512)).views(3))?;
        shadows.prepare(queue, &sun.views(&fit(&shadows), Cascades::new(3))?)?;
        if shadows.description().storage == CasterStorage::Depth {
            // Of the views of `prepare`, or of several for each (`stratified`).
            let casts = shadows.caster_views().iter();
            let matrices: Vec<_> =
                casts.map(|v| common::uniform(device, &uniforms, v.clip_from_world)).collect();
            shadows.encode(&mut encoder, |pass| {
                let matrix = &matrices[pass.index()];
                pass.set_pipeline(&cast);
                pass.set_bind_group(0, matrix, &[]);
                mesh.draw(pass);
            })?;
        } else {
            shadows.encode(&mut encoder, |pass| pass.draw_mesh(&triangles, ..))?;
        }

        let source = shadows.wgsl(1).after(SHADER);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let groups = [Some(&uniforms), Some(shadows.layout())];
        halves.push((common::pipeline(device, &module, &groups, "vertex", Some("fragment")), shadows));
    }
    let from_camera = common::uniform(device, &uniforms, camera());
    Ok(common::render(device, queue, encoder, |pass| {
        pass.set_bind_group(0, &from_camera, &[]);
        for (half, (receive, shadows)) in (0..).zip(&halves) {
            pass.set_pipeline(receive);
            pass.set_bind_group(1, shadows.bind_group(), &[]);
            pass.set_scissor_rect(half * WIDTH / 2, 0, WIDTH / 2, HEIGHT);
            mesh.draw(pass);
        }
    }))
}

/// What the light's views are fitted to.
fn fit(shadows: &ShadowMap) -> CameraFit {
    CameraFit {
        camera: camera(),
        scene: Bounds { min: Vec3::new(-20.0, -1.0, -80.0), max: Vec3::new(20.0, 5.0, 20.0) },
        size: shadows.size(),
        margin_texels: shadows.margin_texels(),
        lean: shadows.leans(),
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (device, queue) = common::device();
    let spec = |i, usual: &str| std::env::args().nth(i).unwrap_or_else(|| usual.to_string());
    let (left, right) = (spec(2, "hard"), spec(3, "csm"));
    common::save("own_shader", &run(&device, &queue, [&left, &right])?)
}
