//! One small picture per technique, and what each picture must show.
//!
//! The scene, in the light's own space: a tilted ground; a disc far above it; a sheet just above
//! the ground that reaches under the disc's rim; a bar of about one texel; a ramp that rises from
//! the ground. White is lit.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capabilities, Capacity, Options, ShadowMap, Size, Technique, technique,
    technique::{Bias, Caster},
};
use antumbra_testing::{
    Gpu, Trials,
    broken::Broken,
    image::{Image, Tolerance},
};
use common::{Receiver, depth_layers, depth_texture, shadow_map, visibility};
use glam::{Vec2, Vec3};
use std::path::PathBuf;

const SIZE: Size = Size::square(64);
/// Pixels along a side of the picture: two per texel, so that none lies on a texel's border.
const SIDE: u32 = 128;
const TOLERANCE: Tolerance = Tolerance { mean: 2.0, max: 32 };
/// Where graphics cards rasterise triangles: texels whose centres lie on an edge fall on either side.
const ON_EDGES: Tolerance = Tolerance { mean: 0.25, max: 255 };

/// Depth of the ground.
fn ground(u: f32, v: f32) -> f32 {
    0.78 + 0.12 * (u - 0.5) + 0.1 * (v - 0.5)
}

fn in_disc(u: f32, v: f32, grown: f32) -> bool {
    Vec2::new(u - 0.33, v - 0.33).length() < 0.17 + grown
}

fn in_sheet(u: f32, v: f32, grown: f32) -> bool {
    (0.3 - grown..0.62 + grown).contains(&u) && (0.3 - grown..0.5 + grown).contains(&v)
}

/// From the foot of the ramp, where it touches the ground.
fn up_the_ramp(u: f32, v: f32) -> Option<f32> {
    ((0.65..0.9).contains(&u) && (0.55..0.9).contains(&v)).then_some(v - 0.55)
}

