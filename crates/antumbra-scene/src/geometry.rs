//! World-space triangles: what raster and rays share.

use crate::{AlphaMode, Image, Instance, Material, Mesh, Placement, Scene};
use glam::{DMat3, DVec3, Vec2, Vec3, Vec4};

/// Axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Aabb {
    /// Smallest corner.
    pub min: Vec3,
    /// Largest corner.
    pub max: Vec3,
}

impl Aabb {
    /// The smallest box around some points; `None` if there are no points.
    #[must_use]
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Option<Self> {
        let mut points = points.into_iter();
        let first = points.next()?;
        Some(
            points
                .fold(Self { min: first, max: first }, |b, p| Self { min: b.min.min(p), max: b.max.max(p) }),
        )
    }

    /// Middle of the box.
    #[must_use]
    pub fn center(&self) -> Vec3 {
        self.min * 0.5 + self.max * 0.5
    }

    /// Edge lengths.
    #[must_use]
    pub fn size(&self) -> Vec3 {
        self.max - self.min
    }

    /// Radius of the sphere through the corners.
    #[must_use]
    pub fn radius(&self) -> f32 {
        (self.max * 0.5 - self.min * 0.5).length()
    }

    /// The eight corners; bit 0 of the place chooses x, bit 1 y, bit 2 z.
    #[must_use]
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, k: usize| if i >> bit & 1 == 0 { self.min[k] } else { self.max[k] };
            Vec3::new(pick(0, 0), pick(1, 1), pick(2, 2))
        })
    }
}

/// One indexed list of world-space triangles, sorted by material: triangle `t` has the corners
/// `indices[3t..3t+3]`, and its number `t` is its identity in every picture and report.
#[derive(Debug, Clone, Default)]
pub struct Geometry {
    /// World positions, finite.
    pub positions: Vec<Vec3>,
    /// Unit world normals, one per position.
    pub normals: Vec<Vec3>,
    /// Texture coordinates, one per position.
    pub uvs: Vec<Vec2>,
    /// Linear vertex colours, one per position.
    pub colors: Vec<Vec4>,
    /// Three per triangle.
    pub indices: Vec<u32>,
    /// For each material that is used: its index and the range of triangles that use it.
    /// Ranges are contiguous, in order, and cover every triangle; opaque materials come first.
    pub groups: Vec<(usize, std::ops::Range<u32>)>,
    /// The scene's materials.
    pub materials: Vec<Material>,
    /// The scene's images.
    pub images: Vec<Image>,
    /// Where the scene lies in its file's coordinates.
    pub placement: Placement,
    /// Whether cameras see single-sided materials from their front alone. Light is stopped from both sides
    /// all the same, so that a room whose front wall a camera looks through has its shadows.
    pub single_sided: bool,
}

impl Geometry {
    /// Number of triangles.
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        self.indices.len() / 3
    }

    /// Corners of triangle `t` in world space.
    #[must_use]
    pub fn triangle(&self, t: usize) -> [Vec3; 3] {
        self.corners(t).map(|i| self.positions[i])
    }

    /// Vertex numbers of the corners of triangle `t`.
    #[must_use]
    pub fn corners(&self, t: usize) -> [usize; 3] {
        [0, 1, 2].map(|k| self.indices[3 * t + k] as usize)
    }

    /// Whether a camera that looks along `direction` passes through triangle `t`, since that turns its back.
    #[must_use]
    pub fn is_seen_through(&self, t: usize, direction: DVec3) -> bool {
        let double_sided = || {
            let material = self.material_of(t).and_then(|m| self.materials.get(m));
            material.is_none_or(|material| material.double_sided)
        };
        if !self.single_sided || double_sided() {
            return false;
        }
        let [a, b, c] = self.triangle(t).map(Vec3::as_dvec3);
        (b - a).cross(c - a).dot(direction) > 0.0
    }

    /// Smallest box around every triangle; `None` if there are none.
    #[must_use]
    pub fn bounds(&self) -> Option<Aabb> {
        Aabb::around(self.indices.iter().map(|&i| self.positions[i as usize]))
    }

    /// Number of triangles without area: two corners coincide or all three lie on a line. They
    /// cover no pixel and stop no ray.
    #[must_use]
    pub fn zero_area_count(&self) -> usize {
        (0..self.triangle_count())
            .filter(|&t| {
                let [a, b, c] = self.triangle(t).map(Vec3::as_dvec3);
                (b - a).cross(c - a) == DVec3::ZERO
            })
            .count()
    }
}

impl Scene {
    /// All instances in world space, sorted by material. Zero-area triangles are kept (they cover
    /// no pixel and stop no ray).
    ///
    /// Positions are transformed in double precision and rounded once. Normals take the inverse
    /// transpose; mirrored instances (negative determinant) get their winding flipped, so that the
    /// geometric normal `(b−a)×(c−a)` stays on the side that the mesh meant.
    ///
    /// Whatever [`Scene::validate`] refuses (a missing mesh or material, an index out of range, an
    /// attribute of the wrong length) is left out here: validate first, then nothing is.
    ///
    /// Cost: one copy of every vertex for each instance, 48 bytes each.
    #[must_use]
    pub fn flatten(&self) -> Geometry {
        let mut out = Geometry {
            materials: self.materials.clone(),
            images: self.images.clone(),
            placement: self.placement,
            ..Geometry::default()
        };
        let opaque_first = |masked: bool| {
            self.materials.iter().enumerate().filter(move |(_, m)| (m.alpha != AlphaMode::Opaque) == masked)
        };
        let mut placed: Vec<Vec<(&Mesh, &Instance)>> = vec![Vec::new(); self.materials.len()];
        for instance in &self.instances {
            let mesh = self.meshes.get(instance.mesh);
            if let Some((mesh, list)) = mesh.and_then(|mesh| Some((mesh, placed.get_mut(mesh.material)?))) {
                list.push((mesh, instance));
            }
        }
        for (material, _) in opaque_first(false).chain(opaque_first(true)) {
            let start = out.triangle_count();
            for (mesh, instance) in &placed[material] {
                append(&mut out, mesh, instance);
            }
            let end = out.triangle_count();
            if end > start {
                out.groups.push((material, start as u32..end as u32));
            }
        }
        out
    }
}

