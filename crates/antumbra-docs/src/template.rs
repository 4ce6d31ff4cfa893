//! Templates: documents with directives.

use crate::{Cell, Record, Results, Row};
use anyhow::{Context, Result, bail};
use std::{collections::BTreeSet, fmt::Write};

/// A document from its template.
///
/// # Errors
/// A directive that cannot be read, a file, row or column that is not there, numbers of a file whose source
/// the document does not show.
pub fn fill(template: &str, results: &Results) -> Result<String> {
    let mut filler = Filler { results, taken: BTreeSet::new(), sourced: BTreeSet::new() };
    let mut document = String::with_capacity(2 * template.len());
    for (number, line) in template.lines().enumerate() {
        let line = filler.line(line).with_context(|| format!("line {}: {line}", number + 1))?;
        document.push_str(&line);
        document.push('\n');
    }
    if let Some(file) = filler.taken.difference(&filler.sourced).next() {
        bail!(
            "numbers of {file} are taken, and the document does not say where they come from: add {{{{source {file}}}}}"
        );
    }
    Ok(document)
}

/// Begins a part of a document that carries its own template, in a comment of which this is the first line.
const BEGIN: &str = "<!-- made by make docs of:";
/// Ends it.
const END: &str = "<!-- end of what is made -->";

/// A document with parts that carry their templates: below each comment what its lines give, up to the next
/// end.
///
/// # Errors
/// As [`fill`]; a comment or a part that does not end.
pub fn refill(document: &str, results: &Results) -> Result<String> {
    let mut text = String::with_capacity(document.len());
    let mut rest = document;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (template, after) = after.split_once("\n-->\n").context("a comment without -->")?;
        let (_, after) = after.split_once(END).with_context(|| format!("no {END}"))?;
        let made = fill(template.trim_start_matches('\n'), results)?;
        text.push_str(&format!("{before}{BEGIN}{template}\n-->\n\n{made}\n{END}"));
        rest = after;
    }
    Ok(text + rest)
}

struct Filler<'r> {
    results: &'r Results,
    /// Files whose numbers stand in the document.
    taken: BTreeSet<String>,
    /// Files whose source the document shows.
    sourced: BTreeSet<String>,
}

impl Filler<'_> {
    fn line(&mut self, line: &str) -> Result<String> {
        let mut text = String::new();
        let mut rest = line;
        while let Some((before, after)) = rest.split_once("{{") {
            let (directive, after) = after.split_once("}}").context("a {{ without }}")?;
            text.push_str(before);
            text.push_str(&self.directive(directive.trim())?);
            rest = after;
        }
        Ok(text + rest)
    }

    fn directive(&mut self, directive: &str) -> Result<String> {
        if let Some(table) = directive.strip_prefix("table ") {
            return self.table(table);
        }
        if let Some(file) = directive.strip_prefix("source ") {
            let source = &self.results.record(file)?.source;
            self.sourced.insert(stem(file));
            return Ok(source.to_string());
        }
        let (what, format) = directive.rsplit_once('|').context("no | and format at the end")?;
        let (what, format) = (what.trim(), Format::read(format.trim())?);
        let operands = [" / ", " - "].into_iter().find_map(|o| Some((o, what.split_once(o)?)));
        let Some((operator, (left, right))) = operands else {
            return Ok(format.of(self.number(what, "")?));
        };
        let file = left.split('|').next().unwrap_or_default().trim();
        let (left, right) = (self.number(left, file)?, self.number(right, file)?);
        Ok(format.of(if operator == " / " { left / right } else { left - right }))
    }

    /// `FILE | ROW | COLUMN`, or without a file, which then is `file`.
    fn number(&mut self, operand: &str, file: &str) -> Result<f64> {
        let parts: Vec<&str> = operand.split('|').map(str::trim).collect();
        let (file, row, column) = match parts[..] {
            [file, row, column] => (file, row, column),
            [row, column] if !file.is_empty() => (file, row, column),
            _ => bail!("{operand:?} is not FILE | ROW | COLUMN"),
        };
        self.taken.insert(stem(file));
        self.results.record(file)?.row(row).and_then(|row| row.number(column)).context(file.to_string())
    }

    fn table(&mut self, text: &str) -> Result<String> {
        let mut parts = text.split('|').map(str::trim);
        let (file, format) = formatted(parts.next().unwrap_or_default(), Format::default())?;
        let columns: Vec<(&str, Format)> =
            parts.map(|part| formatted(part, format)).collect::<Result<_>>()?;
        if columns.is_empty() {
            bail!("a table of no columns");
        }
        let record = self.results.record(file)?;
        self.taken.insert(stem(file));
        self.sourced.insert(stem(file));
        let table = rows(record, &columns).with_context(|| file.to_string())?;
        Ok(format!("{table}\n{}", record.source))
    }
}

