//! Times of techniques and of the ray tracer, without scores: the content of `bench --json`.

use crate::{
    facts,
    gpu::Gpu,
    prepared::Prepared,
    progress::Progress,
    results::{Family, LeftOut, MemoryResult, RunFacts, StartUp, TimeResult, Work},
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

/// What to time.
#[derive(Debug)]
pub struct Request<'a> {
    /// The scene, how it is seen and lit, and its maps.
    pub shot: &'a Shot,
    /// The techniques.
    pub techniques: &'a [Box<dyn Technique>],
    /// Frames that are timed, per technique.
    pub rounds: u32,
    /// Whether start-up is timed too.
    pub start_up: bool,
    /// The command line, for the results.
    pub command: Vec<String>,
}

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
    /// What it costs before the second frame, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub start_up: Option<StartUp>,
    /// Cost in memory.
    pub memory: MemoryResult,
    /// Cost that does not depend on the device's speed.
    pub work: Work,
    /// Why these numbers are worth nothing, if so.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
}

/// Times all techniques in turns, and then the hard truth.
///
/// # Errors
/// As [`Session::new`]; a lost device.
pub fn measure(gpu: &Gpu, request: Request<'_>, progress: &dyn Progress) -> Result<Results> {
    let Request { shot, techniques, rounds, start_up, command } = request;
    progress.step("upload");
    let session = Session::new(gpu, shot, techniques)?;
    progress.step("time");
    let start_ups: Vec<Option<StartUp>> = session
        .prepared()
        .iter()
        .map(|prepared| start_up.then(|| session.start_up(prepared)).transpose())
        .collect::<Result<_>>()?;
    let times = session.time(rounds, progress)?;
    progress.step("truth");
    let start = Instant::now();
    let traced = TracedShot::new(shot)?;
    let seconds_build = start.elapsed().as_secs_f64();
    let start = Instant::now();
    traced.trace(Truth::Hard, session.views(), progress)?;
    let truth = TruthTime { seconds_build, seconds_hard: start.elapsed().as_secs_f64() };
    let timed = session.prepared().iter().zip(times.techniques).zip(start_ups);
    Ok(Results {
        schema: SCHEMA.into(),
        run: facts::run(gpu, &session, command)?,
        truth,
        unshadowed: times.unshadowed,
        techniques: timed.map(|((prepared, time), start_up)| of(prepared, time, start_up)).collect(),
        left_out: session.left_out().to_vec(),
    })
}

/// One entry of the results.
fn of(prepared: &Prepared, time: TimeResult, start_up: Option<StartUp>) -> TechniqueTime {
    let shadows = &prepared.shadows;
    let about = shadows.technique().about();
    TechniqueTime {
        name: about.name.into(),
        spec: technique::spec(shadows.technique()),
        title: about.title.into(),
        family: about.family,
        time,
        start_up,
        memory: facts::memory(&shadows.memory()),
        work: facts::work(shadows),
        invalid: prepared.invalid(),
    }
}
