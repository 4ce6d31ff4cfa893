//! Things put together from several shapes: one mesh for each material, placed as one.

use super::shapes::{self, Builder};
use crate::Mesh;
use glam::{Mat3, Mat4, Quat, Vec3};

/// A thing under construction.
#[derive(Debug, Default)]
pub(super) struct Model {
    /// One for each material, in order of first use.
    parts: Vec<Mesh>,
}

impl Model {
    /// Adds a transformed copy of a shape.
    pub(super) fn add(&mut self, material: usize, shape: &Mesh, model_from_shape: Mat4) {
        let place = self.parts.iter().position(|m| m.material == material).unwrap_or_else(|| {
            self.parts.push(Mesh { material, ..Mesh::default() });
            self.parts.len() - 1
        });
        shapes::append(&mut self.parts[place], shape, model_from_shape);
    }

    /// Adds a shape as it is.
    pub(super) fn put(&mut self, material: usize, shape: &Mesh) {
        self.add(material, shape, Mat4::IDENTITY);
    }

    /// Adds a box with these edge lengths around a centre.
    pub(super) fn block(&mut self, material: usize, center: Vec3, size: Vec3) {
        self.add(material, &shapes::cuboid(size), Mat4::from_translation(center));
    }

    /// Adds a board from one point to another, `width` across and `thickness` along the direction
    /// nearest to `face`.
    pub(super) fn board(
        &mut self,
        material: usize,
        [from, to]: [Vec3; 2],
        [width, thickness]: [f32; 2],
        face: Vec3,
    ) {
        let along = (to - from).normalize();
        let across = face.cross(along).normalize();
        let rotation = Quat::from_mat3(&Mat3::from_cols(across, along.cross(across), along));
        let place = Mat4::from_rotation_translation(rotation, (from + to) * 0.5);
        self.add(material, &shapes::cuboid(Vec3::new(width, thickness, from.distance(to))), place);
    }

    /// Adds a round bar from one point to another, closed at its ends: `4 · sides` triangles.
    pub(super) fn rod(&mut self, material: usize, [from, to]: [Vec3; 2], radius: f32, sides: u32) {
        let bar = shapes::turned(&[[radius, 0.0], [radius, from.distance(to)]], sides);
        let turn = Quat::from_rotation_arc(Vec3::Y, (to - from).normalize());
        self.add(material, &bar, Mat4::from_rotation_translation(turn, from));
    }

    /// Adds round bars along a line of points.
    pub(super) fn rods(&mut self, material: usize, points: &[Vec3], radius: f32, sides: u32) {
        for ends in points.windows(2) {
            self.rod(material, [ends[0], ends[1]], radius, sides);
        }
    }

    /// Puts the parts into a scene; the numbers are for [`Builder::place_all`].
    pub(super) fn finish(self, scene: &mut Builder, name: &str) -> Vec<usize> {
        self.parts
            .into_iter()
            .map(|part| {
                let material = part.material;
                scene.mesh(name, part, material)
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_lie_where_they_should() {
        let mut model = Model::default();
        model.rod(3, [Vec3::ONE, Vec3::new(1.0, 4.0, 5.0)], 0.1, 8);
        model.board(5, [Vec3::ZERO, Vec3::X * 2.0], [0.4, 0.1], Vec3::Y);
        model.block(5, Vec3::Y * 3.0, Vec3::ONE);
        let mut scene = Builder::new("parts");
        let meshes = model.finish(&mut scene, "thing");
        assert_eq!(meshes, [0, 1]);
        scene.place_all(&meshes, Mat4::IDENTITY);
        let scene =
            scene.finish(crate::Scene::default().default_camera(), crate::Scene::default().default_light());
        assert_eq!(scene.meshes[0].indices.len() / 3, 4 * 8);
        let near = |p: Vec3, q: Vec3| p.distance(q) < 0.11;
        let ends = [Vec3::ONE, Vec3::new(1.0, 4.0, 5.0)];
        assert!(scene.meshes[0].positions.iter().all(|&p| ends.iter().any(|&q| near(p, q))));
        let board = crate::Aabb::around(scene.meshes[1].positions[..24].iter().copied()).unwrap();
        assert!((board.size() - Vec3::new(2.0, 0.1, 0.4)).length() < 1e-6);
        assert!((board.center() - Vec3::X).length() < 1e-6);
    }

    #[test]
    fn mirrored_copies_keep_their_outside() {
        let mut mesh = Mesh::default();
        shapes::append(&mut mesh, &shapes::cuboid(Vec3::ONE), Mat4::from_scale(Vec3::new(-2.0, 1.0, 3.0)));
        for corners in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[corners[k] as usize]);
            let outward = (b - a).cross(c - a);
            assert!(outward.dot(a + b + c) > 0.0 && outward.dot(mesh.normals[corners[0] as usize]) > 0.0);
        }
    }
}