/// Depth of the nearest caster.
fn nearest(u: f32, v: f32) -> f32 {
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

fn receivers() -> Vec<Receiver> {
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
fn triangles() -> Vec<Vec3> {
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
fn behind(gpu: &Gpu, spec: &str, options: Options, casters: &[Vec3], receivers: &[Receiver]) -> Vec<f32> {
    let technique = technique::parse(spec).unwrap();
    let mesh = common::caster_mesh(gpu, casters);
    let view = common::view(options.size);
    let mut shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options).unwrap();
    shadows.prepare(&gpu.queue, &[view]).unwrap();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, |pass| pass.draw_mesh(&mesh, ..)).unwrap();
    gpu.queue.submit([encoder.finish()]);
    visibility(gpu, &shadows, receivers)
}

fn picture(gpu: &Gpu, spec: &str, bias: Bias) -> Vec<f32> {
    let technique = technique::parse(spec).unwrap();
    if technique.describe(&Capabilities::full()).unwrap().caster != Caster::Depth {
        return behind(gpu, spec, SIZE.into(), &triangles(), &receivers());
    }
    picture_of(gpu, technique.as_ref(), bias)
}

/// The picture of a technique that keeps depth.
fn picture_of(gpu: &Gpu, technique: &dyn Technique, bias: Bias) -> Vec<f32> {
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
fn at(picture: &[f32], there: impl Fn(f32, f32) -> bool) -> Vec<f32> {
    let chosen: Vec<f32> = std::iter::zip(receivers(), picture)
        .filter(|(r, _)| there(r.uv.x, r.uv.y))
        .map(|(_, v)| *v)
        .collect();
    assert!(chosen.len() > 50, "only {} pixels", chosen.len());
    chosen
}

fn mean(values: &[f32]) -> f32 {
    values.iter().sum::<f32>() / values.len() as f32
}

fn largest(values: &[f32]) -> f32 {
    values.iter().fold(0.0, |a: f32, b| a.max(*b))
}

/// Number of different grey levels.
fn levels(picture: &[f32]) -> usize {
    let mut levels: Vec<u32> = picture.iter().map(|v| (v * 4096.0).round() as u32).collect();
    levels.sort_unstable();
    levels.dedup();
    levels.len()
}

/// Well inside the map, away from all casters.
fn open(u: f32, v: f32) -> bool {
    (0.7..0.95).contains(&u) && (0.05..0.45).contains(&v)
}

/// In the sheet's shadow, along the disc's rim, away from the sheet's own edge.
fn two_layers(u: f32, v: f32) -> bool {
    in_sheet(u, v, -0.03) && in_disc(u, v, 0.03) && !in_disc(u, v, -0.03)
}

fn hard_has_two_levels(gpu: &Gpu) {
    let hard = picture(gpu, "hard", Bias::Auto);
    assert_eq!(levels(&hard), 2);
    assert_eq!(mean(&at(&hard, open)), 1.0);
    assert_eq!(largest(&at(&hard, |u, v| in_disc(u, v, -0.03))), 0.0);
}

fn pcf_has_as_many_levels_as_taps(gpu: &Gpu) {
    let nearest = levels(&picture(gpu, "pcf.kernel=3,weights=box,taps=nearest", Bias::Auto));
    assert!((5..=10).contains(&nearest), "{nearest} levels from 9 taps");
    let bilinear = levels(&picture(gpu, "pcf.kernel=3,weights=box", Bias::Auto));
    assert!(bilinear > 20, "{bilinear} levels from interpolated taps");
}

/// Largest difference of pixels side by side along the disc's rim.
fn roughness(picture: &[f32]) -> f32 {
    let rim = |i: usize| {
        let uv = receivers()[i].uv;
        in_disc(uv.x, uv.y, 0.03) && !in_disc(uv.x, uv.y, -0.03) && !in_sheet(uv.x, uv.y, 0.05)
    };
    let pairs = (1..picture.len()).filter(|i| i % SIDE as usize != 0 && rim(*i));
    pairs.map(|i| (picture[i] - picture[i - 1]).abs()).fold(0.0, f32::max)
}

fn bicubic_has_the_smoothest_edge_of_four_lookups(gpu: &Gpu) {
    let edge = |spec| roughness(&picture(gpu, spec, Bias::Auto));
    let (bicubic, bilinear, grid) = (edge("bicubic"), edge("pcf.kernel=1"), edge("pcf.kernel=3,weights=box"));
    assert!(bicubic < 0.8 * bilinear, "{bicubic}, one lookup {bilinear}");
    assert!(bicubic < 0.45 && grid < 0.45, "{bicubic}, four merged lookups {grid}");
}

/// Along the ramp's straight side a fixed disk answers the same everywhere, a turned one scatters.
fn poisson_turns_bands_into_noise(gpu: &Gpu) {
    let wide = |spin| picture(gpu, &format!("poisson.kernel=6,points=8,spin={spin}"), Bias::Auto);
    let scatter = |picture: &[f32]| {
        let column = |u: f32| (u * SIDE as f32) as u32;
        let side = (column(0.6)..column(0.7)).map(|x| {
            let values: Vec<f32> =
                (column(0.63)..column(0.72)).map(|y| picture[(y * SIDE + x) as usize]).collect();
            largest(&values) - values.iter().fold(1.0, |a: f32, b| a.min(*b))
        });
        side.fold(0.0, f32::max)
    };
    let (fixed, noise) = (wide("fixed"), wide("noise"));
    assert!(scatter(&fixed) < 1e-3, "{}", scatter(&fixed));
    assert!(scatter(&noise) > 0.15, "{}", scatter(&noise));
    // The noise does not move the shadow.
    assert!((mean(&noise) - mean(&fixed)).abs() < 2e-3, "{} {}", mean(&noise), mean(&fixed));
}

fn footprint_grows_with_the_pixel(gpu: &Gpu) {
    let texel = |i: u32| (i as f32 + 0.5) / 64.0;
    let depth = depth_texture(gpu, SIZE, |x, y| nearest(texel(x), texel(y)));
    let technique = technique::parse("footprint.budget=64").unwrap();
    let shadows = shadow_map(gpu, technique.as_ref(), &depth, SIZE.into());
    let edge = |texels: f32| {
        let receivers: Vec<Receiver> = receivers()
            .into_iter()
            .map(|r| Receiver { footprint: Vec2::splat(texels / SIZE.width as f32), ..r })
            .collect();
        roughness(&visibility(gpu, &shadows, &receivers))
    };
    let (small, large) = (edge(0.5), edge(6.0));
    assert!(large < 0.4 * small, "a pixel of half a texel {small}, of six {large}");
}

/// Whether every value is a whole number of steps.
fn in_steps_of(picture: &[f32], step: f32) -> bool {
    picture.iter().all(|v| (v / step - (v / step).round()).abs() < 1e-3)
}

fn packed_has_the_levels_of_the_paper(gpu: &Gpu) {
    let [two, four] = ["packed", "packed.grid=4"].map(|spec| picture(gpu, spec, Bias::Auto));
    assert!(levels(&two) == 5 && in_steps_of(&two, 1.0 / 4.0), "{} levels of 2×2", levels(&two));
    assert!(levels(&four) == 17 && in_steps_of(&four, 1.0 / 16.0), "{} levels of 4×4", levels(&four));
    // All ways to shadow 16 texels, phase by phase: the first so many of each 2×2 block.
    let depth = depth_texture(gpu, Size::square(128), |x, y| {
        let mixed = (y / 2 * 64 + x / 2).wrapping_mul(2_654_435_761);
        let block = (mixed ^ mixed >> 15).wrapping_mul(2_246_822_519) >> 16;
        if y % 2 * 2 + x % 2 < block % 5 { 0.2 } else { 1.0 }
    });
    let shown = |spec: &str| {
        let technique = technique::parse(spec).unwrap();
        let shadows = shadow_map(gpu, technique.as_ref(), &depth, Size::square(128).into());
        let corners = (0..62 * 62).map(|i| (2.0 + Vec2::new((i % 62) as f32, (i / 62) as f32) * 2.0) / 128.0);
        let receivers: Vec<_> = corners.map(|uv| Receiver::point(uv.x, uv.y, 0.5)).collect();
        levels(&visibility(gpu, &shadows, &receivers))
    };
    assert_eq!(shown("packed.grid=4"), 17);
    assert_eq!(shown("packed.grid=4,accumulation=bytes"), 20);
    assert_eq!(shown("packed.accumulation=bytes"), 5);
}

fn stratified_has_as_many_levels_as_samples(gpu: &Gpu) {
    for grid in [2_u32, 3, 4] {
        let picture = picture(gpu, &format!("stratified.grid={grid}"), Bias::Auto);
        let samples = grid * grid;
        assert!(in_steps_of(&picture, 1.0 / samples as f32), "{grid}×{grid}");
        assert!(levels(&picture) <= samples as usize + 1 && levels(&picture) > samples as usize / 2);
    }
}

/// n×n samples in a texel are those of a map n times as fine along each axis: their mean is the mean of
/// its n×n texels, exactly.
fn stratified_resolves_as_a_finer_map(gpu: &Gpu) {
    const TEXELS: u32 = 48;
    let seen = |spec: &str, size: u32, receivers: &[Receiver]| {
        let technique = technique::parse(spec).unwrap();
        let offsets = technique.describe(&Capabilities::full()).unwrap().sample_offsets;
        let texel = |i: u32, offset: f32| (i as f32 + 0.5 + offset) / size as f32;
        let depth = depth_layers(gpu, Size::square(size), offsets.len() as u32, |pass, x, y| {
            let offset = offsets[pass as usize];
            nearest(texel(x, offset.x), texel(y, offset.y))
        });
        // Without a bias, whose texels are those of the map.
        let options = Options { bias: Bias::NONE, ..Size::square(size).into() };
        visibility(gpu, &shadow_map(gpu, technique.as_ref(), &depth, options), receivers)
    };
    // Centres of the n×n parts of each texel of the coarse map, texel by texel, between its casters and
    // the ground.
    let parts = |n: u32| -> Vec<Receiver> {
        let at = |texel: u32, part: u32| (texel as f32 + (part as f32 + 0.5) / n as f32) / TEXELS as f32;
        let texels = (1..TEXELS - 1).flat_map(|y| (1..TEXELS - 1).map(move |x| (x, y)));
        texels
            .flat_map(|(x, y)| (0..n * n).map(move |k| Receiver::point(at(x, k % n), at(y, k / n), 0.5)))
            .collect()
    };
    for n in [2, 3, 4] {
        let stratified = seen(&format!("stratified.grid={n}"), TEXELS, &parts(1));
        let of_finer = |times: u32| -> Vec<f32> {
            seen("hard", times * TEXELS, &parts(times)).chunks(times.pow(2) as usize).map(mean).collect()
        };
        let differ = |other: &[f32]| std::iter::zip(&stratified, other).filter(|(a, b)| a != b).count();
        assert_eq!(differ(&of_finer(n)), 0, "{n}×{n}");
        for wrong in [1, n - 1, n + 1] {
            let count = differ(&of_finer(wrong));
            assert!(count > 40, "{n}×{n} samples are those of {wrong}×{wrong} but in {count} texels");
        }
    }
}

fn vsm_bleeds_between_two_layers(gpu: &Gpu) {
    let leak = |spec| largest(&at(&picture(gpu, spec, Bias::Auto), two_layers));
    let (vsm, reduced, esm) = (leak("vsm"), leak("vsm.reduction=0.4"), leak("esm"));
    assert!(vsm > 0.2, "the bound must bleed: {vsm}");
    assert!(reduced < 0.5 * vsm, "reduction must cut it: {reduced} of {vsm}");
    assert!(esm < 0.02, "an exponential must not: {esm}");
}

/// Of the light that vsm lets through where the disc's rim lies over the sheet, the share that a
/// technique lets through.
fn share_of_leak(gpu: &Gpu, spec: &str) -> f32 {
    let leak = |spec| mean(&at(&picture(gpu, spec, Bias::Auto), two_layers));
    leak(spec) / leak("vsm")
}

/// Share of the open, slanted ground that is not quite lit.
fn acne(gpu: &Gpu, spec: &str) -> f32 {
    let open = at(&picture(gpu, spec, Bias::Auto), open);
    open.iter().filter(|v| **v < 0.9).count() as f32 / open.len() as f32
}

fn evsm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("evsm") < 0.02, "{} of vsm's", leak("evsm"));
    assert!(leak("evsm.format=float16") < 0.2, "{} of vsm's", leak("evsm.format=float16"));
    assert!(leak("evsm.positive=1,negative=1") > 0.5, "nearly linear warps are vsm");
    assert_eq!(acne(gpu, "evsm") + acne(gpu, "evsm.format=float16"), 0.0);
}

