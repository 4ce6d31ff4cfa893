//! What makes a scene unfit for raster and rays.

use crate::{Light, Mesh, Projection, Scene};
use glam::Vec3;

/// Why a scene cannot be used. Each message names the element, its value and what is allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Nothing to draw.
    #[error(
        "scene '{scene}' has no triangles: {meshes} meshes in {instances} instances; at least one is needed"
    )]
    NoTriangles {
        /// Name of the scene.
        scene: String,
        /// Number of meshes.
        meshes: usize,
        /// Number of instances.
        instances: usize,
    },
    /// More than 32-bit numbers can count.
    #[error(
        "scene '{scene}' has {triangles} triangles and {vertices} vertices once instanced; at most {} triangles and {} vertices are allowed",
        Scene::MAX_TRIANGLES,
        Scene::MAX_VERTICES
    )]
    TooLarge {
        /// Name of the scene.
        scene: String,
        /// Triangles of all instances.
        triangles: u64,
        /// Vertices of all instances.
        vertices: u64,
    },
    /// A coordinate is infinite or not a number.
    #[error("mesh {mesh} '{name}': {attribute} of vertex {vertex} is ({x}, {y}, {z}); it must be finite", x = value.x, y = value.y, z = value.z)]
    NonFiniteVertex {
        /// Index of the mesh.
        mesh: usize,
        /// Name of the mesh.
        name: String,
        /// "position", "normal" or "texture coordinate".
        attribute: &'static str,
        /// Index of the vertex.
        vertex: usize,
        /// What was found (z is 0 for texture coordinates).
        value: Vec3,
    },
    /// An index names no vertex.
    #[error(
        "mesh {mesh} '{name}': indices[{place}] is {index}; it must be below {vertices}, the number of vertices"
    )]
    IndexOutOfRange {
        /// Index of the mesh.
        mesh: usize,
        /// Name of the mesh.
        name: String,
        /// Place in the index list.
        place: usize,
        /// What was found there.
        index: u32,
        /// Number of vertices.
        vertices: usize,
    },
    /// The index list does not divide into triangles.
    #[error("mesh {mesh} '{name}' has {indices} indices; a triangle list needs a multiple of 3")]
    PartialTriangle {
        /// Index of the mesh.
        mesh: usize,
        /// Name of the mesh.
        name: String,
        /// Number of indices.
        indices: usize,
    },
    /// An attribute has more or fewer entries than the positions.
    #[error("mesh {mesh} '{name}' has {found} {attribute} for {positions} positions; it needs one each")]
    AttributeCount {
        /// Index of the mesh.
        mesh: usize,
        /// Name of the mesh.
        name: String,
        /// "normals", "uvs" or "colors".
        attribute: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        positions: usize,
    },
    /// A reference leads nowhere.
    #[error("{owner}: {kind} {index} does not exist; there are {count}")]
    Missing {
        /// Who refers.
        owner: String,
        /// "mesh", "material" or "image".
        kind: &'static str,
        /// To what.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A placed vertex is farther out than [`Scene::MAX_COORDINATE`], or the transform is not finite.
    #[error("instance {instance} moves vertex {vertex} of mesh {mesh} to ({x}, {y}, {z}); world positions must be finite and within {max:e} of the origin: scale the scene", x = world.x, y = world.y, z = world.z, max = Scene::MAX_COORDINATE)]
    BadTransform {
        /// Index of the instance.
        instance: usize,
        /// Index of its mesh.
        mesh: usize,
        /// Index of the first such vertex.
        vertex: usize,
        /// Where it ends up.
        world: Vec3,
    },
    /// An image's bytes do not match its size.
    #[error(
        "image {image} '{name}' has {bytes} bytes for {width}x{height} pixels; it needs 4 a pixel and at least one pixel"
    )]
    BadImage {
        /// Index of the image.
        image: usize,
        /// Name of the image.
        name: String,
        /// Bytes found.
        bytes: usize,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// A light or camera has a number that no view can be made of.
    #[error("{what}: {problem}")]
    BadView {
        /// `lights[i]` or `cameras[i]`.
        what: String,
        /// What is wrong with it.
        problem: &'static str,
    },
}

impl Scene {
    /// Most triangles that a scene may have, all instances counted.
    pub const MAX_TRIANGLES: u64 = (u32::MAX / 3) as u64;
    /// Most vertices that a scene may have, all instances counted.
    pub const MAX_VERTICES: u64 = u32::MAX as u64;
    /// Farthest that a placed vertex may be from the origin along an axis: what leaves room in `f32` for a
    /// camera that sees the whole.
    pub const MAX_COORDINATE: f32 = 1e36;

