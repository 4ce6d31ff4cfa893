//! Closed shapes with outward normals and counter-clockwise triangles.

use crate::{Instance, Material, Mesh, Scene};
use glam::{Mat3, Mat4, Vec2, Vec3, Vec4};
use std::f32::consts::{PI, TAU};

/// Collects meshes, materials and instances.
#[derive(Debug, Default)]
pub(super) struct Builder {
    scene: Scene,
}

impl Builder {
    pub(super) fn new(name: &str) -> Self {
        Self { scene: Scene { name: name.into(), ..Scene::default() } }
    }

    /// Adds a matte material of that linear colour.
    pub(super) fn material(&mut self, name: &str, color: [f32; 3], roughness: f32) -> usize {
        let [r, g, b] = color;
        self.scene.materials.push(Material {
            name: name.into(),
            base_color: Vec4::new(r, g, b, 1.0),
            roughness,
            ..Material::default()
        });
        self.scene.materials.len() - 1
    }

    /// Adds a mesh and returns its number, for [`Builder::place`].
    pub(super) fn mesh(&mut self, name: &str, mesh: Mesh, material: usize) -> usize {
        self.scene.meshes.push(Mesh { name: name.into(), material, ..mesh });
        self.scene.meshes.len() - 1
    }

    pub(super) fn place(&mut self, mesh: usize, world_from_mesh: Mat4) {
        self.scene.instances.push(Instance::new(mesh, world_from_mesh.as_dmat4()));
    }

    /// Places every mesh of a [`Model`](super::model::Model).
    pub(super) fn place_all(&mut self, meshes: &[usize], world_from_model: Mat4) {
        for &mesh in meshes {
            self.place(mesh, world_from_model);
        }
    }

    pub(super) fn finish(self, camera: crate::Camera, light: crate::Light) -> Scene {
        Scene { cameras: vec![camera], lights: vec![light], ..self.scene }
    }
}

/// Appends one vertex and returns its number.
pub(super) fn vertex(mesh: &mut Mesh, position: Vec3, normal: Vec3, uv: Vec2) -> u32 {
    mesh.positions.push(position);
    mesh.normals.push(normal);
    mesh.uvs.push(uv);
    mesh.colors.push(Vec4::ONE);
    mesh.positions.len() as u32 - 1
}

/// Appends a transformed copy of `shape` to `mesh`; mirrored copies keep their outside outside.
pub(super) fn append(mesh: &mut Mesh, shape: &Mesh, mesh_from_shape: Mat4) {
    let first = mesh.positions.len() as u32;
    let linear = Mat3::from_mat4(mesh_from_shape);
    let mirrored = linear.determinant() < 0.0;
    let normals = linear.inverse().transpose();
    mesh.positions.extend(shape.positions.iter().map(|&p| mesh_from_shape.transform_point3(p)));
    mesh.normals.extend(shape.normals.iter().map(|&n| (normals * n).normalize()));
    mesh.uvs.extend_from_slice(&shape.uvs);
    mesh.colors.extend_from_slice(&shape.colors);
    for corners in shape.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|k| corners[k] + first);
        mesh.indices.extend(if mirrored { [a, c, b] } else { [a, b, c] });
    }
}

/// A convex flat polygon, corners counter-clockwise seen from its front.
pub(super) fn polygon(corners: &[Vec3]) -> Mesh {
    let mut mesh = Mesh::default();
    if let [a, b, c, ..] = corners {
        let normal = (*b - *a).cross(*c - *a).normalize();
        for (i, corner) in corners.iter().enumerate() {
            let uv = Vec2::new((i == 1 || i == 2).into(), (i >= 2).into());
            vertex(&mut mesh, *corner, normal, uv);
        }
        mesh.indices = (1..corners.len() as u32 - 1).flat_map(|i| [0, i, i + 1]).collect();
    }
    mesh
}

/// A horizontal square at y = 0 around the origin, `size` metres wide: 2 triangles.
pub(super) fn ground(size: f32) -> Mesh {
    let h = size * 0.5;
    polygon(&[Vec3::new(-h, 0.0, h), Vec3::new(h, 0.0, h), Vec3::new(h, 0.0, -h), Vec3::new(-h, 0.0, -h)])
}

/// A box around the origin with these edge lengths: 12 triangles.
pub(super) fn cuboid(size: Vec3) -> Mesh {
    let mut mesh = Mesh::default();
    let half = size * 0.5;
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let [n, s, t] = [0, 1, 2].map(|k| Vec3::AXES[(axis + k) % 3]);
            let (n, s) = (n * sign, s * sign);
            let first = mesh.positions.len() as u32;
            for (a, b) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
                let uv = Vec2::new(a, b) * 0.5 + 0.5;
                vertex(&mut mesh, (n + s * a + t * b) * half, n, uv);
            }
            mesh.indices.extend([0, 1, 2, 0, 2, 3].map(|i| first + i));
        }
    }
    mesh
}