fn msm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("msm") < 0.2, "{} of vsm's", leak("msm"));
    assert_eq!(acne(gpu, "msm") + acne(gpu, "msm.format=float32"), 0.0);
}

fn lvsm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("lvsm") < 0.2, "{} of vsm's", leak("lvsm"));
    assert_eq!(acne(gpu, "lvsm"), 0.0);
    // The ground crosses four fifths of the depth range.
    assert_eq!(acne(gpu, "lvsm.intervals=5"), 0.0);
    assert!(acne(gpu, "lvsm.intervals=5,overlap=0") > 0.0, "an overlap keeps slopes lit");
}

fn csm_is_brighter_at_contact_with_fewer_terms(gpu: &Gpu) {
    let foot = |u: f32, v: f32| {
        (0.68..0.87).contains(&u) && up_the_ramp(u, v).is_some_and(|t| (0.03..0.07).contains(&t))
    };
    let contact = |spec| mean(&at(&picture(gpu, spec, Bias::Auto), foot));
    let (few, many, hard) = (contact("csm.terms=4"), contact("csm.terms=16"), contact("hard"));
    assert!(few > many + 0.1, "4 terms {few}, 16 terms {many}");
    assert!(many > hard, "both are brighter than the truth");
}

fn esm_needs_no_bias(gpu: &Gpu) {
    let acne = |spec| {
        let open = at(&picture(gpu, spec, Bias::NONE), open);
        open.iter().filter(|v| **v < 0.5).count() as f32 / open.len() as f32
    };
    let (esm, hard) = (acne("esm"), acne("hard"));
    assert_eq!(esm, 0.0);
    assert!(hard > 0.2, "without bias a comparison shadows a tilted plane: {hard}");
}

