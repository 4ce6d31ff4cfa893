//! `results.csv`: the numbers without the structure.

use super::{Results, TechniqueResult};
use crate::metrics::Score;

const SCORE: [&str; 15] = [
    "pixel_match",
    "pixel_match_near_edges",
    "rmse",
    "mae",
    "psnr_db",
    "ssim",
    "flip",
    "leak",
    "over_darkening",
    "acne",
    "shadowable_pixels",
    "edge_pixels",
    "lit_pixels",
    "deep_shadow_pixels",
    "deep_lit_pixels",
];

/// Columns before the numbers, which invalid techniques do not have.
const NAMES: usize = 4;

pub(super) fn table(results: &Results) -> String {
    let names: [&str; NAMES] = ["spec", "name", "title", "family"];
    let mut head: Vec<String> = names.map(String::from).into();
    for truth in ["hard", "light_space", "screen_space"] {
        head.extend(SCORE.iter().map(|metric| format!("{truth}_{metric}")));
    }
    let cost = ["frame_ms", "frame_min_ms", "frame_max_ms", "frame_ratio_to_hard", "lookup_ratio_to_hard"];
    head.extend(cost.map(String::from));
    head.extend(["kept_bytes", "transient_bytes"].map(String::from));
    head.extend(["bytes_per_texel", "bytes_per_texel_with_mips", "lookups", "passes"].map(String::from));
    head.push("invalid".into());
    let rows = results.techniques.iter().map(row);
    std::iter::once(head).chain(rows).map(|cells| line(&cells)).collect()
}

fn row(technique: &TechniqueResult) -> Vec<String> {
    let mut cells: Vec<String> =
        [&technique.spec, &technique.name, &technique.title].map(String::clone).into();
    cells.push(technique.family.name().into());
    let scores = &technique.scores;
    for score in [&scores.hard, &scores.light_space, &scores.screen_space] {
        cells.extend(score_cells(score));
    }
    let time = &technique.time;
    cells.extend([time.frame.median_ms, time.frame.min_ms, time.frame.max_ms].map(|ms| ms.to_string()));
    cells.extend([time.frame_ratio_to_hard, time.lookup_ratio_to_hard].map(optional));
    cells.extend([technique.memory.kept_bytes, technique.memory.transient_bytes].map(|b| b.to_string()));
    let work = technique.work.as_ref();
    cells.extend([
        optional(work.map(|w| w.bytes_per_texel)),
        optional(work.map(|w| w.bytes_per_texel_with_mips)),
        optional(work.map(|w| f64::from(w.lookups))),
        optional(work.map(|w| w.passes.len() as f64)),
    ]);
    if technique.invalid.is_some() {
        cells[NAMES..].iter_mut().for_each(String::clear);
    }
    cells.push(technique.invalid.clone().unwrap_or_default());
    cells
}

fn score_cells(score: &Score) -> [String; SCORE.len()] {
    [
        score.pixel_match.to_string(),
        optional(score.pixel_match_near_edges),
        score.rmse.to_string(),
        score.mae.to_string(),
        optional(score.psnr),
        score.ssim.to_string(),
        score.flip.to_string(),
        optional(score.leak),
        optional(score.over_darkening),
        optional(score.acne),
        score.shadowable_pixels.to_string(),
        score.edge_pixels.to_string(),
        score.lit_pixels.to_string(),
        score.deep_shadow_pixels.to_string(),
        score.deep_lit_pixels.to_string(),
    ]
}

fn optional(value: Option<f64>) -> String {
    value.map_or_else(String::new, |v| v.to_string())
}

fn line(cells: &[String]) -> String {
    let quoted: Vec<String> = cells
        .iter()
        .map(|cell| {
            if cell.contains([',', '"', '\n', '\r']) {
                format!("\"{}\"", cell.replace('"', "\"\""))
            } else {
                cell.clone()
            }
        })
        .collect();
    quoted.join(",") + "\r\n"
}
