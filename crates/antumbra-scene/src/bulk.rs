//! Where most of a scene is, whatever strays from it.

use crate::{Aabb, Geometry, Scene};
use glam::{DVec3, Vec3};

/// Where most of a scene is, whatever strays from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bulk {
    /// Median of all points, axis by axis.
    pub(crate) center: DVec3,
    /// Nine of ten points are no farther than this from the centre along any axis.
    pub(crate) reach: f64,
}

/// Points that are looked at to find where most of them are.
const SAMPLE: usize = 1 << 16;
/// A scene whose middle is more than that many times its reach from the origin gets an origin of its own.
/// 16 costs four bits of 24.
const FAR: f64 = 16.0;
/// What is that many times as far out as nine of ten points strays.
const STRAY: f64 = 32.0;

impl Bulk {
    /// Of some points, each of them finite; `None` if there are none.
    pub(crate) fn of(points: &[DVec3]) -> Option<Self> {
        let axes = [0, 1, 2].map(|axis| quantile(points.iter().map(|p| p[axis]).collect(), 0.5));
        let [Some(x), Some(y), Some(z)] = axes else { return None };
        let center = DVec3::new(x, y, z);
        let away = points.iter().map(|p| (*p - center).abs().max_element()).collect();
        quantile(away, 0.9).map(|reach| Self { center, reach })
    }

    /// Whether a point is no stray.
    fn holds(&self, point: Vec3) -> bool {
        (point.as_dvec3() - self.center).abs().max_element() <= STRAY * self.reach
    }

    /// The box around those of the points that are no strays; `whole` is the box around all.
    fn bounds(&self, whole: Aabb, points: impl Iterator<Item = Vec3>) -> Aabb {
        let all = self.reach == 0.0 || self.holds(whole.min) && self.holds(whole.max);
        let max = if all { None } else { Aabb::around(points.filter(|p| self.holds(*p))) };
        max.unwrap_or(whole)
    }

    /// A round point in the middle, if that is far from the origin.
    fn origin(&self) -> Option<DVec3> {
        let is_far = self.center.abs().max_element() > FAR * self.reach;
        let step = 10f64.powf((2.0 * self.reach).log10().floor());
        (is_far && self.reach > 0.0).then(|| (self.center / step).round() * step).filter(|o| o.is_finite())
    }
}