/// A convex outline in the xy plane, counter-clockwise, drawn out along z to `depth` around z = 0:
/// `4n − 4` triangles for n corners.
pub(super) fn extruded(outline: &[[f32; 2]], depth: f32) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |&[x, y]: &[f32; 2], side: f32| Vec3::new(x, y, side * 0.5 * depth);
    let mut face = |corners: &[Vec3]| append(&mut mesh, &polygon(corners), Mat4::IDENTITY);
    face(&outline.iter().map(|p| at(p, 1.0)).collect::<Vec<_>>());
    face(&outline.iter().rev().map(|p| at(p, -1.0)).collect::<Vec<_>>());
    for (p, q) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        face(&[at(p, 1.0), at(p, -1.0), at(q, -1.0), at(q, 1.0)]);
    }
    mesh
}

/// A surface of revolution about the y axis. The profile gives (radius, height) points with the
/// outside to its right when drawn with y up; edges bent by more than 40° stay sharp. Segments that
/// touch the axis give one triangle a side, others two.
pub(super) fn lathe(profile: &[Vec2], sides: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let normals: Vec<Vec2> = profile
        .windows(2)
        .map(|w| {
            let along = w[1] - w[0];
            Vec2::new(along.y, -along.x).normalize()
        })
        .collect();
    let last = normals.len() - 1;
    let closed = profile[0].distance(profile[last + 1]) < 1e-6;
    let soften = |n: Vec2, neighbour: Option<usize>| match neighbour.map(|i| normals[i]) {
        Some(m) if n.dot(m) > 0.76 => (n + m).normalize(),
        _ => n,
    };
    for (row, (ends, &n)) in profile.windows(2).zip(&normals).enumerate() {
        let before = if row > 0 { Some(row - 1) } else { closed.then_some(last) };
        let after = if row < last { Some(row + 1) } else { closed.then_some(0) };
        let ring = |mesh: &mut Mesh, p: Vec2, n: Vec2, v: f32| {
            let first = mesh.positions.len() as u32;
            for side in 0..=sides {
                // The seam repeats the first angle exactly, so that the shape is closed.
                let (sin, cos) = (TAU * (side % sides) as f32 / sides as f32).sin_cos();
                let turn = |q: Vec2| Vec3::new(q.x * sin, q.y, q.x * cos);
                vertex(mesh, turn(p), turn(n), Vec2::new(side as f32 / sides as f32, v));
            }
            first
        };
        let v = |r: usize| r as f32 / normals.len() as f32;
        let low = ring(&mut mesh, ends[0], soften(n, before), v(row));
        let high = ring(&mut mesh, ends[1], soften(n, after), v(row + 1));
        for i in 0..sides {
            if ends[0].x > 0.0 {
                mesh.indices.extend([low + i, low + i + 1, high + i + 1]);
            }
            if ends[1].x > 0.0 {
                mesh.indices.extend([low + i, high + i + 1, high + i]);
            }
        }
    }
    mesh
}

/// A sphere of radius 1: `2 · sides · (rows − 1)` triangles.
pub(super) fn sphere(sides: u32, rows: u32) -> Mesh {
    let profile: Vec<Vec2> = (0..=rows)
        .map(|row| {
            let angle = PI * (row as f32 / rows as f32 - 0.5);
            let radius = if row == 0 || row == rows { 0.0 } else { angle.cos() };
            Vec2::new(radius, angle.sin())
        })
        .collect();
    lathe(&profile, sides)
}

/// A ring about the y axis: `2 · sides · rows` triangles.
pub(super) fn torus(radius: f32, thickness: f32, sides: u32, rows: u32) -> Mesh {
    let profile: Vec<Vec2> = (0..=rows)
        .map(|row| {
            let (sin, cos) = (TAU * (row % rows) as f32 / rows as f32).sin_cos();
            Vec2::new(radius + thickness * cos, thickness * sin)
        })
        .collect();
    lathe(&profile, sides)
}

/// An upright solid turned from (radius, height) points, closed by flat ends: two triangles a side
/// and segment, one a side and end.
pub(super) fn turned(profile: &[[f32; 2]], sides: u32) -> Mesh {
    let mut points: Vec<Vec2> = profile.iter().map(|&p| p.into()).collect();
    if let (Some(&first), Some(&last)) = (points.first(), points.last()) {
        if first.x > 0.0 {
            points.insert(0, Vec2::new(0.0, first.y));
        }
        if last.x > 0.0 {
            points.push(Vec2::new(0.0, last.y));
        }
    }
    lathe(&points, sides)
}
