//! `antumbra bias`: acne against detached shadows.

use super::table;
use crate::{arguments::Bias, progress::Bar, scene, techniques};
use antumbra_lab::{
    bias::{self, Request, Row, Standing},
    facts, gpu,
    results::LeftOut,
};
use anyhow::Result;
use serde::Serialize;
use serde_json::json;
use std::io::{self, Write};

/// Name and version of the schema that is printed.
const SCHEMA: &str = "antumbra-bias/1";

/// One scene.
#[derive(Debug, Serialize)]
struct Scene {
    scene: String,
    rows: Vec<Row>,
    left_out: Vec<LeftOut>,
}

pub(crate) fn run(arguments: &Bias) -> Result<()> {
    scene::check_view(&arguments.view)?;
    let techniques = techniques::read(&arguments.techniques, arguments.view.kernel)?;
    let settings: Vec<_> = arguments.settings.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    let gpu = gpu::open()?;
    let out = &mut io::stdout();
    let mut scenes = Vec::new();
    for name in &arguments.scenes {
        let shot = scene::load_view(name, &arguments.view)?;
        let request = Request { shot: &shot, techniques: &techniques, settings: &settings };
        let bias::Study { rows, left_out } = {
            let bar = Bar::new([("upload", 1.0), ("truth", 8.0), ("render", 6.0)]);
            bias::study(&gpu, &request, &bar)?
        };
        super::note_left_out(&left_out);
        let scene = Scene { scene: shot.name, rows, left_out };
        if !arguments.json {
            print(out, &scene)?;
        }
        scenes.push(scene);
    }
    let all: Vec<(&str, &[Row])> = scenes.iter().map(|s| (s.scene.as_str(), s.rows.as_slice())).collect();
    let standings = bias::standings(&all);
    if arguments.json {
        let about = json!({ "schema": SCHEMA, "program": facts::program(), "command": super::command_given(),
            "adapter": facts::adapter(&gpu), "resolution": arguments.view.resolution,
            "map_size": arguments.view.size, "kernel_texels": arguments.view.kernel });
        let results = json!({ "scenes": scenes });
        let parts = [about, results, json!(standings)];
        let merged: serde_json::Map<_, _> =
            parts.into_iter().filter_map(|part| part.as_object().cloned()).flatten().collect();
        writeln!(out, "{}", serde_json::to_string_pretty(&merged)?)?;
    } else if scenes.len() > 1 {
        print_standings(out, scenes.len(), &standings.standings)?;
    }
    Ok(())
}

fn print(out: &mut impl Write, Scene { scene, rows, left_out }: &Scene) -> Result<()> {
    writeln!(out, "{scene}")?;
    let cells = |row: &Row| {
        if let Some(why) = &row.invalid {
            return vec![row.technique.clone(), format!("{}  invalid: {why}", row.bias)];
        }
        vec![
            row.technique.clone(),
            row.bias.clone(),
            format!("{:.3}", 100.0 * row.acne),
            row.detached_texels.map_or("-".into(), |texels| format!("{texels:.2}")),
            format!("{:.4}", row.rmse),
            format!("{:.3}", 100.0 * row.over_darkening),
        ]
    };
    let table: Vec<Vec<String>> = rows.iter().map(cells).chain(super::left_out_rows(left_out)).collect();
    table::print(out, &["technique", "bias", "acne %", "detached texels", "RMSE", "dark %"], &table)?;
    for ranking in bias::rank_biases(rows) {
        writeln!(out, "{}", ranking_line(&ranking))?;
    }
    Ok(())
}

/// Each bias over all scenes.
fn print_standings(out: &mut impl Write, scenes: usize, standings: &[Standing]) -> Result<()> {
    let number = |value: Option<f64>, factor: f64| value.map_or("-".into(), |v| format!("{:.3}", factor * v));
    let cells = |s: &Standing| {
        vec![
            s.technique.clone(),
            s.bias.clone(),
            number(s.mean_ratio, 1.0),
            s.above_a_tenth.to_string(),
            number(s.worst_ratio, 1.0),
            number(s.mean_acne, 100.0),
            number(s.worst_acne, 100.0),
            number(s.mean_detached_texels, 1.0),
            number(s.worst_detached_texels, 1.0),
        ]
    };
    let rows: Vec<Vec<String>> = standings.iter().map(cells).collect();
    writeln!(out, "all {scenes} scenes: RMSE over that of each scene's best fixed bias without acne")?;
    let last = ["acne %, mean", "worst", "detached, mean", "worst"];
    let header: Vec<&str> =
        ["technique", "bias", "mean ratio", "above 1.1", "worst"].into_iter().chain(last).collect();
    Ok(table::print(out, &header, &rows)?)
}

/// How many times the error of the best other bias `auto` has.
fn ranking_line(ranking: &bias::Ranking<'_>) -> String {
    let against =
        |best: &bias::Row| format!("{:.2} times that of {}", ranking.auto.rmse / best.rmse, best.bias);
    let best = ranking.best.map_or("not comparable, all leave acne".into(), against);
    let all = match ranking.best {
        Some(best) if best == ranking.best_of_all => String::new(),
        _ => format!("; {}, which leaves acne", against(ranking.best_of_all)),
    };
    format!("{}: RMSE of auto {best}{all}", ranking.auto.technique)
}
