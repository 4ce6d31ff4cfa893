//! Surfaces of fields on a grid, by surface nets [Gibson 1998, "Constrained elastic surface nets"]:
//! one vertex in each cell that the surface crosses, in the mean of the crossings of its edges; one
//! quad around each edge that is crossed. Then the net relaxes and is drawn back to the surface, in
//! turns, so that it shows no steps of the grid.

use super::shapes::vertex;
use crate::Mesh;
use glam::{DVec3, Vec2};

/// A field sampled at the corners of cubes: negative inside.
#[derive(Debug, Clone)]
pub(super) struct Grid {
    origin: DVec3,
    cell: f64,
    /// Samples along each axis.
    size: [usize; 3],
    values: Vec<f32>,
}

impl Grid {
    /// A grid over the cube from −`half` to +`half`, `cells` along each edge, all outside: the field
    /// is `far` everywhere.
    pub(super) fn new(half: f64, cells: usize, far: f32) -> Self {
        let size = [cells + 1; 3];
        let values = vec![far; size.iter().product()];
        Self { origin: DVec3::splat(-half), cell: 2.0 * half / cells as f64, size, values }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    fn place(&self, corner: [usize; 3]) -> DVec3 {
        self.origin + DVec3::from(corner.map(|i| i as f64)) * self.cell
    }

    /// Replaces every sample within `radius` of `center`, at least by its box, by a function of its
    /// place and what it was.
    pub(super) fn change(&mut self, center: DVec3, radius: f64, f: impl Fn(DVec3, f32) -> f32) {
        let bound = |p: f64| (p / self.cell).clamp(0.0, (self.size[0] - 1) as f64);
        let low = (center - radius - self.origin).to_array().map(|p| bound(p).floor() as usize);
        let high = (center + radius - self.origin).to_array().map(|p| bound(p).ceil() as usize);
        for z in low[2]..=high[2] {
            for y in low[1]..=high[1] {
                for x in low[0]..=high[0] {
                    let i = self.index([x, y, z]);
                    self.values[i] = f(self.place([x, y, z]), self.values[i]);
                }
            }
        }
    }

    /// Adds a second field of the same grid; where both surfaces are nearer than about `blend` to
    /// each other, they run into each other.
    pub(super) fn join(&mut self, other: &Self, blend: f32) {
        for (a, &b) in self.values.iter_mut().zip(&other.values) {
            let near = (blend - (*a - b).abs()).max(0.0) / blend;
            *a = a.min(b) - 0.25 * blend * near * near;
        }
    }

    /// The surface where the field is 0, facing the positive side, with smooth normals. It is closed
    /// if the field is positive on the border. Gaps narrower than a cell are filled.
    pub(super) fn surface(mut self) -> Mesh {
        while self.fill_gaps() {}
        let mut net = Net::default();
        let mut vertices = vec![u32::MAX; self.values.len()];
        let [nx, ny, nz] = self.size;
        for z in 0..nz - 1 {
            for y in 0..ny - 1 {
                for x in 0..nx - 1 {
                    if let Some(position) = self.crossing([x, y, z]) {
                        vertices[self.index([x, y, z])] = net.positions.len() as u32;
                        net.positions.push(position);
                    }
                }
            }
        }
        for z in 1..nz - 1 {
            for y in 1..ny - 1 {
                for x in 1..nx - 1 {
                    let around = (0..3).filter_map(|axis| self.quad(&vertices, [x, y, z], axis));
                    net.quads.extend(around);
                }
            }
        }
        for _ in 0..4 {
            net.relax();
            net.positions.iter_mut().for_each(|p| *p = self.nearest(*p));
        }
        net.mesh()
    }

    /// A cell has one vertex, so one sheet may cross it. Where more do, the corner nearest to the
    /// inside joins it. Says whether there was such a cell.
    fn fill_gaps(&mut self) -> bool {
        let [nx, ny, nz] = self.size.map(|n| n - 1);
        let mut found = false;
        for cell in (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z]))) {
            let corners: [usize; 8] = corners(cell).map(|p| self.index(p));
            let outside = |i: &usize| self.values[*i] >= 0.0;
            let mask = (0..8).filter(|&i| outside(&corners[i])).fold(0, |mask, i| mask | 1_u8 << i);
            if connected(mask) && connected(!mask) {
                continue;
            }
            let min = corners
                .into_iter()
                .filter(outside)
                .min_by(|&a, &b| self.values[a].total_cmp(&self.values[b]));
            if let Some(corner) = min {
                self.values[corner] = -0.05 * self.cell as f32;
                found = true;
            }
        }
        found
    }

    /// The vertex of a cell that the surface crosses.
    fn crossing(&self, cell: [usize; 3]) -> Option<DVec3> {
        let corners = corners(cell);
        let values = corners.map(|corner| self.values[self.index(corner)]);
        let inside = values.iter().filter(|v| **v < 0.0).count();
        if inside == 0 || inside == 8 {
            return None;
        }
        let (mut sum, mut count) = (DVec3::ZERO, 0.0);
        for a in 0..8 {
            for b in [a | 1, a | 2, a | 4].into_iter().filter(|&b| b != a) {
                if (values[a] < 0.0) != (values[b] < 0.0) {
                    let t = f64::from(values[a]) / f64::from(values[a] - values[b]);
                    sum += self.place(corners[a]).lerp(self.place(corners[b]), t);
                    count += 1.0;
                }
            }
        }
        Some(sum / count)
    }

    /// The field and its gradient by cubic (Catmull-Rom) interpolation.
    fn sample(&self, p: DVec3) -> (f64, DVec3) {
        let place = (p - self.origin) / self.cell;
        let low: [usize; 3] = std::array::from_fn(|k| {
            let last = (self.size[k] - 3) as f64;
            place[k].floor().clamp(1.0, last) as usize
        });
        let weights: [[[f64; 2]; 4]; 3] = std::array::from_fn(|k| {
            let t = place[k] - low[k] as f64;
            [
                [t * (t * (1.0 - 0.5 * t) - 0.5), t * (2.0 - 1.5 * t) - 0.5],
                [t * t * (1.5 * t - 2.5) + 1.0, t * (4.5 * t - 5.0)],
                [t * (t * (2.0 - 1.5 * t) + 0.5), t * (4.0 - 4.5 * t) + 0.5],
                [t * t * (0.5 * t - 0.5), t * (1.5 * t - 1.0)],
            ]
        });
        let (mut value, mut gradient) = (0.0, DVec3::ZERO);
        for (k, wz) in weights[2].iter().enumerate() {
            for (j, wy) in weights[1].iter().enumerate() {
                let row = self.index([low[0] - 1, low[1] + j - 1, low[2] + k - 1]);
                for (wx, &v) in weights[0].iter().zip(&self.values[row..row + 4]) {
                    let v = f64::from(v);
                    value += v * wx[0] * wy[0] * wz[0];
                    gradient +=
                        v * DVec3::new(wx[1] * wy[0] * wz[0], wx[0] * wy[1] * wz[0], wx[0] * wy[0] * wz[1]);
                }
            }
        }
        (value, gradient / self.cell)
    }

    /// One Newton step to the surface, of half a cell at most.
    fn nearest(&self, p: DVec3) -> DVec3 {
        let (value, gradient) = self.sample(p);
        let step = gradient * (value / gradient.length_squared().max(1e-9));
        p - step.clamp_length_max(0.5 * self.cell)
    }

    /// The quad around the edge from a corner along an axis, if the surface crosses it.
    fn quad(&self, vertices: &[u32], at: [usize; 3], axis: usize) -> Option<[u32; 4]> {
        let mut end = at;
        end[axis] += 1;
        let [from, to] = [at, end].map(|p| self.values[self.index(p)] < 0.0);
        if from == to {
            return None;
        }
        let [u, v] = [(axis + 1) % 3, (axis + 2) % 3];
        let cell = |du: usize, dv: usize| {
            let mut cell = at;
            cell[u] -= du;
            cell[v] -= dv;
            vertices[self.index(cell)]
        };
        // Counter-clockwise seen from the end of the edge.
        let [a, b, c, d] = [cell(0, 0), cell(1, 0), cell(1, 1), cell(0, 1)];
        Some(if from { [a, b, c, d] } else { [d, c, b, a] })
    }
}

