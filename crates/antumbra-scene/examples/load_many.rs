//! Loads many files and prints a line for each: the triangles drawn, or the reason for refusal.
//!
//! `cargo run --release --example load_many -- <index.json | list.txt | folder | file>…`
//!
//! An index is a JSON list of objects with a `file` (relative to the index) and, if known, the
//! expected number of `triangles` or `triangles_unique` (each mesh counted once). A list holds one
//! path a line. Folders are searched for .gltf, .glb and .obj. Differences are marked with `!`.

use antumbra_scene::{Scene, import};
use std::{
    error::Error,
    fs,
    path::{Path, PathBuf},
};

struct Item {
    file: PathBuf,
    triangles: Option<u64>,
    unique: Option<u64>,
    expect: String,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut items = Vec::new();
    for argument in std::env::args_os().skip(1).map(PathBuf::from) {
        collect(&argument, &mut items)?;
    }
    let (mut loaded, mut refused, mut different) = (0, 0, 0);
    for item in &items {
        let (line, differs) = report(item);
        match line.starts_with("ok") {
            true => loaded += 1,
            false => refused += 1,
        }
        different += u32::from(differs);
        println!("{} {}: {line}", if differs { "!" } else { " " }, item.file.display());
    }
    println!("{} files: {loaded} loaded, {refused} refused, {different} differ", items.len());
    Ok(())
}

fn report(item: &Item) -> (String, bool) {
    let start = std::time::Instant::now();
    let result = import::load(&item.file);
    let ms = start.elapsed().as_millis();
    let (drawn, unique) = result.as_ref().map_or((0, 0), counts);
    let differs = item.triangles.is_some_and(|t| t != drawn) || item.unique.is_some_and(|t| t != unique);
    let wanted = item.triangles.or(item.unique).map_or("?".into(), |t| t.to_string());
    let expect = &item.expect;
    match result {
        Ok(scene) => {
            let (lights, cameras) = (scene.lights.len(), scene.cameras.len());
            let notes: String = scene.notes.iter().take(3).map(|n| format!(" | {n}")).collect();
            let line = format!(
                "ok, {drawn} drawn, {unique} unique, {wanted} wanted ({expect}), {cameras} cameras, {lights} \
                 lights, {ms} ms{notes}"
            );
            (line, differs)
        }
        Err(error) => {
            let reason = error.problem;
            (format!("refused, {wanted} wanted ({expect}), {ms} ms: {reason}"), differs)
        }
    }
}

/// Triangles drawn, and triangles of the meshes that instances use.
fn counts(scene: &Scene) -> (u64, u64) {
    let drawn = scene.flatten().triangle_count() as u64;
    let mut used = vec![false; scene.meshes.len()];
    scene.instances.iter().for_each(|i| used[i.mesh] = true);
    let unique = scene.meshes.iter().zip(used).filter(|(_, u)| *u).map(|(m, _)| m.indices.len() as u64 / 3);
    (drawn, unique.sum())
}

fn collect(path: &Path, items: &mut Vec<Item>) -> Result<(), Box<dyn Error>> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let plain = |file| Item { file, triangles: None, unique: None, expect: String::new() };
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    if path.is_dir() {
        let mut entries: Vec<PathBuf> = fs::read_dir(path)?.flatten().map(|e| e.path()).collect();
        entries.sort();
        for entry in entries {
            let known = entry
                .extension()
                .is_some_and(|e| ["gltf", "glb", "obj"].iter().any(|k| e.eq_ignore_ascii_case(k)));
            if known {
                items.push(plain(entry));
            } else if entry.is_dir() {
                collect(&entry, items)?;
            }
        }
    } else if extension == "json" {
        let index: Vec<serde_json::Value> = serde_json::from_slice(&fs::read(path)?)?;
        items.extend(index.iter().filter_map(|entry| {
            Some(Item {
                file: folder.join(entry["file"].as_str()?),
                triangles: entry["triangles"].as_u64().or_else(|| entry["facts"]["triangles_drawn"].as_u64()),
                unique: entry["triangles_unique"].as_u64(),
                expect: entry["expect"].as_str().unwrap_or_default().into(),
            })
        }));
    } else if extension == "txt" {
        items.extend(fs::read_to_string(path)?.lines().map(|line| plain(folder.join(line))));
    } else {
        items.push(plain(path.into()));
    }
    Ok(())
}
