//! `antumbra bias`: acne against detached shadows.

use super::table;
use crate::{arguments::Bias, progress::Bar, scene, techniques};
use antumbra_lab::{
    bias::{self, Request},
    gpu,
};
use anyhow::Result;
use serde_json::json;
use std::io::{self, Write};

pub(crate) fn run(arguments: &Bias) -> Result<()> {
    scene::check_view(&arguments.view)?;
    let techniques = techniques::read(&arguments.techniques, arguments.view.kernel)?;
    let settings: Vec<_> = arguments.settings.iter().map(|text| text.parse()).collect::<Result<_, _>>()?;
    let gpu = gpu::open()?;
    let out = &mut io::stdout();
    let mut all = serde_json::Map::new();
    for name in &arguments.scenes {
        let shot = scene::load_view(name, &arguments.view)?;
        let request = Request { shot: &shot, techniques: &techniques, settings: &settings };
        let bias::Study { rows, left_out } = {
            let bar = Bar::new([("upload", 1.0), ("truth", 8.0), ("render", 6.0)]);
            bias::study(&gpu, &request, &bar)?
        };
        super::note_left_out(&left_out);
        if arguments.json {
            all.insert(shot.name, json!({ "rows": rows, "left_out": left_out }));
            continue;
        }
        writeln!(out, "{}", shot.name)?;
        let cells = |row: &bias::Row| {
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
        let table: Vec<Vec<String>> = rows.iter().map(cells).chain(super::left_out_rows(&left_out)).collect();
        table::print(out, &["technique", "bias", "acne %", "detached texels", "RMSE", "dark %"], &table)?;
        for ranking in bias::rank_biases(&rows) {
            writeln!(out, "{}", ranking_line(&ranking))?;
        }
    }
    if arguments.json {
        writeln!(out, "{}", serde_json::to_string_pretty(&all)?)?;
    }
    Ok(())
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
