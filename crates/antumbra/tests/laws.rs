//! Laws that every technique obeys, for every member of `all()` and a few settings of each.
//!
//! A law is a function that says what is wrong; each is also given a technique that is broken on
//! purpose, and must say so.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra::{
    Capabilities, Capacity, Options, Size, Technique, View, technique,
    technique::{Access, Caster, Combine, Description, Pass},
};
use antumbra_testing::{Gpu, Trials, broken::Broken, settings};
use common::{Random, Receiver, depth_layers, depth_texture, shadow_map, shadow_map_of, texels, visibility};
use glam::{Mat4, Vec2, Vec3};

const SIZE: Size = Size::square(64);

type Law = fn(&Gpu, &dyn Technique) -> Result<(), String>;

/// What a technique says of itself on a device.
fn described(gpu: &Gpu, technique: &dyn Technique) -> Description {
    technique.describe(&Capabilities::of(&gpu.device)).unwrap()
}

/// A run-time setting, if there is one of that name.
fn setting(described: &Description, name: &str) -> Option<f32> {
    described.settings.iter().find(|(n, _)| *n == name).map(|(_, value)| *value)
}

/// Sets a parameter where there is one.
fn try_set(technique: &mut dyn Technique, name: &str, value: &str) {
    if technique.parameters().iter().any(|p| p.name == name) {
        technique::set(technique, name, value).unwrap();
    }
}

/// What blocks of random depth a map is made of: flat within, so that no texel is a slope.
fn blocks(seed: u64, side: u32) -> impl Fn(u32, u32) -> f32 {
    let mut random = Random::new(seed);
    let count = SIZE.width.div_ceil(side);
    let depths: Vec<f32> = (0..count * count).map(|_| random.unit()).collect();
    move |x, y| depths[(y / side * count + x / side) as usize]
}

fn receivers(seed: u64, count: usize) -> Vec<Receiver> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let footprint = Vec2::new(random.range(-18.0, -3.0).exp2(), random.range(-18.0, -3.0).exp2());
            Receiver { footprint, ..Receiver::point(random.unit(), random.unit(), random.unit()) }
        })
        .collect()
}

fn all_of<'a>(
    results: impl Iterator<Item = (&'a Receiver, f32)>,
    good: impl Fn(&Receiver, f32) -> bool,
) -> Result<(), String> {
    for (r, v) in results {
        if !good(r, v) {
            return Err(format!("visibility {v} at {} in depth {}", r.uv, r.depth));
        }
    }
    Ok(())
}

/// Not by a rounding beyond: weights that sum to one in f32 may.
fn stays_within_zero_and_one(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    for side in [1, 5] {
        let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(1, side)), SIZE.into());
        let receivers = receivers(2, 4096);
        let results = visibility(gpu, &shadows, &receivers);
        all_of(receivers.iter().zip(results), |_, v| (0.0..=1.0).contains(&v))?;
    }
    Ok(())
}

/// Up to the far plane itself, where the receiver touches what an empty texel stores.
fn is_lit_without_casters(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, |_, _| 1.0), SIZE.into());
    let receivers: Vec<_> = (0..=256).map(|i| Receiver::point(0.3, 0.6, i as f32 / 256.0)).collect();
    let least = 0.999 - described(gpu, technique).ringing;
    all_of(receivers.iter().zip(visibility(gpu, &shadows, &receivers)), |_, v| v >= least)
}

fn is_dark_behind_a_blocker(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    is_dark_within(gpu, technique, Capacity::default())
}

fn is_dark_within(gpu: &Gpu, technique: &dyn Technique, capacity: Capacity) -> Result<(), String> {
    let options = Options::from(SIZE).capacity(capacity);
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, |_, _| 0.2), options);
    let receivers: Vec<_> =
        (0..=256).map(|i| Receiver::point(0.7, 0.4, 0.7 + 0.3 * i as f32 / 256.0)).collect();
    let most = described(gpu, technique).ringing + 1e-4;
    all_of(receivers.iter().zip(visibility(gpu, &shadows, &receivers)), |_, v| v <= most)
}