    /// Checks everything that [`Scene::flatten`] and its users rely on. Zero-area triangles are
    /// allowed: [`Geometry::zero_area_count`](crate::Geometry::zero_area_count) counts them.
    ///
    /// Cost: reads every vertex of every instance once.
    ///
    /// # Errors
    /// The first problem found, in the order images, materials, meshes, instances, sizes, views.
    pub fn validate(&self) -> Result<(), SceneError> {
        for (index, image) in self.images.iter().enumerate() {
            let need = 4 * u64::from(image.width) * u64::from(image.height);
            if need == 0 || need != image.rgba.len() as u64 {
                return Err(SceneError::BadImage {
                    image: index,
                    name: image.name.clone(),
                    bytes: image.rgba.len(),
                    width: image.width,
                    height: image.height,
                });
            }
        }
        for material in &self.materials {
            if let Some(image) = material.base_color_image {
                exists(|| format!("material '{}'", material.name), "image", image, self.images.len())?;
            }
        }
        for (index, mesh) in self.meshes.iter().enumerate() {
            exists(
                || format!("mesh {index} '{}'", mesh.name),
                "material",
                mesh.material,
                self.materials.len(),
            )?;
            validate_mesh(index, mesh)?;
        }
        self.validate_instances()?;
        self.validate_views()
    }

    fn validate_instances(&self) -> Result<(), SceneError> {
        let (mut triangles, mut vertices) = (0_u64, 0_u64);
        for (index, instance) in self.instances.iter().enumerate() {
            exists(|| format!("instance {index}"), "mesh", instance.mesh, self.meshes.len())?;
            let mesh = &self.meshes[instance.mesh];
            triangles += mesh.indices.len() as u64 / 3;
            vertices += mesh.positions.len() as u64;
        }
        if triangles > Self::MAX_TRIANGLES || vertices > Self::MAX_VERTICES {
            return Err(SceneError::TooLarge { scene: self.name.clone(), triangles, vertices });
        }
        if triangles == 0 {
            return Err(SceneError::NoTriangles {
                scene: self.name.clone(),
                meshes: self.meshes.len(),
                instances: self.instances.len(),
            });
        }
        for (index, instance) in self.instances.iter().enumerate() {
            let matrix = instance.world_from_mesh;
            for (vertex, p) in self.meshes[instance.mesh].positions.iter().enumerate() {
                let world = matrix.transform_point3(p.as_dvec3()).as_vec3();
                if world.is_nan() || world.abs().max_element() > Self::MAX_COORDINATE {
                    return Err(SceneError::BadTransform {
                        instance: index,
                        mesh: instance.mesh,
                        vertex,
                        world,
                    });
                }
            }
        }
        Ok(())
    }

    fn validate_views(&self) -> Result<(), SceneError> {
        let bad = |what: String, problem| Err(SceneError::BadView { what, problem });
        for (index, camera) in self.cameras.iter().enumerate() {
            let what = format!("cameras[{index}]");
            let forward = camera.target - camera.position;
            if !(camera.position.is_finite() && forward.is_finite() && camera.up.is_finite()) {
                return bad(what, "position, target and up must be finite");
            }
            // In f64, where every finite length has a square.
            let [ahead, up] = [forward, camera.up].map(|v| v.as_dvec3().normalize_or_zero());
            if ahead.cross(up).length() < 1e-6 {
                return bad(what, "up must not be parallel to the line from position to target");
            }
            if !camera.projection.is_usable() {
                return bad(
                    what,
                    match camera.projection {
                        Projection::Perspective { .. } => "fov_y must lie between 0 and π",
                        Projection::Orthographic { .. } => "height must be finite and more than 0",
                    },
                );
            }
        }
        for (index, light) in self.lights.iter().enumerate() {
            let what = format!("lights[{index}]");
            let (Light::Directional { direction } | Light::Spot { direction, .. }) = *light;
            if !direction.is_normalized() {
                return bad(what, "direction must have length 1");
            }
            if let Light::Spot { position, outer_angle, .. } = *light {
                if !position.is_finite() {
                    return bad(what, "position must be finite");
                }
                if !(outer_angle > 0.0 && outer_angle <= Light::MAX_OUTER_ANGLE) {
                    return bad(
                        what,
                        "outer_angle must be more than 0 and at most 1.48 (Light::MAX_OUTER_ANGLE)",
                    );
                }
            }
        }
        Ok(())
    }
}

