//! `antumbra bench`: times only.

use super::table;
use crate::{arguments::Bench, progress::Bar, scene, techniques};
use antumbra_lab::{
    bench::{self, Request, TechniqueTime},
    gpu,
    results::TimeResult,
    timing,
};
use anyhow::{Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Bench) -> Result<()> {
    if arguments.rounds == 0 {
        bail!("--rounds 0: at least 1 frame has to be timed");
    }
    scene::check(&arguments.scene)?;
    let techniques = techniques::read(&arguments.techniques, arguments.scene.view.kernel)?;
    let shot = scene::load(&arguments.scene)?;
    let gpu = gpu::open()?;
    let results = {
        let bar = Bar::new([("upload", 1.0), ("time", f64::from(arguments.rounds)), ("truth", 2.0)]);
        let request = Request {
            shot: &shot,
            techniques: &techniques,
            rounds: arguments.rounds,
            start_up: arguments.start_up,
            command: super::command_given(),
        };
        bench::measure(&gpu, request, &bar)?
    };
    super::note_run(&results.run, &results.left_out);
    let out = &mut io::stdout();
    if arguments.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&results)?)?;
        return Ok(());
    }
    print(out, &results)
}

fn print(out: &mut impl Write, results: &bench::Results) -> Result<()> {
    const PASSES: [&str; 8] = ["cast", "scan", "convert", "blur", "mips", "sum", "surfaces", "lookup"];
    let row = |name: &str, time: &TimeResult| -> Vec<String> {
        let passes = PASSES.map(|p| timing::pass_ms(time, p).map_or("-".into(), milliseconds));
        let f = time.frame;
        let ratio = |ratio: Option<f64>| ratio.map_or("-".into(), |r| format!("{r:.2}"));
        std::iter::once(name.to_string())
            .chain(passes)
            .chain([f.median_ms, f.min_ms, f.max_ms].map(milliseconds))
            .chain([time.frame_ratio_to_hard, time.lookup_ratio_to_hard].map(ratio))
            .collect()
    };
    let start_up = results.techniques.iter().any(|t| t.start_up.is_some());
    let technique = |t: &TechniqueTime| match &t.invalid {
        Some(why) => vec![t.spec.clone(), format!("invalid: {why}")],
        None => {
            let start_up = t.start_up.iter().flat_map(|s| [s.set_up_ms, s.first_frame_ms]);
            row(&t.spec, &t.time).into_iter().chain(start_up.map(milliseconds)).collect()
        }
    };
    let rows: Vec<Vec<String>> = std::iter::once(row("none", &results.unshadowed))
        .chain(results.techniques.iter().map(technique))
        .chain(super::left_out_rows(&results.left_out))
        .collect();
    writeln!(
        out,
        "median milliseconds over {} rounds; frame: {} with its extremes",
        results.unshadowed.rounds, results.unshadowed.frame_method
    )?;
    let last = ["frame", "min", "max", "× hard", "lookup × hard"];
    let first: &[&str] = if start_up { &["set-up", "first frame"] } else { &[] };
    let header: Vec<&str> =
        std::iter::once("technique").chain(PASSES).chain(last).chain(first.iter().copied()).collect();
    table::print(out, &header, &rows)?;
    let truth = results.truth.seconds_build + results.truth.seconds_hard;
    writeln!(out, "ray-traced hard truth, acceleration structure included: {truth:.2} s")?;
    Ok(())
}

/// To microseconds where that is a thousandth or more.
fn milliseconds(ms: f64) -> String {
    if ms < 10.0 { format!("{ms:.3}") } else { format!("{ms:.1}") }
}
