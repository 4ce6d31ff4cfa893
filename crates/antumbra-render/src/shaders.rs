//! The renderer's WGSL, put together from its files.

macro_rules! wgsl {
    ($($file:literal),+) => { concat!($(include_str!($file)),+) };
}

/// What the camera sees.
pub(crate) const SURFACES: &str = wgsl!("scene/frame.wgsl", "scene/surfaces.wgsl");
/// Casters that leave depth, before [`antumbra::CASTER_WGSL`].
pub(crate) const CASTER: &str = wgsl!("scene/frame.wgsl", "scene/caster.wgsl");
/// Holes of casters that are triangles.
pub(crate) const CUTOUT: &str = wgsl!("scene/frame.wgsl", "scene/cutout.wgsl");
/// `shadow_covers`, behind what asks a map about surfaces, with its bindings in group 2.
pub(crate) const COVERS: &str = wgsl!("scene/covers.wgsl");
/// Visibility of every surface, before a map's `shadow_visibility`.
pub(crate) const VISIBILITY: &str =
    wgsl!("scene/frame.wgsl", "lighting/lookup.wgsl", "lighting/visibility.wgsl");
/// Class of every surface, before a map's `shadow_class`.
pub(crate) const CLASS: &str = wgsl!("scene/frame.wgsl", "lighting/lookup.wgsl", "lighting/class.wgsl");
/// Visibility where everything is lit.
pub(crate) const UNSHADOWED: &str =
    wgsl!("scene/frame.wgsl", "lighting/lookup.wgsl", "lighting/visibility.wgsl", "lighting/unshadowed.wgsl");
/// A sample's share of the light of every surface.
pub(crate) const LIGHT: &str = wgsl!("scene/frame.wgsl", "lighting/light.wgsl");
/// Visibility shaded.
pub(crate) const PICTURE: &str = wgsl!("lighting/picture.wgsl");

#[cfg(test)]
mod tests {
    use super::*;
    use antumbra::{Capabilities, Options, Shader, ShaderText, Size, technique};
    use antumbra_testing::shaders::{Needs, Shaders};
    use std::path::{Path, PathBuf};

    /// All `.wgsl` files below a folder.
    fn files(folder: &Path) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        let of = |path: PathBuf| if path.is_dir() { files(&path) } else { vec![path] };
        entries.flat_map(of).filter(|path| path.extension().is_some_and(|e| e == "wgsl")).collect()
    }

    /// Every one with every technique's receiver, or every caster with holes: with all settings the
    /// library's own tests have them.
    #[test]
    fn every_shader_is_portable() {
        let mut shaders = Shaders::default();
        let caster = [CASTER, antumbra::CASTER_WGSL].concat();
        let alone = [
            ("surfaces", SURFACES),
            ("caster", caster.as_str()),
            ("unshadowed", UNSHADOWED),
            ("light", LIGHT),
        ];
        for (name, text) in alone.into_iter().chain([("picture", PICTURE)]) {
            shaders.add(name, text.into(), &[], Needs::LEAST);
        }
        let device = Capabilities::least();
        let plain = Options::from(Size::square(64)).views(4);
        let asking = plain.clone().cutouts(true);
        let all = technique::all();
        for (technique, options) in all.iter().flat_map(|t| [(t, &plain), (t, &asking)]) {
            let described = technique.describe(&device).unwrap();
            let name = described.about.name;
            let covers = if options.cutouts && described.storage.keeps_ids() { COVERS } else { "" };
            let receiver =
                |group| ShaderText::receiver(technique.as_ref(), &device, options, group).unwrap().text();
            let class = (!described.classes.is_empty()).then_some(("class", CLASS, 1));
            for (what, text, group) in [("visibility", VISIBILITY, 1)].into_iter().chain(class) {
                let text = format!("{text}{covers}\n{}", receiver(group));
                shaders.add(&format!("{name}: {what}"), text, &[], Needs::LEAST);
            }
            let casters = Shader::all(technique.as_ref(), &device, options, Some(CUTOUT)).unwrap();
            for shader in casters.into_iter().filter(|shader| shader.pass == "cut-out") {
                shaders.add(&format!("{name}: cut-out"), shader.text, &shader.targets, Needs::LEAST);
            }
        }
        shaders.check("render").unwrap();
    }

    #[test]
    fn every_file_is_put_somewhere() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        let found = files(&folder);
        assert!(found.len() > 5, "{found:?}");
        for path in found {
            let text = std::fs::read_to_string(&path).unwrap();
            let all = [SURFACES, CASTER, CUTOUT, VISIBILITY, CLASS, UNSHADOWED, LIGHT, PICTURE, COVERS];
            assert!(all.iter().any(|all| all.contains(&text)), "{} is in no shader", path.display());
        }
    }
}