/// The corners of a cell; bit 0 of the place is one step along x, bit 1 along y, bit 2 along z.
fn corners([x, y, z]: [usize; 3]) -> [[usize; 3]; 8] {
    std::array::from_fn(|i| [x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)])
}

/// Whether the corners of a cube that a mask names (or their absence) hang together along its edges.
fn connected(mask: u8) -> bool {
    let mut reached = mask & mask.wrapping_neg();
    loop {
        // Along x, y and z: swap the bits of neighbouring corners.
        let x = (reached & 0x55) << 1 | reached >> 1 & 0x55;
        let y = (reached & 0x33) << 2 | reached >> 2 & 0x33;
        let z = reached.rotate_left(4);
        let next = (reached | x | y | z) & mask;
        if next == reached {
            return reached == mask;
        }
        reached = next;
    }
}

/// The net that becomes a surface.
#[derive(Debug, Default)]
struct Net {
    positions: Vec<DVec3>,
    quads: Vec<[u32; 4]>,
}

impl Net {
    /// Moves each vertex half the way to the mean of its neighbours.
    fn relax(&mut self) {
        let mut sums = vec![(DVec3::ZERO, 0.0); self.positions.len()];
        for quad in &self.quads {
            for (i, &corner) in quad.iter().enumerate() {
                let (sum, count) = &mut sums[corner as usize];
                *sum +=
                    self.positions[quad[(i + 1) % 4] as usize] + self.positions[quad[(i + 3) % 4] as usize];
                *count += 2.0;
            }
        }
        for (position, (sum, count)) in self.positions.iter_mut().zip(sums) {
            if count > 0.0 {
                *position = position.lerp(sum / count, 0.5);
            }
        }
    }

