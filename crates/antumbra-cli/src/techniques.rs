//! Techniques as they are named on the command line.

use antumbra::Technique;
use antumbra_lab::specs;
use antumbra_scene::procedural;
use anyhow::{Result, bail};
use std::path::Path;

/// Reads specs as [`specs::techniques`] does.
///
/// # Errors
/// As there; a word that names a scene is told to stand in the wrong place.
pub(crate) fn read(specs: &[String], kernel: u32) -> Result<Vec<Box<dyn Technique>>> {
    if let Some(scene) = specs.iter().find(|spec| names_scene(spec)) {
        bail!(
            "'{scene}' is a scene, but all words that follow --techniques are read as techniques: put the scene \
             first (antumbra compare {scene} --techniques hard pcf)"
        );
    }
    specs::techniques(specs, kernel)
}

fn names_scene(word: &str) -> bool {
    let path = Path::new(word);
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    procedural::by_name(word).is_some()
        || ["glb", "gltf", "obj"].contains(&extension.as_str())
        || path.is_file()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scenes_among_techniques_are_told_from_slips() {
        let error = |specs: &[&str]| {
            let specs: Vec<String> = specs.iter().map(ToString::to_string).collect();
            read(&specs, 5).unwrap_err().to_string()
        };
        for scene in ["model.glb", "a/b.OBJ", "fence"] {
            let message = error(&["hard", "pcf", scene]);
            assert!(message.contains(scene) && message.contains("put the scene first"), "{message}");
        }
        assert!(error(&["hard", "pfc"]).contains("unknown technique 'pfc'"));
    }
}
