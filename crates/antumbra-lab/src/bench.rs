//! Times of techniques and of the ray tracer, without scores: the content of `bench --json`.

use crate::{
    facts,
    gpu::Gpu,
    prepared::Prepared,
    progress::Progress,
    results::{Family, LeftOut, MemoryResult, RunFacts, TimeResult, Work},
    session::Session,
    shot::Shot,
    truth::{TracedShot, Truth},
};
use antumbra::{Technique, technique};
use anyhow::Result;
use serde::Serialize;
use std::time::Instant;

/// Name and version of the schema. Keys have the names that they have in a comparison's results.
pub const SCHEMA: &str = "antumbra-bench/1";

/// Everything that was timed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Results {
    /// [`SCHEMA`].
    pub schema: String,
    /// What was run.
    #[serde(flatten)]
    pub run: RunFacts,
    /// The ray tracer.
    pub truth: TruthTime,
    /// Shading without any shadow.
    pub unshadowed: TimeResult,
    /// One entry per technique and settings, in the order they were asked for.
    pub techniques: Vec<TechniqueTime>,
    /// Techniques that the device or the scene refuses.
    pub left_out: Vec<LeftOut>,
}

/// Time of the hard truth, seconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct TruthTime {
    /// Time to build the acceleration structure; next to nothing where a default view was chosen with it.
    pub seconds_build: f64,
    /// Time to trace.
    pub seconds_hard: f64,
}

/// What one technique costs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TechniqueTime {
    /// E.g. "esm".
    pub name: String,
    /// What reproduces it on the command line.
    pub spec: String,
    /// Name for people.
    pub title: String,
    /// How it filters.
    pub family: Family,
    /// Cost in time; ratios are to `hard` if that was among the techniques.
    pub time: TimeResult,
    /// Cost in memory.
    pub memory: MemoryResult,
    /// Cost that does not depend on the device's speed.
    pub work: Work,
    /// Why these numbers are worth nothing, if so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
}

/// Times all `techniques` in turns, `rounds` frames each, and then the hard truth.
///
/// # Errors
/// As [`Session::new`]; a lost device.
pub fn measure(
    gpu: &Gpu,
    shot: &Shot,
    techniques: &[Box<dyn Technique>],
    rounds: u32,
    command: Vec<String>,
    progress: &dyn Progress,
) -> Result<Results> {
    progress.step("upload");
    let session = Session::new(gpu, shot, techniques)?;
    progress.step("time");
    let times = session.time(rounds, progress)?;
    progress.step("truth");
    let start = Instant::now();
    let traced = TracedShot::new(shot)?;
    let seconds_build = start.elapsed().as_secs_f64();
    let start = Instant::now();
    traced.trace(Truth::Hard, session.views(), progress)?;
    let truth = TruthTime { seconds_build, seconds_hard: start.elapsed().as_secs_f64() };
    Ok(Results {
        schema: SCHEMA.into(),
        run: facts::run(gpu, &session, command)?,
        truth,
        unshadowed: times.unshadowed,
        techniques: session.prepared().iter().zip(times.techniques).map(timed).collect(),
        left_out: session.left_out().to_vec(),
    })
}

/// One entry of the results.
fn timed((prepared, time): (&Prepared, TimeResult)) -> TechniqueTime {
    let shadows = &prepared.shadows;
    let about = shadows.technique().about();
    TechniqueTime {
        name: about.name.into(),
        spec: technique::spec(shadows.technique()),
        title: about.title.into(),
        family: about.family,
        time,
        memory: facts::memory(&shadows.memory()),
        work: facts::work(shadows),
        invalid: prepared.invalid(),
    }
}
