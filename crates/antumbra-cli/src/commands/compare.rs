//! `antumbra compare`.

use super::table;
use crate::{arguments::Compare, progress::Bar, scene};
use antumbra_lab::{
    compare::{self, Request},
    gpu::Gpu,
    report,
    results::Results,
};
use anyhow::{Result, bail};

pub(crate) fn run(arguments: &Compare) -> Result<()> {
    if arguments.rounds == 0 || arguments.grid == 0 || arguments.grid > 16 {
        bail!("--rounds must be at least 1, --grid 1 to 16");
    }
    let techniques = compare::techniques(&arguments.techniques, arguments.scene.kernel)?;
    let setting = scene::load(&arguments.scene)?;
    let gpu = Gpu::new()?;
    let request = Request {
        scene: setting.name,
        geometry: setting.geometry,
        camera: setting.camera,
        light: setting.light,
        techniques,
        map_size: arguments.scene.size,
        kernel: arguments.scene.kernel,
        resolution: setting.resolution,
        grid: arguments.grid,
        rounds: arguments.rounds,
        command: std::iter::once("antumbra".to_string()).chain(std::env::args().skip(1)).collect(),
    };
    let comparison = {
        let bar = Bar::new();
        compare::compare(&gpu, &request, &bar)?
    };
    let folder = report::write(&comparison.results, &comparison.images, &arguments.output)?;
    if arguments.json {
        println!("{}", comparison.results.to_json()?);
    } else {
        print(&comparison.results);
        println!("\nreport: {}", folder.join("index.html").display());
    }
    Ok(())
}

fn print(results: &Results) {
    let truth = &results.truth;
    println!(
        "{}: {} triangles, {}x{} pixels, map {}x{}, kernel {}; raster and rays agree on {:.3} % of pixels",
        results.scene.name,
        results.scene.triangles,
        results.resolution[0],
        results.resolution[1],
        results.map_size,
        results.map_size,
        results.kernel_texels,
        100.0 * truth.coverage_agreement,
    );
    let percent = |v: Option<f64>| v.map_or("-".into(), |v| format!("{:.2}", 100.0 * v));
    let rows: Vec<Vec<String>> = results
        .techniques
        .iter()
        .map(|t| {
            let (ideal, hard) = (&t.scores.light_space, &t.scores.hard);
            vec![
                t.spec.clone(),
                format!("{:.4}", ideal.rmse),
                percent(ideal.leak),
                percent(ideal.over_darkening),
                percent(hard.acne),
                percent(Some(hard.pixel_match)),
                format!("{:.1}", t.time.frame.median_ms),
                t.time.frame_ratio_to_hard.map_or("-".into(), |r| format!("{r:.2}")),
                t.time.lookup_ratio_to_hard.map_or("-".into(), |r| format!("{r:.2}")),
                format!("{:.1}", t.memory.kept_bytes as f64 / (1024.0 * 1024.0)),
            ]
        })
        .collect();
    table::print(
        &[
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
        ],
        &rows,
    );
    println!("no shadow at all matches {:.2} % of shadowable pixels", 100.0 * truth.no_shadow.pixel_match);
}