/// Adds one placed mesh, if it is sound and vertex numbers still fit `u32`.
fn append(out: &mut Geometry, mesh: &Mesh, instance: &Instance) {
    let vertices = mesh.positions.len();
    let whole = [mesh.normals.len(), mesh.uvs.len(), mesh.colors.len()].iter().all(|&n| n == vertices);
    let first = out.positions.len();
    if !whole || first + vertices > u32::MAX as usize {
        return;
    }
    let matrix = instance.world_from_mesh;
    let linear = DMat3::from_mat4(matrix);
    let mirrored = linear.determinant() < 0.0;
    // The cofactor matrix is det · inverse transpose: it needs no division, so it also serves
    // flattened (singular) instances.
    let cofactor = DMat3::from_cols(
        linear.y_axis.cross(linear.z_axis),
        linear.z_axis.cross(linear.x_axis),
        linear.x_axis.cross(linear.y_axis),
    ) * if mirrored { -1.0 } else { 1.0 };
    out.positions.extend(mesh.positions.iter().map(|p| matrix.transform_point3(p.as_dvec3()).as_vec3()));
    out.normals.extend(
        mesh.normals
            .iter()
            .map(|n| (cofactor * n.as_dvec3()).try_normalize().map_or(Vec3::Y, |n| n.as_vec3())),
    );
    out.uvs.extend_from_slice(&mesh.uvs);
    out.colors.extend_from_slice(&mesh.colors);
    for corners in mesh.indices.chunks_exact(3) {
        if let &[a, b, c] = corners
            && corners.iter().all(|&i| (i as usize) < vertices)
        {
            let (b, c) = if mirrored { (c, b) } else { (b, c) };
            out.indices.extend([a, b, c].map(|i| i + first as u32));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat4, DQuat};

    /// A triangle facing +z.
    fn mesh(material: usize) -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::ZERO; 3],
            colors: vec![Vec4::ONE; 3],
            indices: vec![0, 1, 2],
            material,
            ..Mesh::default()
        }
    }

    fn scene(transforms: &[DMat4]) -> Scene {
        Scene {
            meshes: vec![mesh(0)],
            instances: transforms.iter().map(|&m| Instance::new(0, m)).collect(),
            materials: vec![Material::default()],
            ..Scene::default()
        }
    }

    #[test]
    fn geometric_normals_agree_with_shading_normals() {
        let turn = DMat4::from_quat(DQuat::from_rotation_x(0.7) * DQuat::from_rotation_y(2.0));
        let scale = |x, y, z| turn * DMat4::from_scale(DVec3::new(x, y, z));
        let transforms =
            [scale(1.0, 2.0, 0.1), scale(-1.0, 2.0, 3.0), scale(1.0, -3.0, 1.0), scale(-1.0, -1.0, -5.0)];
        let geometry = scene(&transforms).flatten();
        for (t, transform) in transforms.iter().enumerate() {
            let [a, b, c] = geometry.triangle(t);
            let geometric = (b - a).cross(c - a).normalize();
            let normal = geometry.normals[geometry.corners(t)[0]];
            assert!(geometric.dot(normal) > 0.999, "instance {t}");
            // The side that the mesh meant: where its +z goes.
            assert!(geometric.as_dvec3().dot(transform.transform_vector3(DVec3::Z)) > 0.0, "instance {t}");
        }
    }

    #[test]
    fn flattened_instances_keep_a_normal() {
        let geometry =
            scene(&[DMat4::from_scale(DVec3::new(2.0, 2.0, 0.0)), DMat4::from_scale(DVec3::ZERO)]).flatten();
        assert_eq!(geometry.normals[0], Vec3::Z);
        assert!(geometry.normals.iter().all(|n| n.is_normalized()));
        assert_eq!((geometry.triangle_count(), geometry.zero_area_count()), (2, 1));
    }

    #[test]
    fn opaque_groups_come_first() {
        let mut scene = scene(&[DMat4::IDENTITY]);
        let cut = Material { alpha: AlphaMode::Mask { cutoff: 0.5 }, ..Material::default() };
        scene.materials = vec![cut.clone(), Material::default(), cut, Material::default()];
        scene.meshes = [3, 0, 1, 0].map(mesh).to_vec();
        scene.instances = (0..4).map(|mesh| Instance::new(mesh, DMat4::IDENTITY)).collect();
        let geometry = scene.flatten();
        assert_eq!(geometry.groups, [(1, 0..1), (3, 1..2), (0, 2..4)]);
        assert_eq!([0, 1, 2, 3].map(|t| geometry.material_of(t)), [1, 3, 0, 0].map(Some));
    }

    #[test]
    fn bounds_ignore_unused_vertices() {
        let mut scene = scene(&[DMat4::from_translation(DVec3::ONE)]);
        scene.meshes[0].positions[2] = Vec3::splat(50.0);
        scene.meshes[0].indices = vec![0, 1, 1];
        let bounds = scene.flatten().bounds();
        assert_eq!(bounds, Some(Aabb { min: Vec3::ONE, max: Vec3::new(2.0, 1.0, 1.0) }));
        assert_eq!(bounds, scene.bounds());
        assert_eq!(Geometry::default().bounds(), None);
    }
}
