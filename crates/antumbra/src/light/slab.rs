//! The least range of depth: planes of equal depth that lean.
//!
//! Depth along parallel light may lean: a coordinate across the light, times a constant, added to it keeps the order
//! of all points on a ray and the world length that a step of depth has along it. Among all such depths the least
//! range over a convex body is as long as the longest way of a ray through the body (they are each other's dual as
//! linear programs), and its ends touch the body.

use glam::{DVec2, DVec3};

/// Steepest planes of equal depth, as depth per length across: 84° to the plane at right angles to the light.
const STEEPEST: f64 = 10.0;
/// Planes that are tried: a dozen finds the least range of a box cut by a frustum.
const TRIALS: usize = 48;

/// The lean with the least range: what depth (z) gains per length along x and y.
pub(super) fn lean(points: impl Iterator<Item = DVec3> + Clone) -> DVec2 {
    let range = |lean: DVec2| widest(points.clone(), lean);
    let level = range(DVec2::ZERO);
    let mut best = (level.dot(DVec3::Z), DVec2::ZERO);
    // The range is the greatest of linear functions of the lean, one for each pair of points. Three that rise in
    // directions around the origin have a least value, which only the greatest of all at that place can raise. The
    // first three are no pairs: they keep the lean within a triangle.
    let size = level.length().max(f64::MIN_POSITIVE);
    let corner =
        |third: f64| DVec2::from_angle(third * std::f64::consts::TAU / 3.0).extend(-0.5 * STEEPEST) * size;
    let mut three = [0.0, 1.0, 2.0].map(corner);
    for _ in 0..TRIALS {
        let Some((lean, least)) = lowest(&three) else { break };
        let found = range(lean);
        let value = found.dot(lean.extend(1.0));
        if value < best.0 {
            best = (value, lean);
        }
        if best.0 - least <= 1e-6 * level.z {
            break;
        }
        three = around_origin(&three, found);
    }
    best.1
}

/// From the point of least to that of greatest leaning depth: what makes the range.
fn widest(points: impl Iterator<Item = DVec3>, lean: DVec2) -> DVec3 {
    let depth = |p: DVec3| p.dot(lean.extend(1.0));
    let start = [(f64::INFINITY, DVec3::ZERO), (f64::NEG_INFINITY, DVec3::ZERO)];
    let [low, high] = points.fold(start, |[low, high], p| {
        let d = depth(p);
        [if d < low.0 { (d, p) } else { low }, if d > high.0 { (d, p) } else { high }]
    });
    high.1 - low.1
}

/// Where three functions z + x·a + y·b are equal, (a, b), and their value there.
fn lowest(three: &[DVec3; 3]) -> Option<(DVec2, f64)> {
    let [p, q, r] = *three;
    let normal = (q - p).cross(r - p);
    let lean = normal.truncate() / normal.z;
    lean.is_finite().then(|| (lean, p.dot(lean.extend(1.0))))
}

/// The three with `new` for one of them, so that the origin still lies between their places across.
fn around_origin(three: &[DVec3; 3], new: DVec3) -> [DVec3; 3] {
    let least_share = |t: &[DVec3; 3]| {
        let [p, q, r] = t.map(DVec3::truncate);
        let shares = DVec3::new(p.perp_dot(q), q.perp_dot(r), r.perp_dot(p));
        let least = (shares / shares.element_sum()).min_element();
        if least.is_finite() { least } else { f64::NEG_INFINITY }
    };
    let swapped = [0, 1, 2].map(|i| {
        let mut t = *three;
        t[i] = new;
        t
    });
    let [a, b, c] = swapped.each_ref().map(least_share);
    swapped[if a >= b && a >= c {
        0
    } else if b >= c {
        1
    } else {
        2
    }]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners of a box, turned about two axes.
    fn corners(size: DVec3, turn: f64, tilt: f64) -> Vec<DVec3> {
        let rotation = glam::DQuat::from_rotation_x(tilt) * glam::DQuat::from_rotation_z(turn);
        let end = |i: u32| if i & 1 == 0 { -0.5 } else { 0.5 };
        let corner = |i: u32| rotation * (DVec3::new(end(i), end(i >> 1), end(i >> 2)) * size);
        (0..8).map(|i| corner(i) + DVec3::new(30.0, -20.0, 5.0)).collect()
    }

    fn range(points: &[DVec3], lean: DVec2) -> f64 {
        widest(points.iter().copied(), lean).dot(lean.extend(1.0))
    }

    #[test]
    fn the_range_of_a_box_is_its_thickness_along_the_light() {
        for (turn, tilt) in [(0.0, 0.0), (0.3, 0.9), (1.0, 1.2), (0.7, -0.5), (0.0, 1.3)] {
            // A wide flat box: rays go through floor and ceiling.
            let points = corners(DVec3::new(40.0, 40.0, 5.0), turn, tilt);
            let found = range(&points, lean(points.iter().copied()));
            let expected = 5.0 / tilt.cos();
            assert!((found - expected).abs() < 1e-5 * expected, "{turn} {tilt}: {found} for {expected}");
            let level = range(&points, DVec2::ZERO);
            assert!(tilt == 0.0 || level > 1.5 * found, "negative control: {level}");
        }
    }

    #[test]
    fn no_lean_nearby_has_a_shorter_range() {
        for i in 0..40 {
            let t = f64::from(i);
            let points = corners(DVec3::new(7.0, 3.0 + t, 2.0), 0.37 * t, 0.11 * t);
            let least = lean(points.iter().copied());
            let found = range(&points, least);
            for turn in 0..16 {
                let near = least + DVec2::from_angle(f64::from(turn)) * 1e-3;
                assert!(range(&points, near) >= found * (1.0 - 1e-6), "{i}: {near}");
            }
        }
    }

    #[test]
    fn flat_thin_and_single_points_have_a_lean_that_is_bounded() {
        let flat = corners(DVec3::new(4.0, 4.0, 0.0), 0.2, 1.0);
        let edge_on = corners(DVec3::new(4.0, 4.0, 0.0), 0.2, std::f64::consts::FRAC_PI_2);
        let thin = corners(DVec3::new(4.0, 0.0, 0.0), 0.2, 0.5);
        let one = corners(DVec3::ZERO, 0.0, 0.0);
        for points in [flat, edge_on, thin, one] {
            let found = lean(points.iter().copied());
            assert!(found.length() <= 1.5 * STEEPEST, "{found}");
            assert!(range(&points, found) <= range(&points, DVec2::ZERO) + 1e-12);
        }
    }
}
