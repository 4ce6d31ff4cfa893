//! What files say of vertices, and the meshes made of it.

use crate::Mesh;
use glam::{Vec2, Vec3, Vec4};

/// Vertices as the file has them.
#[derive(Debug, Clone, Default)]
pub(super) struct Vertices {
    pub(super) positions: Vec<Vec3>,
    /// Empty if the file has none.
    pub(super) normals: Vec<Vec3>,
    pub(super) uvs: Vec<Vec2>,
    pub(super) colors: Vec<Vec4>,
    /// Joints and weights of each vertex, for skins; empty if the file has none.
    pub(super) joints: Vec<Vec<(u32, f32)>>,
    /// Three per triangle, each below `positions.len()`.
    pub(super) triangles: Vec<u32>,
}

impl Vertices {
    /// A mesh of the vertices that triangles use. Without normals each triangle gets vertices of its
    /// own and its flat normal, as glTF demands; normals of length zero become the mean of the
    /// triangles around.
    pub(super) fn into_mesh(self, name: &str, material: usize) -> Mesh {
        let flat = self.normals.is_empty();
        let order: Vec<u32> = if flat { self.triangles.clone() } else { used(&self) };
        let pick = |i: &u32| *i as usize;
        let mut mesh = Mesh {
            name: name.into(),
            positions: order.iter().map(|i| self.positions[pick(i)]).collect(),
            uvs: order.iter().map(|i| self.uvs[pick(i)]).collect(),
            colors: order.iter().map(|i| self.colors[pick(i)]).collect(),
            normals: Vec::new(),
            indices: if flat { (0..order.len() as u32).collect() } else { renumber(&self, &order) },
            material,
        };
        mesh.normals = if flat {
            vec![Vec3::ZERO; order.len()]
        } else {
            order.iter().map(|i| self.normals[pick(i)].normalize_or_zero()).collect()
        };
        if mesh.normals.contains(&Vec3::ZERO) {
            fill_normals(&mut mesh);
        }
        mesh
    }
}

/// The numbers of all vertices that triangles use, ascending.
fn used(vertices: &Vertices) -> Vec<u32> {
    let mut marks = vec![false; vertices.positions.len()];
    vertices.triangles.iter().for_each(|&i| marks[i as usize] = true);
    (0..marks.len() as u32).filter(|&i| marks[i as usize]).collect()
}

/// The triangles in terms of places in `order`.
fn renumber(vertices: &Vertices, order: &[u32]) -> Vec<u32> {
    let mut places = vec![0; vertices.positions.len()];
    order.iter().zip(0..).for_each(|(&i, place)| places[i as usize] = place);
    vertices.triangles.iter().map(|&i| places[i as usize]).collect()
}

/// Replaces zero normals by the area-weighted mean of the triangles that share the vertex, or +Y.
fn fill_normals(mesh: &mut Mesh) {
    let mut sums = vec![glam::DVec3::ZERO; mesh.positions.len()];
    for corners in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[corners[k] as usize].as_dvec3());
        let normal = (b - a).cross(c - a);
        corners.iter().for_each(|&i| sums[i as usize] += normal);
    }
    for (normal, sum) in mesh.normals.iter_mut().zip(sums) {
        if *normal == Vec3::ZERO {
            *normal = sum.try_normalize().map_or(Vec3::Y, |n| n.as_vec3());
        }
    }
}
