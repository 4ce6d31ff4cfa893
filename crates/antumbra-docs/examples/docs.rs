//! Makes the documents of `docs/` from their templates and result files, and keeps result files.

use anyhow::{Context, Result, bail};
use std::{fs, path::Path, process::ExitCode};

const USAGE: &str = "usage:
  docs                                 make docs/*.md from docs/*.md.in and docs/results/*.json
  docs keep NAME COMMAND…              run a command that prints JSON and keep it as docs/results/NAME.json
  docs between NAME COMMIT FILE… -- COMMIT FILE…
                                       keep how two builds compare, by what bench --json printed of each in turns";

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::from(2)
        }
    }
}

fn run() -> Result<()> {
    let docs = Path::new("docs");
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    match &arguments[..] {
        [] => {
            for (path, text) in antumbra_docs::fill_all(docs)? {
                if fs::read_to_string(&path).ok().as_ref() != Some(&text) {
                    fs::write(&path, text).with_context(|| path.display().to_string())?;
                    println!("wrote {}", path.display());
                }
            }
            Ok(())
        }
        [keep, name, command @ ..] if keep == "keep" && !command.is_empty() => {
            println!("wrote {}", antumbra_docs::keep(docs, name, command)?.display());
            Ok(())
        }
        [between, name, both @ ..] if between == "between" => {
            let mut sides = both.split(|argument| argument == "--");
            match [sides.next(), sides.next()] {
                [Some([before, runs @ ..]), Some([after, later @ ..])] => {
                    let kept = antumbra_docs::keep_between(docs, name, [before, after], [runs, later])?;
                    println!("wrote {}", kept.display());
                    Ok(())
                }
                _ => bail!("{USAGE}"),
            }
        }
        _ => bail!("{USAGE}"),
    }
}
