//! Leafless trees by space colonisation [Runions, Lane and Prusinkiewicz 2007, "Modeling trees with
//! a space colonization algorithm"]. Points scattered in the crown attract the nearest piece of wood;
//! each step, wood grows towards the mean of what attracts it, and points that it reaches vanish. So
//! branches fill the crown, keep apart and fork ever finer.
//!
//! Only the arithmetic that IEEE 754 rounds the same everywhere decides what grows, so a habit gives
//! the same number of triangles on every machine.

use super::{random::Random, tree};
use crate::Mesh;
use glam::Vec3;
use std::collections::HashMap;

/// What a tree looks like. Lengths are metres.
#[derive(Debug, Clone, Copy)]
pub(super) struct Habit {
    /// Chance of this tree. The same habit always grows the same tree.
    pub(super) seed: u64,
    /// Height at which the crown begins.
    pub(super) trunk: f32,
    /// Greatest half width along x, height, and greatest half width along z of the crown, which is
    /// widest at a third of its height.
    pub(super) crown: Vec3,
    /// Points that attract.
    pub(super) points: u32,
    /// Length that wood grows in one step.
    pub(super) step: f32,
    /// Distance within which a point attracts wood.
    pub(super) influence: f32,
    /// Distance within which wood has reached a point.
    pub(super) reach: f32,
    /// Radius of the finest twigs.
    pub(super) twig: f32,
}

/// Radius of a branch in radii of its twigs. Where branches fork, r^(16/7) of the whole is the sum of
/// its parts', a little more than what keeps the area (Runions et al. use exponents of 2 to 3). That
/// exponent needs square roots only.
fn thickness(twigs: u32) -> f32 {
    let fourth = (twigs as f32).sqrt().sqrt();
    let eighth = fourth.sqrt();
    fourth * eighth * eighth.sqrt()
}

/// A tree that stands on the origin and sinks a little below y = 0.
pub(super) fn grow(habit: &Habit) -> Mesh {
    let mut wood = colonise(habit);
    wood.smooth();
    wood.mesh(habit.twig)
}

/// Joints of the branches; each but the first grows from an earlier one.
#[derive(Debug, Default)]
struct Wood {
    joints: Vec<Vec3>,
    parents: Vec<usize>,
}

/// The points not yet reached.
#[derive(Debug)]
struct Crown {
    points: Vec<Vec3>,
    /// Nearest joint and its squared distance, for points that attract; `None` once reached.
    nearest: Vec<Option<(usize, f32)>>,
    /// Numbers of the points in each cube with edges of the influence's length.
    cells: HashMap<[i32; 3], Vec<u32>>,
    influence: f32,
}

impl Crown {
    fn new(habit: &Habit, random: &mut Random) -> Self {
        let lobes: [(Vec3, f32); 18] = std::array::from_fn(|_| {
            let center = Vec3::new(random.around(0.75), random.between(0.1, 0.85), random.around(0.75));
            (center, random.between(0.25, 0.5))
        });
        let mut points = Vec::new();
        while points.len() < habit.points as usize {
            let p = Vec3::new(random.around(1.0), random.between(0.0, 1.0), random.around(1.0));
            // 27/4 · t(1 − t)² is 1 at t = 1/3 and 0 at both ends.
            let edge = 6.75 * p.y * (1.0 - p.y) * (1.0 - p.y);
            let share = (p.x * p.x + p.z * p.z) / edge.max(1e-6);
            // Bunches of twigs with gaps between them, denser outside, where the light is.
            let bunched = lobes.iter().any(|(center, radius)| center.distance_squared(p) < radius * radius);
            let chance = if bunched { 0.35 + 0.65 * share } else { 0.02 };
            if share < 1.0 && random.between(0.0, 1.0) < chance {
                points.push(p * habit.crown + Vec3::Y * habit.trunk);
            }
        }
        let mut cells: HashMap<[i32; 3], Vec<u32>> = HashMap::new();
        for (&point, i) in points.iter().zip(0..) {
            cells.entry(Self::cell(point, habit.influence)).or_default().push(i);
        }
        let nearest = vec![Some((usize::MAX, f32::INFINITY)); points.len()];
        Self { points, nearest, cells, influence: habit.influence }
    }