/// Whether it chooses between several ways to answer, by depth: its answers jump where it changes over.
fn changes_over(gpu: &Gpu, technique: &dyn Technique) -> bool {
    let classifies = !described(gpu, technique).classes.is_empty();
    technique.clone_box().parameters().iter().any(|p| {
        let custom = p.name == "custom" && p.value() != "none" && classifies;
        custom || (p.name == "choose" && p.value() != "least")
    })
}

/// Ripples may rise by their whole height once, up to rounding.
fn darkens_with_depth(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    const STEPS: usize = 64;
    if changes_over(gpu, technique) {
        return Ok(());
    }
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(3, 3)), SIZE.into());
    // Silhouettes of triangles that are not kept are guesses, which differ with what is in front.
    let described = described(gpu, technique);
    let centred = |r: Receiver| match described.caster {
        Caster::Depth => r,
        Caster::Lists | Caster::Ranked { .. } => r,
        Caster::Triangles(_) => Receiver { uv: ((r.uv * 64.0).floor() + 0.5) / 64.0, ..r },
    };
    let deeper = |r: Receiver| (0..STEPS).map(move |i| Receiver { depth: i as f32 / STEPS as f32, ..r });
    let receivers: Vec<_> = receivers(4, 100).into_iter().map(centred).flat_map(deeper).collect();
    let results = visibility(gpu, &shadows, &receivers);
    let most = 2.0 * described.ringing + 1e-4;
    for (r, v) in receivers.chunks(STEPS).zip(results.chunks(STEPS)) {
        let mut lowest = f32::INFINITY;
        for (r, v) in r.iter().zip(v) {
            lowest = lowest.min(*v);
            if v - lowest > most {
                return Err(format!("{} rises from {lowest} to {v} in depth {}", r.uv, r.depth));
            }
        }
    }
    Ok(())
}

/// Without blur and interpolation, at texel centres, out of the approximation's own ramp. A kernel that
/// cannot be narrowed sees one depth where it lies within one block.
fn shrinks_to_the_hard_shadow(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    const BLOCK: u32 = 8;
    let mut narrow = technique.clone_box();
    let least = narrow.parameters().iter().find(|p| p.name == "kernel").map(|p| match &p.field {
        antumbra::Field::Number(_, r) => r.start().to_string(),
        _ => "1".to_string(),
    });
    let margin = if least.is_some() {
        0
    } else {
        (described(gpu, technique).filter_radius_texels - 0.5).ceil() as u32
    };
    try_set(narrow.as_mut(), "kernel", &least.unwrap_or_default());
    for (name, value) in [("sampling", "nearest"), ("taps", "nearest")] {
        try_set(narrow.as_mut(), name, value);
    }
    let map = blocks(5, BLOCK);
    let inner = |x: u32| (margin..BLOCK - margin).contains(&(x % BLOCK));
    let shadows = shadow_map(gpu, narrow.as_ref(), &depth_texture(gpu, SIZE, &map), SIZE.into());
    // A series lifted by its own half ramp is at one end of the ramp where d = z.
    let of_narrow = described(gpu, narrow.as_ref());
    let set = |name| setting(&of_narrow, name).unwrap_or(0.0);
    let ramp = (2.0 * set("offset") / set("span").max(0.5)).max(0.1);
    let mut random = Random::new(6);
    let mut receivers = Vec::new();
    let mut expected = Vec::new();
    for (x, y) in (2..62).flat_map(|y| (2..62).map(move |x| (x, y))) {
        let (z, d) = (map(x, y), random.unit());
        if (d - z).abs() > ramp && inner(x) && inner(y) {
            receivers.push(Receiver::point((x as f32 + 0.5) / 64.0, (y as f32 + 0.5) / 64.0, d));
            expected.push(if d <= z { 1.0 } else { 0.0 });
        }
    }
    // A series of one term is all ramp: nothing to compare.
    if receivers.is_empty() {
        return Ok(());
    }
    let tolerance = described(gpu, technique).ringing + 1e-3;
    let results = visibility(gpu, &shadows, &receivers);
    for ((r, v), e) in receivers.iter().zip(results).zip(expected) {
        if (v - e).abs() > tolerance {
            return Err(format!("visibility {v} instead of {e} at {} in depth {}", r.uv, r.depth));
        }
    }
    Ok(())
}

