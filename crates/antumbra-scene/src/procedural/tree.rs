//! Leafless trees: tapered, bent tubes that branch a fixed number of times, so that every seed gives
//! the same number of triangles.

use super::{random::Random, shapes::vertex};
use crate::Mesh;
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;

/// How the branches of one generation look.
#[derive(Debug, Clone, Copy)]
pub(super) struct Generation {
    /// Branches that grow from each branch of the generation before (1 for the trunk).
    pub(super) count: u32,
    /// Straight pieces of a branch.
    pub(super) pieces: u32,
    /// Sides of its cross section.
    pub(super) sides: u32,
    /// Length relative to the parent; metres for the trunk.
    pub(super) length: f32,
    /// Angle to the parent, radians.
    pub(super) spread: f32,
}

/// A branch about to grow.
#[derive(Debug, Clone, Copy)]
struct Bud {
    base: Vec3,
    direction: Vec3,
    length: f32,
    radius: f32,
}

/// A tree that stands on the origin and sinks a little below y = 0.
pub(super) fn grow(generations: &[Generation], radius: f32, random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    if let Some((trunk, rest)) = generations.split_first() {
        let base = Vec3::new(0.0, -0.1, 0.0);
        let bud = Bud { base, direction: Vec3::Y, length: trunk.length, radius };
        branch(&mut mesh, bud, trunk, rest, random);
    }
    mesh
}

fn branch(mesh: &mut Mesh, bud: Bud, this: &Generation, rest: &[Generation], random: &mut Random) {
    let spine = spine(bud, this.pieces, random);
    tube(mesh, &spine, this.sides);
    let Some((next, later)) = rest.split_first() else { return };
    let turn = random.between(0.0, TAU);
    for i in 0..next.count {
        // Children leave the upper two thirds, turned by the golden angle, longer lower down.
        let along = 0.35 + 0.62 * (i as f32 + random.between(0.2, 0.8)) / next.count as f32;
        let place = along * this.pieces as f32;
        let piece = (place as usize).min(spine.len() - 2);
        let ((a, from), (b, to)) = (spine[piece], spine[piece + 1]);
        let f = place - piece as f32;
        let axis = (b - a).normalize();
        let side = Quat::from_axis_angle(axis, turn + i as f32 * 2.399_963) * axis.any_orthonormal_vector();
        let angle = next.spread * random.between(0.75, 1.25);
        let child = Bud {
            base: a.lerp(b, f),
            direction: (axis * angle.cos() + side * angle.sin()).normalize(),
            length: bud.length * next.length * (1.25 - 0.5 * along) * random.between(0.85, 1.15),
            radius: (from + (to - from) * f) * 0.62,
        };
        branch(mesh, child, next, later, random);
    }
}

/// Points and radii along a branch: it wanders a little and turns towards the sky.
fn spine(bud: Bud, pieces: u32, random: &mut Random) -> Vec<(Vec3, f32)> {
    let mut at = bud.base;
    let mut direction = bud.direction;
    let mut points = vec![(at, bud.radius)];
    for i in 1..=pieces {
        let wander = Vec3::new(random.around(1.0), random.around(1.0), random.around(1.0)) * 0.16;
        direction = (direction + wander + Vec3::Y * 0.06).normalize();
        at += direction * (bud.length / pieces as f32);
        let along = i as f32 / pieces as f32;
        points.push((at, bud.radius * (1.0 - 0.8 * along)));
    }
    points
}

/// A tube around the spine that ends in a point.
pub(super) fn tube(mesh: &mut Mesh, spine: &[(Vec3, f32)], sides: u32) {
    let direction = |i: usize| {
        let (a, b) = (spine[i.saturating_sub(1)].0, spine[(i + 1).min(spine.len() - 1)].0);
        (b - a).normalize()
    };
    let mut side = direction(0).any_orthonormal_vector();
    let mut previous = 0;
    for (i, &(center, radius)) in spine.iter().enumerate() {
        let axis = direction(i);
        side = (side - axis * side.dot(axis)).normalize();
        let up = axis.cross(side);
        let first = mesh.positions.len() as u32;
        let tip = i + 1 == spine.len();
        for s in 0..=sides {
            let (sin, cos) = (TAU * (s % sides) as f32 / sides as f32).sin_cos();
            let normal = side * cos + up * sin;
            let uv = Vec2::new(s as f32 / sides as f32, i as f32);
            vertex(mesh, if tip { center } else { center + normal * radius }, normal, uv);
        }
        if i > 0 {
            for s in 0..sides {
                mesh.indices.extend([previous + s, previous + s + 1, first + s + 1]);
                if !tip {
                    mesh.indices.extend([previous + s, first + s + 1, first + s]);
                }
            }
        }
        previous = first;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_do_not_depend_on_chance() {
        let generation = |count, length| Generation { count, pieces: 3, sides: 5, length, spread: 0.7 };
        let generations = [generation(1, 2.0), generation(4, 0.5), generation(3, 0.5)];
        for seed in 0..5 {
            let mesh = grow(&generations, 0.1, &mut Random::new(seed));
            assert_eq!(mesh.indices.len() / 3, (1 + 4 + 12) * 5 * (2 * 3 - 1));
            assert!(mesh.positions.iter().all(|p| p.is_finite()));
        }
    }
}
