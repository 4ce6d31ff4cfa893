//! `antumbra maps`.

use super::table;
use crate::{arguments::Maps, scene, techniques};
use antumbra::technique;
use antumbra_lab::{
    files, gpu,
    maps::{self, Picture, Sheet},
    session::Session,
};
use anyhow::{Result, bail};
use serde_json::{Value, json};
use std::{
    io::{self, Write},
    path::Path,
};

const SHEET: &str = "sheet.png";

pub(crate) fn run(arguments: &Maps) -> Result<()> {
    scene::check(&arguments.scene)?;
    files::check_folder(&arguments.output)?;
    let techniques =
        techniques::read(std::slice::from_ref(&arguments.technique), arguments.scene.view.kernel)?;
    if techniques.len() > 1 {
        bail!("--technique {}: maps takes one technique", arguments.technique);
    }
    let shot = scene::load(&arguments.scene)?;
    let gpu = gpu::open()?;
    let session = Session::new(&gpu, &shot, &techniques)?;
    let technique = session.prepared().first().map(|prepared| technique::spec(prepared.shadows.technique()));
    let mut written = Vec::new();
    let folder = files::write_folder(&arguments.output, |folder| -> Result<()> {
        let mut sheet = Sheet::default();
        let mut take = |picture: Picture| -> Result<()> {
            let file = format!("{}.png", picture.name);
            folder.write(&file, &picture.image.to_png()?)?;
            sheet.add(&picture);
            written.push((file, picture.scale, picture.range));
            Ok(())
        };
        maps::pictures(&gpu, &session, arguments.level, &mut take)?;
        folder.write(SHEET, &sheet.image().to_png()?)?;
        let pictures: Vec<Value> = written
            .iter()
            .map(|(file, scale, [low, high])| json!({ "file": file, "scale": scale, "least": low, "largest": high }))
            .collect();
        let names = written.iter().map(|(file, ..)| file.as_str()).chain([SHEET]);
        let index = json!({
            "schema": "antumbra-maps/1",
            "scene": shot.name,
            "technique": technique,
            "size": shot.map_size,
            "level": arguments.level,
            "cascades": session.views().len(),
            "bias": shot.bias.to_string(),
            "pictures": pictures,
            "files": names.collect::<Vec<_>>(),
        });
        let text = serde_json::to_string_pretty(&index)? + "\n";
        folder.write("maps.json", text.as_bytes())?;
        Ok(())
    })?;
    print(arguments, &folder, &written)
}

fn print(arguments: &Maps, folder: &Path, written: &[(String, maps::Scale, [f32; 2])]) -> Result<()> {
    let out = &mut io::stdout();
    if arguments.json {
        let index = String::from_utf8_lossy(&files::read(&folder.join("maps.json"))?).into_owned();
        write!(out, "{index}")?;
        return Ok(());
    }
    let number = |v: f32| {
        if v == 0.0 || (1e-3..1e5).contains(&v.abs()) { format!("{v:.5}") } else { format!("{v:.4e}") }
    };
    let rows: Vec<Vec<String>> = written
        .iter()
        .map(|(file, scale, [low, high])| {
            vec![file.clone(), format!("{scale:?}").to_lowercase(), number(*low), number(*high)]
        })
        .collect();
    table::print(out, &["picture", "scale", "least", "largest"], &rows)?;
    if written.iter().any(|(_, scale, _)| *scale == maps::Scale::Signed) {
        writeln!(out, "signed: white at zero, blue above, red below")?;
    }
    writeln!(out, "all on one sheet: {}", folder.join(SHEET).display())?;
    Ok(())
}
