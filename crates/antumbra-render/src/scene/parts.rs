//! Geometry in parts that bindings can hold.

use antumbra::MeshPart;

/// Most parts: a mesh whose triangles take vertices from everywhere has no parts that help.
const MAX_PARTS: usize = 256;

/// Consecutive triangles together, as long as the vertices that they use are at most `max` in a row; all of
/// them as one part where that would take too many.
pub(super) fn parts(indices: &[u32], max: u32) -> Vec<MeshPart> {
    let mut parts: Vec<MeshPart> = Vec::new();
    for (triangle, corners) in (0..).zip(indices.chunks_exact(3)) {
        let low = corners.iter().copied().min().unwrap_or(0);
        let high = corners.iter().copied().max().unwrap_or(0).saturating_add(1);
        if let Some(part) = parts.last_mut() {
            let vertices = part.vertices.start.min(low)..part.vertices.end.max(high);
            if vertices.end - vertices.start <= max {
                *part = MeshPart { triangles: part.triangles.start..triangle + 1, vertices };
                continue;
            }
        }
        parts.push(MeshPart { triangles: triangle..triangle + 1, vertices: low..high });
    }
    if parts.len() <= MAX_PARTS {
        return parts;
    }
    let vertices = 0..indices.iter().copied().max().map_or(0, |high| high.saturating_add(1));
    vec![MeshPart { triangles: 0..(indices.len() / 3) as u32, vertices }]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_hold_all_triangles_and_their_vertices() {
        let strip: Vec<u32> = (0..100).flat_map(|i| [i, i + 1, i + 2]).collect();
        let found = parts(&strip, 12);
        assert_eq!(found.len(), 10);
        assert!(found.windows(2).all(|pair| pair[0].triangles.end == pair[1].triangles.start));
        for part in &found {
            assert!(part.vertices.len() <= 12);
            for triangle in part.triangles.clone() {
                assert!(part.vertices.contains(&triangle) && part.vertices.contains(&(triangle + 2)));
            }
        }
        assert_eq!(parts(&strip, 102), [MeshPart { triangles: 0..100, vertices: 0..102 }]);
    }

    #[test]
    fn scattered_vertices_stay_together() {
        let scattered: Vec<u32> = (0..3000).map(|i| i * 7919 % 3000).collect();
        assert_eq!(parts(&scattered, 10), [MeshPart { triangles: 0..1000, vertices: 0..3000 }]);
    }
}
