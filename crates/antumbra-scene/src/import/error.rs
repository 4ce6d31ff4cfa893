//! Why a file was refused.

use crate::SceneError;
use std::fmt::Display;
use std::path::{Path, PathBuf};

/// A file that was refused, and why.
#[derive(Debug, thiserror::Error)]
#[error("{}: {problem}", file.display())]
pub struct ImportError {
    /// The file as it was asked for.
    pub file: PathBuf,
    /// What is wrong with it.
    #[source]
    pub problem: Problem,
}

impl ImportError {
    pub(super) fn new(file: &Path, problem: Problem) -> Self {
        Self { file: file.into(), problem }
    }
}

/// What is wrong with a file. Messages name the element, its value and what is allowed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Problem {
    /// The file itself cannot be read.
    #[error("cannot be read: {0}")]
    Read(#[source] std::io::Error),
    /// Not a format we know.
    #[error("{}; allowed are .gltf, .glb and .obj", unknown_format(extension))]
    Format {
        /// Extension in lower case, without the dot.
        extension: String,
    },
    /// A file that this file needs cannot be read.
    #[error("{element} names '{uri}', which cannot be read: {source}")]
    Resource {
        /// Who needs it.
        element: String,
        /// What it is called there.
        uri: String,
        /// What went wrong.
        source: std::io::Error,
    },
    /// Not JSON, or not the JSON that glTF asks for.
    #[error("{element}: {source}")]
    Json {
        /// Path of the offending element.
        element: String,
        /// What was expected and found, with line and column.
        source: serde_json::Error,
    },
    /// An extension that may move triangles, and is not read, is required.
    #[error(
        "{element} names {extension}, which is not supported: {remedy}; allowed are {allowed} and those that move \
         no triangle"
    )]
    Extension {
        /// Who requires it.
        element: String,
        /// Name of the first such extension.
        extension: String,
        /// What can be done about it.
        remedy: String,
        /// Names of the extensions that are read.
        allowed: &'static str,
    },
    /// A value that breaks a rule of the format.
    #[error("{element} is {value}; {allowed}")]
    Invalid {
        /// Path of the element, such as `meshes[2].primitives[0].attributes.POSITION`.
        element: String,
        /// What was found.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// An image that decides about cut-outs cannot be decoded.
    #[error("{element}: the image cannot be decoded: {message}")]
    Image {
        /// Path of the image.
        element: String,
        /// What the decoder said.
        message: String,
    },
    /// An image is in a format that is not decoded.
    #[error("{element}: {format} is not decoded; convert it to PNG, JPEG or WebP")]
    ImageFormat {
        /// Path of the image.
        element: String,
        /// Name of the format.
        format: String,
    },
    /// Nothing is left to draw, and notes say what was left out.
    #[error("{source}; left out: {notes}")]
    NothingLeft {
        /// That there are no triangles.
        source: SceneError,
        /// What was left out, and how to keep it.
        notes: String,
    },
    /// The file was read, but the scene in it cannot be used.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// What is wrong with a file's name.
fn unknown_format(extension: &str) -> String {
    match extension {
        "" => "the name of the file has no extension, which would tell its format".into(),
        _ => format!("files that end in '.{extension}' are not supported"),
    }
}

/// A [`Problem::Invalid`].
pub(super) fn invalid(
    element: impl Into<String>,
    value: impl Display,
    allowed: impl Into<String>,
) -> Problem {
    Problem::Invalid { element: element.into(), value: value.to_string(), allowed: allowed.into() }
}
