//! The program `antumbra`: compare shadow techniques on any glTF scene.

mod arguments;
mod commands;
mod completion;
mod file_arguments;
mod names;
mod output;
mod progress;
mod scene;
mod scene_arguments;
mod suggestions;
mod techniques;
#[cfg(test)]
mod tests;
mod views;

use clap::Parser;
use std::process::ExitCode;

fn main() -> ExitCode {
    tune_software_driver();
    match commands::run(arguments::Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        // Whoever was listening has heard enough (`antumbra techniques | head`).
        Err(error) if output::is_closed(&error) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", output::message(&error));
            if let Some(hint) = commands::hint(&error) {
                eprintln!("  {hint}");
            }
            ExitCode::from(2)
        }
    }
}

/// Mesa's software driver interpolates 8-bit textures in 8-bit fixed point unless an environment
/// variable says otherwise, and reads it before this program could set it: start again with it.
/// Other drivers ignore it.
fn tune_software_driver() {
    #[cfg(target_os = "linux")]
    if std::env::var_os("GALLIVM_PERF").is_none() {
        use std::os::unix::process::CommandExt;
        if let Ok(program) = std::env::current_exe() {
            // Returns only if it failed, and then this process will do.
            let _ = std::process::Command::new(program)
                .args(std::env::args_os().skip(1))
                .env("GALLIVM_PERF", "no_aos_sampling")
                .env("NODEVICE_SELECT", "1")
                .exec();
        }
    }
}
