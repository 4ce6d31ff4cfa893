//! What the lab draws is what its rays see: triangles, cut-outs, derivatives, shadows.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capabilities, Hard, Parameter, ShadowMap, Size, Stratified, Technique, Unsupported, technique,
    technique::{About, Bias, BiasTerms, Binding, Description, Family},
};
use antumbra_lab::{
    gpu::{Gpu, Wait},
    image::GrayImage,
    specs,
};
use antumbra_scene::{
    AlphaMode, Camera, Image, Instance, Light, Material, Mesh, Projection, Scene, procedural,
};
use antumbra_testing::Trials;
use antumbra_truth::Tracer;
use common::{KERNEL, Picture, score};
use glam::{DMat4, DVec3, Vec2, Vec3, Vec4};

fn main() {
    let mut trials = Trials::default();
    for entry in procedural::all() {
        trials.add(format!("coverage_{}", entry.name), move |gpu| {
            // Twigs and grass are about as small as pixels here: more centres lie on an edge.
            let fine = ["fence", "backyard", "trees", "city"].contains(&entry.name);
            let min = if fine { 0.996 } else { 0.999 };
            sees_what_rays_see(&Picture::new(gpu, &entry.scene(1), [320, 240]), min);
        });
    }
    trials.add("coverage_of_cutouts", |gpu| {
        sees_what_rays_see(&Picture::new(gpu, &checkered(true), [320, 240]), 0.999)
    });
    trials.add("coverage_of_parallel_rays", |gpu| {
        let mut scene = procedural::by_name("spheres").unwrap().scene(1);
        let own = scene.cameras[0];
        // Rolled too, and so near that the plane on which rays begin cuts through the scene.
        let position = own.target + 0.3 * (own.position - own.target);
        let projection = Projection::Orthographic { height: 4.0 };
        scene.cameras[0] = Camera { position, projection, up: Vec3::new(0.4, 1.0, 0.1), ..own };
        sees_what_rays_see(&Picture::new(gpu, &scene, [320, 240]), 0.999);
    });
    trials.add("backs_of_single_sided_walls_are_seen_through", dollhouse);
    trials.add("a_near_surface_is_not_clipped", near_surface);
    trials.add("coverage_notices_another_camera", another_camera);
    trials.add("cutouts_cast_their_holes", holes);
    trials.add("derivatives_are_those_of_the_plane", derivatives);
    trials.add("spot_every_technique_is_near_its_ideal", spot);
    trials.add("stratified_maps_hold_a_finer_map", finer);
    trials.add("refusals_of_the_device_are_errors", refusals);
    trials.run();
}

/// At least that share of pixels shows the same triangle, and every other has a good reason.
fn sees_what_rays_see(shot: &Picture, min: f64) {
    let coverage = shot.coverage();
    // Graphics cards round corners in ways of their own before they snap them.
    let allowed = if shot.gpu.info.device_type == wgpu::DeviceType::Cpu { 0 } else { 2 };
    assert!(coverage.unexplained <= allowed, "{:?}: {coverage:?}", coverage.first_unexplained);
    assert!(coverage.agreement() >= min, "{coverage:?}");
    assert!(coverage.agree > 0);
}

/// A wall that turns its back to the camera, in front of a ground: raster and rays see through it, and it
/// casts its shadow all the same.
fn dollhouse(gpu: &antumbra_testing::Gpu) {
    let mut scene = checkered(true);
    let wall = [(-1.0, 2.0), (-1.0, 0.2), (1.0, 0.2), (1.0, 2.0)].map(|(x, y)| Vec3::new(x, y, 1.0));
    let single = Material { double_sided: false, ..Material::default() };
    scene.materials.push(single);
    // Anticlockwise from behind.
    scene.meshes.push(quad([wall[3], wall[2], wall[1], wall[0]], 2));
    scene.instances.push(Instance::new(2, DMat4::IDENTITY));
    let see = |single_sided| {
        let mut shot =
            Picture::with(gpu, &scene, [320, 240], |geometry| geometry.single_sided = single_sided);
        sees_what_rays_see(&shot, 0.999);
        let hits = Tracer::new(&shot.geometry).unwrap().primary(&shot.rays());
        let wall = shot.geometry.groups.iter().find(|(m, _)| *m == 2).unwrap().1.clone();
        let seen = hits.iter().filter(|hit| wall.contains(&hit.triangle)).count();
        let truth = shot.hard_truth();
        let score = score(&shot.answer(&Hard::default(), 1024, Bias::Auto), &truth).pixel_match;
        assert!(score > 0.98, "pixel match {score}");
        (seen, truth.values.iter().filter(|v| **v < 0.5).count())
    };
    let (both, dark_before) = see(false);
    let (front, dark_behind) = see(true);
    assert!(both > 5000 && front == 0, "{both} and {front} pixels show the wall");
    assert!(
        dark_behind > dark_before,
        "its shadow on the ground comes into sight: {dark_before}, {dark_behind}"
    );
}

