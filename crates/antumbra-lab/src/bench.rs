//! Times of techniques and of the ray tracer, without scores: the content of `bench --json`.

use crate::{
    compare::{self, Contestant, Progress, facts},
    gpu::Gpu,
    lighting::Lookup,
    results::{Family, LeftOut, MemoryResult, RunFacts, TimeResult, Work},
    setting::{Setting, Setup},
    timing::{self, Entrant},
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
    /// To build the acceleration structure.
    pub seconds_build: f64,
    /// To trace.
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
/// As [`Setting::set_up`]; a lost device.
pub fn measure(
    gpu: &Gpu,
    setting: &Setting,
    techniques: &[Box<dyn Technique>],
    rounds: u32,
    command: Vec<String>,
    progress: &dyn Progress,
) -> Result<Results> {
    progress.step("upload");
    let Setup { stage, lighting, contestants, left_out, views } = setting.set_up(gpu, techniques)?;
    let unshadowed = Lookup::unshadowed(gpu, &stage);
    let mut entrants = vec![Entrant { shadows: None, lookup: &unshadowed }];
    entrants.extend(contestants.iter().map(Contestant::entrant));
    progress.step("time");
    let mut times = timing::race(gpu, &stage, &lighting, &entrants, rounds, &|s| progress.share(s))?;
    let hard = contestants.iter().position(|c| c.shadows.technique().page().name == "hard");
    let unshadowed = times.remove(0);
    timing::relate(&mut times, &unshadowed, hard);
    progress.step("truth");
    let start = Instant::now();
    let tracer = setting.tracer()?;
    let seconds_build = start.elapsed().as_secs_f64();
    let start = Instant::now();
    let hard = tracer.hard(&setting.rays()?, &setting.light);
    let truth = TruthTime { seconds_build, seconds_hard: start.elapsed().as_secs_f64() };
    drop(hard);
    let timed = |(contestant, time): (&Contestant, TimeResult)| {
        let technique = contestant.shadows.technique();
        let page = technique.page();
        TechniqueTime {
            name: page.name.into(),
            spec: technique::spec(technique),
            title: page.title.into(),
            family: page.family,
            time,
            memory: compare::memory(&contestant.shadows.memory()),
            work: compare::work(&contestant.shadows),
            invalid: contestant.invalid(),
        }
    };
    Ok(Results {
        schema: SCHEMA.into(),
        run: facts::run(gpu, setting, &views, command)?,
        truth,
        unshadowed,
        techniques: contestants.iter().zip(times).map(timed).collect(),
        left_out,
    })
}
