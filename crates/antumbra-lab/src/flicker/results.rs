//! What was measured, as data.

use crate::{
    motion::Path,
    results::{AdapterFacts, LeftOut, Program},
};
use antumbra::{Technique, technique::Family};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name and version of the data's layout.
pub const SCHEMA: &str = "antumbra-flicker/1";

/// What a technique promises, and so is judged by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Promise {
    /// Sharp shadows: one shadow ray per pixel centre.
    Hard,
    /// The comparison's results, filtered over the kernel in the light's space.
    LightSpace,
    /// The mean over each pixel.
    ScreenSpace,
}

impl Promise {
    /// Sharp shadows from the nearest texel and from triangles; a mean over the pixel from kernels of a
    /// pixel's size; the light-space ideal from all that filter. On a path that leads away, all are to
    /// show the mean over each pixel, since the shadows are finer than that.
    #[must_use]
    pub fn of(technique: &dyn Technique, path: Path) -> Self {
        let about = technique.about();
        match (about.name, about.family) {
            _ if path == Path::Recede => Self::ScreenSpace,
            ("footprint", _) => Self::ScreenSpace,
            ("hard", _) | (_, Family::Geometry) => Self::Hard,
            _ => Self::LightSpace,
        }
    }

    /// The same for hard shadow mapping.
    pub(super) fn of_hard(path: Path) -> Self {
        if path == Path::Recede { Self::ScreenSpace } else { Self::Hard }
    }

    /// Its name for people.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Hard => "hard truth",
            Self::LightSpace => "light-space ideal",
            Self::ScreenSpace => "screen-space ideal",
        }
    }
}

/// Flicker against one truth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// Mean |Δv − Δv_truth| per pixel and pair of frames.
    pub mean: f64,
    /// Over that of hard shadow mapping against the same truth; `null` where it was not measured.
    pub ratio_to_hard: Option<f64>,
    /// The mean of each pair of frames.
    pub frames: Vec<f64>,
}

/// One technique.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TechniqueFlicker {
    /// Stem of its files.
    pub name: String,
    /// What reproduces it on the command line; unique.
    pub spec: String,
    /// Name for people.
    pub title: String,
    /// How it filters.
    pub family: Family,
    /// The truth that it is judged by.
    pub promise: Promise,
    /// Flicker against its own truth over that of hard shadow mapping against its own; `null` where
    /// that was not measured.
    pub ratio_to_hard: Option<f64>,
    /// Change of the error in the picture.
    pub flicker: BTreeMap<Promise, Measured>,
    /// Change of the error on surfaces; has no screen-space ideal.
    pub crawl: BTreeMap<Promise, Measured>,
    /// Why these numbers are worth nothing, if so: triangles that its map had no memory for in some frame.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
}

impl TechniqueFlicker {
    /// [`ratio_to_hard`](Self::ratio_to_hard) if it is worth anything.
    #[must_use]
    pub fn rank(&self) -> Option<f64> {
        self.ratio_to_hard.filter(|_| self.invalid.is_none())
    }
}

/// Everything that was measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`SCHEMA`].
    pub schema: String,
    /// What measured it.
    pub program: Program,
    /// The command line.
    pub command: Vec<String>,
    /// Name of the scene.
    pub scene: String,
    /// Triangles after instancing.
    pub triangles: u64,
    /// Name of the path.
    pub path: String,
    /// What moved.
    pub motion: String,
    /// Number of frames that were measured.
    pub frames: u32,
    /// Pixels across and down.
    pub resolution: [u32; 2],
    /// Texels along one side of each map.
    pub map_size: u32,
    /// Kernel width of the light-space ideal, texels.
    pub kernel_texels: u32,
    /// Most views (cascades) of the light. Added later.
    #[serde(default)]
    pub cascades: u32,
    /// The bias of every technique. Added later.
    #[serde(default)]
    pub bias: String,
    /// Pixels from one that was asked for the ideals to the next.
    pub stride: u32,
    /// What drew it.
    pub adapter: AdapterFacts,
    /// Mean number of pixels that counted in a pair of frames.
    pub pixels: f64,
    /// Share of pixels in which raster and rays see the same point, of those that see any.
    pub agreement: f64,
    /// Flicker of the light-space ideal against the hard truth, mean per pixel and pair of frames.
    pub ideal_against_hard: f64,
    /// How often the size of a texel changed along the path: fitted maps change it in steps.
    pub texel_changes: u32,
    /// One entry per technique, in the order in which they were named.
    pub techniques: Vec<TechniqueFlicker>,
    /// Techniques that were asked for and refused.
    #[serde(default)]
    pub left_out: Vec<LeftOut>,
    /// Names of their pictures of where it flickers, in the same order.
    pub heat_maps: Vec<String>,
    /// Time spent on truths, seconds.
    pub seconds_tracing: f64,
    /// Time of the whole run, seconds.
    pub seconds_total: f64,
    /// The files of the page.
    pub files: Vec<String>,
}
