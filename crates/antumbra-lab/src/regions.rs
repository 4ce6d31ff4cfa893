//! Parts of a picture where techniques are known to differ.

use antumbra_scene::Light;
use antumbra_truth::{Hit, Ray, Tracer};
use glam::DVec3;
use rayon::prelude::*;

/// Masks over a picture's pixels, by name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Region {
    /// `contact` or `layers`.
    pub name: &'static str,
    /// One entry per pixel, row by row.
    pub pixels: Vec<bool>,
}

/// What lies between a receiver and the light.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Blockers {
    None,
    /// The first one is near.
    Contact,
    /// The first one is far, and alone.
    One,
    /// Further ones lie well beyond the first.
    Several,
}

/// Contact: shadowed pixels whose blocker is within `near` (world units, for a point in the world) of the
/// receiver, where approximations of the shadow test have no room to fall off. Layers: shadowed pixels with
/// two blockers or more, at least `near` apart, where a kernel sees several depths.
#[must_use]
pub fn regions(
    tracer: &Tracer<'_>,
    hits: &[Hit],
    shadowable: &[bool],
    light: &Light,
    near: &(dyn Fn(DVec3) -> f64 + Sync),
) -> Vec<Region> {
    let classes: Vec<Blockers> = hits
        .par_iter()
        .zip(shadowable)
        .map(|(hit, shadowable)| match shadowable {
            true => blockers(tracer, hit, light, near(hit.position)),
            false => Blockers::None,
        })
        .collect();
    let region = |name, class| Region { name, pixels: classes.iter().map(|c| *c == class).collect() };
    vec![region("contact", Blockers::Contact), region("layers", Blockers::Several)]
}

fn blockers(tracer: &Tracer<'_>, hit: &Hit, light: &Light, near: f64) -> Blockers {
    let (direction, distance) = match *light {
        Light::Directional { direction } => (-direction.as_dvec3().normalize(), f64::INFINITY),
        Light::Spot { position, .. } => {
            let arm = position.as_dvec3() - hit.position;
            (arm.normalize(), arm.length())
        }
    };
    // A start well above the receiver's own facets: this sorts pixels, it does not judge them.
    let mut origin = hit.position + hit.normal * (1e-3 * near);
    let mut first: Option<f64> = None;
    for _ in 0..16 {
        let next = tracer.trace(&Ray { origin, direction });
        let height = next.position.distance(hit.position);
        if !next.is_hit() || height >= distance {
            break;
        }
        match first {
            None if height < near => return Blockers::Contact,
            None => first = Some(height),
            Some(lowest) if height > lowest + near => return Blockers::Several,
            Some(_) => {}
        }
        origin = next.position + direction * (1e-4 * near).max(f64::EPSILON * max_abs(next.position));
    }
    if first.is_some() { Blockers::One } else { Blockers::None }
}

fn max_abs(p: DVec3) -> f64 {
    p.abs().max_element() * 16.0
}
