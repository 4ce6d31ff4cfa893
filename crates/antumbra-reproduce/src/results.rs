//! What was reproduced, as data: `results.json` and `results.csv`.
//!
//! # results.json
//! One object, [`Reproduction`], whose `schema` is [`SCHEMA`]; fields are only ever added under one
//! version. `targets` has a [`Record`] for each page: its verdicts with the comparisons that decide
//! them, its tables, and the numbers of its matrix. Numbers are finite; what was not measured or does
//! not exist is `null`. Shares are 0 to 1, times milliseconds, sizes bytes.
//!
//! # results.csv
//! The same numbers in long form, one per line under `target,table,row,column,unit,ours,paper`
//! [RFC 4180]; an empty field is a number that does not exist. Verdicts have a line for each
//! comparison, the table being `verdict`, the row the claim, the column what is compared.

use crate::{
    page::{Block, Matrix, Page, Table, Unit},
    target::Target,
    verdict::{Comparison, Fact, Outcome, Ran, Saying, Verdict},
};
use antumbra_lab::{
    files,
    results::{AdapterFacts, Program},
};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Name and version of the schema.
pub const SCHEMA: &str = "antumbra-reproduction/2";

/// Everything in one folder.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Reproduction {
    /// [`SCHEMA`].
    pub schema: String,
    /// The program that wrote it last.
    pub program: Program,
    /// The graphics adapter that it ran on.
    pub adapter: AdapterFacts,
    /// One record for each page.
    pub targets: Vec<Record>,
}

/// One target.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// Source and what of it, such as `csm/figure-9`.
    pub id: String,
    /// What it is about.
    pub title: String,
    /// Its page, beside this file.
    pub file: String,
    /// Fingerprint of the program that measured.
    pub build: String,
    /// Whether it was made small.
    pub quick: bool,
    /// Seconds that it took; less where measurements were there already.
    pub seconds: f64,
    /// What became of the claims.
    pub verdicts: Vec<Judged>,
    /// What the source says that cannot come out otherwise.
    pub facts: Vec<Fact>,
    /// Its tables, in the page's order.
    pub tables: Vec<Table>,
    /// Its numbers to be sorted.
    pub matrices: Vec<Matrix>,
}

/// A verdict with its outcome.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judged {
    /// What is claimed, in our words and of our scenes.
    pub claim: String,
    /// Whose claim it is.
    pub source: Saying,
    /// What ran to judge it.
    pub ran: Option<Ran>,
    /// How it ends.
    pub outcome: Outcome,
    /// Why, in words.
    pub reason: String,
    /// Why, in numbers.
    pub comparisons: Vec<Comparison>,
}

impl From<&Verdict> for Judged {
    fn from(verdict: &Verdict) -> Self {
        Self {
            claim: verdict.claim.clone(),
            source: verdict.source.clone(),
            ran: verdict.ran.clone(),
            outcome: verdict.outcome(),
            reason: verdict.reason(),
            comparisons: verdict.comparisons.clone(),
        }
    }
}

impl Record {
    /// The numbers of a page.
    #[must_use]
    pub fn new(target: &Target, page: &Page, build: &str, quick: bool, seconds: f64) -> Self {
        let mut record = Self {
            id: target.id.into(),
            title: target.title.into(),
            file: target.file(),
            build: build.into(),
            quick,
            seconds,
            verdicts: page.verdicts.iter().map(Judged::from).collect(),
            facts: page.facts.clone(),
            tables: Vec::new(),
            matrices: Vec::new(),
        };
        for block in &page.blocks {
            match block {
                Block::Table(table) => record.tables.push(table.clone()),
                Block::Matrix(matrix) => record.matrices.push(matrix.clone()),
                Block::Text(_) | Block::Pictures(_) | Block::Plot(..) => {}
            }
        }
        record
    }

    /// How many of the documents' claims end so.
    #[must_use]
    pub fn count(&self, outcome: Outcome) -> usize {
        self.verdicts.iter().filter(|v| v.outcome == outcome && v.source.is_of_a_document()).count()
    }
}

impl Reproduction {
    /// What is in a folder: `None` if it has no `results.json` of this schema.
    #[must_use]
    pub fn read(path: &Path) -> Option<Self> {
        let read: Self = serde_json::from_slice(&files::read(path).ok()?).ok()?;
        (read.schema == SCHEMA).then_some(read)
    }

    /// As indented JSON.
    ///
    /// # Errors
    /// Never for numbers that were measured here.
    pub fn to_json(&self) -> Result<String> {
        Ok(serde_json::to_string_pretty(self).context("the results")? + "\n")
    }

    /// `results.csv`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut text = line(&["target", "table", "row", "column", "unit", "ours", "paper"].map(String::from));
        let number = |v: Option<f64>| v.map_or_else(String::new, |v| v.to_string());
        for record in &self.targets {
            let mut add = |table: &str, row: &str, column: &str, unit: &str, ours, paper| {
                let words = [&record.id, table, row, column, unit].map(String::from);
                text += &line(&[&words[..], &[number(ours), number(paper)]].concat());
            };
            for verdict in &record.verdicts {
                for c in &verdict.comparisons {
                    add("verdict", &verdict.claim, &c.what, "number", c.value, None);
                    add("verdict", &verdict.claim, &c.than, "number", c.limit, None);
                }
            }
            for table in &record.tables {
                for row in &table.rows {
                    for (head, cell) in table.head.iter().skip(1).zip(&row.cells) {
                        add(&table.caption, &row.name, head, unit(cell.unit), cell.ours, cell.paper);
                    }
                }
            }
            for matrix in &record.matrices {
                for row in &matrix.rows {
                    let name = format!("{} {}", row.scene, row.technique);
                    for (column, value) in matrix.columns.iter().zip(&row.values) {
                        add(&matrix.caption, &name, &column.key, unit(column.unit), *value, None);
                    }
                }
            }
        }
        text
    }
}

fn unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Number => "number",
        Unit::Share => "share",
        Unit::Times => "times",
        Unit::Milliseconds => "milliseconds",
        Unit::Bytes => "bytes",
    }
}

fn line(cells: &[String]) -> String {
    let quoted = cells.iter().map(|cell| match cell.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", cell.replace('"', "\"\"")),
        false => cell.clone(),
    });
    quoted.collect::<Vec<_>>().join(",") + "\r\n"
}