/// A millimetre from the ground of a scene that a stray triangle makes kilometres wide.
fn near_surface(gpu: &antumbra_testing::Gpu) {
    let mut scene = checkered(false);
    scene.meshes.push(quad(square(1.0, 0.0, 0.0).map(|p| p + 9000.0 * Vec3::X), 0));
    scene.instances.push(Instance::new(2, DMat4::IDENTITY));
    scene.cameras[0] = Camera {
        position: Vec3::new(0.0, 0.001, 2.5),
        target: Vec3::new(0.0, -0.01, 2.49),
        ..scene.cameras[0]
    };
    let shot = Picture::new(gpu, &scene, [320, 240]);
    sees_what_rays_see(&shot, 0.999);
    let rays = shot.rays();
    let nearest = Tracer::new(&shot.geometry).unwrap().trace(&rays.ray(160.0, 239.5)).position;
    assert!(nearest.distance(rays.eye()) < 0.002, "{nearest} should be close to the eye");
}

/// Half a pixel aside is enough to be noticed.
fn another_camera(gpu: &antumbra_testing::Gpu) {
    let scene = procedural::by_name("contact").unwrap().scene(1);
    let mut shot = Picture::new(gpu, &scene, [320, 240]);
    shot.camera.target.x += 0.01;
    let coverage = shot.coverage();
    assert!(coverage.unexplained > 0 && coverage.agreement() < 0.999, "{coverage:?}");
}

/// A quad through four corners, with texture coordinates 0 to 1.
fn quad(corners: [Vec3; 4], material: usize) -> Mesh {
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    Mesh {
        name: "quad".into(),
        positions: corners.to_vec(),
        normals: vec![normal; 4],
        uvs: vec![Vec2::ZERO, Vec2::Y, Vec2::ONE, Vec2::X],
        colors: vec![Vec4::ONE; 4],
        indices: vec![0, 1, 2, 0, 2, 3],
        material,
    }
}

fn square(half: f32, height: f32, tilt: f32) -> [Vec3; 4] {
    [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)]
        .map(|(x, z)| Vec3::new(x * half, height + tilt * x * half, z * half))
}

fn placed(meshes: Vec<Mesh>, materials: Vec<Material>, images: Vec<Image>) -> Scene {
    Scene {
        name: "quads".into(),
        instances: (0..meshes.len()).map(|mesh| Instance::new(mesh, DMat4::IDENTITY)).collect(),
        meshes,
        materials,
        images,
        cameras: vec![Camera {
            position: Vec3::new(1.5, 4.0, 5.5),
            target: Vec3::new(0.0, 0.3, 0.0),
            up: Vec3::Y,
            projection: Projection::Perspective { fov_y: 0.8 },
        }],
        lights: vec![Light::Directional { direction: Vec3::new(0.3, -1.0, 0.35).normalize() }],
        ..Scene::default()
    }
}

/// A quad over a ground; a chequerboard of 4 by 4 fields is cut out of it, or not.
fn checkered(masked: bool) -> Scene {
    let field = |i: usize| if (i % 4 + i / 4).is_multiple_of(2) { 255 } else { 0 };
    // Eight texels along each field, so that interpolation at the borders does not matter.
    let rgba = (0..32 * 32).flat_map(|i| [255, 255, 255, field(i % 32 / 8 + i / 256 * 4)]).collect();
    let image = Image { name: "fields".into(), width: 32, height: 32, rgba, repeat: [false; 2] };
    let alpha = if masked { AlphaMode::Mask { cutoff: 0.5 } } else { AlphaMode::Opaque };
    let fields = Material { name: "fields".into(), base_color_image: Some(0), alpha, ..Material::default() };
    let meshes = vec![quad(square(3.0, 0.0, 0.0), 0), quad(square(1.0, 1.0, 0.2), 1)];
    placed(meshes, vec![Material::default(), fields], vec![image])
}

fn holes(gpu: &antumbra_testing::Gpu) {
    let mut masked = Picture::new(gpu, &checkered(true), [320, 240]);
    let mut solid = Picture::new(gpu, &checkered(false), [320, 240]);
    let truth = masked.hard_truth();
    let good = score(&masked.answer(&Hard::default(), 1024, Bias::Auto), &truth).pixel_match;
    assert!(good >= 0.98, "pixel match {good}");
    // The shadow of the uncut quad is not that shadow.
    let other = score(&solid.answer(&Hard::default(), 1024, Bias::Auto), &truth).pixel_match;
    assert!(other < 0.98, "pixel match {other}");
    let dark = |shot: &mut Picture| {
        shot.answer(&Hard::default(), 1024, Bias::Auto).values.iter().filter(|v| **v < 0.5).count() as f64
    };
    let share = dark(&mut masked) / dark(&mut solid);
    assert!((0.4..0.6).contains(&share), "half of the fields are open, yet {share} of the shadow is left");
}

