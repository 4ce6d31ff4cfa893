//! What all experiments share: scenes, pictures with every technique, truths, scores, times. All of
//! it is kept on disk ([`Cache`]), so that asking twice costs nothing.

use crate::{
    cache::{Cache, fingerprint},
    study::ShotKey,
};
use antumbra::{Technique, technique};
use antumbra_lab::{
    curve, facts,
    gpu::{self, Gpu},
    progress::Progress,
    results::AdapterFacts,
};
use anyhow::{Context, Result};
pub use own::FILTERED_DEPTH;
use scenes::Scenes;
use std::path::Path;

mod own;
mod scenes;
mod studies;
mod timings;
mod truths;

/// Frames of each kind that a verdict on times rests on: the fewest of which neither the fastest nor the
/// slowest decides alone.
const ROUNDS: u32 = 9;

/// Shared services of all experiments.
pub struct Workbench<'a> {
    gpu: Gpu,
    cache: Cache,
    scenes: Scenes,
    progress: &'a dyn Progress,
    /// Whether everything is made small, to see that it works rather than to measure.
    pub quick: bool,
    /// Fingerprint of the program.
    pub build: String,
}

impl std::fmt::Debug for Workbench<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Workbench")
            .field("cache", &self.cache)
            .field("quick", &self.quick)
            .finish_non_exhaustive()
    }
}

/// The first spec that this program can read, if any.
#[must_use]
pub fn first_known<'s>(specs: &[&'s str]) -> Option<&'s str> {
    specs.iter().copied().find(|spec| technique::parse(spec).is_ok())
}

fn parse(specs: &[&str]) -> Result<Vec<Box<dyn Technique>>> {
    specs.iter().map(|spec| own::parse(spec)).collect()
}

impl<'a> Workbench<'a> {
    /// Opens the graphics device. Measurements are kept in `cache`.
    ///
    /// # Errors
    /// No adapter; an executable that cannot be read.
    pub fn new(cache: &Path, quick: bool, progress: &'a dyn Progress) -> Result<Self> {
        let gpu = gpu::open()?;
        let program = std::env::current_exe().context("the path of this program")?;
        let program = std::fs::read(&program).with_context(|| program.display().to_string())?;
        let build = format!("{:032x}", fingerprint(&program));
        let adapter = serde_json::to_string(&facts::adapter(&gpu))?;
        let cache = Cache::new(cache, &format!("{} {build}", env!("CARGO_PKG_VERSION")), &adapter);
        Ok(Self { gpu, cache, scenes: Scenes::default(), progress, quick, build })
    }

    /// What the graphics device says of itself.
    #[must_use]
    pub fn adapter(&self) -> AdapterFacts {
        facts::adapter(&self.gpu)
    }

    /// A scene at a resolution, a quarter of that each way in a quick run.
    #[must_use]
    pub fn shot(&self, scene: &'static str, resolution: [u32; 2]) -> ShotKey {
        let scale = if self.quick { 4 } else { 1 };
        ShotKey { scene, distance: 1.0, cascades: 1, resolution: resolution.map(|n| (n / scale).max(1)) }
    }

    /// A map's size, a quarter of it in a quick run.
    #[must_use]
    pub fn map(&self, texels: u32) -> u32 {
        if self.quick { (texels / 4).max(32) } else { texels }
    }

    /// Frames to time for a verdict: so many that the median's range is known; one in a quick run.
    #[must_use]
    pub fn rounds(&self) -> u32 {
        if self.quick { 1 } else { ROUNDS }
    }

    /// What [`curve::visibility`] answers to a caster at the depth `caster`.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn curve(&self, spec: &str, caster: f32, receivers: &[f32]) -> Result<Vec<f32>> {
        self.cache.memo(&("curve", spec, caster, receivers), || {
            self.progress.step(&format!("curve of {spec}"));
            curve::visibility(&self.gpu, technique::parse(spec)?.as_ref(), caster, receivers)
        })
    }

    /// What [`curve::edge`] answers across the edge of a caster to receivers at the depth `receiver`.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn edge(&self, spec: &str, receiver: f32, positions: &[f32]) -> Result<Vec<f32>> {
        self.cache.memo(&("edge", spec, receiver, positions), || {
            self.progress.step(&format!("edge with {spec}"));
            curve::edge(&self.gpu, own::parse(spec)?.as_ref(), receiver, positions)
        })
    }

    /// What [`curve::beside`] answers.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn beside(&self, spec: &str, depths: [f32; 3], positions: &[f32]) -> Result<Vec<f32>> {
        self.cache.memo(&("beside", spec, depths, positions), || {
            self.progress.step(&format!("edge with {spec}"));
            curve::beside(&self.gpu, technique::parse(spec)?.as_ref(), depths, positions)
        })
    }
}
