//! What a result file holds: rows of named numbers, and where they come from.

use anyhow::{Context, Result, bail};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::{collections::BTreeMap, fmt};

mod bench;
mod bias;
mod compare;

/// Where numbers come from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Source {
    /// The command line that printed them.
    pub command: String,
    /// The machine it ran on.
    pub machine: String,
    /// The graphics driver, empty where none took part.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub driver: String,
    /// The commit that was built, short; `+` behind it if files had changed since.
    pub commit: String,
    /// The day, as 2026-12-01.
    pub date: String,
    /// How the numbers came into the file if no command wrote it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub transcribed: Option<String>,
}

impl Source {
    /// What is missing of it, if anything.
    fn check(&self) -> Result<()> {
        for (name, text) in [("command", &self.command), ("machine", &self.machine), ("commit", &self.commit)]
        {
            if text.trim().is_empty() {
                bail!("source.{name} is empty: say where the numbers come from");
            }
        }
        let date: Vec<usize> = self.date.split('-').map(str::len).collect();
        if date != [4, 2, 2] || !self.date.chars().all(|c| c.is_ascii_digit() || c == '-') {
            bail!("source.date is {:?}: write it like 2026-12-01", self.date);
        }
        Ok(())
    }
}

impl fmt::Display for Source {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { command, machine, driver, commit, date, transcribed } = self;
        let driver = if driver.is_empty() { String::new() } else { format!("; {driver}") };
        write!(f, "*`{command}` at {commit}, {date}: {machine}{driver}.")?;
        if let Some(how) = transcribed {
            write!(f, " Transcribed: {how}.")?;
        }
        f.write_str("*")
    }
}

/// One table.
#[derive(Debug, Clone, PartialEq)]
pub struct Record {
    /// Where it comes from.
    pub source: Source,
    /// What its rows are, e.g. "technique".
    pub key: String,
    /// In the order of the file.
    pub rows: Vec<Row>,
}

/// One row.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// E.g. a technique with its settings.
    pub name: String,
    /// By name of the column; what was not measured is missing.
    pub cells: BTreeMap<String, Cell>,
}

/// What stands in a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A measured number.
    Number(f64),
    /// A word.
    Text(String),
}

impl Record {
    /// The tables of a result file, those behind the first with the name of their part.
    ///
    /// # Errors
    /// Not such a file, or one of a schema that is not known.
    pub fn read(file: &Value) -> Result<Vec<(String, Self)>> {
        let source: Source =
            serde_json::from_value(file.get("source").context("no \"source\"")?.clone()).context("source")?;
        source.check()?;
        let result = file.get("result").context("no \"result\"")?;
        let schema = text(result, "schema")?;
        let tables = match schema {
            "antumbra-table/1" => vec![table(result)?],
            "antumbra-bench/1" => vec![bench::table(result)?],
            "antumbra-bias/1" => bias::tables(result)?,
            "antumbra-results/1" => compare::tables(result)?,
            other => bail!("schema {other:?} is none that documents are made of"),
        };
        let record = |(part, key, rows)| (part, Self { source: source.clone(), key, rows });
        Ok(tables.into_iter().map(record).collect())
    }

    /// One row.
    ///
    /// # Errors
    /// No row has that name.
    pub fn row(&self, name: &str) -> Result<&Row> {
        self.rows.iter().find(|row| row.name == name).with_context(|| {
            let known: Vec<&str> = self.rows.iter().map(|row| row.name.as_str()).collect();
            format!("no row {name:?}; there are {}", known.join("; "))
        })
    }
}

impl Row {
    /// One number.
    ///
    /// # Errors
    /// The row has none of that name.
    pub fn number(&self, column: &str) -> Result<f64> {
        match self.cells.get(column) {
            Some(Cell::Number(number)) => Ok(*number),
            Some(Cell::Text(text)) => bail!("{}, {column} is the text {text:?}, no number", self.name),
            None => {
                let known: Vec<&str> = self.cells.keys().map(String::as_str).collect();
                bail!("{} has no {column:?}; there are {}", self.name, known.join(", "))
            }
        }
    }
}

/// Name of the part, what its rows are, its rows.
type Table = (String, String, Vec<Row>);

/// `{"key": "technique", "columns": ["cast"], "rows": [["hard", 1.5]]}`.
fn table(result: &Value) -> Result<Table> {
    let columns = list(result, "columns")?;
    let columns: Vec<&str> = columns.iter().map(|c| c.as_str().context("columns")).collect::<Result<_>>()?;
    let row = |row: &Value| -> Result<Row> {
        let cells = row.as_array().context("a row is no array")?;
        let name = cells.first().and_then(Value::as_str).context("a row without a name")?;
        if cells.len() != columns.len() + 1 {
            bail!("row {name:?} has {} cells for {} columns", cells.len() - 1, columns.len());
        }
        let named = columns.iter().map(ToString::to_string).zip(cells[1..].iter().map(Cell::of));
        let cells = named.filter_map(|(column, cell)| Some((column, cell?))).collect();
        Ok(Row { name: name.into(), cells })
    };
    let rows = list(result, "rows")?.iter().map(row).collect::<Result<_>>()?;
    Ok((String::new(), text(result, "key")?.into(), rows))
}

impl Cell {
    /// `None` of null.
    fn of(value: &Value) -> Option<Self> {
        match value {
            Value::Null => None,
            Value::String(text) => Some(Self::Text(text.clone())),
            other => Some(Self::Number(other.as_f64()?)),
        }
    }
}

/// A text of an object.
fn text<'v>(value: &'v Value, key: &str) -> Result<&'v str> {
    value.get(key).and_then(Value::as_str).with_context(|| format!("no text {key:?}"))
}

/// A list of an object.
fn list<'v>(value: &'v Value, key: &str) -> Result<&'v Vec<Value>> {
    value.get(key).and_then(Value::as_array).with_context(|| format!("no list {key:?}"))
}