    fn cell(point: Vec3, size: f32) -> [i32; 3] {
        (point / size).floor().as_ivec3().to_array()
    }

    /// Tells the points around of a new joint. Those within its reach vanish.
    fn notice(&mut self, joint: usize, at: Vec3, reach: f32) {
        let [x, y, z] = Self::cell(at, self.influence);
        let around = |n: i32| n - 1..=n + 1;
        for cell in around(x).flat_map(|x| around(y).flat_map(move |y| around(z).map(move |z| [x, y, z]))) {
            for &point in self.cells.get(&cell).map_or(&[][..], Vec::as_slice) {
                let distance = at.distance_squared(self.points[point as usize]);
                let nearest = &mut self.nearest[point as usize];
                if distance < reach * reach {
                    *nearest = None;
                } else if nearest.is_some_and(|(_, d)| distance < d)
                    && distance < self.influence * self.influence
                {
                    *nearest = Some((joint, distance));
                }
            }
        }
    }

    /// The sum of the directions to all points that each joint attracts.
    fn pulls(&self, joints: &[Vec3]) -> Vec<Vec3> {
        let mut pulls = vec![Vec3::ZERO; joints.len()];
        for (point, nearest) in self.points.iter().zip(&self.nearest) {
            if let Some((joint, _)) = nearest.filter(|(_, d)| d.is_finite()) {
                pulls[joint] += (point - joints[joint]).normalize_or_zero();
            }
        }
        pulls
    }

    /// Forgets the points that attract a joint which cannot follow.
    fn forget(&mut self, joint: usize) {
        for nearest in &mut self.nearest {
            if nearest.is_some_and(|(j, _)| j == joint) {
                *nearest = None;
            }
        }
    }
}

fn colonise(habit: &Habit) -> Wood {
    let mut random = Random::new(habit.seed);
    let mut crown = Crown::new(habit, &mut random);
    let mut wood = Wood::default();
    let mut children: Vec<Vec<usize>> = Vec::new();
    let add = |wood: &mut Wood, crown: &mut Crown, parent: usize, at: Vec3| {
        let joint = wood.joints.len();
        wood.joints.push(at);
        wood.parents.push(parent);
        crown.notice(joint, at, habit.reach);
        joint
    };
    // The trunk climbs until something attracts it.
    let mut at = Vec3::new(0.0, -0.1, 0.0);
    let mut top = add(&mut wood, &mut crown, 0, at);
    let mut direction = Vec3::Y;
    while at.y < habit.trunk + 0.1 * habit.crown.y {
        let bend = Vec3::new(random.around(0.12), 0.05, random.around(0.12));
        direction = (direction + bend).normalize();
        at += direction * habit.step;
        top = add(&mut wood, &mut crown, top, at);
    }
    loop {
        children.resize(wood.joints.len(), Vec::new());
        let pulls = crown.pulls(&wood.joints);
        let mut grown = false;
        for (joint, pull) in pulls.into_iter().enumerate().filter(|(_, pull)| *pull != Vec3::ZERO) {
            let stray = Vec3::new(random.around(0.2), random.around(0.2) + 0.08, random.around(0.2));
            let at = wood.joints[joint] + (pull.normalize_or_zero() + stray).normalize_or_zero() * habit.step;
            // Between points that pull apart wood would grow back and forth for ever.
            let near = |&c: &usize| wood.joints[c].distance_squared(at) < 0.2 * habit.step * habit.step;
            if children[joint].len() >= 3 || children[joint].iter().any(near) {
                crown.forget(joint);
            } else {
                let child = add(&mut wood, &mut crown, joint, at);
                children[joint].push(child);
            }
            grown = true;
        }
        if !grown {
            return wood;
        }
    }
}

impl Wood {
    /// For each joint, the number of twigs that end beyond it.
    fn twigs(&self) -> Vec<u32> {
        let mut twigs = vec![0; self.joints.len()];
        for joint in (0..twigs.len()).rev() {
            twigs[joint] = twigs[joint].max(1);
            if joint > 0 {
                twigs[self.parents[joint]] += twigs[joint];
            }
        }
        twigs
    }