    /// Each quad cut along its shorter diagonal; normals are the mean of the triangles around, by
    /// area.
    fn mesh(&self) -> Mesh {
        let at = |i: u32| self.positions[i as usize];
        let mut mesh = Mesh::default();
        let mut normals = vec![DVec3::ZERO; self.positions.len()];
        for &[a, b, c, d] in &self.quads {
            let shorter = at(a).distance_squared(at(c)) < at(b).distance_squared(at(d));
            for corners in if shorter { [[a, b, c], [a, c, d]] } else { [[b, c, d], [b, d, a]] } {
                let [p, q, r] = corners.map(at);
                corners.iter().for_each(|&i| normals[i as usize] += (q - p).cross(r - p));
                mesh.indices.extend(corners);
            }
        }
        for (position, normal) in self.positions.iter().zip(normals) {
            let normal = normal.try_normalize().unwrap_or(DVec3::Y);
            vertex(&mut mesh, position.as_vec3(), normal.as_vec3(), Vec2::ZERO);
        }
        mesh
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use std::collections::HashMap;

    fn ball(center: DVec3, radius: f64) -> Grid {
        let mut grid = Grid::new(1.0, 40, 1.0);
        grid.change(center, 2.0, |p, old| old.min((p.distance(center) - radius) as f32));
        grid
    }

    #[test]
    fn balls_are_round_and_face_outwards() {
        let mesh = ball(DVec3::new(0.1, 0.05, -0.1), 0.6).surface();
        let center = Vec3::new(0.1, 0.05, -0.1);
        for (p, n) in mesh.positions.iter().zip(&mesh.normals) {
            assert!((p.distance(center) - 0.6).abs() < 0.02);
            assert!(n.dot((p - center).normalize()) > 0.99);
        }
        for corners in mesh.indices.chunks_exact(3) {
            let [a, b, c] = [0, 1, 2].map(|k| mesh.positions[corners[k] as usize]);
            assert!((b - a).cross(c - a).dot(a - center) > 0.0);
        }
    }

    #[test]
    fn corners_hang_together() {
        for (mask, expected) in [
            (0, true),
            (0xff, true),
            (0b1, true),
            (0b1001, false),
            (0b1011, true),
            (0x81, false),
            (0x3c, false),
        ] {
            assert_eq!(connected(mask), expected, "{mask:#b}");
        }
    }

    /// Euler's number of a closed surface is 2 − 2 · handles for each part.
    fn euler(mesh: &Mesh) -> i64 {
        let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
        for corners in mesh.indices.chunks_exact(3) {
            for [a, b] in [[0, 1], [1, 2], [2, 0]].map(|e| e.map(|k| corners[k])) {
                *edges.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        assert!(edges.values().all(|&n| n == 0), "each edge is used once in each direction");
        mesh.positions.len() as i64 - edges.len() as i64 + (mesh.indices.len() / 3) as i64
    }

    #[test]
    fn surfaces_are_closed_and_join() {
        // Their gap lies within one layer of cells: none is left where it is narrower than they are.
        let (mut grid, other) = (ball(DVec3::X * -0.325, 0.33), ball(DVec3::X * 0.375, 0.33));
        assert_eq!(euler(&grid.clone().surface()), 2);
        let mut apart = grid.clone();
        apart.join(&other, 0.001);
        assert_eq!(euler(&apart.surface()), 2);
        let mut far = ball(DVec3::X * -0.5, 0.33);
        far.join(&ball(DVec3::X * 0.5, 0.33), 0.001);
        assert_eq!(euler(&far.surface()), 4);
        grid.join(&other, 0.3);
        assert_eq!(euler(&grid.surface()), 2);
    }
}