fn exists(
    owner: impl FnOnce() -> String,
    kind: &'static str,
    index: usize,
    count: usize,
) -> Result<(), SceneError> {
    if index < count { Ok(()) } else { Err(SceneError::Missing { owner: owner(), kind, index, count }) }
}

fn validate_mesh(index: usize, mesh: &Mesh) -> Result<(), SceneError> {
    let (name, positions) = (&mesh.name, mesh.positions.len());
    let counts = [("normals", mesh.normals.len()), ("uvs", mesh.uvs.len()), ("colors", mesh.colors.len())];
    if let Some(&(attribute, found)) = counts.iter().find(|(_, n)| *n != positions) {
        return Err(SceneError::AttributeCount {
            mesh: index,
            name: name.clone(),
            attribute,
            found,
            positions,
        });
    }
    let finite = |attribute, values: &mut dyn Iterator<Item = Vec3>| match values
        .enumerate()
        .find(|(_, v)| !v.is_finite())
    {
        Some((vertex, value)) => {
            Err(SceneError::NonFiniteVertex { mesh: index, name: name.clone(), attribute, vertex, value })
        }
        None => Ok(()),
    };
    finite("position", &mut mesh.positions.iter().copied())?;
    finite("normal", &mut mesh.normals.iter().copied())?;
    finite("texture coordinate", &mut mesh.uvs.iter().map(|uv| uv.extend(0.0)))?;
    if !mesh.indices.len().is_multiple_of(3) {
        return Err(SceneError::PartialTriangle {
            mesh: index,
            name: name.clone(),
            indices: mesh.indices.len(),
        });
    }
    match mesh.indices.iter().enumerate().find(|(_, i)| **i as usize >= positions) {
        Some((place, &found)) => Err(SceneError::IndexOutOfRange {
            mesh: index,
            name: name.clone(),
            place,
            index: found,
            vertices: positions,
        }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::procedural;
    use glam::{DMat4, DVec3};

    fn message(change: impl FnOnce(&mut Scene)) -> String {
        let mut scene = procedural::by_name("contact").map(|p| p.scene(1)).unwrap_or_default();
        assert_eq!(scene.validate(), Ok(()));
        change(&mut scene);
        scene.validate().unwrap_err().to_string()
    }

    #[test]
    fn messages_name_the_element_and_its_value() {
        assert_eq!(
            message(|s| s.meshes[1].positions[5].y = f32::INFINITY),
            "mesh 1 'box': position of vertex 5 is (0.7, inf, -0.4); it must be finite"
        );
        assert_eq!(
            message(|s| s.meshes[0].indices[4] = 4),
            "mesh 0 'ground': indices[4] is 4; it must be below 4, the number of vertices"
        );
        assert_eq!(
            message(|s| s.instances.clear()),
            "scene 'contact' has no triangles: 3 meshes in 0 instances; at least one is needed"
        );
        assert_eq!(message(|s| s.instances[2].mesh = 8), "instance 2: mesh 8 does not exist; there are 3");
        assert_eq!(
            message(|s| s.meshes[0].material = 3),
            "mesh 0 'ground': material 3 does not exist; there are 3"
        );
        assert_eq!(
            message(|s| s.materials[1].base_color_image = Some(0)),
            "material 'clay': image 0 does not exist; there are 0"
        );
        assert!(message(|s| s.meshes[0].uvs.truncate(3)).contains("has 3 uvs for 4 positions"));
        assert!(message(|s| s.meshes[0].indices.truncate(5)).contains("has 5 indices"));
        assert!(
            message(|s| s.instances[0].world_from_mesh = DMat4::from_scale(DVec3::NAN))
                .starts_with("instance 0 moves vertex 0 of mesh 0 to (NaN")
        );
    }

    #[test]
    fn views_must_be_usable() {
        let lens = |projection| message(|s| s.cameras[0].projection = projection);
        assert!(lens(Projection::Perspective { fov_y: 0.0 }).starts_with("cameras[0]: fov_y"));
        for height in [0.0, -1.0, f32::INFINITY, f32::NAN] {
            assert!(lens(Projection::Orthographic { height }).starts_with("cameras[0]: height"), "{height}");
        }
        assert!(message(|s| s.cameras[0].target = s.cameras[0].position + Vec3::Y).contains("up must not"));
        let mut scene = procedural::by_name("contact").map(|p| p.scene(1)).unwrap_or_default();
        scene.cameras[0].target = Vec3::X * 2e25;
        assert_eq!(scene.validate(), Ok(()), "a length without a square in f32 has a direction");
        let long = Light::Directional { direction: Vec3::splat(2.0) };
        assert_eq!(message(|s| s.lights[0] = long), "lights[0]: direction must have length 1");
    }
}
