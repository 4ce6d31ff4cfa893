//! Laws of what `shadow_visibility` answers.

use super::cases::{SIZE, all_of, blocks, described, receivers, try_set};
use crate::{
    Gpu,
    ask::{self, Random, Receiver, depth_layers, depth_texture, shadow_map, shadow_map_of, visibility},
};
use antumbra::{Capacity, Options, Technique, View, technique::CasterStorage};
use glam::{Mat4, Vec3};

/// Visibility is 0 to 1, and not by a rounding beyond: weights that sum to one in f32 may.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn stays_within_zero_and_one(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    for side in [1, 5] {
        let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(1, side)), SIZE.into());
        let receivers = receivers(2, 4096);
        let results = visibility(gpu, &shadows, &receivers);
        all_of(receivers.iter().zip(results), |_, v| (0.0..=1.0).contains(&v))?;
    }
    Ok(())
}

/// Receivers without casters are lit, up to the far plane itself, where they touch what an empty texel stores.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn is_lit_without_casters(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, |_, _| 1.0), SIZE.into());
    let receivers: Vec<_> = (0..=256).map(|i| Receiver::point(0.3, 0.6, i as f32 / 256.0)).collect();
    let least = 0.999 - described(gpu, technique).ringing;
    all_of(receivers.iter().zip(visibility(gpu, &shadows, &receivers)), |_, v| v >= least)
}

/// Receivers well behind a blocker that fills the map are dark.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn is_dark_behind_a_blocker(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    is_dark_within(gpu, technique, Capacity::default())
}

/// The same in a map of such capacity.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn is_dark_within(gpu: &Gpu, technique: &dyn Technique, capacity: Capacity) -> Result<(), String> {
    let options = Options::from(SIZE).capacity(capacity);
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, |_, _| 0.2), options);
    let receivers: Vec<_> =
        (0..=256).map(|i| Receiver::point(0.7, 0.4, 0.7 + 0.3 * i as f32 / 256.0)).collect();
    let most = described(gpu, technique).ringing + 1e-4;
    all_of(receivers.iter().zip(visibility(gpu, &shadows, &receivers)), |_, v| v <= most)
}

/// Visibility falls with the receiver's depth where techniques say so; ripples may rise by their whole height
/// once, up to rounding.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn darkens_with_depth(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    const STEPS: usize = 64;
    let described = described(gpu, technique);
    if !described.monotonic {
        return Ok(());
    }
    let shadows = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, blocks(3, 3)), SIZE.into());
    // Silhouettes of triangles that are not kept are guesses, which differ with what is in front.
    let centred = |r: Receiver| match described.storage {
        CasterStorage::NearestTriangle(_) => Receiver { uv: ((r.uv * 64.0).floor() + 0.5) / 64.0, ..r },
        _ => r,
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

/// Without blur and interpolation, at texel centres, out of the approximation's own ramp, visibility is that of
/// the hard shadow. A kernel that cannot be narrowed sees one depth where it lies within one block.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn shrinks_to_the_hard_shadow(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
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
    // Bias takes some depth, too.
    let ramp = described(gpu, narrow.as_ref()).ramp.max(0.1);
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
        return if ramp > 0.5 { Ok(()) } else { Err(format!("no receiver is out of a ramp of {ramp}")) };
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

/// The same depth gives the same visibility in the second layer of a two-view map, behind a first view that looks
/// elsewhere: beside the receivers, or only beyond them, so that they are in front of its near plane.
///
/// # Errors
/// Where not: a visibility or what else is wrong.
pub fn views_do_not_matter(gpu: &Gpu, technique: &dyn Technique) -> Result<(), String> {
    let map = blocks(8, 4);
    let alone = shadow_map(gpu, technique, &depth_texture(gpu, SIZE, &map), SIZE.into());
    let depth =
        depth_layers(gpu, SIZE, 2, |layer, x, y| if layer == 1 { map(x, y) } else { 1.0 - map(x, y) });
    let receivers = receivers(9, 1024);
    let expected = visibility(gpu, &alone, &receivers);
    let here = ask::view(SIZE);
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
