//! Documents are what their templates and the result files give, and take no number from elsewhere.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra_docs::{Cell, Record, Results, documents, fill, fill_all, measured_numbers, refill};
use std::{
    fs,
    path::{Path, PathBuf},
};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs")
}

fn results() -> Results {
    Results::read(&docs().join("results")).unwrap()
}

#[test]
fn documents_are_what_the_result_files_give() {
    let made = fill_all(&docs()).unwrap();
    assert!(made.len() >= 3, "{made:?}");
    for (path, text) in made {
        let there = fs::read_to_string(&path).unwrap();
        let differs = there.lines().zip(text.lines()).position(|(there, made)| there != made);
        let line = differs.map(|i| format!(", first in line {}", i + 1)).unwrap_or_default();
        assert!(there == text, "{} differs from what `make docs` gives{line}", path.display());
    }
}

/// Each table's first number, changed, changes a document: no table is there for nothing.
#[test]
fn every_result_shows_in_a_document() {
    let templates: Vec<String> = documents(&docs())
        .unwrap()
        .iter()
        .map(|(template, _)| fs::read_to_string(template).unwrap())
        .collect();
    let readme = fs::read_to_string(docs().join("../README.md")).unwrap();
    let all = |results: &Results| -> Vec<String> {
        let readme = refill(&readme, results).unwrap();
        templates.iter().map(|template| fill(template, results).unwrap()).chain([readme]).collect()
    };
    let usual = all(&results());
    for name in results().names() {
        let mut changed = results();
        for row in &mut changed.record_mut(name).unwrap().rows {
            for cell in row.cells.values_mut() {
                if let Cell::Number(number) = cell {
                    *number = 3.0 * *number + 1000.0;
                }
            }
        }
        assert_ne!(all(&changed), usual, "no document shows a number of {name}");
    }
}

#[test]
fn templates_bring_no_measured_numbers_of_their_own() {
    for (template, _) in documents(&docs()).unwrap() {
        let found = measured_numbers(&fs::read_to_string(&template).unwrap());
        let of_a_paper = |text: &String| OF_PAPERS.iter().any(|known| text.starts_with(known));
        let own: Vec<String> = found.into_iter().filter(|text| !of_a_paper(text)).collect();
        assert!(own.is_empty(), "{}: {own:#?}: take them from a result file", template.display());
    }
}

/// Numbers of the papers.
const OF_PAPERS: [&str; 2] = ["1.10 :", "4.5 in"];

#[test]
fn numbers_from_nowhere_are_noticed() {
    assert_eq!(measured_numbers("It took 31 ms, and 1.5 of that"), ["31 ms,", "1.5 of"]);
    assert_eq!(
        measured_numbers("A share of 4 %; `x 2.5 ms` {{a | b | c | .1}} [a](1.5.md) 2048² maps of 7 texels"),
        ["4 %;"]
    );
}

fn record(result: &str) -> anyhow::Result<Record> {
    let source = r#"{"command": "antumbra bench", "machine": "a", "commit": "c", "date": "2026-12-01"}"#;
    let file = format!(r#"{{"source": {source}, "result": {result}}}"#);
    Ok(Record::read(&serde_json::from_str(&file)?)?.remove(0).1)
}

const TABLE: &str = r#"{"schema": "antumbra-table/1", "key": "what", "columns": ["cast", "word"],
    "rows": [["hard", 2, "x"], ["esm", 3, null]]}"#;

#[test]
fn files_that_say_too_little_are_refused() {
    record(TABLE).unwrap();
    let refusal = |result: &str| format!("{:#}", record(result).unwrap_err());
    assert!(refusal(&TABLE.replace("table/1", "table/2")).contains("antumbra-table/2"));
    assert!(refusal(&TABLE.replace("3, null", "3")).contains("\"esm\" has 1 cells for 2 columns"));
    let whole = format!(
        r#"{{"source": {{"command": "c", "machine": "m", "commit": "c", "date": "today"}}, "result": {TABLE}}}"#
    );
    let error = |text: &str| format!("{:#}", Record::read(&serde_json::from_str(text).unwrap()).unwrap_err());
    assert!(error(&whole).contains("like 2026-12-01"));
    let day = whole.replace("today", "2026-12-01");
    assert!(
        error(&day.replace(r#""machine": "m""#, r#""machine": " ""#)).contains("source.machine is empty")
    );
    assert!(error(&day.replace(r#""commit": "c", "#, "")).contains("commit"));
}

#[test]
fn directives_give_numbers_tables_and_sources() {
    let folder = std::env::temp_dir().join(format!("antumbra-docs-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let source = r#"{"command": "antumbra bench", "machine": "a", "commit": "c", "date": "2026-12-01", "transcribed": "by hand"}"#;
    fs::write(folder.join("a.json"), format!(r#"{{"source": {source}, "result": {TABLE}}}"#)).unwrap();
    let results = Results::read(&folder).unwrap();
    fs::remove_dir_all(&folder).unwrap();
    let from = "*`antumbra bench` at c, 2026-12-01: a. Transcribed: by hand.*";
    let fill = |template: &str| fill(template, &results).map_err(|error| format!("{error:#}"));
    let table = format!(
        "| what | cast | word |\n| --- | --- | --- |\n| `hard` | 2.0 | x |\n| `esm` | 3.0 | – |\n\n{from}\n"
    );
    assert_eq!(fill("{{table a .1 | cast | word}}").unwrap(), table);
    let text = "{{source a}} {{a | esm | cast / hard | cast | .2}}, {{a | hard | cast - a | esm | cast | .0}}, {{a | esm | cast | .0%}}";
    assert_eq!(fill(text).unwrap(), format!("{from} 1.50, -1, 300 %\n"));
    let part = |old: &str| {
        format!(
            "x\n<!-- made by make docs of:\n{{{{table a .1 | cast | word}}}}\n-->\n{old}<!-- end of what is made -->\ny\n"
        )
    };
    let made = refill(&part("old\n"), &results).unwrap();
    assert_eq!(made, part(&format!("\n{table}\n")));
    assert_eq!(refill(&made, &results).unwrap(), made);
    assert!(refill("<!-- made by make docs of:\n-->\n", &results).is_err());
    for (template, words) in [
        ("{{a | esm | cast | .1}}", "add {{source a}}"),
        ("{{b | esm | cast | .1}}", "no result file \"b\"; there are a"),
        ("{{a | vsm | cast | .1}}", "no row \"vsm\"; there are hard; esm"),
        ("{{a | esm | blur | .1}}", "esm has no \"blur\"; there are cast"),
        ("{{a | hard | word | .1}}", "no number"),
        ("{{a | esm | cast | 1}}", "write .1 or .1%"),
        ("{{table a .1 | casts}}", "no row has a column \"casts\""),
        ("{{a | esm", "line 1"),
    ] {
        let error = fill(template).unwrap_err();
        assert!(error.contains(words), "{template}: {error}");
    }
}
