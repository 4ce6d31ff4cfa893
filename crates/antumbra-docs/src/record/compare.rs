//! What `antumbra compare --json` prints: a row per technique, errors to the light-space ideal but for `match`, and
//! a part on what they are measured against.

use super::{Cell, Row, Table, list, text};
use anyhow::Result;
use serde_json::Value;
use std::collections::BTreeMap;

/// Columns of a technique, with where they stand.
const COLUMNS: [(&str, &str); 9] = [
    ("RMSE", "/scores/light_space/rmse"),
    ("RMSE at contact", "/regions/contact/rmse"),
    ("leak", "/scores/light_space/leak"),
    ("acne", "/scores/hard/acne"),
    ("pixel match", "/scores/hard/pixel_match"),
    ("frame, ms", "/time/frame/median_ms"),
    ("frame", "/time/frame_ratio_to_hard"),
    ("bytes per texel", "/work/bytes_per_texel_with_mips"),
    ("lookups", "/work/lookups"),
];

/// The same of the truth.
const TRUTH: [(&str, &str); 6] = [
    ("raster and rays agree", "/truth/coverage_agreement"),
    ("no shadow matches", "/truth/no_shadow/pixel_match"),
    ("seconds, tree", "/truth/seconds_build"),
    ("seconds, hard", "/truth/seconds_hard"),
    ("seconds, light space", "/truth/seconds_light_space"),
    ("seconds, screen space", "/truth/seconds_screen_space"),
];

pub(super) fn tables(result: &Value) -> Result<Vec<Table>> {
    let mut rows = Vec::new();
    for technique in list(result, "techniques")? {
        let name = text(technique, "spec")?.into();
        if technique.get("invalid").is_some() {
            let cells = BTreeMap::from([("pixel match".to_string(), Cell::Text("invalid".into()))]);
            rows.push(Row { name, cells });
            continue;
        }
        let mut cells = cells(technique, &COLUMNS);
        if let Some(bytes) = technique.pointer("/memory/kept_bytes").and_then(Value::as_f64) {
            cells.insert("map, MiB".into(), Cell::Number(bytes / f64::from(1 << 20)));
        }
        rows.push(Row { name, cells });
    }
    let truth = Row { name: "all".into(), cells: cells(result, &TRUTH) };
    Ok(vec![(String::new(), "technique".into(), rows), ("truth".into(), "pixels".into(), vec![truth])])
}

fn cells(value: &Value, columns: &[(&str, &str)]) -> BTreeMap<String, Cell> {
    let cell = |(column, path): &(&str, &str)| Some((column.to_string(), Cell::of(value.pointer(path)?)?));
    columns.iter().filter_map(cell).collect()
}
