//! What laws are tried on: maps, receivers, and what techniques say of themselves.

use crate::{
    Gpu,
    ask::{Random, Receiver},
};
use antumbra::{Capabilities, Description, Size, Technique, technique};
use glam::Vec2;

pub(super) const SIZE: Size = Size::square(64);

/// What a technique says of itself on a device.
pub(super) fn described(gpu: &Gpu, technique: &dyn Technique) -> Description {
    technique.describe(&Capabilities::of(&gpu.device)).unwrap()
}

/// Sets a parameter where there is one.
pub(super) fn try_set(technique: &mut dyn Technique, name: &str, value: &str) {
    if technique.parameters().iter().any(|p| p.name == name) {
        technique::set(technique, name, value).unwrap();
    }
}

/// What blocks of random depth a map is made of: flat within, so that no texel is a slope.
pub(super) fn blocks(seed: u64, side: u32) -> impl Fn(u32, u32) -> f32 {
    let mut random = Random::new(seed);
    let count = SIZE.width.div_ceil(side);
    let depths: Vec<f32> = (0..count * count).map(|_| random.unit()).collect();
    move |x, y| depths[(y / side * count + x / side) as usize]
}

pub(super) fn receivers(seed: u64, count: usize) -> Vec<Receiver> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let footprint = Vec2::new(random.range(-18.0, -3.0).exp2(), random.range(-18.0, -3.0).exp2());
            Receiver { footprint, ..Receiver::point(random.unit(), random.unit(), random.unit()) }
        })
        .collect()
}

pub(super) fn all_of<'a>(
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
