//! Scenes from files: glTF 2.0 (`.gltf`, `.glb`) and Wavefront OBJ (`.obj`).
//!
//! What comes back has passed [`Scene::validate`]: it has triangles, every number is finite and
//! every reference leads somewhere. Files are not trusted: sizes are checked against the bytes that
//! are there before anything is allocated, and no input makes the importer panic.

mod error;
mod gltf;
mod image;
mod notes;
mod obj;
mod options;
mod vertices;

pub use error::{ImportError, Problem};
pub use options::{Blend, Options};

use crate::Scene;
use std::path::Path;

/// Loads a scene as its file leaves it; the file's extension chooses the format, in upper or lower
/// case.
///
/// # Errors
/// See [`ImportError`]; an unknown extension is answered with the list of those allowed.
pub fn load(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    load_with(path, &Options::default())
}

/// Like [`load`], with a choice of scene, pose and more.
///
/// # Errors
/// See [`ImportError`]; also for choices that the file does not offer.
pub fn load_with(path: impl AsRef<Path>, options: &Options) -> Result<Scene, ImportError> {
    let path = path.as_ref();
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    match extension.as_str() {
        "gltf" | "glb" => gltf_with(path, options),
        "obj" => match options.refuse_gltf_choices("OBJ") {
            Ok(()) => obj_with(path, options),
            Err(problem) => Err(ImportError::new(path, problem)),
        },
        _ => Err(ImportError::new(path, Problem::Format { extension })),
    }
}

/// Loads a glTF 2.0 file, text or binary, with the buffers and images it refers to.
///
/// Taken: every triangle list, strip and fan of one scene (the default one, the first if none is
/// named, all nodes if there is no scene, all meshes if there are no nodes either), indexed or not,
/// sparse or not, quantised, compressed by meshoptimizer or not; nodes with matrices or TRS, mirrored
/// or not; GPU instancing; skins and morph targets, at rest or posed by an animation
/// ([`Options::time`]); base colours (PNG, JPEG, WebP) with their texture transforms, cut-outs
/// (`MASK`), two-sidedness; perspective and orthographic cameras; directional and spot lights, spots of more
/// than [`Light::MAX_OUTER_ANGLE`](crate::Light::MAX_OUTER_ANGLE) narrowed to it. Missing normals become flat
/// ones, as the format demands.
///
/// Changed or left out, with a line in [`Scene::notes`] for each kind: points and lines, hidden nodes,
/// coarser levels of detail, surfaces that blend or transmit light ([`Blend`]), point lights, images that
/// cannot be had or decoded, animations that are not asked for, extensions that are not read. Ignored: all
/// material properties but the above, magnification filters (always linear).
///
/// A file that requires an extension that may move triangles and is not read, Draco's among them, is
/// refused with what converts it.
///
/// # Errors
/// See [`ImportError`].
pub fn gltf(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    gltf_with(path.as_ref(), &Options::default())
}

fn gltf_with(path: &Path, options: &Options) -> Result<Scene, ImportError> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    std::fs::read(path)
        .map_err(Problem::Read)
        .and_then(|bytes| gltf::import(&bytes, path.parent(), &name, options))
        .map_err(|problem| ImportError::new(path, problem))
}

/// Like [`gltf()`] for a file in memory, which may refer to no other files.
///
/// # Errors
/// See [`ImportError`]; messages name the file `name`.
pub fn gltf_bytes(bytes: &[u8], name: &str) -> Result<Scene, ImportError> {
    gltf_bytes_with(bytes, name, &Options::default())
}

/// Like [`gltf_bytes`], with a choice of scene, pose and more.
///
/// # Errors
/// See [`ImportError`]; also for choices that the file does not offer.
pub fn gltf_bytes_with(bytes: &[u8], name: &str, options: &Options) -> Result<Scene, ImportError> {
    gltf::import(bytes, None, name, options).map_err(|problem| ImportError::new(name.as_ref(), problem))
}

/// Loads a Wavefront OBJ file with its MTL libraries: polygons, concave ones too, split into triangles;
/// normals, texture coordinates, vertex colours, diffuse colours, maps with their options (`-s`, `-o`,
/// `-clamp`, `-imfchan`). Text may be UTF-8 or UTF-16, with or without a byte order mark. Positions are read
/// in double precision. Missing normals become flat ones.
///
/// A dissolve map (`map_d`) or else holes in the alpha of the diffuse map make a material a cut-out at ½.
/// Without them a material that lets half of the light or more through (`d`, `Tr`) is left out, unless
/// [`Blend`] says otherwise.
///
/// Changed or left out, with a line in [`Scene::notes`] for each kind: points, lines and curved surfaces,
/// unknown statements, numbers that are none, libraries and images that cannot be read (a surface whose mask
/// is missing is solid), displacement maps.
///
/// # Errors
/// See [`ImportError`].
pub fn obj(path: impl AsRef<Path>) -> Result<Scene, ImportError> {
    obj_with(path.as_ref(), &Options::default())
}

fn obj_with(path: &Path, options: &Options) -> Result<Scene, ImportError> {
    obj::import(path, options.blend).map_err(|problem| ImportError::new(path, problem))
}

/// Like [`obj`] for a file in memory; `others` are the libraries and images that it may refer to, with the
/// names that they have there.
///
/// # Errors
/// See [`ImportError`]; messages name the file `name`.
pub fn obj_bytes(bytes: &[u8], others: &[(&str, &[u8])], name: &str) -> Result<Scene, ImportError> {
    obj::import_bytes(bytes, others, name, Blend::default())
        .map_err(|problem| ImportError::new(name.as_ref(), problem))
}
