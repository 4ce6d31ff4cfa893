//! Polygons to triangles.

use earcut::Earcut;
use glam::{DVec2, DVec3};

/// What became of a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Filled {
    /// Its triangles have its area.
    Whole,
    /// It has no area of its own, or its outline crosses itself.
    Crossed,
}

/// Cuts polygons into triangles; keeps its memory from one to the next.
#[derive(Default)]
pub(super) struct Cutter {
    ears: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    triangles: Vec<u32>,
}

/// A corner turns inwards if its sine is less than this: what single precision makes of a straight one.
const STRAIGHT: f64 = -1e-6;
/// Triangles may have this much less or more area than their polygon, as a share.
const ROUNDING: f64 = 1e-6;

impl Cutter {
    /// The triangles of a polygon, as numbers of its corners, with its sense of rotation. Convex ones become
    /// a fan around their first corner; others lose their ears one by one, seen along their normal.
    pub(super) fn cut(&mut self, corners: &[DVec3]) -> (&[u32], Filled) {
        self.triangles.clear();
        let fan = |triangles: &mut Vec<u32>| {
            triangles.extend((2..corners.len() as u32).flat_map(|i| [0, i - 1, i]));
        };
        if corners.len() <= 3 {
            fan(&mut self.triangles);
            return (&self.triangles, Filled::Whole);
        }
        // Newell's normal: twice the area, whatever the shape.
        let around = || (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
        let normal = around().fold(DVec3::ZERO, |sum, (a, b)| sum + (a - corners[0]).cross(b - corners[0]));
        let Some(axis) = normal.try_normalize() else {
            fan(&mut self.triangles);
            return (&self.triangles, Filled::Crossed);
        };
        if is_convex(corners, axis) {
            fan(&mut self.triangles);
            return (&self.triangles, Filled::Whole);
        }
        let (right, up) = axis.any_orthonormal_pair();
        self.flat.clear();
        self.flat.extend(corners.iter().map(|p| {
            let arm = *p - corners[0];
            [arm.dot(right), arm.dot(up)]
        }));
        self.ears.earcut(self.flat.iter().copied(), &[], &mut self.triangles);
        let mut area = 0.0;
        for triangle in self.triangles.chunks_exact_mut(3) {
            let [a, b, c] = [0, 1, 2].map(|k| DVec2::from(self.flat[triangle[k] as usize]));
            let twice = (b - a).perp_dot(c - a);
            if twice < 0.0 {
                triangle.swap(1, 2);
            }
            area += twice.abs();
        }
        let whole = normal.length();
        let filled = if (area - whole).abs() <= ROUNDING * whole { Filled::Whole } else { Filled::Crossed };
        (&self.triangles, filled)
    }
}

/// Whether no corner turns inwards, seen against the normal.
fn is_convex(corners: &[DVec3], axis: DVec3) -> bool {
    let count = corners.len();
    // Corners that lie on one another have no direction between them.
    let mut edges = (0..count).map(|i| corners[(i + 1) % count] - corners[i]).filter(|e| *e != DVec3::ZERO);
    let Some(first) = edges.next() else { return true };
    let mut last = first;
    edges.chain([first]).all(|edge| {
        let turn = last.cross(edge).dot(axis);
        let straight = STRAIGHT * last.length() * edge.length();
        let back = last.dot(edge) < 0.0 && turn.abs() <= -straight;
        last = edge;
        turn >= straight && !back
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(corners: &[DVec3], triangles: &[u32]) -> f64 {
        let sum = triangles.chunks_exact(3).map(|t| {
            let [a, b, c] = [0, 1, 2].map(|k| corners[t[k] as usize]);
            0.5 * (b - a).cross(c - a)
        });
        sum.fold(DVec3::ZERO, |sum, n| sum + n).length()
    }

    /// Area of the triangles, each counted as positive.
    fn covered(corners: &[DVec3], triangles: &[u32]) -> f64 {
        triangles.chunks_exact(3).map(|t| area(corners, t)).sum()
    }

    fn tilted(outline: &[[f64; 2]]) -> Vec<DVec3> {
        let turn = glam::DQuat::from_rotation_x(0.7) * glam::DQuat::from_rotation_y(-1.1);
        outline.iter().map(|[x, y]| turn * DVec3::new(*x, *y, 3.0)).collect()
    }

    #[test]
    fn concave_outlines_keep_their_area() {
        let u =
            [[0.0, 0.0], [6.0, 0.0], [6.0, 4.0], [5.0, 4.0], [5.0, 1.0], [1.0, 1.0], [1.0, 4.0], [0.0, 4.0]];
        let arrow = [[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [0.5, 1.0]];
        // Corners on edges, and twice in the same place.
        let doubled = [
            [0.0, 0.0],
            [3.0, 0.0],
            [6.0, 0.0],
            [6.0, 4.0],
            [6.0, 4.0],
            [5.0, 4.0],
            [5.0, 1.0],
            [3.0, 1.0],
            [1.0, 1.0],
            [1.0, 4.0],
            [0.0, 4.0],
            [0.0, 2.0],
        ];
        // A square with a square hole, which a bridge joins to the outline.
        let hole = [
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, 4.0],
            [0.0, 4.0],
            [0.0, 0.0],
            [1.0, 1.0],
            [1.0, 3.0],
            [3.0, 3.0],
            [3.0, 1.0],
            [1.0, 1.0],
        ];
        for (outline, expected) in
            [(&u[..], 12.0), (&arrow[..], 1.5), (&doubled[..], 12.0), (&hole[..], 12.0)]
        {
            for reversed in [false, true] {
                let mut corners = tilted(outline);
                if reversed {
                    corners.reverse();
                }
                for first in 0..corners.len() {
                    corners.rotate_left(1);
                    let mut cutter = Cutter::default();
                    let (triangles, filled) = cutter.cut(&corners);
                    assert_eq!(filled, Filled::Whole, "{outline:?} from {first}");
                    // Covered once, and all triangles on the side of the polygon.
                    assert!(
                        (covered(&corners, triangles) - expected).abs() < 1e-9,
                        "{outline:?} from {first}"
                    );
                    assert!((area(&corners, triangles) - expected).abs() < 1e-9, "{outline:?} from {first}");
                }
            }
        }
    }

    #[test]
    fn convex_outlines_are_fans_and_bent_ones_keep_their_shadow() {
        let square = tilted(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        assert_eq!(Cutter::default().cut(&square), (&[0, 1, 2, 0, 2, 3][..], Filled::Whole));
        // A concave quad whose corner is lifted out of the plane.
        let bent =
            [DVec3::ZERO, DVec3::new(2.0, 1.0, 0.2), DVec3::new(0.0, 2.0, 0.0), DVec3::new(0.5, 1.0, 0.0)];
        let mut cutter = Cutter::default();
        let (triangles, filled) = cutter.cut(&bent);
        assert!(filled == Filled::Whole && triangles.len() == 6);
        assert!(
            triangles.chunks(3).all(|t| t.contains(&3) && t.contains(&1)),
            "split at the dent: {triangles:?}"
        );
    }

    #[test]
    fn outlines_that_cross_themselves_are_told_apart() {
        let bow = [[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 2.0]];
        let uneven = [[0.0, 0.0], [3.0, 3.0], [3.0, 0.0], [0.0, 1.0]];
        for outline in [bow, uneven] {
            let mut cutter = Cutter::default();
            assert_eq!(cutter.cut(&tilted(&outline)).1, Filled::Crossed, "{outline:?}");
        }
        let line = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]];
        let corners = tilted(&line);
        let mut cutter = Cutter::default();
        let (triangles, _) = cutter.cut(&corners);
        assert!(covered(&corners, triangles) < 1e-9);
    }
}
