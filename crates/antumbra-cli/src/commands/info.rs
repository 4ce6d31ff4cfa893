//! `antumbra techniques`, `scenes` and `info`.

use super::table;
use antumbra::{Filter, ShadowMap, Size, technique};
use antumbra_lab::{facts, gpu, specs};
use antumbra_scene::procedural;
use anyhow::Result;
use serde_json::json;
use std::io::{self, Write};

pub(crate) fn techniques(names: &[String], as_json: bool) -> Result<()> {
    let out = &mut io::stdout();
    let mut list = Vec::new();
    let all = if names.is_empty() { &["all".to_string()] } else { names };
    for mut technique in specs::techniques(all, Filter::default().kernel)? {
        let about = technique.about();
        let parameters = technique.parameters();
        if as_json {
            let parameters: Vec<_> = parameters
                .iter()
                .map(|p| {
                    json!({ "name": p.name, "unit": p.unit, "default": p.value(), "allowed": p.allowed(), "meaning": p.meaning })
                })
                .collect();
            list.push(json!({
                "name": about.name, "title": about.title, "family": about.family.name(), "paper": about.paper,
                "parameters": parameters,
            }));
            continue;
        }
        writeln!(out, "{}  {} ({}; {})", about.name, about.title, about.family.name(), about.paper)?;
        let rows: Vec<Vec<String>> = parameters
            .iter()
            .map(|p| {
                let unit = if p.unit.is_empty() { String::new() } else { format!(" {}", p.unit) };
                vec![format!("  {}", p.name), format!("{}{unit}", p.value()), p.allowed(), p.meaning.into()]
            })
            .collect();
        if !rows.is_empty() {
            table::print(out, &["  parameter", "default", "allowed", "meaning"], &rows)?;
        }
        writeln!(out)?;
    }
    if as_json {
        writeln!(out, "{}", serde_json::to_string_pretty(&list)?)?;
    } else {
        writeln!(out, "write a technique with settings as name.parameter=value,parameter=value")?;
    }
    Ok(())
}

pub(crate) fn scenes(as_json: bool) -> Result<()> {
    let out = &mut io::stdout();
    if as_json {
        let list: Vec<_> = procedural::all()
            .iter()
            .map(|p| {
                json!({ "name": p.name, "triangles": p.triangles, "description": p.description, "stresses": p.stresses, "source": p.source })
            })
            .collect();
        writeln!(out, "{}", serde_json::to_string_pretty(&list)?)?;
        return Ok(());
    }
    for p in procedural::all() {
        writeln!(
            out,
            "{}  {} triangles\n  {}\n  stresses: {}\n  after: {}\n",
            p.name, p.triangles, p.description, p.stresses, p.source
        )?;
    }
    Ok(())
}

pub(crate) fn adapter(as_json: bool) -> Result<()> {
    let gpu = gpu::open()?;
    let adapter = facts::adapter(&gpu);
    let mut choices = Vec::new();
    for technique in technique::all() {
        let shadows = ShadowMap::new(&gpu.device, technique.as_ref(), Size::square(64));
        let lines = shadows.map_or_else(|reason| vec![reason.to_string()], |map| map.explain());
        choices.push((technique.about().name, lines));
    }
    let missing = gpu.missing_features();
    let out = &mut io::stdout();
    if as_json {
        let choices: serde_json::Map<_, _> =
            choices.into_iter().map(|(name, lines)| (name.into(), json!(lines))).collect();
        let all = json!({ "adapter": adapter, "missing_features": missing, "choices": choices });
        writeln!(out, "{}", serde_json::to_string_pretty(&all)?)?;
        return Ok(());
    }
    writeln!(
        out,
        "adapter   {} ({})\ndriver    {}\nbackend   {}",
        adapter.name, adapter.device_type, adapter.driver, adapter.backend
    )?;
    writeln!(out, "features  {}", adapter.features.join(", "))?;
    writeln!(out, "missing   {}", if missing.is_empty() { "none".into() } else { missing.join(", ") })?;
    let limits = gpu.device.limits();
    writeln!(
        out,
        "limits    maps up to {0}x{0}, {1} layers, {2} bytes per pixel and pass",
        limits.max_texture_dimension_2d,
        limits.max_texture_array_layers,
        limits.max_color_attachment_bytes_per_sample
    )?;
    writeln!(out, "\nchosen per technique:")?;
    for (name, lines) in choices {
        for line in lines {
            writeln!(out, "  {name:<6} {line}")?;
        }
    }
    Ok(())
}
