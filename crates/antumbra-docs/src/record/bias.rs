//! What `antumbra bias --json` prints: a part for each technique, with a row for each bias over all scenes, and
//! one with a row for each scene.

use super::{Cell, Row, Table, list, text};
use anyhow::Result;
use serde_json::Value;
use std::collections::BTreeMap;

/// Columns over all scenes, with their keys.
const OVERALL: [(&str, &str); 10] = [
    ("mean ratio", "mean_ratio"),
    ("above 1.1", "above_a_tenth"),
    ("worst ratio", "worst_ratio"),
    ("among all: mean", "mean_ratio_of_all"),
    ("among all: above 1.1", "above_a_tenth_of_all"),
    ("among all: worst", "worst_ratio_of_all"),
    ("acne", "mean_acne"),
    ("worst acne", "worst_acne"),
    ("detached", "mean_detached_texels"),
    ("worst detached", "worst_detached_texels"),
];

/// Columns of one scene, with their keys.
const OF_SCENE: [(&str, &str); 7] = [
    ("best", "best"),
    ("its RMSE", "best_rmse"),
    ("RMSE", "rmse"),
    ("acne", "acne"),
    ("detached", "detached_texels"),
    ("ratio", "ratio"),
    ("ratio among all", "ratio_of_all"),
];

pub(super) fn tables(result: &Value) -> Result<Vec<Table>> {
    let mut tables: Vec<Table> = Vec::new();
    for standing in list(result, "standings")? {
        let technique = text(standing, "technique")?;
        let row = Row { name: text(standing, "bias")?.into(), cells: cells(standing, &OVERALL) };
        push(&mut tables, technique.into(), "bias", row);
    }
    for place in list(result, "places")? {
        let part = format!("{} by scene", text(place, "technique")?);
        let row = Row { name: text(place, "scene")?.into(), cells: cells(place, &OF_SCENE) };
        push(&mut tables, part, "scene", row);
    }
    Ok(tables)
}

/// Adds a row to the part of that name.
fn push(tables: &mut Vec<Table>, part: String, key: &str, row: Row) {
    match tables.iter_mut().find(|(name, ..)| *name == part) {
        Some((.., rows)) => rows.push(row),
        None => tables.push((part, key.into(), vec![row])),
    }
}

fn cells(value: &Value, columns: &[(&str, &str)]) -> BTreeMap<String, Cell> {
    let cell = |(column, key): &(&str, &str)| Some((column.to_string(), Cell::of(value.get(key)?)?));
    columns.iter().filter_map(cell).collect()
}