/// How far a mean may move, absolutely and relatively: few bits round at every step, but by far less
/// than a level on average; 16-bit floats may be truncated at each of eight steps.
fn rounding(format: wgpu::TextureFormat) -> (f64, f64) {
    use wgpu::TextureFormat as F;
    match format {
        F::Rgba8Unorm => (1.0 / 255.0, 0.0),
        F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => (1.0 / 65535.0, 0.0),
        F::R16Float | F::Rg16Float | F::Rgba16Float => (1e-7, 8e-3),
        _ => (0.0, 1e-5),
    }
}

/// Blur with a constant border, and every mip level, keep the mean of what is stored, or of the powers
/// whose logarithms are. Summed-area tables and greatest values have no mean to keep.
fn filtering_keeps_the_mean(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let inner = blocks(7, 1);
    let border = |x: u32| !(16..48).contains(&x);
    let depth = depth_texture(gpu, SIZE, |x, y| if border(x) || border(y) { 0.5 } else { inner(x, y) });
    let filtered = shadow_map(gpu, technique, &depth, SIZE.into());
    let mut plain = technique.clone_box();
    try_set(plain.as_mut(), "kernel", "1");
    let plain = shadow_map(gpu, plain.as_ref(), &depth, SIZE.into());
    for (index, map) in described(gpu, technique).maps.iter().enumerate() {
        let (Some(filtered), Some(plain)) = (filtered.map_texture(index), plain.map_texture(index)) else {
            return Err("a map is missing".into());
        };
        let combine = map.passes.iter().find_map(|p| match p {
            Pass::Blur(_, combine) | Pass::Mips(combine) => Some(*combine),
            Pass::Sum(_) => None,
        });
        let (absolute, relative) = rounding(filtered.format());
        let (power, relative) = match combine {
            None | Some(Combine::Greatest) => continue,
            Some(Combine::Mean) => (0.0, relative),
            // c times the rounding of a depth.
            Some(Combine::LogMean(c)) => {
                (f64::from(c), f64::from(c) * (8.0 * absolute.max(1e-6) + 0.5 * relative))
            }
        };
        let value = |t: f64| if power > 0.0 { (power * (t - 1.0)).exp() } else { t };
        for layer in 0..filtered.depth_or_array_layers() {
            let mean = |texture: &wgpu::Texture, mip| -> [f64; 4] {
                let texels = texels(gpu, texture, layer, mip);
                std::array::from_fn(|i| texels.iter().map(|t| value(t[i])).sum::<f64>() / texels.len() as f64)
            };
            let expected = mean(plain, 0);
            for mip in 0..filtered.mip_level_count() {
                let found = mean(filtered, mip);
                // Each level rounds once more, by half a step.
                let steps = if gpu.is_software() { 1.0 } else { 0.5 * f64::from(mip + 2) };
                for (f, e) in found.iter().zip(expected) {
                    if (f - e).abs() > steps * absolute + relative * e.abs() {
                        return Err(format!("layer {layer}, level {mip}: mean {f} instead of {e}"));
                    }
                }
            }
        }
    }
    Ok(())
}