/// The value that a share of all values does not exceed.
fn quantile(mut values: Vec<f64>, share: f64) -> Option<f64> {
    let place = (values.len().checked_sub(1)? as f64 * share) as usize;
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// The origin that a scene of these points is given: zero, unless they are far from that.
///
/// Cost: looks at 65,536 points at most.
pub(crate) fn origin(points: &[DVec3]) -> DVec3 {
    let stride = points.len().div_ceil(SAMPLE).max(1);
    let sample: Vec<DVec3> = points.iter().step_by(stride).copied().filter(|p| p.is_finite()).collect();
    Bulk::of(&sample).and_then(|bulk| bulk.origin()).unwrap_or_default()
}

impl Scene {
    /// Where most of the placed vertices are; `None` if there are none.
    ///
    /// Cost: looks at 65,536 vertices at most, at equal distances in the list of all.
    pub(crate) fn bulk(&self) -> Option<Bulk> {
        let placed = || self.instances.iter().filter_map(|i| Some((self.meshes.get(i.mesh)?, i)));
        let count: usize = placed().map(|(mesh, _)| mesh.positions.len()).sum();
        let stride = count.div_ceil(SAMPLE).max(1);
        let mut points = Vec::with_capacity(count / stride + 1);
        let mut next = 0;
        for (mesh, instance) in placed() {
            let own = mesh.positions.iter().skip(next).step_by(stride);
            let before = points.len();
            points.extend(own.map(|p| instance.world_from_mesh.transform_point3(p.as_dvec3())));
            next = next + (points.len() - before) * stride - mesh.positions.len();
        }
        points.retain(|p| p.is_finite());
        Bulk::of(&points)
    }

    /// The box around what is not far away from all the rest: what a picture of the whole should show.
    /// Equal to [`bounds`](Self::bounds) unless something strays.
    ///
    /// Cost: reads every index of every instance up to twice.
    #[must_use]
    pub fn main_bounds(&self) -> Option<Aabb> {
        Some(self.bulk()?.bounds(self.bounds()?, self.placed_points()))
    }

    /// A sentence about what [`main_bounds`](Self::main_bounds) leaves out, if it leaves out anything.
    #[must_use]
    pub fn strays(&self) -> Option<String> {
        let (bulk, whole) = (self.bulk()?, self.bounds()?);
        let main = self.main_bounds()?;
        if main == whole {
            return None;
        }
        let strays = |i: &&crate::Instance| {
            let Some(mesh) = self.meshes.get(i.mesh) else { return false };
            mesh.positions
                .iter()
                .any(|p| !bulk.holds(i.world_from_mesh.transform_point3(p.as_dvec3()).as_vec3()))
        };
        let strays: Vec<_> = self.instances.iter().filter(strays).collect();
        let name = |i: &&crate::Instance| {
            let node =
                i.node.and_then(|n| self.nodes.get(n)).map(|n| n.name.clone()).filter(|n| !n.is_empty());
            format!("'{}'", node.unwrap_or_else(|| self.meshes[i.mesh].name.clone()))
        };
        let named: Vec<String> = strays.iter().take(3).map(name).collect();
        let more = if strays.len() > 3 { format!(" and {} more", strays.len() - 3) } else { String::new() };
        Some(format!(
            "of {} parts, {}{more} reach beyond {STRAY} times the size of the rest ({} units of {}); the default \
             camera shows the rest (--leave-out leaves parts out, --camera looks elsewhere)",
            self.instances.len(),
            named.join(", "),
            whole.size().max_element(),
            main.size().max_element(),
        ))
    }
}

impl Geometry {
    /// The box around what a camera at `eye` may be about: all but triangles that lie far away from all the
    /// rest, unless the eye does too. A ground that reaches from here to there is not far away.
    ///
    /// Cost: reads every index up to three times.
    #[must_use]
    pub fn bounds_around(&self, eye: Vec3) -> Option<Aabb> {
        let whole = self.bounds()?;
        let stride = self.indices.len().div_ceil(SAMPLE).max(1);
        let corner = |&i: &u32| self.positions[i as usize];
        let sample: Vec<DVec3> = self.indices.iter().step_by(stride).map(|i| corner(i).as_dvec3()).collect();
        let bulk = Bulk::of(&sample)?;
        if bulk.reach == 0.0 || !bulk.holds(eye) || bulk.holds(whole.min) && bulk.holds(whole.max) {
            return Some(whole);
        }
        let room = DVec3::splat(STRAY * bulk.reach);
        let (low, high) = ((bulk.center - room).as_vec3(), (bulk.center + room).as_vec3());
        let near = (0..self.triangle_count()).map(|t| self.triangle(t)).filter(|[a, b, c]| {
            let (min, max) = (a.min(*b).min(*c), a.max(*b).max(*c));
            min.cmple(high).all() && max.cmpge(low).all()
        });
        Aabb::around(near.flatten())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural;

    /// Points of a box around `center`.
    fn cloud(center: DVec3, half: f64) -> Vec<DVec3> {
        (0..64)
            .map(|i| {
                center + half * DVec3::new(f64::from(i % 4), f64::from(i / 4 % 4), f64::from(i / 16)) / 1.5
                    - half
            })
            .collect()
    }

    #[test]
    fn only_what_is_far_gets_an_origin_of_its_own() {
        assert_eq!(origin(&[]), DVec3::ZERO);
        assert_eq!(origin(&cloud(DVec3::new(60.0, -3.0, 0.0), 5.0)), DVec3::ZERO);
        let far = DVec3::new(4_180_374.2, 500_000.0, -855_123.7);
        let found = origin(&cloud(far, 5.0));
        assert!((found - far).abs().max_element() <= 7.0 && found.x % 10.0 == 0.0, "{found}");
        // A stray point neither moves the origin nor keeps the scene from having one.
        let mut points = cloud(far, 5.0);
        points.push(DVec3::ZERO);
        assert!((origin(&points) - far).abs().max_element() <= 7.0);
        // Thin, small and single points have no size to be far in terms of.
        assert_eq!(origin(&[far]), DVec3::ZERO);
        let small = origin(&cloud(DVec3::new(1.0, 2.0, 3.0), 1e-4));
        assert!((small - DVec3::new(1.0, 2.0, 3.0)).abs().max_element() <= 1e-3, "{small}");
    }

    #[test]
    fn a_stray_triangle_is_not_framed() {
        let mut scene = procedural::by_name("spheres").unwrap().scene(1);
        scene.cameras.clear();
        let (whole, camera) = (scene.bounds(), scene.default_camera());
        assert_eq!((scene.main_bounds(), scene.strays()), (whole, None));
        scene.meshes.push(crate::Mesh {
            name: "stray".into(),
            positions: [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p * 0.001 + 8000.0 * Vec3::X).to_vec(),
            normals: vec![Vec3::Z; 3],
            uvs: vec![glam::Vec2::ZERO; 3],
            colors: vec![glam::Vec4::ONE; 3],
            indices: vec![0, 1, 2],
            material: 0,
        });
        scene.instances.push(crate::Instance::new(scene.meshes.len() - 1, glam::DMat4::IDENTITY));
        assert_eq!((scene.main_bounds(), scene.default_camera()), (whole, camera));
        let geometry = scene.flatten();
        assert_eq!(geometry.bounds_around(camera.position), whole);
        assert_eq!(geometry.bounds_around(Vec3::new(8000.0, 1.0, 0.0)), geometry.bounds(), "it is there too");
        let said = scene.strays().unwrap();
        assert!(said.contains("'stray' reach beyond"), "{said}");
    }

    #[test]
    fn a_large_ground_receives_shadows() {
        let mut scene = procedural::by_name("spheres").unwrap().scene(1);
        let side = 1e4;
        scene.meshes.push(crate::Mesh {
            positions: vec![
                Vec3::new(-side, 0.0, side),
                Vec3::new(side, 0.0, side),
                Vec3::new(0.0, 0.0, -side),
            ],
            normals: vec![Vec3::Y; 3],
            uvs: vec![glam::Vec2::ZERO; 3],
            colors: vec![glam::Vec4::ONE; 3],
            indices: vec![0, 1, 2],
            ..crate::Mesh::default()
        });
        scene.instances.push(crate::Instance::new(scene.meshes.len() - 1, glam::DMat4::IDENTITY));
        let geometry = scene.flatten();
        assert_eq!(geometry.bounds_around(Vec3::Y), geometry.bounds());
        assert!(scene.main_bounds().unwrap().size().x < 1000.0, "but a camera sees the spheres");
    }
}
