//! `antumbra kernels`: error and cost over kernel widths.

use super::table;
use crate::{
    arguments::Kernels,
    progress::{self, Bar},
    scene,
    scene_arguments::ViewArguments,
    techniques,
};
use antumbra_lab::{
    compare::{self, Request},
    gpu,
    results::{LeftOut, TechniqueResult},
    shot::Shot,
    timing,
};
use anyhow::{Result, bail};
use serde::Serialize;
use std::io::{self, Write};

/// One technique with one kernel.
#[derive(Debug, Serialize)]
struct Row {
    kernel: u32,
    technique: String,
    /// `None` where the technique was left out or is invalid, with the reason in `missing`.
    #[serde(flatten)]
    measured: Option<Measured>,
    #[serde(skip_serializing_if = "Option::is_none")]
    missing: Option<String>,
}

/// Errors and costs.
#[derive(Debug, Serialize)]
struct Measured {
    rmse_light_space: f64,
    rmse_screen_space: f64,
    /// Passes between casting and lighting, milliseconds.
    filter_ms: f64,
    lookup_ms: f64,
    frame_ms: f64,
    lookups: u32,
    bytes_per_texel: f64,
}

impl Row {
    fn new(kernel: u32, result: &TechniqueResult) -> Self {
        let missing = result.invalid.as_ref().map(|why| format!("invalid: {why}"));
        let measured = missing.is_none().then(|| Measured::new(result));
        Self { kernel, technique: result.spec.clone(), measured, missing }
    }

    fn left_out(kernel: u32, left_out: &LeftOut) -> Self {
        let missing = Some(format!("left out: {}", left_out.reason));
        Self { kernel, technique: left_out.spec.clone(), measured: None, missing }
    }

    fn cells(&self) -> Vec<String> {
        let kernel = self.kernel.to_string();
        match (&self.measured, &self.missing) {
            (Some(measured), _) => [vec![kernel, self.technique.clone()], measured.cells()].concat(),
            (None, why) => vec![kernel, format!("{} {}", self.technique, why.as_deref().unwrap_or_default())],
        }
    }
}

impl Measured {
    fn new(result: &TechniqueResult) -> Self {
        let ms = |name| timing::pass_ms(&result.time, name).unwrap_or(0.0);
        let work = result.work.as_ref();
        Self {
            rmse_light_space: result.scores.light_space.rmse,
            rmse_screen_space: result.scores.screen_space.rmse,
            filter_ms: ["convert", "blur", "mips", "sum"].map(ms).iter().sum(),
            lookup_ms: ms("lookup"),
            frame_ms: result.time.frame.median_ms,
            lookups: work.map_or(0, |w| w.lookups),
            bytes_per_texel: work.map_or(0.0, |w| w.bytes_per_texel_with_mips),
        }
    }

    fn cells(&self) -> Vec<String> {
        vec![
            format!("{:.4}", self.rmse_light_space),
            format!("{:.4}", self.rmse_screen_space),
            format!("{:.1}", self.filter_ms),
            format!("{:.1}", self.lookup_ms),
            format!("{:.1}", self.filter_ms + self.lookup_ms),
            format!("{:.1}", self.frame_ms),
            self.lookups.to_string(),
            format!("{:.1}", self.bytes_per_texel),
        ]
    }
}

pub(crate) fn run(arguments: &Kernels) -> Result<()> {
    if arguments.rounds == 0 {
        bail!("--rounds 0: at least 1 frame has to be timed");
    }
    let mut rows = Vec::new();
    // Three texels suit every technique: what is refused here is wrong.
    techniques::read(&arguments.techniques, 3)?;
    for &kernel in &arguments.kernels {
        scene::check_view(&ViewArguments { kernel, ..arguments.scene.view.clone() })?;
    }
    scene::check(&arguments.scene)?;
    let shot = scene::load(&arguments.scene)?;
    let gpu = gpu::open()?;
    let widest = arguments.kernels.iter().copied().max().unwrap_or(1);
    let work = (arguments.techniques.len(), arguments.rounds);
    let bar = Bar::new(progress::comparison(&gpu, shot.resolution, (widest, arguments.grid), work));
    for (part, &kernel) in arguments.kernels.iter().enumerate() {
        bar.part(part, arguments.kernels.len());
        // Some kernels are odd only.
        let takes = |spec: &&String| techniques::read(&[(*spec).clone()], kernel).is_ok();
        let specs: Vec<String> = arguments.techniques.iter().filter(takes).cloned().collect();
        let request = Request {
            shot: Shot { kernel, ..shot.clone() },
            techniques: techniques::read(&specs, kernel)?,
            grid: arguments.grid,
            rounds: arguments.rounds,
            command: Vec::new(),
        };
        if request.techniques.is_empty() {
            continue;
        }
        let results = compare::compare(&gpu, &request, &bar)?.results;
        rows.extend(results.techniques.iter().map(|result| Row::new(kernel, result)));
        rows.extend(results.left_out.iter().map(|left_out| Row::left_out(kernel, left_out)));
        super::note_left_out(&results.left_out);
    }
    drop(bar);
    let out = &mut io::stdout();
    if arguments.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&rows)?)?;
        return Ok(());
    }
    let cells: Vec<Vec<String>> = rows.iter().map(Row::cells).collect();
    let header = [
        "kernel",
        "technique",
        "RMSE light space",
        "RMSE screen space",
        "filter ms",
        "lookup ms",
        "both",
        "frame ms",
        "lookups",
        "B/texel",
    ];
    table::print(out, &header, &cells)?;
    Ok(())
}
