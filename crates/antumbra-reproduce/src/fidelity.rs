//! What becomes of each claim of the five documents: where it is in the program, and how well.
//!
//! The rows are data, `fidelity/*.json`, one file a document. The program `antumbra-fidelity` writes
//! `docs/fidelity.md` from them, and a test holds them to what is there: files, parameters, targets.

use anyhow::{Context, Result};
use serde::Deserialize;
use std::fmt::Write;

/// How well a claim is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum State {
    /// There and right.
    Ok,
    /// There in part, or without the evidence that the document gives.
    Partly,
    /// Not there.
    Missing,
    /// There, and not what the document says.
    Wrong,
    /// A matter of soft shadows, of perspective or of other lights, which come later, or of no shadow at all.
    Later,
}

/// A claim, an equation or a step.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// Document and number, such as `csm-17`.
    pub id: String,
    /// Section, equation, figure, table or slide.
    pub place: String,
    /// The claim in one line.
    pub claim: String,
    /// How well it is kept.
    pub state: State,
    /// Where, from the project's root.
    pub file: String,
    /// The setting that stands for it, such as `csm.terms`; empty if none does.
    pub parameter: String,
    /// The target that shows it; empty if none does.
    pub target: String,
    /// What has to be said of it; may be empty.
    pub note: String,
}

/// The rows of one document.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document {
    /// Authors, year and title.
    pub document: String,
    /// In the document's order.
    pub rows: Vec<Row>,
}

const FILES: [&str; 5] = [
    include_str!("../fidelity/brabec.json"),
    include_str!("../fidelity/csm.json"),
    include_str!("../fidelity/esm.json"),
    include_str!("../fidelity/spsm.json"),
    include_str!("../fidelity/slides.json"),
];

/// What stands above the tables; the errata are among it.
const HEAD: &str = include_str!("../fidelity/head.md");

impl State {
    const ALL: [Self; 5] = [Self::Ok, Self::Partly, Self::Missing, Self::Wrong, Self::Later];

    fn name(self) -> &'static str {
        match self {
            Self::Ok => "ok",
            Self::Partly => "partly",
            Self::Missing => "missing",
            Self::Wrong => "wrong",
            Self::Later => "later",
        }
    }
}

/// All documents.
///
/// # Errors
/// Rows that are not of the form of [`Row`].
pub fn documents() -> Result<Vec<Document>> {
    FILES.iter().map(|text| serde_json::from_str(text).context("fidelity/*.json")).collect()
}

/// `docs/fidelity.md`.
///
/// # Errors
/// As [`documents`].
pub fn page() -> Result<String> {
    let documents = documents()?;
    let mut text = format!("{HEAD}\n| document | rows | {} |\n", State::ALL.map(State::name).join(" | "));
    text += "| --- | --- | --- | --- | --- | --- | --- |\n";
    for document in &documents {
        text += &counts(&document.document, document.rows.iter());
    }
    text += &counts("all", documents.iter().flat_map(|d| &d.rows));
    for document in &documents {
        write!(text, "\n## {}\n\n", document.document)?;
        text += "| id | where | claim | state | file | setting | target | note |\n";
        text += "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
        for row in &document.rows {
            let file = row.file.rsplit('/').next().unwrap_or_default();
            writeln!(
                text,
                "| {} | {} | {} | {} | [{file}](../{}) | {} | {} | {} |",
                row.id,
                row.place,
                row.claim.replace('|', "\\|"),
                row.state.name(),
                row.file,
                code(&row.parameter),
                code(&row.target),
                row.note,
            )?;
        }
    }
    Ok(text)
}

fn code(name: &str) -> String {
    if name.is_empty() { String::new() } else { format!("`{name}`") }
}

/// A line of the table of counts.
fn counts<'r>(name: &str, rows: impl Iterator<Item = &'r Row> + Clone) -> String {
    let of = |state| rows.clone().filter(|row: &&Row| row.state == state).count().to_string();
    format!("| {name} | {} | {} |\n", rows.clone().count(), State::ALL.map(of).join(" | "))
}
