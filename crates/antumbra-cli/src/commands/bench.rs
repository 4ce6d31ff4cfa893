//! `antumbra bench`: times only.

use super::table;
use crate::{arguments::Bench, progress::Bar, scene, techniques};
use antumbra::technique;
use antumbra_lab::{
    compare::{self, Contestant, Entered, Progress},
    gpu::Gpu,
    lighting::{Lighting, Lookup},
    results::TimeResult,
    stage::Stage,
    timing::{self, Entrant},
};
use antumbra_truth::{CameraRays, Tracer};
use anyhow::{Result, bail};
use std::{
    collections::BTreeMap,
    io::{self, Write},
    time::Instant,
};

pub(crate) fn run(arguments: &Bench) -> Result<()> {
    if arguments.rounds == 0 {
        bail!("--rounds 0: at least 1 frame has to be timed");
    }
    scene::check(&arguments.scene)?;
    let techniques = techniques::read(&arguments.techniques, arguments.scene.kernel)?;
    let setting = scene::load(&arguments.scene)?;
    let gpu = Gpu::new()?;
    let mut stage = Stage::new(&gpu, &setting.geometry, &setting.camera, &setting.light, setting.resolution)?;
    let lighting = Lighting::new(&gpu, &stage);
    let (geometry, light) = (&setting.geometry, &setting.light);
    let (Entered { contestants, left_out }, _) =
        compare::enter(&gpu, &mut stage, geometry, light, &techniques, arguments.scene.size)?;
    let unshadowed = Lookup::unshadowed(&gpu, &stage);
    let mut entrants = vec![Entrant { shadows: None, lookup: &unshadowed }];
    entrants.extend(contestants.iter().map(Contestant::entrant));
    let bar = Bar::new([("time", f64::from(arguments.rounds)), ("truth", 2.0)]);
    bar.step("time");
    let times = timing::race(&gpu, &stage, &lighting, &entrants, arguments.rounds, &|s| bar.share(s))?;
    bar.step("truth");
    let start = Instant::now();
    let rays = CameraRays::new(&setting.camera, setting.resolution[0], setting.resolution[1])?;
    let hard = Tracer::new(&setting.geometry)?.hard(&rays, &setting.light);
    let truth = start.elapsed().as_secs_f64();
    drop(hard);
    drop(bar);
    let specs = contestants.iter().map(|c| technique::spec(c.shadows.technique()));
    let names = std::iter::once("none".to_string()).chain(specs);
    let invalid: BTreeMap<String, String> = contestants
        .iter()
        .filter_map(|c| Some((technique::spec(c.shadows.technique()), c.invalid()?)))
        .collect();
    super::note_left_out(&left_out);
    let out = &mut io::stdout();
    if arguments.json {
        let times: serde_json::Map<String, serde_json::Value> = names
            .zip(&times)
            .map(|(name, time)| Ok((name, serde_json::to_value(time)?)))
            .collect::<Result<_>>()?;
        let all = serde_json::json!({
            "truth_hard_seconds": truth, "techniques": times, "invalid": invalid, "left_out": left_out,
        });
        writeln!(out, "{}", serde_json::to_string_pretty(&all)?)?;
        return Ok(());
    }
    const PASSES: [&str; 8] = ["cast", "scan", "convert", "blur", "mips", "sum", "surfaces", "lookup"];
    let row = |(name, time): (String, &TimeResult)| {
        if let Some(why) = invalid.get(&name) {
            return vec![name, format!("invalid: {why}")];
        }
        let passes = PASSES.map(|p| timing::pass_ms(time, p).map_or("-".into(), milliseconds));
        let f = time.frame;
        std::iter::once(name)
            .chain(passes)
            .chain([f.median_ms, f.min_ms, f.max_ms].map(milliseconds))
            .collect()
    };
    let rows: Vec<Vec<String>> = names.zip(&times).map(row).chain(super::left_out_rows(&left_out)).collect();
    writeln!(
        out,
        "median milliseconds over {} rounds; frame: {} with its extremes",
        arguments.rounds, times[0].frame_method
    )?;
    let header: Vec<&str> =
        std::iter::once("technique").chain(PASSES).chain(["frame", "min", "max"]).collect();
    table::print(out, &header, &rows)?;
    writeln!(out, "ray-traced hard truth, acceleration structure included: {truth:.2} s")?;
    Ok(())
}

/// To microseconds where that is a thousandth or more.
fn milliseconds(ms: f64) -> String {
    if ms < 10.0 { format!("{ms:.3}") } else { format!("{ms:.1}") }
}
