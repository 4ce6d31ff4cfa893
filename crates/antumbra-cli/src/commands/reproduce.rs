//! `antumbra reproduce`.

use super::table;
use crate::{arguments::Reproduce, names, progress::Bar};
use antumbra_lab::progress::Progress;
use antumbra_reproduce::{
    Options, RunObserver, catalogue, results::Record, target::Target, verdict::Outcome,
};
use anyhow::{Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Reproduce) -> Result<()> {
    if arguments.list {
        return list();
    }
    let targets = chosen(&arguments.targets)?;
    antumbra_reproduce::check(&arguments.output)?;
    let options = Options { targets, output: arguments.output.clone(), quick: arguments.quick };
    let watch = Watch { bar: Bar::new([]), speak: !arguments.json };
    let results = antumbra_reproduce::run(&options, &watch)?;
    drop(watch);
    let out = &mut io::stdout();
    if arguments.json {
        write!(out, "{}", results.to_json()?)?;
        return Ok(());
    }
    writeln!(out)?;
    for record in results.targets.iter().filter(|r| options.targets.iter().any(|t| t.id == r.id)) {
        for verdict in &record.verdicts {
            let outcome = verdict.outcome.name();
            writeln!(out, "{outcome:<8} {}: {}\n         {}", record.id, verdict.claim, verdict.reason)?;
        }
    }
    writeln!(out, "\nopen {} in a browser", options.output.join("index.html").display())?;
    Ok(())
}

/// Every target, a source's targets, or single ones, each once.
fn chosen(names: &[String]) -> Result<Vec<&'static Target>> {
    let mut targets: Vec<&'static Target> = Vec::new();
    for name in names {
        let wanted = |t: &&Target| {
            name == "all" || t.id == name || t.id.split('/').next().is_some_and(|source| source == name)
        };
        let found: Vec<&'static Target> = catalogue::all().filter(wanted).collect();
        if found.is_empty() {
            let known = catalogue::all().map(|t| t.id).chain(["all"]);
            let nearest = names::nearest(name, known).map(|n| format!("; did you mean {n}?"));
            bail!(
                "'{name}' is nothing to reproduce; `antumbra reproduce --list` shows what is{}",
                nearest.unwrap_or_default()
            );
        }
        for target in found {
            if !targets.iter().any(|t| t.id == target.id) {
                targets.push(target);
            }
        }
    }
    Ok(targets)
}

fn list() -> Result<()> {
    let out = &mut io::stdout();
    let time = |seconds: u32| match seconds {
        0..60 => format!("{seconds} s"),
        _ => format!("{} min {:02} s", seconds / 60, seconds % 60),
    };
    for source in catalogue::SOURCES {
        writeln!(out, "{}", source.name)?;
        let rows: Vec<Vec<String>> = source
            .targets
            .iter()
            .map(|t| vec![format!("  {}", t.id), t.title.into(), time(t.seconds[0]), time(t.seconds[1])])
            .collect();
        table::print(out, &["  target", "shows", "takes", "--quick"], &rows)?;
        writeln!(out)?;
    }
    let total = |i: usize| time(catalogue::all().map(|t| t.seconds[i]).sum());
    writeln!(
        out,
        "all: about {} ({} with --quick) on two busy cores without a graphics card",
        total(0),
        total(1)
    )?;
    Ok(())
}

/// A bar for the steps, and a line for each target.
struct Watch {
    bar: Bar,
    speak: bool,
}

impl Progress for Watch {
    fn step(&self, name: &str) {
        self.bar.step(name);
    }
    fn share(&self, share: f32) {
        self.bar.share(share);
    }
}

impl RunObserver for Watch {
    fn total(&self, target: &str, share: f64, seconds_left: f64) {
        self.bar.total(share, seconds_left);
        self.bar.prefix(target);
    }
    fn target(&self, record: &Record) {
        if !self.speak {
            return;
        }
        let count = |outcome: Outcome| match record.count(outcome) {
            0 => String::new(),
            n => format!("{n} {}  ", outcome.name()),
        };
        let counts = [Outcome::Holds, Outcome::Differs, Outcome::Open].map(count).concat();
        let line = format!("{:<18} {:>6.1} s  {counts}", record.id, record.seconds);
        self.bar.line(line.trim_end());
    }
}