    /// For each joint, the child that carries on the branch: the one with the most twigs.
    fn leaders(&self, twigs: &[u32]) -> Vec<Option<usize>> {
        let mut leaders: Vec<Option<usize>> = vec![None; self.joints.len()];
        for joint in 1..self.joints.len() {
            let leader = &mut leaders[self.parents[joint]];
            if leader.is_none_or(|other| twigs[joint] > twigs[other]) {
                *leader = Some(joint);
            }
        }
        leaders
    }

    /// Takes the zigzag out of branches.
    fn smooth(&mut self) {
        let leaders = self.leaders(&self.twigs());
        for _ in 0..3 {
            let old = self.joints.clone();
            for joint in 1..old.len() {
                if let Some(next) = leaders[joint] {
                    self.joints[joint] = old[joint] * 0.5 + (old[self.parents[joint]] + old[next]) * 0.25;
                }
            }
        }
    }

    /// One tube for each branch, from its parent's axis to its tip. Joints that lie closer than the
    /// branch is thick are left out: there a tube would fold.
    fn mesh(&self, twig: f32) -> Mesh {
        let twigs = self.twigs();
        let leaders = self.leaders(&twigs);
        let mut mesh = Mesh::default();
        for start in 0..self.joints.len() {
            let parent = self.parents[start];
            if start > 0 && leaders[parent] == Some(start) {
                continue;
            }
            // The foot of the trunk widens to the roots.
            let radius = |joint: usize, at: Vec3| {
                let roots = 1.0 + 0.5 / (1.0 + 60.0 * at.y.max(0.0) * at.y.max(0.0));
                twig * thickness(twigs[joint]) * if start == 0 { roots } else { 1.0 }
            };
            let first = self.joints[parent];
            let mut spine = vec![(first, radius(start, first))];
            let mut next = if start == 0 { leaders[0] } else { Some(start) };
            while let Some(joint) = next {
                let at = self.joints[joint];
                next = leaders[joint];
                let (before, thick) = spine[spine.len() - 1];
                if next.is_none() || before.distance_squared(at) > (1.5 * thick + 6.0 * twig).powi(2) {
                    spine.push((at, radius(joint, at)));
                }
            }
            if spine.len() > 1 {
                tree::tube(&mut mesh, &spine, sides(twigs[start]));
            }
        }
        mesh
    }
}

/// Sides of a branch with that many twigs.
fn sides(twigs: u32) -> u32 {
    match twigs {
        0..=2 => 4,
        3..=12 => 5,
        13..=60 => 7,
        61..=300 => 10,
        _ => 18,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const HABIT: Habit = Habit {
        seed: 3,
        trunk: 1.0,
        crown: Vec3::new(1.0, 1.5, 1.2),
        points: 300,
        step: 0.08,
        influence: 0.6,
        reach: 0.16,
        twig: 0.004,
    };

    #[test]
    fn wood_fills_the_crown() {
        let wood = colonise(&HABIT);
        let mut random = Random::new(HABIT.seed);
        let crown = Crown::new(&HABIT, &mut random);
        let reached = |p: &&Vec3| wood.joints.iter().any(|j| j.distance(**p) < 2.0 * HABIT.reach);
        let share = crown.points.iter().filter(reached).count() as f32 / crown.points.len() as f32;
        assert!(share > 0.97, "{share}");
        let twigs = wood.twigs()[0];
        assert!((20..300).contains(&twigs), "{twigs}");
    }

    #[test]
    fn branches_grow_by_steps_and_thin_out() {
        let wood = colonise(&HABIT);
        let twigs = wood.twigs();
        for joint in 1..wood.joints.len() {
            let parent = wood.parents[joint];
            assert!(parent < joint && twigs[parent] >= twigs[joint]);
            assert!((wood.joints[joint].distance(wood.joints[parent]) - HABIT.step).abs() < 1e-3);
        }
    }

    #[test]
    fn habits_decide() {
        let count = |seed| grow(&Habit { seed, ..HABIT }).indices.len();
        assert_eq!(count(3), count(3));
        assert_ne!(count(3), count(4));
    }
}
