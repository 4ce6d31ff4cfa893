//! Techniques as they are named in words.

use antumbra::{Technique, technique};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;

/// Reads technique specs: names with settings, or `all`, `all-comparison`, `all-basis`,
/// `all-geometry`. Every kernel that a spec does not set becomes `kernel` texels wide.
///
/// # Errors
/// [`antumbra::SettingError`], two equal specs.
pub fn techniques(specs: &[String], kernel: u32) -> Result<Vec<Box<dyn Technique>>> {
    let mut list: Vec<Box<dyn Technique>> = Vec::new();
    let mut seen = BTreeSet::new();
    for spec in specs {
        for spec in members(spec)? {
            let technique = technique(&spec, kernel)?;
            let full = technique::spec(technique.as_ref());
            if !seen.insert(full.clone()) {
                bail!("technique '{full}' is listed twice");
            }
            list.push(technique);
        }
    }
    Ok(list)
}

/// The specs that a group stands for, or the spec itself.
fn members(spec: &str) -> Result<Vec<String>> {
    let all = technique::all();
    if spec == "all" {
        return Ok(all.iter().map(|t| t.about().name.into()).collect());
    }
    let Some(family) = spec.strip_prefix("all-") else { return Ok(vec![spec.into()]) };
    let in_family = all.iter().filter(|t| t.about().family.name() == family);
    let names: Vec<String> = in_family.map(|t| t.about().name.into()).collect();
    if names.is_empty() {
        let known: BTreeSet<String> =
            all.iter().map(|t| format!("all-{}", t.about().family.name())).collect();
        let known: Vec<String> = known.into_iter().collect();
        bail!("'{spec}' names no techniques; groups: all, {}", known.join(", "));
    }
    Ok(names)
}

/// One technique, with the kernel of all where its spec sets none.
fn technique(spec: &str, kernel: u32) -> Result<Box<dyn Technique>> {
    let mut technique = technique::parse(spec)?;
    let has_kernel = technique.parameters().iter().any(|p| p.name == "kernel");
    if has_kernel && !spec.contains("kernel=") {
        technique::set(technique.as_mut(), "kernel", &kernel.to_string())
            .with_context(|| format!("a kernel of {kernel} texels for every technique"))?;
    }
    Ok(technique)
}
