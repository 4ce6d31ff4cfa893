//! The files that documents are made of and are.

use crate::{Record, Source, between, fill, refill};
use anyhow::{Context, Result, bail};
use serde_json::{Value, json};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// All result files, read.
#[derive(Debug, Clone, PartialEq)]
pub struct Results(BTreeMap<String, Record>);

impl Results {
    /// Those of a folder.
    ///
    /// # Errors
    /// A file that cannot be read, or is no result file.
    pub fn read(folder: &Path) -> Result<Self> {
        let mut records = BTreeMap::new();
        let entries = fs::read_dir(folder).with_context(|| folder.display().to_string())?;
        for path in entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<PathBuf>>>()? {
            if path.extension().is_none_or(|end| end != "json") {
                bail!("{} is no .json file", path.display());
            }
            let stem = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let read = || Record::read(&serde_json::from_str(&fs::read_to_string(&path)?)?);
            for (part, record) in read().with_context(|| path.display().to_string())? {
                let name = if part.is_empty() { stem.clone() } else { format!("{stem}:{part}") };
                records.insert(name, record);
            }
        }
        Ok(Self(records))
    }

    /// The table of a name.
    ///
    /// # Errors
    /// No file has it.
    pub fn record(&self, name: &str) -> Result<&Record> {
        self.0.get(name).with_context(|| {
            let known: Vec<&str> = self.0.keys().map(String::as_str).collect();
            format!("no result file {name:?}; there are {}", known.join(", "))
        })
    }

    /// The same, to change it.
    pub fn record_mut(&mut self, name: &str) -> Option<&mut Record> {
        self.0.get_mut(name)
    }

    /// Names of all tables.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.keys().map(String::as_str)
    }
}

/// The templates of a folder with the documents that are made of them.
///
/// # Errors
/// The folder cannot be read.
pub fn documents(docs: &Path) -> Result<Vec<(PathBuf, PathBuf)>> {
    let entries = fs::read_dir(docs).with_context(|| docs.display().to_string())?;
    let mut all = entries.map(|entry| Ok(entry?.path())).collect::<Result<Vec<PathBuf>>>()?;
    all.retain(|path| path.to_string_lossy().ends_with(".md.in"));
    all.sort();
    Ok(all.into_iter().map(|path| (path.clone(), path.with_extension(""))).collect())
}

/// Each document's path with what it is to hold: those with templates in `docs`, and the README beside that.
///
/// # Errors
/// As [`Results::read`] and [`fill`].
pub fn fill_all(docs: &Path) -> Result<Vec<(PathBuf, String)>> {
    let results = Results::read(&docs.join("results"))?;
    let made = documents(docs)?.into_iter().map(|(template, document)| {
        let text = fs::read_to_string(&template).with_context(|| template.display().to_string())?;
        Ok((document, fill(&text, &results).with_context(|| template.display().to_string())?))
    });
    let mut made: Vec<(PathBuf, String)> = made.collect::<Result<_>>()?;
    let readme = docs.join("../README.md");
    let text = fs::read_to_string(&readme).with_context(|| readme.display().to_string())?;
    let text = refill(&text, &results).with_context(|| readme.display().to_string())?;
    made.push((readme, text));
    Ok(made)
}

/// Runs a command and keeps the JSON that it prints as the result file `name` of a folder.
///
/// # Errors
/// A command that fails or prints something else, a file that cannot be written.
pub fn keep(docs: &Path, name: &str, command: &[String]) -> Result<PathBuf> {
    let (program, arguments) = command.split_first().context("no command is given")?;
    let output = Command::new(program).args(arguments).stderr(std::process::Stdio::inherit()).output();
    let output = output.with_context(|| program.clone())?;
    if !output.status.success() {
        bail!("{} ended with {}", command.join(" "), output.status);
    }
    let result: Value = serde_json::from_slice(&output.stdout).context("the command printed no JSON")?;
    let driver = result.pointer("/adapter/driver").and_then(Value::as_str).unwrap_or_default();
    let source = Source {
        command: command.iter().map(|word| without_folder(word)).collect::<Vec<_>>().join(" "),
        machine: machine()?,
        driver: driver.into(),
        commit: commit(docs)?,
        date: said("date", &["-u", "+%F"], docs)?,
        transcribed: None,
    };
    write(docs, name, &source, &result)
}

/// Keeps as the result file `name` how what `bench --json` printed of two builds compares, each named by its commit
/// and given with the files of its runs.
///
/// # Errors
/// As [`between`]; files that cannot be read or written.
pub fn keep_between(docs: &Path, name: &str, commits: [&str; 2], runs: [&[String]; 2]) -> Result<PathBuf> {
    let read = |path: &String| -> Result<Value> {
        Ok(serde_json::from_slice(&fs::read(path).with_context(|| path.clone())?)?)
    };
    let read = |paths: &[String]| paths.iter().map(read).collect::<Result<Vec<Value>>>();
    let [before, after] = [read(runs[0])?, read(runs[1])?];
    let result = between(&before, &after)?;
    let words = after[0].get("command").and_then(Value::as_array).into_iter().flatten();
    let command: Vec<&str> = words.filter_map(Value::as_str).collect();
    let source = Source {
        command: format!("{}, {} times in turns", command.join(" "), before.len()),
        machine: machine()?,
        driver: after[0].pointer("/adapter/driver").and_then(Value::as_str).unwrap_or_default().into(),
        commit: commits.join(" and "),
        date: said("date", &["-u", "+%F"], docs)?,
        transcribed: None,
    };
    write(docs, name, &source, &result)
}

/// Writes a result file that can be read.
fn write(docs: &Path, name: &str, source: &Source, result: &Value) -> Result<PathBuf> {
    let file = json!({ "source": source, "result": result });
    Record::read(&file)?;
    let path = docs.join("results").join(name).with_extension("json");
    fs::write(&path, serde_json::to_string_pretty(&file)? + "\n")
        .with_context(|| path.display().to_string())?;
    Ok(path)
}

/// The name of a program that was built here, and any other word as it is.
fn without_folder(word: &str) -> &str {
    word.rsplit_once("target/release/").map_or(word, |(_, name)| name)
}

/// What a small program says.
fn said(program: &str, arguments: &[&str], folder: &Path) -> Result<String> {
    let output = Command::new(program).args(arguments).current_dir(folder).output();
    let output = output.with_context(|| program.to_string())?;
    if !output.status.success() {
        bail!("{program} {} ended with {}", arguments.join(" "), output.status);
    }
    Ok(String::from_utf8_lossy(&output.stdout).trim().into())
}

/// The commit of the tree that `docs` lies in.
fn commit(docs: &Path) -> Result<String> {
    let commit = said("git", &["rev-parse", "--short", "HEAD"], docs)?;
    let changed = said("git", &["status", "--porcelain", "--", "../crates"], docs)?;
    Ok(if changed.is_empty() { commit } else { commit + "+" })
}

/// Processor and number of cores.
fn machine() -> Result<String> {
    let cores = std::thread::available_parallelism()?;
    let told = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = told.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or_else(|| std::env::consts::ARCH.to_string(), |(_, name)| name.trim().to_string());
    Ok(format!("{cores} cores of {model}"))
}
