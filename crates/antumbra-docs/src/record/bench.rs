//! What `antumbra bench --json` prints: a row for shading without shadows and one per technique, times in
//! milliseconds.

use super::{Cell, Row, Table, list, text};
use anyhow::{Context, Result};
use serde_json::Value;
use std::collections::BTreeMap;

pub(super) fn table(result: &Value) -> Result<Table> {
    let none = row("none", result.get("unshadowed").context("no \"unshadowed\"")?)?;
    let mut rows = vec![none];
    for technique in list(result, "techniques")? {
        let name = text(technique, "spec")?;
        if technique.get("invalid").is_some() {
            let cells = BTreeMap::from([("frame".to_string(), Cell::Text("invalid".into()))]);
            rows.push(Row { name: name.into(), cells });
            continue;
        }
        let mut row = row(name, technique.get("time").context("no \"time\"")?).context(name.to_string())?;
        let mut put = |column: &str, value: Option<f64>| {
            value.map(|value| row.cells.insert(column.into(), Cell::Number(value)));
        };
        let number = |path: &str| technique.pointer(path).and_then(Value::as_f64);
        put("MiB", number("/memory/kept_bytes").map(|bytes| bytes / f64::from(1 << 20)));
        put("bytes per texel", number("/work/bytes_per_texel_with_mips"));
        put("set-up", number("/start_up/set_up_ms"));
        put("first frame", number("/start_up/first_frame_ms"));
        rows.push(row);
    }
    Ok((String::new(), "technique".into(), rows))
}

/// Passes by their names, and the frame.
fn row(name: &str, time: &Value) -> Result<Row> {
    let mut cells = BTreeMap::new();
    for pass in list(time, "passes")? {
        let ms = pass.get("median_ms").and_then(Value::as_f64).context("a pass without \"median_ms\"")?;
        cells.insert(text(pass, "name")?.to_string(), Cell::Number(ms));
    }
    let columns = [
        ("frame", "/frame/median_ms"),
        ("min", "/frame/min_ms"),
        ("max", "/frame/max_ms"),
        ("over `hard`", "/frame_ratio_to_hard"),
        ("lookup over `hard`", "/lookup_ratio_to_hard"),
    ];
    for (column, path) in columns {
        if let Some(number) = time.pointer(path).and_then(Value::as_f64) {
            cells.insert(column.into(), Cell::Number(number));
        }
    }
    Ok(Row { name: name.into(), cells })
}
