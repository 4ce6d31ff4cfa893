//! What each subcommand does.

use crate::{
    arguments::{Arguments, Command, SceneAction},
    completion, names, output,
};
use antumbra::SettingError;
use antumbra_lab::results::{LeftOut, RunFacts};
use anyhow::Result;
use std::io::Write;

mod bench;
mod bias;
mod compare;
mod curve;
mod export;
mod flicker;
mod info;
mod kernels;
mod maps;
mod render;
mod reproduce;
mod table;

/// Runs the subcommand.
pub(crate) fn run(arguments: Arguments) -> Result<()> {
    match arguments.command {
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Render(arguments) => render::run(&arguments),
        Command::Flicker(arguments) => flicker::run(&arguments),
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Bias(arguments) => bias::run(&arguments),
        Command::Kernels(arguments) => kernels::run(&arguments),
        Command::Curve(arguments) => curve::run(&arguments),
        Command::Maps(arguments) => maps::run(&arguments),
        Command::Reproduce(arguments) => reproduce::run(&arguments),
        Command::Techniques(arguments) => info::techniques(&arguments.names, arguments.list.json),
        Command::Scenes(arguments) => match arguments.action {
            Some(SceneAction::Export(arguments)) => export::run(&arguments),
            None => info::scenes(arguments.list.json),
        },
        Command::Info(arguments) => info::adapter(arguments.json),
        Command::Completions { shell } => {
            Ok(std::io::stdout().write_all(completion::script(shell).as_bytes())?)
        }
    }
}

/// The command line as typed, but for what is no Unicode.
fn command_given() -> Vec<String> {
    let arguments = std::env::args_os().skip(1).map(|argument| argument.to_string_lossy().into_owned());
    std::iter::once("antumbra".to_string()).chain(arguments).collect()
}

/// Says what makes results less than they could be, and which techniques were left out.
fn note_run(run: &RunFacts, left_out: &[LeftOut]) {
    for warning in &run.warnings {
        let _ = writeln!(std::io::stderr(), "warning: {warning}");
    }
    run.notes.iter().for_each(|text| output::note(text));
    note_left_out(left_out);
}

/// Says which techniques were left out, and why.
fn note_left_out(left_out: &[LeftOut]) {
    for left_out in left_out {
        let _ = writeln!(std::io::stderr(), "note: left out: {left_out}");
    }
}

/// Rows of a table for them.
fn left_out_rows(left_out: &[LeftOut]) -> impl Iterator<Item = Vec<String>> {
    left_out.iter().map(|LeftOut { spec, reason }| vec![spec.clone(), format!("left out: {reason}")])
}

/// What was probably meant, for an error about a name.
pub(crate) fn hint(error: &anyhow::Error) -> Option<String> {
    let (name, known) = error.chain().find_map(|cause| match cause.downcast_ref::<SettingError>()? {
        SettingError::UnknownTechnique { name, known }
        | SettingError::UnknownParameter { name, known, .. } => Some((name, known)),
        _ => None,
    })?;
    names::nearest(name, known.iter().map(String::as_str)).map(|nearest| format!("did you mean {nearest}?"))
}
