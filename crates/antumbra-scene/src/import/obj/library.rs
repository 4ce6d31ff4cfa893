//! Material libraries (MTL): what they say of each material, before any image is read.

use super::files::{Files, text as text_of};
use super::map::{Map, unquoted};
use crate::import::notes::Notes;
use glam::Vec3;
use std::collections::{HashMap, HashSet};

/// What a library says of one material.
#[derive(Debug, Default)]
pub(super) struct Entry {
    pub(super) name: String,
    pub(super) color: Option<Vec3>,
    /// Share of light that the surface stops, 0 to 1.
    pub(super) opacity: Option<f32>,
    pub(super) color_map: Option<Map>,
    pub(super) mask_map: Option<Map>,
    /// A displacement map, which would move the surface.
    pub(super) moves: bool,
}

/// The materials of all libraries with the files that they may name, each library read once. Of materials
/// that share a name the first counts.
pub(super) fn read<'a>(named: &[String], files: &Files<'a>, notes: &mut Notes) -> Vec<(Files<'a>, Entry)> {
    let (mut seen, mut entries) = (HashSet::new(), Vec::new());
    let mut names = HashMap::new();
    for name in named.iter().flat_map(|rest| split(rest, files)) {
        let path = files.find(&name).unwrap_or_else(|| files.missing(&name));
        if !seen.insert(path.clone()) {
            continue;
        }
        let text = match files.read(&path) {
            Ok(bytes) => text_of(&bytes),
            Err(error) => {
                let said = format!("cannot be read ({error}); its materials are plain");
                notes.add(format!("material library '{name}'"), said);
                continue;
            }
        };
        for entry in parse(&text) {
            if *names.entry(entry.name.clone()).or_insert(entries.len()) == entries.len() {
                entries.push((files.beside(&path), entry));
            } else {
                notes.add(format!("material '{}'", entry.name), "is described again; the first counts");
            }
        }
    }
    entries
}

/// The libraries of one line, whose names may hold blanks: the longest names that are files, and what lies
/// between them.
fn split(rest: &str, files: &Files) -> Vec<String> {
    let words: Vec<&str> = rest.split_whitespace().collect();
    let name = |from: usize, to: usize| unquoted(&words[from..to].join(" ")).to_string();
    let (mut found, mut begin, mut missing) = (Vec::new(), 0, 0);
    while begin < words.len() {
        // More words than any name has are not worth asking the system for.
        let mut ends = (begin + 1..=words.len().min(begin + 16)).rev();
        if let Some(end) = ends.find(|&end| files.find(&name(begin, end)).is_some()) {
            if missing < begin {
                found.push(name(missing, begin));
            }
            found.push(name(begin, end));
            (begin, missing) = (end, end);
        } else {
            begin += 1;
        }
    }
    if missing < begin {
        found.push(name(missing, begin));
    }
    found
}

/// The materials that a library describes.
pub(super) fn parse(text: &str) -> Vec<Entry> {
    let mut entries: Vec<Entry> = Vec::new();
    for line in text.split(['\n', '\r']) {
        let line = line.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
        let (keyword, rest) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
        let (keyword, rest) = (keyword.to_ascii_lowercase(), rest.trim());
        if keyword == "newmtl" {
            entries.push(Entry { name: rest.into(), ..Entry::default() });
        }
        let Some(entry) = entries.last_mut() else { continue };
        let last = || {
            rest.split_whitespace().next_back().and_then(|w| w.parse().ok()).filter(|x: &f32| x.is_finite())
        };
        match keyword.as_str() {
            "kd" => entry.color = color(rest),
            // `d -halo 0.5` too. Of both the first word counts: `Tr` has been written for either.
            "d" => entry.opacity = last().or(entry.opacity),
            "tr" => entry.opacity = entry.opacity.or_else(|| last().map(|transparency| 1.0 - transparency)),
            "map_kd" => entry.color_map = Some(Map::read(rest)),
            "map_d" | "map_opacity" => entry.mask_map = Some(Map::read(rest)),
            "disp" | "map_disp" => entry.moves = true,
            _ => {}
        }
    }
    entries
}

/// Three numbers, or one for all.
fn color(rest: &str) -> Option<Vec3> {
    let mut words = rest.split_whitespace().map(|w| w.parse().ok().filter(|x: &f32| x.is_finite()));
    let red = words.next().flatten()?;
    match (words.next(), words.next()) {
        (None, _) => Some(Vec3::splat(red)),
        (Some(Some(green)), Some(Some(blue))) => Some(Vec3::new(red, green, blue)),
        _ => None,
    }
}