/// The same depth in the second layer of a two-view map, behind a first view that looks elsewhere:
/// beside the receivers, or only beyond them, so that they are in front of its near plane.
fn views_do_not_matter(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let map = blocks(8, 4);
    let alone = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, &map), SIZE.into());
    let depth =
        depth_layers(gpu, SIZE, 2, |layer, x, y| if layer == 1 { map(x, y) } else { 1.0 - map(x, y) });
    let receivers = receivers(9, 1024);
    let expected = visibility(gpu, &alone, &receivers);
    let here = common::view(SIZE);
    for shift in [Vec3::new(3.0, 0.0, 0.0), Vec3::new(0.0, 0.0, -2.0)] {
        let elsewhere = View {
            clip_from_world: Mat4::from_translation(shift),
            depth_plane: Vec3::Z.extend(shift.z),
            ..here
        };
        let second = shadow_map_of(gpu, technique, &depth, SIZE.into(), &[elsewhere, here]);
        let found = visibility(gpu, &second, &receivers);
        let differences = expected.iter().zip(found).map(|(e, f)| e - f);
        all_of(receivers.iter().zip(differences), |_, difference| difference == 0.0)?;
    }
    Ok(())
}

/// Interpolation in the shader gives what the sampler gives, and is told.
fn fallbacks_agree(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let lesser =
        antumbra_testing::gpu_without(wgpu::Features::FLOAT32_FILTERABLE).ok_or("no second device")?;
    let receivers = receivers(10, 4096);
    let ask = |gpu: &Gpu| {
        let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(11, 3)), SIZE.into());
        (visibility(gpu, &shadows, &receivers), shadows.explain().join("; "))
    };
    let (expected, _) = ask(gpu);
    let (found, explained) = lesser.checked(ask);
    // Moments are rounded by 6e-8, which a variance near its floor of 1e-6 magnifies, and a moment
    // bias of 3e-6 too; GPUs interpolate with 8-bit weights besides.
    let whole = described(gpu, technique);
    let has = |name| setting(&whole, name).is_some();
    let tolerance = match gpu.is_software() {
        true if has("moment_bias") => 5e-3,
        true if has("least_variance") => 1e-3,
        true => 1e-4,
        false => 2e-2,
    };
    let differ = expected.iter().zip(&found).filter(|(e, f)| (**e - **f).abs() > tolerance).count();
    // A texel or a level that weighs less than half a 256th weighs nothing, though it may hold a power of e
    // that outweighs all others.
    let allowed = if gpu.is_software() { 0 } else { receivers.len() / 50 };
    if differ > allowed {
        return Err(format!("{differ} of {} receivers differ by more than {tolerance}", receivers.len()));
    }
    if let Some(map) = described(&lesser, technique).maps.first() {
        let said =
            explained.contains(&format!("{} in {:?}, interpolated by the shader", map.name, map.format));
        if said != (map.access == Access::Shader) {
            return Err(format!("explain() says: {explained}"));
        }
    }
    Ok(())
}

/// A width in the world that is so many texels of the view is as good as so many texels.
fn widths_in_the_world_are_texels_of_the_view(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let adapts =
        technique.clone_box().parameters().iter().any(|p| p.name == "width" && p.allowed() != "0 to 0");
    if !adapts {
        return Ok(());
    }
    let depth = depth_texture(gpu, SIZE, blocks(12, 3));
    // Away from the border, within which the wider margin makes a difference.
    let inner = |mut r: Receiver| {
        r.uv = Vec2::splat(0.3) + 0.4 * r.uv;
        r
    };
    let receivers: Vec<Receiver> = receivers(13, 2048).into_iter().map(inner).collect();
    let ask = |kernel: &str, texels: f32| {
        let mut technique = technique.clone_box();
        try_set(technique.as_mut(), "kernel", kernel);
        try_set(technique.as_mut(), "width", &(texels * common::view(SIZE).texel_world).to_string());
        visibility(gpu, &shadow_map(gpu, technique.as_ref(), &depth, SIZE.into()), &receivers)
    };
    let (fixed, adapted) = (ask("5", 0.0), ask("9", 5.0));
    // Sums in another order; moments magnify their last bits.
    let described = described(gpu, technique);
    let has = |name| setting(&described, name).is_some();
    let tolerance = if has("least_variance") || has("moment_bias") { 5e-3 } else { 1e-4 };
    all_of(receivers.iter().zip(fixed.iter().zip(adapted).map(|(f, a)| f - a)), |_, difference| {
        difference.abs() <= tolerance
    })
}

