//! Ray against triangle, without cracks.

use crate::Ray;
use glam::DVec3;

/// Corners in world space.
pub(crate) type Corners = [[f32; 3]; 3];

/// Where a ray meets a triangle with corners a, b, c: at `t` along the ray, and at
/// a + `u` (b − a) + `v` (c − a).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Meeting {
    pub(crate) t: f64,
    pub(crate) u: f64,
    pub(crate) v: f64,
}

/// A ray made ready for many triangles: the shear and scale that turn it into the z axis
/// (Woop, Benthin, Wald 2013, "Watertight Ray/Triangle Intersection", here in f64).
///
/// The signs of the three edge functions decide. Both triangles at an edge compute the edge's
/// function from the same sheared corners, with exactly opposite results, and zero counts as
/// inside for both: no ray passes between them. Either winding is hit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Shear {
    origin: [f64; 3],
    axes: [usize; 3],
    shear: [f64; 2],
    scale: f64,
}

impl Shear {
    pub(crate) fn new(ray: &Ray) -> Self {
        let direction = ray.direction.to_array();
        let size = ray.direction.abs();
        let z = if size.x >= size.y && size.x >= size.z {
            0
        } else if size.y >= size.z {
            1
        } else {
            2
        };
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        Self {
            origin: ray.origin.to_array(),
            axes,
            shear: [direction[axes[0]] / direction[z], direction[axes[1]] / direction[z]],
            scale: 1.0 / direction[z],
        }
    }

    /// The point of the triangle's plane on the ray, when it lies on the triangle (edges included).
    /// `t` may have any sign. Triangles seen exactly from the side are never met.
    #[inline(always)]
    pub(crate) fn meet(&self, corners: &Corners) -> Option<Meeting> {
        let [x, y, z] = self.axes;
        let sheared = corners.map(|corner| {
            let depth = f64::from(corner[z]) - self.origin[z];
            let across = f64::from(corner[x]) - self.origin[x] - self.shear[0] * depth;
            let along = f64::from(corner[y]) - self.origin[y] - self.shear[1] * depth;
            (across, along, depth)
        });
        let [a, b, c] = sheared;
        let weight_a = c.0 * b.1 - c.1 * b.0;
        let weight_b = a.0 * c.1 - a.1 * c.0;
        let weight_c = b.0 * a.1 - b.1 * a.0;
        let some_negative = weight_a < 0.0 || weight_b < 0.0 || weight_c < 0.0;
        let some_positive = weight_a > 0.0 || weight_b > 0.0 || weight_c > 0.0;
        if some_negative && some_positive {
            return None;
        }
        let sum = weight_a + weight_b + weight_c;
        if sum == 0.0 {
            return None;
        }
        let t = (weight_a * a.2 + weight_b * b.2 + weight_c * c.2) * self.scale / sum;
        Some(Meeting { t, u: weight_b / sum, v: weight_c / sum })
    }
}

/// Where the ray's line meets the plane of a triangle, whether inside or not. `None` when they are
/// parallel or the triangle has no area.
pub(crate) fn meet_plane(ray: &Ray, corners: [DVec3; 3]) -> Option<Meeting> {
    let [a, b, c] = corners;
    let (edge_b, edge_c) = (b - a, c - a);
    let normal = edge_b.cross(edge_c);
    let slope = normal.dot(ray.direction);
    if slope == 0.0 {
        return None;
    }
    let arm = ray.origin - a;
    let t = -normal.dot(arm) / slope;
    let moment = ray.direction.cross(arm) / slope;
    Some(Meeting { t, u: edge_c.dot(moment), v: -edge_b.dot(moment) })
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNERS: Corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.5], [0.0, 3.0, -0.25]];

    fn ray(origin: DVec3, target: DVec3) -> Ray {
        Ray { origin, direction: (target - origin).normalize() }
    }

    fn at(u: f64, v: f64) -> DVec3 {
        let [a, b, c] = CORNERS.map(|corner| DVec3::from(corner.map(f64::from)));
        a + u * (b - a) + v * (c - a)
    }

    #[test]
    fn finds_the_point_from_either_side() {
        for origin in [DVec3::new(0.3, 0.4, 5.0), DVec3::new(-1.0, 7.0, -2.0)] {
            let target = at(0.25, 0.5);
            let ray = ray(origin, target);
            let met = Shear::new(&ray).meet(&CORNERS).unwrap();
            let plane = meet_plane(&ray, CORNERS.map(|c| DVec3::from(c.map(f64::from)))).unwrap();
            for met in [met, plane] {
                assert!((met.t - (target - origin).length()).abs() < 1e-13);
                assert!((met.u - 0.25).abs() < 1e-14 && (met.v - 0.5).abs() < 1e-14, "{met:?}");
            }
        }
    }

    #[test]
    fn misses_outside_and_without_area() {
        let origin = DVec3::new(0.3, 0.4, 5.0);
        for (u, v) in [(-0.01, 0.5), (0.5, -0.01), (0.51, 0.5)] {
            assert_eq!(Shear::new(&ray(origin, at(u, v))).meet(&CORNERS), None);
        }
        let line = [[1.0; 3]; 3];
        assert_eq!(Shear::new(&ray(origin, DVec3::ONE)).meet(&line), None);
    }
}
