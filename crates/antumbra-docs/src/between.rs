//! Two builds of the program side by side: what `antumbra bench --json` printed, in turns.

use anyhow::{Context, Result, bail};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Passes that are told apart; `surfaces` is the same for all, and `sum` and `scan` belong to few.
const PASSES: [&str; 5] = ["cast", "convert", "blur", "mips", "lookup"];

/// Least times of each technique: by pass, and of the whole frame, one per run.
type Times = BTreeMap<String, Vec<f64>>;

/// A table of the runs of both builds, each list in the order in which they took turns: the least time of any round
/// before, that after over it, and for frames how far that ratio lies apart from pair to pair. The least is what
/// a machine that does other work too says most reliably of a program.
///
/// # Errors
/// No runs, as many before as after, or files that `bench` did not print.
pub fn between(before: &[Value], after: &[Value]) -> Result<Value> {
    if before.is_empty() || before.len() != after.len() {
        bail!("{} runs before and {} after: pairs are needed", before.len(), after.len());
    }
    let [before, after] = [times(before)?, times(after)?];
    let mut columns: Vec<String> = vec!["frame before".into(), "frame after".into(), "frame ×".into()];
    columns.push("frame ×, pairs".into());
    columns.extend(PASSES.map(|pass| format!("{pass} ×")));
    let mut rows = Vec::new();
    for (name, times) in &before {
        let Some(later) = after.iter().find(|(other, _)| other == name).map(|(_, times)| times) else {
            continue;
        };
        let ratio = |pass: &str| Some(least(later.get(pass)?) / least(times.get(pass)?));
        let (frames, later_frames) = (&times["frame"], &later["frame"]);
        let pairs: Vec<f64> = frames.iter().zip(later_frames).map(|(before, after)| after / before).collect();
        let apart = format!("{:.2} to {:.2}", least(&pairs), pairs.iter().copied().fold(0.0, f64::max));
        let mut row = vec![json!(name), json!(least(frames)), json!(least(later_frames))];
        row.extend([json!(ratio("frame")), json!(apart)]);
        row.extend(PASSES.map(|pass| json!(ratio(pass))));
        rows.push(row);
    }
    Ok(json!({ "schema": "antumbra-table/1", "key": "technique", "columns": columns, "rows": rows }))
}

fn least(times: &[f64]) -> f64 {
    times.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Techniques in the order of the first run.
fn times(runs: &[Value]) -> Result<Vec<(String, Times)>> {
    let mut all: Vec<(String, Times)> = Vec::new();
    for run in runs {
        let techniques = run.get("techniques").and_then(Value::as_array).context("no \"techniques\"")?;
        for technique in techniques {
            let name = technique.get("spec").and_then(Value::as_str).context("no \"spec\"")?;
            let place = all.iter().position(|(known, _)| known == name).unwrap_or(all.len());
            if place == all.len() {
                all.push((name.into(), Times::new()));
            }
            let mut put = |pass: &str, ms: Option<f64>| -> Result<()> {
                let ms = ms.with_context(|| format!("{name}: no \"min_ms\" of {pass}"))?;
                all[place].1.entry(pass.into()).or_default().push(ms);
                Ok(())
            };
            put("frame", technique.pointer("/time/frame/min_ms").and_then(Value::as_f64))?;
            let passes =
                technique.pointer("/time/passes").and_then(Value::as_array).context("no \"passes\"")?;
            for pass in passes {
                let label = pass.get("name").and_then(Value::as_str).context("a pass without a name")?;
                put(label, pass.get("min_ms").and_then(Value::as_f64))?;
            }
        }
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "tests fail by panicking")]
    use super::*;

    fn run(frame: f64, cast: f64) -> Value {
        json!({ "techniques": [{ "spec": "hard", "time": {
            "frame": { "min_ms": frame }, "passes": [{ "name": "cast", "min_ms": cast }] } }] })
    }

    #[test]
    fn the_least_of_all_runs_counts() {
        let table = between(&[run(10.0, 2.0), run(20.0, 4.0)], &[run(30.0, 9.0), run(11.0, 3.0)]).unwrap();
        let row = json!(["hard", 10.0, 11.0, 1.1, "0.55 to 3.00", 1.5, null, null, null, null]);
        assert_eq!(table["rows"], json!([row]));
        assert!(between(&[run(1.0, 1.0)], &[]).is_err() && between(&[json!({})], &[json!({})]).is_err());
    }
}