const LAWS: [(&str, Law); 9] = [
    ("visibility within [0,1]", stays_within_zero_and_one),
    ("lit without casters", is_lit_without_casters),
    ("dark behind a blocker", is_dark_behind_a_blocker),
    ("darker with depth", darkens_with_depth),
    ("hard when the kernel shrinks", shrinks_to_the_hard_shadow),
    ("filtering keeps the mean", filtering_keeps_the_mean),
    ("the same in any view", views_do_not_matter),
    ("fallbacks agree", fallbacks_agree),
    ("a width in the world is texels of the view", widths_in_the_world_are_texels_of_the_view),
];

/// For each law, what it must reject.
fn broken() -> Vec<(&'static str, Law, Broken)> {
    vec![
        (
            "weights that sum to one but for rounding",
            stays_within_zero_and_one,
            Broken::saying("pcf", "plane), 1.0)", "plane), 2.0)").weights(1.000_001),
        ),
        (
            "empty texels that store zero",
            is_lit_without_casters,
            Broken::saying(
                "esm",
                "exp(esm_c() * depth), 0.0, 0.0",
                "select(exp(esm_c() * depth), 0.0, depth == 1.0), 0.0, 0.0",
            ),
        ),
        ("a series without offset", is_lit_without_casters, Broken::new("csm").setting("offset", 0.0)),
        (
            "the sign of d − z reversed",
            is_dark_behind_a_blocker,
            Broken::saying("esm", "exp(-esm_c() * depth) * filtered", "exp(esm_c() * depth) * filtered"),
        ),
        (
            "the sign of Eq. 11",
            is_dark_behind_a_blocker,
            Broken::saying("csm", "(basis.y * b.x - basis.x * b.y)", "(basis.x * b.y - basis.y * b.x)"),
        ),
        (
            "depth upside down",
            darkens_with_depth,
            Broken::saying("vsm", "vsm_bound(depth,", "vsm_bound(1.0 - depth,"),
        ),
        (
            "half a texel aside",
            shrinks_to_the_hard_shadow,
            Broken::saying(
                "pcf",
                "compare, uv, view",
                "compare, uv + vec2f(0.5) / vec2f(textureDimensions(casters)), view",
            ),
        ),
        (
            "no half texel towards the four texels' corner",
            shrinks_to_the_hard_shadow,
            Broken::saying("packed", "vec2f(0.5, -0.5)", "vec2f(1.5, -0.5)"),
        ),
        (
            "the first view's samples always",
            views_do_not_matter,
            Broken::saying("stratified", "view * LAYERS + layer", "layer"),
        ),
        (
            "the sum of points instead of their mean",
            stays_within_zero_and_one,
            Broken::saying("poisson", "min(lit / f32(poisson_points), 1.0)", "lit"),
        ),
        (
            "the neighbouring texel",
            shrinks_to_the_hard_shadow,
            Broken::saying("hard", "compare, centre, view", "compare, centre + 1.0 / size, view"),
        ),
        (
            "far too much variance",
            shrinks_to_the_hard_shadow,
            Broken::new("vsm").setting("least_variance", 0.01),
        ),
        (
            "a light that leaks at the receiver's own scale",
            is_dark_behind_a_blocker,
            Broken::saying("evsm.moments=two", "min(abs(warped), abs(moments.x))", "abs(warped)"),
        ),
        (
            "a warp whose order is reversed",
            is_lit_without_casters,
            Broken::saying("evsm", "-exp(-evsm_negative() * z)", "exp(-evsm_negative() * z)"),
        ),
        ("moments without bias", is_lit_without_casters, Broken::new("msm").setting("moment_bias", 0.0)),
        (
            "a root on the wrong side",
            is_dark_behind_a_blocker,
            Broken::saying("msm", "} else if x <= far {", "} else if x >= far {"),
        ),
        (
            "the receiver's interval without those before it",
            darkens_with_depth,
            Broken::saying(
                "lvsm",
                "bound = min(bound, lvsm_one(depth, moments.xy",
                "bound = min(1.0, lvsm_one(depth, moments.xy",
            ),
        ),
        (
            "planes upside down",
            shrinks_to_the_hard_shadow,
            Broken::saying(
                "spsm",
                "spsm_plane(words, at, size) + slack.z",
                "1.0 - spsm_plane(words, at, size)",
            ),
        ),
        (
            "the other side of a triangle",
            is_lit_without_casters,
            Broken::saying(
                "spsm",
                "if !packing_holds(words) {\n        return spsm_lit;",
                "if !packing_holds(words) {\n        return spsm_shadowed;",
            ),
        ),
        (
            "other weights where the width is fixed",
            widths_in_the_world_are_texels_of_the_view,
            Broken::new("vsm").weights(0.97),
        ),
        (
            "light between stored triangles",
            is_dark_behind_a_blocker,
            Broken::new("rgsm.missed=lit,neighbours=1"),
        ),
        (
            "shadow on the surface itself",
            shrinks_to_the_hard_shadow,
            Broken::saying("rgsm", "slack.xy / size, abs(at)) < depth", "slack.xy / size, abs(at)) > depth"),
        ),
        (
            "the first view's triangles",
            views_do_not_matter,
            Broken::saying("dpm", "shadow_corner(view, n", "shadow_corner(0u, n"),
        ),
        ("corners of the first view", views_do_not_matter, Broken::saying("exact", "3u * view + k", "k")),
        ("a blur that brightens", filtering_keeps_the_mean, Broken::new("vsm").weights(1.01)),
        (
            "the first view's layer always",
            views_do_not_matter,
            Broken::saying("esm", "map_sampler, uv, view, ddx", "map_sampler, uv, 0u, ddx"),
        ),
        (
            "the first view's depth always",
            views_do_not_matter,
            Broken::saying("pcf", "uv, view, depth", "uv, 0u, depth"),
        ),
        ("no interpolation on lesser devices", fallbacks_agree, Broken::new("vsm").with(careless)),
    ]
}

