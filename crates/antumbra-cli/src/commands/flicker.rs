//! `antumbra flicker`.

use super::table;
use crate::{
    arguments::{Flicker, Motion},
    progress::Bar,
    scene, techniques,
};
use antumbra_lab::{
    files,
    flicker::{self, Measured, Promise, Request, Results},
    gpu,
    motion::{BadFrameCount, Path},
};
use anyhow::{Result, bail};
use std::{
    collections::BTreeMap,
    io::{self, Write},
};

pub(crate) fn run(arguments: &Flicker) -> Result<()> {
    if !(2..=Path::MAX_FRAMES).contains(&arguments.frames) {
        bail!("--frames {}: {}", arguments.frames, BadFrameCount { count: arguments.frames });
    }
    if !(1..=16).contains(&arguments.grid) {
        bail!("--grid {}: allowed are 1 to 16 rays along one side of a pixel", arguments.grid);
    }
    scene::check(&arguments.scene)?;
    files::check_folder(&arguments.output)?;
    let techniques = techniques::read(&arguments.techniques, arguments.scene.view.kernel)?;
    let shot = scene::load(&arguments.scene)?;
    let shorter = shot.resolution[0].min(shot.resolution[1]);
    if !(1..=shorter).contains(&arguments.stride) {
        bail!("--stride {}: allowed are 1 to {shorter}, the shorter side of the picture", arguments.stride);
    }
    let gpu = gpu::open()?;
    let request = Request {
        shot,
        path: path(arguments.path),
        frames: arguments.frames,
        until: arguments.frames,
        techniques,
        stride: arguments.stride,
        grid: arguments.grid,
        command: super::command_given(),
    };
    let outcome = {
        let bar = Bar::new([("upload", 1.0), ("frames", f64::from(arguments.frames)), ("pictures", 2.0)]);
        flicker::measure(&gpu, &request, &bar)?
    };
    let folder = flicker::write(&outcome, &arguments.output)?;
    super::note_left_out(&outcome.results.left_out);
    let out = &mut io::stdout();
    if arguments.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&outcome.results)?)?;
    } else {
        print(out, &outcome.results)?;
        writeln!(out, "\npage: {}", folder.join("index.html").display())?;
    }
    Ok(())
}

fn path(motion: Motion) -> Path {
    match motion {
        Motion::Camera => Path::Camera,
        Motion::Light => Path::Light,
        Motion::Both => Path::Both,
        Motion::Recede => Path::Recede,
    }
}

fn print(out: &mut impl Write, results: &Results) -> Result<()> {
    writeln!(
        out,
        "mean |dv - dv of the truth| per pixel and frame, in thousandths; {} frames: {}\n",
        results.frames, results.motion
    )?;
    let cell = |kept: &BTreeMap<Promise, Measured>, promise| {
        kept.get(&promise).map_or("-".into(), |measured| format!("{:.3}", 1e3 * measured.mean))
    };
    let rows = results
        .techniques
        .iter()
        .map(|technique| {
            if let Some(why) = &technique.invalid {
                return vec![technique.spec.clone(), format!("invalid: {why}")];
            }
            vec![
                technique.spec.clone(),
                technique.promise.title().into(),
                technique.ratio_to_hard.map_or("-".into(), |ratio| format!("{ratio:.3}")),
                cell(&technique.flicker, Promise::Hard),
                cell(&technique.flicker, Promise::LightSpace),
                cell(&technique.flicker, Promise::ScreenSpace),
                cell(&technique.crawl, Promise::Hard),
                cell(&technique.crawl, Promise::LightSpace),
            ]
        })
        .chain(super::left_out_rows(&results.left_out));
    let rows: Vec<Vec<String>> = rows.collect();
    let header = [
        "technique",
        "own truth",
        "ratio to hard",
        "hard",
        "light-space",
        "screen-space",
        "crawl, hard",
        "crawl, light-space",
    ];
    table::print(out, &header, &rows)?;
    writeln!(
        out,
        "\nthe light-space ideal itself against the hard truth: {:.3}; texels changed their size {} times;\n{:.1} s, {:.1} s of that for the truths",
        1e3 * results.ideal_against_hard,
        results.texel_changes,
        results.seconds_total,
        results.seconds_tracing
    )?;
    Ok(())
}
