//! Scenes from files: glTF 2.0 (`.gltf`, `.glb`) and Wavefront OBJ (`.obj`).
//!
//! What comes back has passed [`Scene::validate`]: it has triangles, every number is finite and
//! every reference leads somewhere. Files are not trusted: sizes are checked against the bytes that
//! are there before anything is allocated, and no input makes the importer panic.

mod error;
mod gltf;
mod image;
mod obj;
mod vertices;

pub use error::{ImportError, Problem};

use crate::Scene;
use std::path::Path;

/// Loads a scene; the file's extension chooses the format, in upper or lower case.
///
/// # Errors
/// See [`ImportError`]; an unknown extension is answered with the list of those allowed.
pub fn load(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    let path = path.as_ref();
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "gltf" | "glb" => gltf(path),
        "obj" => obj(path),
        _ => Err(ImportError::new(path, Problem::Format { extension })),
    }
}

/// Loads a glTF 2.0 file, text or binary, with the buffers and images it refers to.
///
/// Taken: every triangle list, strip and fan of the default scene (the first if none is named, all
/// root nodes if there is no scene, all meshes if there are no nodes either), indexed or not, sparse or not, quantised or not; nodes with
/// matrices or TRS, mirrored or not; GPU instancing; skins and morph targets in the pose at rest;
/// base colours with their texture transforms, cut-outs (`MASK`), two-sidedness; perspective
/// and orthographic cameras; directional and spot lights. Missing normals become flat ones, as the format demands.
///
/// Changed or left out, with a line in [`Scene::notes`]: points and lines, `BLEND` (imported as
/// opaque), point lights, undecodable images on opaque surfaces. Ignored:
/// animations, all material properties but the above, magnification filters (always linear).
///
/// Extensions understood: `KHR_lights_punctual`, `KHR_mesh_quantization`, `KHR_texture_transform`,
/// `EXT_mesh_gpu_instancing`, and the `KHR_materials_*` family in so far as it changes looks and
/// not geometry. A file that requires any other, compression included, is refused.
///
/// # Errors
/// See [`ImportError`].
pub fn gltf(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    let path = path.as_ref();
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    std::fs::read(path)
        .map_err(Problem::Read)
        .and_then(|bytes| gltf::import(&bytes, path.parent(), &name))
        .map_err(|problem| ImportError::new(path, problem))
}

/// Like [`gltf()`] for a file in memory, which may refer to no other files.
///
/// # Errors
/// See [`ImportError`]; messages name the file `name`.
pub fn gltf_bytes(bytes: &[u8], name: &str) -> Result<Scene, ImportError> {
    gltf::import(bytes, None, name).map_err(|problem| ImportError::new(name.as_ref(), problem))
}

/// Loads a Wavefront OBJ file with its MTL libraries: polygons (split into triangles), normals,
/// texture coordinates, vertex colours, diffuse colours and maps. A dissolve map (`map_d`) makes a
/// material a cut-out at 0.5; dissolve factors are ignored. Missing normals become flat ones.
///
/// # Errors
/// See [`ImportError`].
pub fn obj(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    let path = path.as_ref();
    obj::import(path).map_err(|problem| ImportError::new(path, problem))
}
