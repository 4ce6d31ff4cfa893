//! What a comparison measured, as data: the content of `results.json`.
//!
//! The schema is versioned by [`SCHEMA`]. A reader checks that string first; fields are only ever
//! added under one version, and what was added later (marked so) may be missing in older files.
//! Numbers are finite: a quantity that does not exist for an image (the
//! leak of a picture without deep shadow, the PSNR of two equal images) is `null`.

use crate::classes::ClassShare;
use crate::files::{self, FileError};
use crate::metrics::Score;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

mod cost;
mod csv;
mod scene;

pub use antumbra::{Lifetime, MemoryItem, technique::Family};
pub use cost::{MemoryResult, PassTime, Spread, StartUp, TimeMethod, TimeResult, Work};
pub use scene::{BoundsFacts, CameraFacts, LensFacts, LightFacts, SceneFacts, ViewFacts};

/// Name and version of the schema.
pub const SCHEMA: &str = "antumbra-results/1";

/// One comparison: a scene, its truths, and every technique that was tried on it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`SCHEMA`].
    pub schema: String,
    /// What was run.
    #[serde(flatten)]
    pub run: RunFacts,
    /// Name of the picture in the colours of the cascades, if there are several. Added later.
    #[serde(default)]
    pub cascades: Option<String>,
    /// The ray-traced truths.
    pub truth: TruthFacts,
    /// One entry per technique and settings, in the order they were asked for.
    pub techniques: Vec<TechniqueResult>,
    /// Techniques that were asked for and refused. Added later.
    #[serde(default)]
    pub left_out: Vec<LeftOut>,
    /// Most memory the process held at once, bytes; `null` where the system does not tell.
    pub peak_memory_bytes: Option<u64>,
    /// Wall-clock time of the whole comparison, seconds.
    pub seconds_total: f64,
    /// Names of the other files of the report, filled in when the report is written.
    #[serde(default)]
    pub files: Vec<String>,
}

/// What was run: program, scene, maps and machine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunFacts {
    /// The program that measured.
    pub program: Program,
    /// The command line, program first, one entry per argument.
    pub command: Vec<String>,
    /// What was rendered.
    pub scene: SceneFacts,
    /// Width and height of the rendered images, pixels.
    pub resolution: [u32; 2],
    /// Width and height of each shadow map, texels.
    pub map_size: u32,
    /// Width of kernels that a spec does not set and of the light-space ideal's, texels.
    pub kernel_texels: u32,
    /// The bias of every technique. Added later.
    #[serde(default)]
    pub bias: String,
    /// The light's views (cascades), nearest first. Added later.
    #[serde(default)]
    pub views: Vec<ViewFacts>,
    /// The graphics adapter.
    pub adapter: AdapterFacts,
    /// Why no number here is to be trusted, if so: one sentence each. Added later.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub warnings: Vec<String>,
    /// What makes the results less than they could be: one sentence each. Added later.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub notes: Vec<String>,
}

/// Name and version of a program.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Program {
    /// "antumbra".
    pub name: String,
    /// Version as released.
    pub version: String,
}

/// The graphics adapter as it names itself.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AdapterFacts {
    /// Device.
    pub name: String,
    /// Driver and its version.
    pub driver: String,
    /// Graphics API.
    pub backend: String,
    /// Discrete, integrated, virtual or software.
    pub device_type: String,
    /// Optional features in use.
    pub features: Vec<String>,
}

/// The ray-traced truths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TruthFacts {
    /// Time to build the acceleration structure, seconds; next to nothing where a default view was chosen with it.
    pub seconds_build: f64,
    /// Time for the hard truth, seconds.
    pub seconds_hard: f64,
    /// Time for the light-space ideal, seconds.
    pub seconds_light_space: f64,
    /// Time for the screen-space ideal, seconds.
    pub seconds_screen_space: f64,
    /// Share of pixels where raster and rays see the same triangle, 0..1.
    pub coverage_agreement: f64,
    /// Pixels of the rest by explanation, e.g. "on a shared edge".
    pub coverage_explained: BTreeMap<String, u64>,
    /// Pixels that see geometry facing the light.
    pub shadowable_pixels: u64,
    /// The all-lit image against the hard truth: what drawing no shadow scores.
    pub no_shadow: Score,
    /// The truths as images.
    pub images: TruthImages,
}

impl TruthFacts {
    /// Share of pixels that may match without any shadow before a view says nothing about techniques.
    pub const MAX_WITHOUT_SHADOW: f64 = 0.97;

    /// Whether the view shows so little shadow that scores rank nothing.
    #[must_use]
    pub fn shows_no_shadow(&self) -> bool {
        self.no_shadow.pixel_match > Self::MAX_WITHOUT_SHADOW
    }
}

/// Names of the truths' images.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TruthImages {
    /// One shadow ray per pixel.
    pub hard: String,
    /// Ray-traced depth, filtered by the kernel in light space.
    pub light_space: String,
    /// Many rays per pixel.
    pub screen_space: String,
}

