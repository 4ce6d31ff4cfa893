//! A set of shaders on its way through naga and, written to a folder, through a browser's compiler.

use naga::{
    Module,
    valid::{Capabilities, ValidationFlags, Validator},
};
use serde_json::{Value, json};
use std::{collections::BTreeMap, path::Path};
use wgpu::{Features, TextureFormat};

mod pipelines;

/// The environment variable that names the folder which [`Shaders::check`] writes to.
const FOLDER: &str = "ANTUMBRA_SHADERS";

/// Names that browsers have for features of wgpu.
const IN_BROWSERS: [(Features, &str); 4] = [
    (Features::FLOAT32_FILTERABLE, "float32-filterable"),
    (Features::DEPTH_CLIP_CONTROL, "depth-clip-control"),
    (Features::PRIMITIVE_INDEX, "primitive-index"),
    (Features::TEXTURE_FORMAT_16BIT_NORM, "texture-formats-tier1"),
];

/// Features that browsers lack.
pub const NATIVE: Features = Features::CONSERVATIVE_RASTERIZATION.union(Features::VERTEX_WRITABLE_STORAGE);

/// What a device must have beyond the least that WebGPU guarantees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Needs {
    /// Features.
    pub features: Features,
    /// Room for more colours in a pass than every device has.
    pub colours: bool,
}

impl Needs {
    /// Nothing.
    pub const LEAST: Self = Self { features: Features::empty(), colours: false };

    /// Features as browsers call them, and those that they do not have, as wgpu calls them.
    fn names(self) -> [Vec<String>; 2] {
        let known = |(feature, _): &&(Features, &str)| self.features.contains(*feature);
        let browser: Vec<_> = IN_BROWSERS.iter().filter(known).map(|(_, name)| (*name).to_string()).collect();
        let native = self.features & NATIVE;
        let native = native.iter_names().map(|(name, _)| name.to_string()).collect();
        [browser, native]
    }
}

#[derive(Debug)]
struct Entry {
    name: String,
    needs: Needs,
}

/// A text, and browsers' names for the formats of the colours that it is used with; none where any will do.
type Key = (String, Vec<String>);

/// Whole WGSL modules, each text once with each list of formats.
#[derive(Debug, Default)]
pub struct Shaders {
    entries: BTreeMap<Key, Entry>,
}

impl Shaders {
    /// Adds a shader that a device with these needs compiles, for colours of these formats; none where its
    /// types tell. Of several that are the same the first names it: begin with the least needs.
    pub fn add(&mut self, name: &str, text: String, targets: &[TextureFormat], needs: Needs) {
        let targets = targets.iter().map(|format| format!("{format:?}").to_lowercase()).collect();
        self.entries.entry((text, targets)).or_insert_with(|| Entry { name: name.into(), needs });
    }

    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// Puts all of them through naga, with no more than WebGPU allows. If the environment variable
    /// `ANTUMBRA_SHADERS` names a folder they are written to its folder `set`, with an `index.json` that
    /// says what each needs and which pipelines it makes.
    ///
    /// # Errors
    /// Which shaders naga refuses, or why nothing could be written.
    pub fn check(&self, set: &str) -> Result<(), String> {
        let all: Vec<(&Key, &Entry)> = self.entries.iter().collect();
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let parse = |part: &[(&Key, &Entry)]| -> Result<Vec<Module>, String> {
            let one = |((text, _), entry): &(&Key, &Entry)| {
                parse(text).map_err(|e| format!("{}: {e}\n{text}", entry.name))
            };
            part.iter().map(one).collect()
        };
        let parts: Result<Vec<Vec<Module>>, String> = std::thread::scope(|scope| {
            let chunks = all.chunks(all.len().div_ceil(threads).max(1));
            let running: Vec<_> = chunks.map(|part| scope.spawn(move || parse(part))).collect();
            running.into_iter().map(|t| t.join().unwrap_or_else(|e| std::panic::resume_unwind(e))).collect()
        });
        let modules: Vec<Module> = parts?.into_iter().flatten().collect();
        match std::env::var_os(FOLDER) {
            Some(folder) => write(&Path::new(&folder).join(set), &all, &modules),
            None => Ok(()),
        }
    }
}

