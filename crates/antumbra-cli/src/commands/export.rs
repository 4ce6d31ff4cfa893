//! `antumbra scenes export`.

use crate::{arguments::Export, scene};
use antumbra_lab::files;
use antumbra_scene::export;
use anyhow::{Context, Result, bail};
use std::io::{self, Write};

pub(crate) fn run(arguments: &Export) -> Result<()> {
    let output = &arguments.output;
    if !output.extension().is_some_and(|e| e.eq_ignore_ascii_case("glb")) {
        bail!("{}: the output must end in .glb", output.display());
    }
    let scene = scene::open(&arguments.scene, arguments.seed, &arguments.file)?;
    let bytes = export::glb(&scene).with_context(|| arguments.scene.clone())?;
    files::write_atomically(output, &bytes).context("nothing was written")?;
    writeln!(io::stdout(), "{}", output.display())?;
    Ok(())
}
