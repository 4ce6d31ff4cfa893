//! Leaves and grass: flat, two-sided slivers.

use super::{random::Random, shapes::vertex};
use crate::Mesh;
use glam::{Quat, Vec2, Vec3};
use std::f32::consts::TAU;

/// `count` leaves of about that length (metres) near the points of a mesh that lie above `from`:
/// 2 triangles each, folded along the middle. The mesh must have such points.
pub(super) fn leaves(twigs: &Mesh, from: f32, count: u32, length: f32, random: &mut Random) -> Mesh {
    let points: Vec<Vec3> = twigs.positions.iter().copied().filter(|p| p.y > from).collect();
    let mut mesh = Mesh::default();
    for _ in 0..count {
        let pick = (random.between(0.0, 1.0) * points.len() as f32) as usize;
        let stray = Vec3::new(random.around(1.0), random.around(1.0), random.around(1.0)) * 0.6 * length;
        let stem = points[pick.min(points.len() - 1)] + stray;
        let turn = Quat::from_rotation_y(random.between(0.0, TAU))
            * Quat::from_rotation_x(random.between(-0.3, 1.0))
            * Quat::from_rotation_z(random.around(0.5));
        leaf(&mut mesh, stem, turn, length * random.between(0.7, 1.2));
    }
    mesh
}

/// One leaf that points along the turned z axis.
fn leaf(mesh: &mut Mesh, stem: Vec3, turn: Quat, length: f32) {
    let at = |x: f32, y: f32, z: f32| stem + turn * (Vec3::new(x, y, z) * length);
    let [base, tip] = [at(0.0, 0.0, 0.0), at(0.0, 0.0, 1.0)];
    for side in [-1.0, 1.0] {
        let edge = at(0.32 * side, 0.12, 0.45);
        let corners = if side < 0.0 { [base, tip, edge] } else { [base, edge, tip] };
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let up = if normal.dot(turn * Vec3::Y) < 0.0 { [0, 2, 1] } else { [0, 1, 2] };
        let normal = if up == [0, 1, 2] { normal } else { -normal };
        for i in up {
            let v = vertex(mesh, corners[i], normal, Vec2::ZERO);
            mesh.indices.push(v);
        }
    }
}

/// A tuft of bent blades on y = 0, 3 triangles each.
pub(super) fn tuft(blades: u32, height: f32, random: &mut Random) -> Mesh {
    let mut mesh = Mesh::default();
    for i in 0..blades {
        let turn = Quat::from_rotation_y(i as f32 * 2.399_963);
        let (away, lean) = (random.between(0.0, 0.35), random.between(0.15, 0.75));
        let height = height * random.between(0.5, 1.0);
        let width = 0.035 * height + 0.003;
        let at = |x: f32, y: f32| turn * Vec3::new(x, y * height, height * (away + lean * y * y));
        let normal = |y: f32| turn * Vec3::new(0.0, 2.0 * lean * y, -1.0).normalize();
        let rows = [(width, -0.05), (0.75 * width, 0.55)];
        let points = rows.map(|(w, y)| {
            [w, -w].map(|x| vertex(&mut mesh, at(x, y), normal(y.max(0.0)), Vec2::new(x.signum(), y)))
        });
        let tip = vertex(&mut mesh, at(0.0, 1.0), normal(1.0), Vec2::Y);
        let [[a, b], [c, d]] = points;
        mesh.indices.extend([a, b, d, a, d, c, c, d, tip]);
    }
    mesh
}
