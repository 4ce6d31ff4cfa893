//! Material libraries (MTL) of OBJ files: diffuse colours and maps, and dissolve maps as cut-outs.

use super::super::error::Problem;
use super::super::image;
use crate::{AlphaMode, Image, Material, Scene};
use glam::Vec3;
use std::fs;
use std::path::Path;

/// What a library says of one material.
#[derive(Debug, Default)]
struct Entry {
    name: String,
    color: Option<Vec3>,
    color_map: Option<String>,
    dissolve_map: Option<String>,
}

/// Adds the materials of a library; one that cannot be read is noted.
pub(super) fn read(scene: &mut Scene, library: &str, folder: &Path) -> Result<(), Problem> {
    let text = match fs::read(folder.join(library.replace('\\', "/"))) {
        Ok(bytes) => String::from_utf8_lossy(&bytes).into_owned(),
        Err(error) => {
            scene.notes.push(format!("material library '{library}' is left out: {error}"));
            return Ok(());
        }
    };
    let mut entries: Vec<Entry> = Vec::new();
    for line in text.lines().map(str::trim) {
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let rest = rest.trim();
        if keyword == "newmtl" {
            entries.push(Entry { name: rest.into(), ..Entry::default() });
        }
        let Some(entry) = entries.last_mut() else { continue };
        match keyword {
            "Kd" => {
                let mut words =
                    rest.split_whitespace().map(|w| w.parse().ok().filter(|x: &f32| x.is_finite()));
                let mut next = || words.next().flatten();
                entry.color = next().zip(next()).zip(next()).map(|((r, g), b)| Vec3::new(r, g, b));
            }
            "map_Kd" => entry.color_map = Some(file(rest)),
            "map_d" => entry.dissolve_map = Some(file(rest)),
            _ => {}
        }
    }
    entries.into_iter().try_for_each(|entry| add(scene, entry, folder))
}

/// The file of a map, which may follow options such as `-s 1 1 1`.
fn file(rest: &str) -> String {
    let last = if rest.starts_with('-') { rest.split_whitespace().last() } else { Some(rest) };
    last.unwrap_or_default().replace('\\', "/")
}

fn add(scene: &mut Scene, entry: Entry, folder: &Path) -> Result<(), Problem> {
    let image = image(scene, &entry, folder)?;
    let color = if image.is_some() { Vec3::ONE } else { entry.color.unwrap_or(Vec3::ONE) };
    let cut = entry.dissolve_map.is_some();
    scene.materials.push(Material {
        name: entry.name,
        base_color: color.extend(1.0),
        base_color_image: image,
        alpha: if cut { AlphaMode::Mask { cutoff: 0.5 } } else { AlphaMode::Opaque },
        ..Material::default()
    });
    Ok(())
}

/// The diffuse map with the dissolve map as its alpha. A diffuse map that fails is noted, a
/// dissolve map that fails is an error: it decides about shape.
fn image(scene: &mut Scene, entry: &Entry, folder: &Path) -> Result<Option<usize>, Problem> {
    let load = |name: &str| -> Result<Image, Problem> {
        let element = format!("material '{}' map '{name}'", entry.name);
        let bytes = fs::read(folder.join(name)).map_err(|source| Problem::Resource {
            element: element.clone(),
            uri: name.into(),
            source,
        })?;
        let image = image::decode(&bytes).map_err(|message| Problem::Image { element, message })?;
        Ok(Image { name: name.into(), ..image })
    };
    let name =
        [entry.color_map.as_deref(), entry.dissolve_map.as_deref()].map(Option::unwrap_or_default).join("+");
    if let Some(place) = scene.images.iter().position(|i| i.name == name) {
        return Ok(Some(place));
    }
    let mut color = None;
    if let Some(map) = &entry.color_map {
        match load(map) {
            Ok(image) => color = Some(image),
            Err(problem) => scene.notes.push(format!("{problem}; the plain colour is used")),
        }
    }
    if let Some(map) = &entry.dissolve_map {
        let mask = load(map)?;
        let whole = color.filter(|c| (c.width, c.height) == (mask.width, mask.height));
        let mut image = whole.unwrap_or_else(|| Image { rgba: vec![255; mask.rgba.len()], ..mask.clone() });
        for (pixel, mask) in image.rgba.chunks_exact_mut(4).zip(mask.rgba.chunks_exact(4)) {
            // Masks are grey; those drawn in the alpha channel of a white image count as well.
            pixel[3] = mask[0].min(mask[3]);
        }
        color = Some(image);
    }
    let Some(image) = color else { return Ok(None) };
    scene.images.push(Image { name, ..image });
    Ok(Some(scene.images.len() - 1))
}