/// One texel where the shader should interpolate by itself.
fn careless(described: &mut Description) {
    if described.slots.contains(&"level_manual") {
        described.slots = vec!["lookup_nearest"];
        described.constants.retain(|constant| constant.name() != "blur_everywhere");
    }
}

fn main() {
    let mut trials = Trials::default();
    for (law, check) in LAWS {
        for spec in settings::variants() {
            trials.add(format!("{spec}: {law}"), move |gpu| {
                check(gpu, technique::parse(&spec).unwrap().as_ref()).unwrap();
            });
        }
    }
    for (what, law, broken) in broken() {
        let name = LAWS.iter().find(|(_, l)| std::ptr::fn_addr_eq(*l, law)).map_or("", |(name, _)| *name);
        trials.add(format!("rejected: {what} ({}; {name})", broken.about().name), move |gpu| {
            law(gpu, &broken).expect_err("a law must tell");
        });
    }
    for (spec, triangles, triangles_per_texel) in [("dpm", 1, 6), ("exact", 1, 6), ("exact", 1 << 14, 1)] {
        let name = format!("rejected: {triangles} triangles, {triangles_per_texel} per texel ({spec})");
        trials.add(name, move |gpu| {
            let technique = technique::parse(spec).unwrap();
            let capacity = Capacity { triangles, triangles_per_texel };
            is_dark_within(gpu, technique.as_ref(), capacity).expect_err("too little capacity must tell");
            is_dark_within(gpu, technique.as_ref(), Capacity { triangles: 1 << 14, triangles_per_texel: 6 })
                .expect("a square of three triangles in each of 64² texels");
        });
    }
    trials.run();
}