/// One technique with its settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TechniqueResult {
    /// Stem of its files, e.g. "esm".
    pub name: String,
    /// What reproduces it on the command line, e.g. "esm.c=80,kernel=5"; unique in one comparison.
    pub spec: String,
    /// Name for people, e.g. "Exponential shadow map".
    pub title: String,
    /// How it filters.
    pub family: Family,
    /// Where it was published.
    pub paper: String,
    /// Every setting with its value.
    pub settings: BTreeMap<String, Value>,
    /// Error against each truth.
    pub scores: Scores,
    /// Error against the light-space ideal in named parts of the picture, e.g. "contact".
    pub regions: BTreeMap<String, Score>,
    /// Kinds of pixels that the technique tells apart. Added later.
    #[serde(default)]
    pub classes: Vec<ClassShare>,
    /// Cost in time.
    pub time: TimeResult,
    /// Cost in memory.
    pub memory: MemoryResult,
    /// Cost that does not depend on the device's speed. Added later.
    #[serde(default)]
    pub work: Option<Work>,
    /// What the library chose and why: formats, fallbacks.
    pub explain: Vec<String>,
    /// Why its scores are worth nothing, if so: triangles that its map had no memory for. Added later.
    #[serde(default, alias = "shortage", skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
    /// Its images.
    pub images: TechniqueImages,
}

/// A technique that was asked for and could not be measured.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct LeftOut {
    /// What it was asked for as.
    pub spec: String,
    /// What the device or the scene refuses.
    pub reason: String,
}

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}: {}", self.spec, self.reason)
    }
}

/// No technique that was needed is possible: why each was left out.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("left out: {}", self.0.iter().map(LeftOut::to_string).collect::<Vec<_>>().join("; "))]
pub struct Refused(pub Vec<LeftOut>);

/// Error against each truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Scores {
    /// Against one shadow ray per pixel.
    pub hard: Score,
    /// Against the light-space ideal.
    pub light_space: Score,
    /// Against the screen-space ideal.
    pub screen_space: Score,
}

/// Names of a technique's images.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TechniqueImages {
    /// The lit picture, sRGB.
    pub picture: String,
    /// Visibility, linear gray.
    pub visibility: String,
    /// Signed error against the hard truth.
    pub error_hard: String,
    /// Signed error against the light-space ideal.
    pub error_light_space: String,
    /// Visibility with the pixels of each class in its colour, if the technique has any. Added later.
    #[serde(default)]
    pub classes: Option<String>,
}

/// Why results could not be read or written.
#[derive(Debug, thiserror::Error)]
pub enum ResultsError {
    /// The file system refused.
    #[error(transparent)]
    File(#[from] FileError),
    /// Not JSON of this schema.
    #[error("{path}: not results of schema {SCHEMA}: {source}")]
    Json {
        /// The file.
        path: String,
        /// What the parser said.
        source: serde_json::Error,
    },
    /// Another schema or version.
    #[error("{path}: schema is {found:?}, this program reads {SCHEMA:?}: use the version that wrote it")]
    Schema {
        /// The file.
        path: String,
        /// What the file says.
        found: String,
    },
    /// A number is infinite or NaN.
    #[error(
        "a measured number is infinite or NaN, which JSON cannot hold ({0}): leave it out (null) instead"
    )]
    NotFinite(serde_json::Error),
}

impl Results {
    /// As indented JSON.
    ///
    /// # Errors
    /// [`ResultsError::NotFinite`] if a number is infinite or NaN.
    pub fn to_json(&self) -> Result<String, ResultsError> {
        let text = serde_json::to_string_pretty(self).map_err(ResultsError::NotFinite)?;
        // The serialiser writes such numbers as null, which is not a number when read again.
        match serde_json::from_str::<Self>(&text) {
            Ok(_) => Ok(text + "\n"),
            Err(error) => Err(ResultsError::NotFinite(error)),
        }
    }

    /// Writes `results.json`, whole or not at all.
    ///
    /// # Errors
    /// As [`Self::to_json`], or [`ResultsError::File`].
    pub fn write_json(&self, path: &Path) -> Result<(), ResultsError> {
        Ok(files::write_atomically(path, self.to_json()?.as_bytes())?)
    }

    /// Reads `results.json`.
    ///
    /// # Errors
    /// [`ResultsError::File`], [`ResultsError::Schema`] or [`ResultsError::Json`].
    pub fn read(path: &Path) -> Result<Self, ResultsError> {
        let text = files::read(path)?;
        let json = |source| ResultsError::Json { path: path.display().to_string(), source };
        let value: Value = serde_json::from_slice(&text).map_err(json)?;
        let found = value.get("schema").and_then(Value::as_str).unwrap_or_default();
        if found != SCHEMA {
            return Err(ResultsError::Schema { path: path.display().to_string(), found: found.into() });
        }
        serde_json::from_value(value).map_err(json)
    }

    /// The techniques whose numbers are worth something: all but invalid ones.
    pub fn valid(&self) -> impl Iterator<Item = &TechniqueResult> {
        self.techniques.iter().filter(|technique| technique.invalid.is_none())
    }

    /// The techniques by family, those of a family in the order they were asked for; families
    /// without members are left out.
    #[must_use]
    pub fn families(&self) -> Vec<(Family, Vec<&TechniqueResult>)> {
        [Family::Comparison, Family::Basis, Family::Geometry]
            .into_iter()
            .map(|family| (family, self.techniques.iter().filter(|t| t.family == family).collect()))
            .filter(|(_, members): &(_, Vec<_>)| !members.is_empty())
            .collect()
    }

    /// One row per technique under one row of headings, separated by commas [RFC 4180]; a quantity
    /// that does not exist is an empty cell.
    #[must_use]
    pub fn csv(&self) -> String {
        csv::table(self)
    }
}
