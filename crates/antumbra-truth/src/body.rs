//! Which triangles hang together.

use antumbra_scene::Geometry;
use glam::Vec3;
use rayon::prelude::*;

/// For every triangle, the body it belongs to: triangles are of one body if a chain of shared
/// corners joins them. Corners are shared if their positions are equal, whatever their indices.
#[derive(Debug)]
pub(crate) struct Bodies {
    of: Vec<u32>,
}

impl Bodies {
    /// Cost: some 0.1 µs per triangle, sorting on all cores.
    pub(crate) fn new(geometry: &Geometry) -> Self {
        let point = first_alike(&geometry.positions);
        let mut parent: Vec<u32> = (0..point.len() as u32).collect();
        for corners in geometry.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| root(&mut parent, point[corners[k] as usize]));
            let lowest = a.min(b).min(c);
            for corner in [a, b, c] {
                parent[corner as usize] = lowest;
            }
        }
        let of = geometry
            .indices
            .chunks_exact(3)
            .map(|corners| root(&mut parent, point[corners[0] as usize]))
            .collect();
        Self { of }
    }

    pub(crate) fn same(&self, a: u32, b: u32) -> bool {
        self.of[a as usize] == self.of[b as usize]
    }
}

/// For every position the first that equals it.
fn first_alike(positions: &[Vec3]) -> Vec<u32> {
    // Adding zero makes −0.0 and 0.0 the same bits.
    let key = |(i, p): (usize, &Vec3)| (p.to_array().map(|x| (x + 0.0).to_bits()), i as u32);
    let mut sorted: Vec<([u32; 3], u32)> = positions.par_iter().enumerate().map(key).collect();
    sorted.par_sort_unstable();
    let mut first = vec![0; positions.len()];
    for alike in sorted.chunk_by(|a, b| a.0 == b.0) {
        alike.iter().for_each(|(_, i)| first[*i as usize] = alike[0].1);
    }
    first
}

/// The lowest point of a set, halving the path to it.
fn root(parent: &mut [u32], mut point: u32) -> u32 {
    while parent[point as usize] != point {
        parent[point as usize] = parent[parent[point as usize] as usize];
        point = parent[point as usize];
    }
    point
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_positions_are_one_point() {
        let of = |i: u32| Vec3::new((i * 7919 % 50) as f32 - 25.0, (i * 31 % 3) as f32, -0.0);
        let mut positions: Vec<Vec3> = (0..1000).map(of).collect();
        positions.push(Vec3 { z: 0.0, ..positions[40] });
        let first = first_alike(&positions);
        for (i, p) in positions.iter().enumerate() {
            assert_eq!(positions.iter().position(|q| q == p), Some(first[i] as usize));
        }
        assert_eq!(first[1000], first[40]);
    }
}
