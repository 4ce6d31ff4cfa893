//! The scene, and its picture by a technique.

use antumbra::{
    Capabilities, Options, ShadowMap, Size, Technique, technique,
    technique::{Bias, CasterStorage},
};
use antumbra_testing::Gpu;
use antumbra_testing::ask::{self, Receiver, depth_layers, shadow_map, visibility};
use glam::{Vec2, Vec3};

pub(crate) const SIZE: Size = Size::square(64);
/// Pixels along a side of the picture: two per texel, so that none lies on a texel's border.
pub(crate) const SIDE: u32 = 128;
/// Depth of the ground.
pub(crate) fn ground(u: f32, v: f32) -> f32 {
    0.78 + 0.12 * (u - 0.5) + 0.1 * (v - 0.5)
}

pub(crate) fn in_disc(u: f32, v: f32, grown: f32) -> bool {
    Vec2::new(u - 0.33, v - 0.33).length() < 0.17 + grown
}

pub(crate) fn in_sheet(u: f32, v: f32, grown: f32) -> bool {
    (0.3 - grown..0.62 + grown).contains(&u) && (0.3 - grown..0.5 + grown).contains(&v)
}

/// From the foot of the ramp, where it touches the ground.
pub(crate) fn up_the_ramp(u: f32, v: f32) -> Option<f32> {
    ((0.65..0.9).contains(&u) && (0.55..0.9).contains(&v)).then_some(v - 0.55)
}

/// Depth of the nearest caster.
pub(crate) fn nearest(u: f32, v: f32) -> f32 {
    let mut z = ground(u, v);
    let mut cast = |there: bool, depth: f32| {
        if there {
            z = z.min(depth);
        }
    };
    cast(in_disc(u, v, 0.0), 0.1);
    cast(in_sheet(u, v, 0.0), 0.62);
    cast((0.15..0.6).contains(&u) && (v - 0.62 - 0.3 * u).abs() < 0.01, 0.35);
    cast(up_the_ramp(u, v).is_some(), ground(u, v) - 1.1 * up_the_ramp(u, v).unwrap_or(0.0));
    z
}

pub(crate) fn receivers() -> Vec<Receiver> {
    let normal = Vec3::new(0.06, -0.05, -1.0).normalize();
    let centre = |i: u32| (i as f32 + 0.5) / SIDE as f32;
    (0..SIDE * SIDE)
        .map(|i| (centre(i % SIDE), centre(i / SIDE)))
        .map(|(u, v)| Receiver {
            footprint: Vec2::splat(1.0 / SIDE as f32),
            normal,
            ..Receiver::point(u, v, ground(u, v))
        })
        .collect()
}

/// The same scene as triangles, in world space.
pub(crate) fn triangles() -> Vec<Vec3> {
    let at = |u: f32, v: f32, z: f32| Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, z);
    let on_ground = |[u, v]: [f32; 2]| at(u, v, ground(u, v));
    let quad = |place: &dyn Fn([f32; 2]) -> Vec3, [a, b, c, d]: [[f32; 2]; 4]| {
        [a, b, c, c, b, d].map(place).to_vec()
    };
    let mut all = quad(&on_ground, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    all.extend(quad(&|[u, v]| at(u, v, 0.62), [[0.3, 0.3], [0.62, 0.3], [0.3, 0.5], [0.62, 0.5]]));
    let bar = |u: f32, side: f32| [u, 0.62 + 0.3 * u + side * 0.01];
    all.extend(quad(
        &|[u, v]| at(u, v, 0.35),
        [bar(0.15, -1.0), bar(0.6, -1.0), bar(0.15, 1.0), bar(0.6, 1.0)],
    ));
    let up = |[u, v]: [f32; 2]| at(u, v, ground(u, v) - 1.1 * (v - 0.55));
    all.extend(quad(&up, [[0.65, 0.55], [0.9, 0.55], [0.65, 0.9], [0.9, 0.9]]));
    let rim = |k: u32| {
        let (sine, cosine) = (k as f32 * std::f32::consts::TAU / 48.0).sin_cos();
        at(0.33 + 0.17 * cosine, 0.33 + 0.17 * sine, 0.1)
    };
    all.extend((0..48).flat_map(|k| [at(0.33, 0.33, 0.1), rim(k), rim(k + 1)]));
    all
}

/// Visibility of receivers behind casters that are triangles.
pub(crate) fn behind(
    gpu: &Gpu,
    spec: &str,
    options: Options,
    casters: &[Vec3],
    receivers: &[Receiver],
) -> Vec<f32> {
    let technique = technique::parse(spec).unwrap();
    let mesh = ask::caster_mesh(gpu, casters);
    let view = ask::view(options.size);
    let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
    shadows.prepare(&gpu.queue, &[view]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    visibility(gpu, &shadows, receivers)
}

pub(crate) fn picture(gpu: &Gpu, spec: &str, bias: Bias) -> Vec<f32> {
    let technique = technique::parse(spec).unwrap();
    if technique.describe(&Capabilities::full()).unwrap().storage != CasterStorage::Depth {
        return behind(gpu, spec, SIZE.into(), &triangles(), &receivers());
    }
    picture_of(gpu, technique.as_ref(), bias)
}

/// The picture of a technique that keeps depth.
pub(crate) fn picture_of(gpu: &Gpu, technique: &dyn Technique, bias: Bias) -> Vec<f32> {
    let offsets = technique.describe(&Capabilities::full()).unwrap().sample_offsets;
    let texel = |i: u32, offset: f32| (i as f32 + 0.5 + offset) / 64.0;
    let depth = depth_layers(gpu, SIZE, offsets.len() as u32, |pass, x, y| {
        let offset = offsets[pass as usize];
        nearest(texel(x, offset.x), texel(y, offset.y))
    });
    let options = Options { bias, ..SIZE.into() };
    let shadows = shadow_map(gpu, technique, &depth, options);
    visibility(gpu, &shadows, &receivers())
}

/// Values of a picture at the receivers that `there` chooses by their uv.
pub(crate) fn at(picture: &[f32], there: impl Fn(f32, f32) -> bool) -> Vec<f32> {
    let chosen: Vec<f32> = std::iter::zip(receivers(), picture)
        .filter(|(r, _)| there(r.uv.x, r.uv.y))
        .map(|(_, v)| *v)
        .collect();
    assert!(chosen.len() > 50, "only {} pixels", chosen.len());
    chosen
}

pub(crate) fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

pub(crate) fn largest(values: &[f32]) -> f32 {
    values.iter().fold(0.0, |a: f32, b| a.max(*b))
}

/// Number of different grey levels.
pub(crate) fn levels(picture: &[f32]) -> usize {
    let mut levels: Vec<u32> = picture.iter().map(|v| (v * 4096.0).round() as u32).collect();
    levels.sort_unstable();
    levels.dedup();
    levels.len()
}

/// Well inside the map, away from all casters.
pub(crate) fn open(u: f32, v: f32) -> bool {
    (0.7..0.95).contains(&u) && (0.05..0.45).contains(&v)
}

/// In the sheet's shadow, along the disc's rim, away from the sheet's own edge.
pub(crate) fn two_layers(u: f32, v: f32) -> bool {
    in_sheet(u, v, -0.03) && in_disc(u, v, 0.03) && !in_disc(u, v, -0.03)
}