/// A slanted triangle and one of about a texel beside it.
const SLANTED: [[(f32, f32); 3]; 2] =
    [[(0.2, 0.13), (0.83, 0.42), (0.31, 0.87)], [(0.81, 0.71), (0.86, 0.72), (0.82, 0.74)]];

/// How many of the picture's receivers behind such triangles a technique answers wrongly, from a map so
/// small that many fall into each texel.
fn wrong_behind(gpu: &Gpu, spec: &str, triangles: &[[(f32, f32); 3]]) -> usize {
    wrong_within(gpu, spec, Capacity::default(), triangles)
}

/// The same with that capacity.
fn wrong_within(gpu: &Gpu, spec: &str, capacity: Capacity, triangles: &[[(f32, f32); 3]]) -> usize {
    let corner = |(u, v): (f32, f32)| Vec3::new(2.0 * u - 1.0, 1.0 - 2.0 * v, 0.3);
    let corners: Vec<Vec3> = triangles.iter().flatten().map(|c| corner(*c)).collect();
    let receivers: Vec<Receiver> =
        receivers().into_iter().map(|r| Receiver { depth: 0.8, normal: Vec3::NEG_Z, ..r }).collect();
    let covered = |p: Vec2| {
        triangles.iter().any(|t| {
            let [a, b, c] = t.map(|(u, v)| Vec2::new(u, v));
            let side = |a: Vec2, b: Vec2| (b - a).perp_dot(p - a);
            side(a, b) >= 0.0 && side(b, c) >= 0.0 && side(c, a) >= 0.0
        })
    };
    let options = Options::from(Size::square(20)).capacity(capacity);
    let found = behind(gpu, spec, options, &corners, &receivers);
    let differs = |(r, v): (&Receiver, f32)| (v < 0.5) != covered(r.uv);
    receivers.iter().zip(found).filter(|pair| differs(*pair)).count()
}