/// What naga makes of a text, with nothing that WebGPU does not have.
///
/// # Errors
/// What it says.
pub fn parse(text: &str) -> Result<Module, String> {
    let module = naga::front::wgsl::parse_str(text).map_err(|e| e.emit_to_string(text))?;
    // Packing two 16-bit floats into a word is core WebGPU; naga counts it among what drivers may lack.
    Validator::new(
        ValidationFlags::all(),
        Capabilities::SHADER_FLOAT16_IN_FLOAT32 | Capabilities::PRIMITIVE_INDEX,
    )
    .validate(&module)
    .map_err(|e| e.emit_to_string(text))?;
    Ok(module)
}

fn write(folder: &Path, all: &[(&Key, &Entry)], modules: &[Module]) -> Result<(), String> {
    let at = |path: &Path, e: std::io::Error| format!("{}: {e}", path.display());
    std::fs::create_dir_all(folder).map_err(|e| at(folder, e))?;
    let mut index = Vec::new();
    for (i, (((text, targets), entry), module)) in all.iter().zip(modules).enumerate() {
        let plain = |c: char| if c.is_ascii_alphanumeric() || "._=,".contains(c) { c } else { '-' };
        let file = format!("{i:04}-{}.wgsl", entry.name.chars().map(plain).take(100).collect::<String>());
        let path = folder.join(&file);
        std::fs::write(&path, text).map_err(|e| at(&path, e))?;
        index.push(line(&file, entry, pipelines::of(module, targets), module));
    }
    let path = folder.join("index.json");
    std::fs::write(&path, Value::Array(index).to_string()).map_err(|e| at(&path, e))
}

fn line(file: &str, entry: &Entry, pipelines: Vec<Value>, module: &Module) -> Value {
    let [features, native] = entry.needs.names();
    json!({
        "name": entry.name,
        "file": file,
        "features": features,
        "native": native,
        "colours": entry.needs.colours,
        "constants": pipelines::constants(module),
        "pipelines": pipelines,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLAIN: &str = "@compute @workgroup_size(1) fn compute() {}";

    #[test]
    fn what_naga_refuses_is_named() {
        let mut shaders = Shaders::default();
        shaders.add("good", PLAIN.into(), &[], Needs::LEAST);
        shaders.check("test").unwrap();
        shaders.add("bad", "fn f() -> u32 { return nonsense; }".into(), &[], Needs::LEAST);
        let refusal = shaders.check("test").unwrap_err();
        assert!(refusal.starts_with("bad: ") && refusal.contains("nonsense"), "{refusal}");
    }

    /// The other half of `portability/check.mjs`, where a browser's compiler must refuse it.
    #[test]
    fn naga_takes_the_control() {
        let control = concat!(env!("CARGO_MANIFEST_DIR"), "/../../portability/refused.wgsl");
        parse(&std::fs::read_to_string(control).unwrap()).unwrap();
    }

    #[test]
    fn the_first_name_is_kept() {
        let mut shaders = Shaders::default();
        let more = Needs { features: Features::all(), colours: true };
        for (name, format, needs) in [
            ("first", TextureFormat::R32Float, Needs::LEAST),
            ("second", TextureFormat::Rg32Float, more),
            ("third", TextureFormat::R32Float, more),
        ] {
            shaders.add(name, PLAIN.into(), &[format], needs);
        }
        let kept = |format: &str| &shaders.entries[&(PLAIN.to_string(), vec![format.to_string()])];
        assert_eq!((kept("r32float").name.as_str(), kept("r32float").needs), ("first", Needs::LEAST));
        assert_eq!((kept("rg32float").name.as_str(), shaders.len()), ("second", 2));
    }

    #[test]
    fn features_that_browsers_lack_are_told_apart() {
        let all = antumbra::Capabilities::OPTIONAL_FEATURES;
        // What wgpu wants beside 16-bit formats.
        let beside = Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
        let known = IN_BROWSERS.iter().fold(NATIVE | beside, |known, (feature, _)| known | *feature);
        assert!(known.contains(all), "say how browsers call {:?}", all.difference(known));
        let [browser, native] = Needs { features: all, colours: false }.names();
        assert_eq!(browser, IN_BROWSERS.map(|(_, name)| name));
        assert_eq!(native, ["CONSERVATIVE_RASTERIZATION", "VERTEX_WRITABLE_STORAGE"].map(String::from));
    }
}
