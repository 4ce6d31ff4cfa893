//! Scenes made by formula: the pictures of the papers, rebuilt to be free of files and licences.
//!
//! Each scene is a function of a seed: the same seed gives the same scene. Lengths are metres.

mod backyard;
mod blocks;
mod brabec;
mod contact;
mod fence;
mod growth;
mod layers;
mod model;
mod plants;
mod props;
mod random;
mod shapes;
mod shed;
mod spheres;
mod spot;
mod tree;
mod trees;

use crate::Scene;

/// A scene that can be built by name.
#[derive(Debug, Clone, Copy)]
pub struct Procedural {
    /// Name, also that of the scene it builds.
    pub name: &'static str,
    /// What one sees, in one line.
    pub description: &'static str,
    /// What is hard about it for shadow maps.
    pub stresses: &'static str,
    /// The paper whose picture it rebuilds.
    pub source: &'static str,
    /// Triangles once flattened, whatever the seed.
    pub triangles: usize,
    build: fn(u64) -> Scene,
}

impl Procedural {
    /// The seed used where none is asked for.
    pub const DEFAULT_SEED: u64 = 1;

    /// Builds the scene, camera and light included. The seed moves and turns things; it changes
    /// neither the number of triangles nor what the scene is about.
    #[must_use]
    pub fn scene(&self, seed: u64) -> Scene {
        (self.build)(seed)
    }
}

/// Every procedural scene.
#[must_use]
pub fn all() -> &'static [Procedural] {
    &[
        fence::FENCE,
        spheres::SPHERES,
        contact::CONTACT,
        spot::SPOT,
        layers::LAYERS,
        blocks::BLOCKS,
        backyard::BACKYARD,
        trees::TREES,
        brabec::BRABEC,
    ]
}

/// The procedural scene of that name, if there is one.
#[must_use]
pub fn by_name(name: &str) -> Option<&'static Procedural> {
    all().iter().find(|p| p.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Aabb;

    #[test]
    fn counts_are_as_announced_for_any_seed() {
        for entry in all() {
            for seed in [1, 77] {
                let scene = entry.scene(seed);
                assert_eq!(scene.name, entry.name);
                assert_eq!(scene.validate(), Ok(()), "{}", entry.name);
                let geometry = scene.flatten();
                assert_eq!(geometry.triangle_count(), entry.triangles, "{}", entry.name);
                assert_eq!(geometry.zero_area_count(), 0, "{}", entry.name);
                assert!(!scene.cameras.is_empty() && !scene.lights.is_empty());
            }
        }
    }

    #[test]
    fn sizes_are_those_of_the_papers() {
        for (name, sizes) in [
            ("fence", 350_000..380_000),
            ("backyard", 350_000..380_000),
            ("spheres", 12_000..12_001),
            ("layers", 0..5_000),
        ] {
            let triangles = by_name(name).map(|entry| entry.triangles);
            assert!(triangles.is_some_and(|n| sizes.contains(&n)), "{name}: {triangles:?}");
        }
    }

    #[test]
    fn seeds_decide() {
        for entry in all() {
            let positions = |seed| entry.scene(seed).flatten().positions;
            assert_eq!(positions(5), positions(5));
        }
        // `contact` alone leaves nothing to chance.
        for entry in all().iter().filter(|entry| entry.name != "contact") {
            let positions = |seed| entry.scene(seed).flatten().positions;
            assert_ne!(positions(1), positions(2), "{}", entry.name);
        }
    }

    #[test]
    fn normals_agree_with_winding() {
        for entry in all() {
            let geometry = entry.scene(3).flatten();
            for t in 0..geometry.triangle_count() {
                let [a, b, c] = geometry.triangle(t);
                let mean: glam::Vec3 = geometry.corners(t).iter().map(|&i| geometry.normals[i]).sum();
                assert!((b - a).cross(c - a).dot(mean) > 0.0, "{} triangle {t}", entry.name);
            }
        }
    }

    #[test]
    fn names_are_found() {
        assert_eq!(by_name("fence").map(|p| p.name), Some("fence"));
        assert!(by_name("garden").is_none());
        let size = |b: Aabb| b.size().x;
        assert_eq!(by_name("fence").and_then(|p| p.scene(1).bounds()).map(size), Some(30.0));
    }
}
