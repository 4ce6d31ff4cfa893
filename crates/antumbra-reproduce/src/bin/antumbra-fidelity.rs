//! Writes `docs/fidelity.md` from `crates/antumbra-reproduce/fidelity`; run it in the project's root.

use anyhow::{Context, Result};

const PAGE: &str = "docs/fidelity.md";

fn main() -> Result<()> {
    let text = antumbra_reproduce::fidelity::page()?;
    std::fs::write(PAGE, text).context(PAGE)?;
    println!("wrote {PAGE}");
    Ok(())
}
