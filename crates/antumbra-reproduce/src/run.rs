//! Runs targets and writes their pages.

use crate::{
    catalogue, html,
    page::Page,
    results::{Record, Reproduction, SCHEMA},
    target::Target,
    verdict::{Verdict, ours},
    workbench::Workbench,
};
use antumbra::Unsupported;
use antumbra_lab::{
    files,
    progress::Progress,
    results::{Program, Refused},
};
use anyhow::{Context, Result, bail};
use std::{
    cell::Cell,
    fs,
    path::{Path, PathBuf},
    time::Instant,
};

/// What to run, and where to.
#[derive(Debug, Clone)]
pub struct Options {
    /// The targets, in the order in which they run.
    pub targets: Vec<&'static Target>,
    /// The folder; pages of other targets in it stay.
    pub output: PathBuf,
    /// Whether everything is made small.
    pub quick: bool,
}

/// Is told what has been done.
pub trait RunObserver: Progress {
    /// So much of all targets is done (0 to 1), and about so many seconds are left.
    fn total(&self, target: &str, share: f64, seconds_left: f64);
    /// A target's page has been written.
    fn target(&self, record: &Record);
}

/// Runs all targets. Pages, index and numbers are written after each, so that an interruption loses
/// one target at most, and of that only what was not measured yet.
///
/// # Errors
/// A folder with foreign content; what a target's measurements fail with; a full disk.
pub fn run(options: &Options, observer: &dyn RunObserver) -> Result<Reproduction> {
    let output = &options.output;
    let before = check(output)?;
    fs::create_dir_all(output).with_context(|| output.display().to_string())?;
    let bench = Workbench::new(&output.join("cache"), options.quick, observer)?;
    let mut results = Reproduction {
        schema: SCHEMA.into(),
        program: Program { name: "antumbra".into(), version: env!("CARGO_PKG_VERSION").into() },
        adapter: bench.adapter(),
        targets: before.map(|b| b.targets).unwrap_or_default(),
    };
    // Pages that are gone, or that this program does not know.
    let known = |r: &Record| catalogue::all().any(|t| t.id == r.id) && output.join(&r.file).is_file();
    results.targets.retain(known);
    write_index(output, &results)?;
    let seconds = |t: &Target| f64::from(t.seconds[usize::from(options.quick)]);
    let total: f64 = options.targets.iter().map(|t| seconds(t)).sum();
    let (start, expected) = (Instant::now(), Cell::new(0.0));
    for target in &options.targets {
        // Expected times are scaled by what the machine took so far.
        let (past, took) = (expected.get(), start.elapsed().as_secs_f64());
        let pace = if past > 30.0 { took / past } else { 1.0 };
        observer.total(target.id, past / total, (total - past) * pace);
        let begun = Instant::now();
        let page = measured(target, (target.run)(&bench)).with_context(|| format!("target {}", target.id))?;
        let record = Record::new(target, &page, &bench.build, options.quick, begun.elapsed().as_secs_f64());
        let text = html::page(target, &page, &record, &results);
        files::write_atomically(&output.join(&record.file), text.as_bytes())?;
        results.targets.retain(|r| r.id != record.id);
        observer.target(&record);
        results.targets.push(record);
        results.targets.sort_by_key(|r| catalogue::all().position(|t| t.id == r.id));
        write_index(output, &results)?;
        expected.set(past + seconds(target));
    }
    Ok(results)
}

/// A target's page; one that says why there is none where the device or a scene refuses what it needs.
fn measured(target: &Target, page: Result<Page>) -> Result<Page> {
    match page {
        Err(error) if error.is::<Refused>() || error.is::<Unsupported>() => {
            let reason = format!("{error:#}");
            let mut page = Page::default();
            page.text(format!("Nothing was measured. {reason}."));
            let source = ours("it stands for all that the page would have judged");
            page.verdict(Verdict::open(source, target.title, format!("not measured: {reason}")));
            Ok(page)
        }
        page => page,
    }
}

fn write_index(output: &Path, results: &Reproduction) -> Result<()> {
    files::write_atomically(&output.join("index.html"), html::index(results).as_bytes())?;
    files::write_atomically(&output.join("results.csv"), results.csv().as_bytes())?;
    files::write_atomically(&output.join("results.json"), results.to_json()?.as_bytes())?;
    Ok(())
}

/// What is in the folder: nothing, or an earlier reproduction.
///
/// # Errors
/// Any other content.
pub fn check(output: &Path) -> Result<Option<Reproduction>> {
    if !output.exists() {
        return Ok(None);
    }
    if !output.is_dir() {
        bail!("{} is a file: name a folder", output.display());
    }
    let earlier = Reproduction::read(&output.join("results.json"));
    let empty = || -> Result<bool> {
        Ok(fs::read_dir(output).with_context(|| output.display().to_string())?.next().is_none())
    };
    if earlier.is_none() && !empty()? {
        bail!(
            "{} is not empty and has no results.json of an earlier reproduction: choose another folder or empty it",
            output.display()
        );
    }
    Ok(earlier)
}