fn spsm_resolves_edges_below_a_texel(gpu: &Gpu) {
    let wrong = |spec| wrong_behind(gpu, spec, &SLANTED);
    let (published, two) = (wrong("spsm.layers=1"), wrong("spsm"));
    // The silhouette is exact here; texels' centres, which tell with two layers, hold its edge to a fraction
    // of a texel where no stored triangle does.
    assert!(published <= 8 && two <= 16, "{published} and {two} of {} pixels", receivers().len());
    let coarse = wrong("spsm.packing=map");
    assert!(coarse <= 80, "{coarse} with corners over the map");
}

/// At the tips of a large triangle no centre sees it.
fn rgsm_resolves_edges_of_large_triangles(gpu: &Gpu) {
    let wrong = |spec: &str, count| wrong_behind(gpu, &format!("rgsm.missed=lit,{spec}"), &SLANTED[..count]);
    let [own, three, five] = [1, 3, 5].map(|n| wrong(&format!("neighbours={n}"), 1));
    assert!(five <= three && three <= 30, "{three} with 3×3, {five} with 5×5");
    assert!(own > 4 * three, "{own} with the own texel alone");
    // One that lies between two rows of centres leaves nothing.
    let between = [[(0.78, 0.73), (0.92, 0.73), (0.85, 0.77)]];
    let lost = wrong_behind(gpu, "rgsm.missed=lit,neighbours=5", &between);
    let kept = wrong_behind(gpu, "spsm", &between);
    assert!(lost > 30 && kept < 8, "{lost}, and {kept} with conservative rasterisation");
    // Where the receiver casts nothing, the texel's centre answers beside a triangle.
    let centres = wrong_behind(gpu, "rgsm", &SLANTED[..1]);
    assert!(centres > 4 * three, "{centres}");
}

/// Sixty slivers around a point.
fn fan() -> Vec<[(f32, f32); 3]> {
    (0..60)
        .map(|k| {
            let turn = |k: i32| {
                let (sine, cosine) = (k as f32 * std::f32::consts::TAU / 60.0).sin_cos();
                (0.5 + 0.37 * cosine, 0.5 + 0.37 * sine)
            };
            [(0.52, 0.49), turn(k), turn(k + 1)]
        })
        .collect()
}

/// Elsewhere centres of texels hold the edge to a fraction of a texel.
fn dpm_resolves_what_has_room(gpu: &Gpu) {
    let wrong = |spec: &str, triangles: &[[(f32, f32); 3]]| wrong_behind(gpu, spec, triangles);
    let (few, roomy) = (wrong("dpm", &SLANTED), wrong("dpm.keeps=32", &fan()));
    assert!(few <= 1 && roomy <= 1, "{few} behind {}, {roomy} behind a fan", SLANTED.len());
    let one = Capacity { triangles: 1, ..Capacity::default() };
    let (full, cut) = (wrong("dpm.keeps=2", &fan()), wrong_within(gpu, "dpm", one, &fan()));
    assert!(full < 120 && cut > 5 * full.max(10), "{full} of full texels, {cut} with one triangle");
}