/// A technique that answers with a weighted sum of the gradients that it is given.
#[derive(Debug, Clone)]
struct Gradients([f32; 4]);

impl Technique for Gradients {
    fn about(&self) -> About {
        About { name: "gradients", title: "Gradients", family: Family::Comparison, paper: "none" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let wgsl = "fn gradients_visibility(casters: texture_depth_2d_array, uv: vec2f, view: u32, depth: f32, plane: vec2f, ddx: vec2f, ddy: vec2f) -> f32 {
            return dot(vec4f(ddx, ddy), vec4f(gradients_a(), gradients_b(), gradients_c(), gradients_d()));
        }";
        let mut described = Description::new(self.about(), wgsl);
        described.bindings = vec![Binding::Depth];
        described.uniforms = ["a", "b", "c", "d"].into_iter().zip(self.0).collect();
        Ok(described)
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}

/// Receivers are told how far the map's coordinates move to the next pixel, on the plane of the
/// pixel's own surface: compared with rays in f64, on a plane that is tilted to camera and light.
fn derivatives(gpu: &antumbra_testing::Gpu) {
    let corners = square(2.0, 0.5, 0.6);
    let mut shot =
        Picture::new(gpu, &placed(vec![quad(corners, 0)], vec![Material::default()], Vec::new()), [160, 120]);
    let [a, b, c, _] = corners.map(Vec3::as_dvec3);
    let normal = (b - a).cross(c - a);
    let rays = shot.rays();
    let on_plane = |x: f64, y: f64| {
        let ray = rays.ray(x, y);
        ray.origin + ray.direction * (normal.dot(a - ray.origin) / normal.dot(ray.direction))
    };
    let mut worst = |picked: usize, expected: usize| {
        let weights = std::array::from_fn(|i| if i == picked { 1.0 } else { 0.0 });
        let (maps, view) = shot.maps(&[&Gradients(weights)], 256, Bias::Auto);
        let matrix = view.clip_from_world.as_dmat4();
        let uv = |p: DVec3| matrix.transform_point3(p) * DVec3::new(0.5, -0.5, 1.0);
        let told = shot.visibility(&maps[0]);
        // Gradients of coordinates are far below 1, the answer outside of the map.
        let seen = told.values.iter().enumerate().filter(|(_, v)| **v != 1.0);
        let (mut count, mut worst) = (0, 0.0_f64);
        for (pixel, value) in seen {
            let (x, y) = rays.pixel(pixel);
            let (x, y) = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            let step = |dx: f64, dy: f64| uv(on_plane(x + dx, y + dy)) - uv(on_plane(x, y));
            let [right, down] = [step(1.0, 0.0), step(0.0, 1.0)];
            let exact = [right.x, right.y, down.x, down.y];
            let size = right.truncate().length().max(down.truncate().length());
            worst = worst.max((f64::from(*value) - exact[expected]).abs() / size);
            count += 1;
        }
        assert!(count > 1000, "only {count} pixels see the plane");
        worst
    };
    let rounding = if gpu.is_software() { 1e-3 } else { 2e-3 };
    for i in 0..4 {
        let error = worst(i, i);
        assert!(error < rounding, "gradient {i} is off by {error} of the footprint");
        let mixed = worst(i, (i + 1) % 4);
        assert!(mixed > rounding, "gradient {i} passes for its neighbour");
    }
}

/// Largest RMSE against the light-space ideal, measured plus a quarter.
const SPOT_BOUNDS: [(&str, f64); 13] = [
    ("hard", 0.086),
    ("pcf", 0.022),
    ("poisson", 0.026),
    ("bicubic", 0.048),
    ("footprint", 0.049),
    ("packed", 0.057),
    ("stratified", 0.069),
    ("vsm", 0.109),
    ("csm", 0.130),
    ("esm", 0.119),
    ("evsm", 0.099),
    ("msm", 0.096),
    ("lvsm", 0.098),
];
/// Bound of a technique that has none of its own yet.
const SPOT_BOUND: f64 = 0.130;

/// Bounds on the distance from truth, which pictures that are wrong must exceed.
fn spot(gpu: &antumbra_testing::Gpu) {
    let mut shot = Picture::new(gpu, &procedural::by_name("spot").unwrap().scene(1), [320, 240]);
    let techniques = specs::techniques(&["all".into()], KERNEL).unwrap();
    let all: Vec<&dyn Technique> = techniques.iter().map(|t| t.as_ref()).collect();
    let (maps, view) = shot.maps(&all, 1024, Bias::Auto);
    let (hard, ideal) = (shot.hard_truth(), shot.light_space_ideal(&view));
    for map in &maps {
        let answer = shot.visibility(map);
        let name = map.technique().about().name;
        let bound = SPOT_BOUNDS.iter().find(|(n, _)| *n == name).map_or(SPOT_BOUND, |(_, bound)| *bound);
        let rmse = score(&answer, &ideal).rmse;
        assert!(rmse <= bound, "{name}: RMSE {rmse} is above {bound}");
        let shifted = |x: u32, y| answer.get((x + 4).min(answer.width - 1), y).unwrap();
        let shifted = GrayImage::from_fn(answer.width, answer.height, shifted);
        let rmse = score(&shifted, &ideal).rmse;
        assert!(rmse > bound, "{name}: RMSE {rmse} four pixels aside");
        let pixel_match = score(&answer, &hard).pixel_match;
        assert!(name != "hard" || pixel_match >= 0.97, "pixel match {pixel_match}");
        // Too little bias, and lit surfaces shadow themselves.
        let early = BiasTerms { constant_texels: -64.0, ..BiasTerms::NONE };
        let rmse = score(&shot.answer(map.technique(), 1024, early.into()), &ideal).rmse;
        assert!(rmse > bound, "{name}: RMSE {rmse} with acne");
    }
}

/// The n² samples of each texel of a stratified map are the texels of a plain one n times as large.
fn finer(gpu: &antumbra_testing::Gpu) {
    const SIDE: u32 = 96;
    // Of graphics cards' corners, snapped to fractions of texels of two sizes.
    let rounding = if gpu.is_software() { 1e-5 } else { 1e-3 };
    let mut shot = Picture::new(gpu, &procedural::by_name("spheres").unwrap().scene(1), [64, 48]);
    let floats = |bytes: &[u8]| -> Vec<f32> {
        bytes.chunks_exact(4).map(|b| f32::from_ne_bytes(b.try_into().unwrap())).collect()
    };
    for grid in [2, 3, 4] {
        let stratified = Stratified { grid, ..Stratified::default() };
        let (maps, view) = shot.maps(&[&stratified], SIDE, Bias::Auto);
        // The mean of a single texel is its depth.
        let plain = technique::parse("vsm.kernel=1,sampling=nearest").unwrap();
        let mut fine = ShadowMap::new(&shot.gpu.device, plain.as_ref(), Size::square(SIDE * grid)).unwrap();
        fine.prepare(&shot.gpu.queue, &[view]).unwrap();
        shot.visibility(&maps[0]);
        shot.visibility(&fine);
        let fine = floats(&gpu.read_texture(fine.map_texture(0).unwrap(), 0, 0));
        let layer = |i| floats(&gpu.read_texture(maps[0].map_texture(0).unwrap(), i, 0));
        let layers: Vec<Vec<f32>> = (0..(grid * grid).div_ceil(4)).map(layer).collect();
        let agreement = |flipped: bool| {
            let texels = (0..SIDE * grid).flat_map(|y| (0..SIDE * grid).map(move |x| (x, y)));
            let same = texels.filter(|(x, y)| {
                let row = if flipped { grid - 1 - y % grid } else { y % grid };
                let (k, texel) = (row * grid + x % grid, y / grid * SIDE + x / grid);
                let sample = layers[k as usize / 4][(4 * texel + k % 4) as usize];
                (sample - fine[2 * (y * SIDE * grid + x) as usize]).abs() < rounding
            });
            same.count() as f64 / f64::from(SIDE * grid).powi(2)
        };
        // Edges through a sample fall on either side.
        assert!(agreement(false) > 0.998, "{grid}×{grid}: {}", agreement(false));
        assert!(agreement(true) < 0.9, "{grid}×{grid}: upside down {}", agreement(true));
    }
}

/// What wgpu reports outside of error scopes ends up in a result and not in a panic.
fn refusals(_: &antumbra_testing::Gpu) {
    // Of its own, since the shared one is inside an error scope.
    let other = antumbra_testing::gpu_without(wgpu::Features::empty()).unwrap();
    let gpu = Gpu::adopt(other.device, other.queue, other.info);
    gpu.check().unwrap();
    let max = gpu.device.limits().max_buffer_size;
    let too_large = |size| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("too large"),
            size,
            usage: wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        })
    };
    let buffer = too_large(max + 4);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.clear_buffer(&buffer, 0, None);
    let message = gpu.finish(encoder).unwrap_err().to_string();
    assert!(message.contains("too large") && message.contains(&max.to_string()), "{message}");
    // Said once, and then the device goes on.
    gpu.check().unwrap();
    gpu.finish(gpu.device.create_command_encoder(&Default::default())).unwrap();
}