/// The name of the file that a part lies in.
fn stem(file: &str) -> String {
    file.split(':').next().unwrap_or_default().into()
}

/// A Markdown table.
fn rows(record: &Record, columns: &[(&str, Format)]) -> Result<String> {
    for (column, _) in columns {
        if !record.rows.iter().any(|row| row.cells.contains_key(*column)) {
            bail!("no row has a column {column:?}");
        }
    }
    let mut text = format!("| {} |", record.key);
    columns.iter().for_each(|(column, _)| text.push_str(&format!(" {column} |")));
    text.push_str("\n|");
    text.push_str(&" --- |".repeat(columns.len() + 1));
    for row in &record.rows {
        if !columns.iter().any(|(column, _)| row.cells.contains_key(*column)) {
            continue;
        }
        write!(text, "\n| {} |", label(row))?;
        for (column, format) in columns {
            match row.cells.get(*column) {
                Some(Cell::Number(number)) => write!(text, " {} |", format.of(*number))?,
                Some(Cell::Text(cell)) => write!(text, " {cell} |")?,
                None => text.push_str(" – |"),
            }
        }
    }
    text.push('\n');
    Ok(text)
}

/// What stands before a row: a name or a spec as code, other texts as they are.
fn label(row: &Row) -> String {
    let is_word = |c: char| c.is_ascii_alphanumeric() || "_=.,".contains(c);
    if row.name.chars().all(is_word) { format!("`{}`", row.name) } else { row.name.clone() }
}

/// How numbers are written.
#[derive(Debug, Clone, Copy, Default)]
struct Format {
    decimals: usize,
    percent: bool,
}

impl Format {
    fn read(text: &str) -> Result<Self> {
        let digits = text.strip_prefix('.').with_context(|| format!("format {text:?}: write .1 or .1%"))?;
        let (digits, percent) = digits.strip_suffix('%').map_or((digits, false), |digits| (digits, true));
        let decimals = digits.parse().with_context(|| format!("format {text:?}: write .1 or .1%"))?;
        Ok(Self { decimals, percent })
    }

    fn of(self, number: f64) -> String {
        let decimals = self.decimals;
        if self.percent { format!("{:.decimals$} %", 100.0 * number) } else { format!("{number:.decimals$}") }
    }
}

/// A name with a format behind it, or `usual`.
fn formatted(text: &str, usual: Format) -> Result<(&str, Format)> {
    match text.rsplit_once(' ') {
        Some((name, format)) if format.starts_with('.') => Ok((name.trim(), Format::read(format)?)),
        _ => Ok((text, usual)),
    }
}

/// What in the prose of a template looks like a measured number: decimal fractions, percentages and times that
/// stand outside directives, code (settings) and links.
#[must_use]
pub fn measured_numbers(template: &str) -> Vec<String> {
    let outside = |text: &str, open: &str, close: &str| -> String {
        let mut parts = text.split(open);
        let first = parts.next().unwrap_or_default().to_string();
        parts.fold(first, |text, part| text + " " + part.split_once(close).map_or("", |(_, rest)| rest))
    };
    let prose = outside(template, "{{", "}}");
    let prose: String = prose.split('`').step_by(2).collect::<Vec<_>>().join(" ");
    let prose = outside(&prose, "](", ")");
    let words: Vec<&str> = prose.split_whitespace().collect();
    let bare = |word: &str| word.trim_matches(|c: char| !c.is_ascii_alphanumeric()).to_string();
    let digits = |word: &str| !word.is_empty() && word.chars().all(|c| c.is_ascii_digit() || c == '.');
    let mut found = Vec::new();
    for (i, word) in words.iter().enumerate() {
        let number = bare(word);
        let unit = words.get(i + 1).map(|next| next.trim_end_matches([',', '.', ';', ':', ')']));
        let measured = number.contains('.') || matches!(unit, Some("%" | "ms" | "s" | "times"));
        if digits(&number) && measured {
            found.push(format!("{word} {}", words.get(i + 1).unwrap_or(&"")));
        }
    }
    found
}
