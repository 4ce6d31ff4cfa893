//! What the rows of the documents' claims name must be there.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::technique;
use antumbra_reproduce::{
    catalogue,
    fidelity::{Row, State, documents, page},
};
use std::{collections::BTreeSet, fs, path::Path};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// What a row names and is not there.
fn lacks(row: &Row) -> Vec<String> {
    let file = root().join(&row.file).is_file().then_some(()).ok_or(&row.file);
    let parameter = if has_parameter(&row.parameter) { Ok(()) } else { Err(&row.parameter) };
    let target = row.target.is_empty() || catalogue::all().any(|t| t.id == row.target);
    let target = if target { Ok(()) } else { Err(&row.target) };
    [file, parameter, target]
        .into_iter()
        .filter_map(Result::err)
        .map(|what| format!("{}: {what}", row.id))
        .collect()
}

fn has_parameter(name: &str) -> bool {
    if name.is_empty() {
        return true;
    }
    let Some((technique, parameter)) = name.split_once('.') else { return false };
    technique::parse(technique).is_ok_and(|mut t| t.parameters().iter().any(|p| p.name == parameter))
}

#[test]
fn rows_name_what_is_there() {
    let rows: Vec<Row> = documents().unwrap().into_iter().flat_map(|d| d.rows).collect();
    let missing: Vec<String> = rows.iter().flat_map(lacks).collect();
    assert!(missing.is_empty(), "not there:\n{}", missing.join("\n"));
    let ids: BTreeSet<&str> = rows.iter().map(|row| row.id.as_str()).collect();
    assert_eq!(ids.len(), rows.len(), "ids are unique");
    assert!(rows.iter().all(|row| !row.place.is_empty() && !row.claim.is_empty()));
    let silent: Vec<&str> =
        rows.iter().filter(|r| r.state != State::Ok && r.note.is_empty()).map(|r| r.id.as_str()).collect();
    assert!(silent.is_empty(), "what is not ok says why: {silent:?}");
}

#[test]
fn what_is_not_there_is_found() {
    let row = Row {
        id: "x-1".into(),
        place: "§1".into(),
        claim: "claim".into(),
        state: State::Ok,
        file: "crates/nowhere.rs".into(),
        parameter: "csm.nothing".into(),
        target: "csm/figure-0".into(),
        note: String::new(),
    };
    assert_eq!(lacks(&row), ["x-1: crates/nowhere.rs", "x-1: csm.nothing", "x-1: csm/figure-0"]);
}

#[test]
fn the_document_is_what_the_rows_give() {
    let kept = fs::read_to_string(root().join("docs/fidelity.md")).unwrap();
    assert!(kept == page().unwrap(), "docs/fidelity.md is not what the rows give: make docs");
}
