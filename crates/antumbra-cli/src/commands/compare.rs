//! `antumbra compare`.

use super::table;
use crate::{
    arguments::Compare,
    progress::{self, Bar},
    scene, techniques,
};
use antumbra_lab::{
    compare::{self, Request},
    files, gpu,
    metrics::MIN_DEEP_PIXELS,
    report::{self, significant},
    results::{Results, TechniqueResult},
    shot::Shot,
};
use anyhow::{Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Compare) -> Result<()> {
    if arguments.rounds == 0 {
        bail!("--rounds 0: at least 1 frame has to be timed");
    }
    if !(1..=16).contains(&arguments.grid) {
        bail!("--grid {}: allowed are 1 to 16 rays along one side of a pixel", arguments.grid);
    }
    scene::check(&arguments.scene)?;
    files::check_folder(&arguments.output)?;
    let techniques = techniques::read(&arguments.techniques, arguments.scene.view.kernel)?;
    let shot = scene::load(&arguments.scene)?;
    let gpu = gpu::open()?;
    let request = Request {
        shot,
        techniques,
        grid: arguments.grid,
        rounds: arguments.rounds,
        command: super::command_given(),
    };
    let comparison = {
        let work = (request.techniques.len(), request.rounds);
        let Shot { resolution, kernel, .. } = request.shot;
        let phases = progress::comparison(&gpu, resolution, (kernel, request.grid), work);
        let bar = Bar::new(phases);
        compare::compare(&gpu, &request, &bar)?
    };
    let folder = report::write(&comparison.results, &comparison.images, &arguments.output)?;
    warn(&comparison.results);
    let out = &mut io::stdout();
    if arguments.json {
        writeln!(out, "{}", comparison.results.to_json()?)?;
    } else {
        print(out, &comparison.results)?;
        writeln!(out, "\nreport: {}", folder.join("index.html").display())?;
    }
    Ok(())
}

/// Says what makes scores mean little.
fn warn(results: &Results) {
    if results.truth.shows_no_shadow() {
        let _ = writeln!(
            io::stderr(),
            "warning: no shadow at all matches {:.2} % of the pixels: this view says little about techniques; choose \
             another with --camera and --light",
            100.0 * results.truth.no_shadow.pixel_match
        );
    }
    for (spec, why) in results.techniques.iter().filter_map(|t| Some((&t.spec, t.invalid.as_ref()?))) {
        let _ = writeln!(io::stderr(), "warning: {spec} is invalid: {why}");
    }
    super::note_run(&results.run, &results.left_out);
}

fn print(out: &mut impl Write, results: &Results) -> Result<()> {
    let (truth, run) = (&results.truth, &results.run);
    writeln!(
        out,
        "{}: {} triangles, {}x{} pixels, map {}x{}, kernel {}; raster and rays agree on {:.3} % of pixels",
        run.scene.name,
        run.scene.triangles,
        run.resolution[0],
        run.resolution[1],
        run.map_size,
        run.map_size,
        run.kernel_texels,
        100.0 * truth.coverage_agreement,
    )?;
    let mut rows: Vec<Vec<String>> = Vec::new();
    for (family, members) in results.families() {
        rows.push(vec![format!("- {}", family.name())]);
        rows.extend(members.into_iter().map(row));
    }
    rows.extend(super::left_out_rows(&results.left_out));
    table::print(out, &HEADER, &rows)?;
    print_notes(out, results)
}

const HEADER: [&str; 13] = [
    "technique",
    "RMSE",
    "leak %",
    "dark %",
    "acne %",
    "match %",
    "frame ms",
    "× hard",
    "lookup × hard",
    "MiB",
    "B/texel",
    "lookups",
    "passes",
];

/// The row of one technique.
fn row(t: &TechniqueResult) -> Vec<String> {
    let deep = |mean: Option<f64>, pixels: u64| match mean {
        Some(mean) => format!("{:.2}", 100.0 * mean),
        None => format!("– ({pixels})"),
    };
    let percent = |v: Option<f64>| v.map_or("-".into(), |v| format!("{:.2}", 100.0 * v));
    let work = |value: Option<f64>| value.map_or("-".into(), |v| v.to_string());
    if let Some(why) = &t.invalid {
        return vec![t.spec.clone(), format!("invalid: {why}")];
    }
    let (ideal, hard) = (&t.scores.light_space, &t.scores.hard);
    vec![
        t.spec.clone(),
        format!("{:.4}", ideal.rmse),
        deep(ideal.leak, ideal.deep_shadow_pixels),
        deep(ideal.over_darkening, ideal.deep_lit_pixels),
        percent(hard.acne),
        percent(Some(hard.pixel_match)),
        format!("{:.1}", t.time.frame.median_ms),
        t.time.frame_ratio_to_hard.map_or("-".into(), |r| format!("{r:.2}")),
        t.time.lookup_ratio_to_hard.map_or("-".into(), |r| format!("{r:.2}")),
        format!("{:.1}", t.memory.kept_bytes as f64 / (1024.0 * 1024.0)),
        work(t.work.as_ref().map(|w| w.bytes_per_texel)),
        work(t.work.as_ref().map(|w| w.lookups.into())),
        work(t.work.as_ref().map(|w| w.passes.len() as f64)),
    ]
}

/// What stands below the table.
fn print_notes(out: &mut impl Write, results: &Results) -> Result<()> {
    for warning in &results.run.warnings {
        writeln!(out, "warning: {warning}")?;
    }
    for note in &results.run.notes {
        writeln!(out, "{note}")?;
    }
    for technique in results.valid() {
        for class in &technique.classes {
            writeln!(
                out,
                "{}: {} in {:.2} % of the pixels that see geometry",
                technique.spec,
                class.name,
                100.0 * class.share
            )?;
        }
    }
    let few = |t: &&TechniqueResult| {
        t.scores.light_space.leak.is_none() || t.scores.light_space.over_darkening.is_none()
    };
    if results.valid().any(|t| few(&t)) {
        writeln!(
            out,
            "–: fewer than {MIN_DEEP_PIXELS} pixels, in brackets, lie deep enough in shadow or light"
        )?;
    }
    if results.run.views.len() > 1 {
        let texels: Vec<String> =
            results.run.views.iter().map(|v| significant(v.texel_world.into())).collect();
        writeln!(
            out,
            "{} cascades with texels of {} world units",
            results.run.views.len(),
            texels.join(", ")
        )?;
    }
    writeln!(
        out,
        "no shadow at all matches {:.2} % of shadowable pixels",
        100.0 * results.truth.no_shadow.pixel_match
    )?;
    Ok(())
}