/// However small the map and the triangles.
fn exact_resolves_everything(gpu: &Gpu) {
    let fan = fan();
    for triangles in [&SLANTED[..], &fan] {
        let enough = Capacity { triangles: 60, triangles_per_texel: 64 };
        let wrong = wrong_within(gpu, "exact", enough, triangles);
        assert!(wrong <= 1, "{wrong} behind {} triangles", triangles.len());
        let cut = wrong_within(gpu, "exact", Capacity { triangles: 1, ..enough }, triangles);
        assert!(cut > 5, "{cut} with one triangle");
    }
}

fn main() {
    type Claim = (&'static str, &'static str, fn(&Gpu));
    const CLAIMS: &[Claim] = &[
        ("hard", "two levels", hard_has_two_levels),
        ("pcf", "as many levels as taps", pcf_has_as_many_levels_as_taps),
        ("poisson", "turns bands into noise", poisson_turns_bands_into_noise),
        ("bicubic", "smoothest edge of four lookups", bicubic_has_the_smoothest_edge_of_four_lookups),
        ("footprint", "grows with the pixel", footprint_grows_with_the_pixel),
        ("packed", "the levels of the paper", packed_has_the_levels_of_the_paper),
        ("stratified", "as many levels as samples", stratified_has_as_many_levels_as_samples),
        ("stratified", "resolves as a finer map", stratified_resolves_as_a_finer_map),
        ("vsm", "bleeds between two layers", vsm_bleeds_between_two_layers),
        ("csm", "brighter at contact with fewer terms", csm_is_brighter_at_contact_with_fewer_terms),
        ("esm", "needs no bias", esm_needs_no_bias),
        ("evsm", "bleeds less than vsm", evsm_bleeds_less_than_vsm),
        ("msm", "bleeds less than vsm", msm_bleeds_less_than_vsm),
        ("lvsm", "bleeds less than vsm", lvsm_bleeds_less_than_vsm),
        ("dpm", "everything where texels have room", dpm_resolves_what_has_room),
        ("exact", "everything", exact_resolves_everything),
        ("rgsm", "edges of large triangles", rgsm_resolves_edges_of_large_triangles),
        ("spsm", "edges finer than texels", spsm_resolves_edges_below_a_texel),
    ];
    let path =
        |name: &str| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.png"));
    let mut trials = Trials::default();
    for name in technique::all().iter().map(|t| t.about().name) {
        trials.add(format!("{name}: picture"), move |gpu| {
            let image = Image::grey(SIDE, &picture(gpu, name, Bias::Auto));
            let triangles = technique::parse(name).unwrap().describe(&Capabilities::full()).unwrap().caster
                != Caster::Depth;
            let tolerance = if triangles && !gpu.is_software() { ON_EDGES } else { TOLERANCE };
            image.compare_with_reference(&path(name), tolerance).unwrap();
        });
        trials.add_plain(format!("{name}: has a claim"), move || {
            assert!(CLAIMS.iter().any(|c| c.0 == name));
        });
    }
    for (name, claim, check) in CLAIMS {
        trials.add(format!("{name}: {claim}"), *check);
    }
    trials.add("rejected: the picture of another technique", move |gpu| {
        let image = Image::grey(SIDE, &picture(gpu, "esm", Bias::Auto));
        image.compare(&Image::read(&path("vsm")).unwrap(), TOLERANCE).unwrap_err();
        image.compare(&Image::read(&path("hard")).unwrap(), TOLERANCE).unwrap_err();
    });
    let aside = "compare, uv + vec2f(0.5) / vec2f(textureDimensions(casters)), view";
    for (what, broken) in [
        ("half a texel aside", Broken::saying("pcf", "compare, uv, view", aside)),
        ("weights that do not sum to one", Broken::new("pcf").weights(0.97)),
        ("a tap dropped", Broken::saying("stratified", "k < COUNT", "k + 1u < COUNT")),
        ("a tap dropped", Broken::saying("poisson", "var i = 0u; i <", "var i = 1u; i <")),
        (
            "no half texel towards the four texels' corner",
            Broken::saying("packed", "vec2f(0.5, -0.5)", "vec2f(0.0, 0.0)"),
        ),
    ] {
        let name = broken.about().name;
        let path = path(name);
        trials.add(format!("rejected: {what} ({name})"), move |gpu| {
            let image = Image::grey(SIDE, &picture_of(gpu, &broken, Bias::Auto));
            image.compare(&Image::read(&path).unwrap(), TOLERANCE).unwrap_err();
        });
    }
    trials.run();
}
