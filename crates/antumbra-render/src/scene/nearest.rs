//! How far a point is from the nearest triangle.

use antumbra_scene::Geometry;
use glam::{DVec3, Vec3};

/// Distance from a point to the nearest triangle; infinite if there are none.
///
/// Cost: some 5 ns a triangle.
pub(super) fn distance(geometry: &Geometry, point: Vec3) -> f32 {
    // Squares of single precision would leave its range in very large and very small scenes.
    let point = point.as_dvec3();
    let mut min = f64::INFINITY;
    for t in 0..geometry.triangle_count() {
        let [a, b, c] = geometry.triangle(t).map(|corner| corner.as_dvec3() - point);
        let outside = a.min(b).min(c).max(-a.max(b).max(c)).max(DVec3::ZERO);
        if outside.length_squared() < min * min {
            min = min.min(closest([a, b, c]).length());
        }
    }
    min as f32
}

/// The point of a triangle that is closest to the origin (Ericson, Real-Time Collision Detection, 5.1.5).
fn closest([a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let along = |p: DVec3| (-ab.dot(p), -ac.dot(p));
    let ((a1, a2), (b1, b2), (c1, c2)) = (along(a), along(b), along(c));
    let (of_c, of_b, of_a) = (a1 * b2 - b1 * a2, c1 * a2 - a1 * c2, b1 * c2 - c1 * b2);
    if a1 <= 0.0 && a2 <= 0.0 {
        a
    } else if b1 >= 0.0 && b2 <= b1 {
        b
    } else if c2 >= 0.0 && c1 <= c2 {
        c
    } else if of_c <= 0.0 && a1 >= 0.0 && b1 <= 0.0 {
        a + ab * (a1 / (a1 - b1))
    } else if of_b <= 0.0 && a2 >= 0.0 && c2 <= 0.0 {
        a + ac * (a2 / (a2 - c2))
    } else if of_a <= 0.0 && b2 >= b1 && c1 >= c2 {
        b + (c - b) * ((b2 - b1) / ((b2 - b1) + (c1 - c2)))
    } else {
        a + (ab * of_b + ac * of_c) / (of_a + of_b + of_c)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_of_a_triangle_can_be_nearest() {
        let corners = [Vec3::ZERO, Vec3::new(4.0, 0.0, 0.0), Vec3::new(0.0, 4.0, 0.0)];
        let geometry =
            Geometry { positions: corners.to_vec(), indices: vec![0, 1, 2], ..Geometry::default() };
        for (point, expected) in [
            (Vec3::new(-3.0, -4.0, 0.0), 5.0),
            (Vec3::new(7.0, -4.0, 0.0), 5.0),
            (Vec3::new(-4.0, 7.0, 0.0), 5.0),
            (Vec3::new(2.0, -3.0, 4.0), 5.0),
            (Vec3::new(-3.0, 2.0, 4.0), 5.0),
            (Vec3::new(4.0, 4.0, 0.0), 8f32.sqrt()),
            (Vec3::new(1.0, 1.0, -0.5), 0.5),
            (Vec3::new(1.0, 1.0, 0.0), 0.0),
        ] {
            assert!((distance(&geometry, point) - expected).abs() < 1e-5, "{point}");
        }
        for scale in [1e-30, 1e30] {
            let positions = geometry.positions.iter().map(|p| *p * scale).collect();
            let scaled = Geometry { positions, ..geometry.clone() };
            let share = distance(&scaled, Vec3::new(-3.0, 2.0, 4.0) * scale) / (5.0 * scale);
            assert!((share - 1.0).abs() < 1e-5, "{scale}: {share}");
        }
        // Without area it still has edges.
        let line = Geometry { indices: vec![0, 1, 1], ..geometry };
        assert!((distance(&line, Vec3::new(2.0, 0.0, 3.0)) - 3.0).abs() < 1e-6);
    }
}
