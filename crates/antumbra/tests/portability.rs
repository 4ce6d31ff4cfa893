//! Every shader that the library composes, through naga; `make portability` takes them on to the compiler
//! of a browser.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{
    CASTER_WGSL, Capabilities, Capacity, Options, Pipelines, Shader, ShaderText, ShadowMap, Size,
    Unsupported, technique,
};
use antumbra_testing::{
    Gpu, Trials, settings,
    shaders::{NATIVE, Needs, Shaders},
};
use std::{
    collections::BTreeSet,
    path::{Path, PathBuf},
};
use wgpu::Features;

/// A user's shader: the receiver in a fragment and in a compute shader.
const RECEIVES: &str = "
struct Surface { @builtin(position) clip: vec4f, @location(0) world: vec3f, @location(1) normal: vec3f }
@vertex fn vertex(@location(0) world: vec3f, @location(1) normal: vec3f) -> Surface {
    return Surface(vec4f(world, 1.0), world, normal);
}
@fragment fn fragment(in: Surface) -> @location(0) vec4f {
    return vec4f(shadow_visibility(in.world, in.normal, dpdx(in.world), dpdy(in.world)));
}
@group(0) @binding(0) var<storage, read_write> answers: array<f32>;
@compute @workgroup_size(64) fn compute(@builtin(global_invocation_id) id: vec3u) {
    answers[id.x] = shadow_visibility(vec3f(id), vec3f(0.0, 1.0, 0.0), vec3f(0.1), vec3f(0.1));
}
";

/// The same for techniques with classes.
const CLASSIFIES: &str = "
@fragment fn classify(in: Surface) -> @location(0) u32 {
    return shadow_class(in.world, in.normal, dpdx(in.world), dpdy(in.world));
}
";

/// What it adds where lookups ask about cut-outs.
const COVERS: &str = "
fn shadow_covers(tag: u32, triangle: u32, weights: vec3f) -> bool {
    return weights.x + f32(tag % 4u) > 0.5 || triangle > 7u;
}
";

/// Holes of a user's casters.
const CUTOUT: &str = "
@group(2) @binding(0) var mask: texture_2d<f32>;
@group(2) @binding(1) var mask_sampler: sampler;
fn caster_covers(triangle: u32, weights: vec3f) -> bool {
    let corner = f32(caster_vertex(triangle, 2u));
    return textureSampleLevel(mask, mask_sampler, weights.xy + corner, 0.0).a > 0.5;
}
fn caster_tag(triangle: u32) -> u32 {
    return triangle / 100u;
}
";

/// What changes the text of shaders beside settings, the least needs first.
fn devices() -> Vec<Needs> {
    let joined = Features::TEXTURE_FORMAT_16BIT_NORM | Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES;
    let others = Capabilities::OPTIONAL_FEATURES.difference(joined).iter();
    let switches: Vec<Features> = others.chain([joined]).collect();
    let colours = 1 << switches.len();
    let mut sets: Vec<u32> = (0..2 * colours).collect();
    sets.sort_by_key(|set| set.count_ones());
    let needs = |set: u32| {
        let on = switches.iter().enumerate().filter(|(i, _)| set >> i & 1 == 1);
        Needs { features: on.fold(Features::empty(), |all, (_, f)| all | *f), colours: set >= colours }
    };
    sets.into_iter().map(needs).collect()
}

fn capabilities(needs: Needs) -> Capabilities {
    let least = wgpu::Limits::default();
    let bytes = least.max_color_attachment_bytes_per_sample * if needs.colours { 4 } else { 1 };
    let limits = wgpu::Limits { max_color_attachment_bytes_per_sample: bytes, ..least };
    Capabilities { features: needs.features, limits }
}

fn add(shaders: &mut Shaders, spec: &str, options: &Options, needs: Needs) {
    let (technique, device) = (technique::parse(spec).unwrap(), capabilities(needs));
    let all = match Shader::all(technique.as_ref(), &device, options, Some(CUTOUT)) {
        Ok(all) => all,
        // The map is refused, and said so.
        Err(Unsupported::Feature { .. }) => return,
        Err(error) => panic!("{spec}: {error}"),
    };
    for shader in all {
        shaders.add(&format!("{spec}: {}", shader.pass), shader.text, &shader.targets, needs);
    }
    let described = technique.describe(&device).unwrap();
    let asks = if described.classes.is_empty() { "" } else { CLASSIFIES };
    let covers = if options.cutouts && described.storage.keeps_ids() { COVERS } else { "" };
    let receiver = ShaderText::receiver(technique.as_ref(), &device, options, 1).unwrap().text();
    let mut user = format!("{RECEIVES}{asks}{covers}");
    if options.lights > 1 {
        for function in ["shadow_visibility(", "shadow_class("] {
            user = user.replace(function, &format!("{function}1u, "));
        }
    }
    shaders.add(&format!("{spec}: receiver"), format!("{user}\n{receiver}"), &[], needs);
}

/// Everything: with one setting at a time on all kinds of devices, with several on the least device and on
/// one with all that browsers have.
fn library() -> Shaders {
    let mut shaders = Shaders::default();
    let usual = Options::from(Size::square(64)).views(3);
    // Two buffers for what is more than a binding of 128 MiB.
    let capacity = Capacity { triangles: 1 << 22, ..Capacity::default() };
    let split = Options::from(Size::square(4096)).capacity(capacity);
    for needs in devices() {
        settings::single().iter().for_each(|spec| add(&mut shaders, spec, &usual, needs));
        for options in [&split, &usual.clone().cutouts(true), &split.clone().cutouts(true)] {
            technique::all().iter().for_each(|t| add(&mut shaders, t.about().name, options, needs));
        }
    }
    let browser = Needs { features: Capabilities::OPTIONAL_FEATURES.difference(NATIVE), ..Needs::LEAST };
    for needs in [Needs::LEAST, browser] {
        settings::many().iter().for_each(|spec| add(&mut shaders, spec, &usual, needs));
        let tiled = usual.clone().tiled(2).lights(2);
        settings::variants().iter().for_each(|spec| add(&mut shaders, spec, &tiled, needs));
    }
    shaders
}

/// The strings of WGSL that a text of Rust holds, in code or in its documentation.
fn wgsl_in(text: &str) -> Vec<String> {
    let bare = |line: &str| line.trim_start_matches("//! ").trim_start_matches("/// ").to_string() + "\n";
    let text: String = text.lines().map(bare).collect();
    let strings = text.split(": &str = ").skip(1).filter_map(|rest| {
        let start = rest.find('"')?;
        let end = format!("\"{}", "#".repeat(rest[..start].matches('#').count()));
        let (string, _) = rest[start + 1..].split_once(&format!("{end};"))?;
        Some(string.to_string())
    });
    let strings: Vec<String> = strings.filter(|s| s.contains("fn ")).collect();
    let is_whole =
        |s: &&String| ["@vertex", "@fragment", "@compute", "fn caster_"].iter().any(|w| s.contains(w));
    // What is no shader by itself stands before each that calls it.
    let helpers: String = strings.iter().filter(|s| !is_whole(s)).map(String::as_str).collect();
    let names: Vec<&str> =
        helpers.split("fn ").skip(1).filter_map(|f| f.split_inclusive('(').next()).collect();
    let calls = |s: &str| names.iter().any(|name| s.contains(name));
    let whole = |s: &String| if calls(s) { helpers.clone() + s } else { s.clone() };
    strings.iter().filter(is_whole).map(whole).collect()
}

/// All files of Rust below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: PathBuf| if path.is_dir() { sources(&path) } else { vec![path] };
    entries.flat_map(of).filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// What readers copy: shaders of the examples, of the library's page and of the README, with what they call
/// of every technique.
fn documents() -> Shaders {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let pages = [root.join("src/lib.rs"), root.join("../../README.md")].into_iter();
    let mut shaders = Shaders::default();
    let mut found = 0;
    for path in sources(&root.join("examples")).into_iter().chain(pages.filter(|page| page.exists())) {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        for wgsl in wgsl_in(&std::fs::read_to_string(&path).unwrap()) {
            add_document(&mut shaders, &name, &wgsl);
            found += 1;
        }
    }
    assert!(found > 4, "{found} strings of WGSL");
    shaders
}

/// The words in front of `_visibility(` in a text: one for each of its maps.
fn visibilities(wgsl: &str) -> BTreeSet<&str> {
    let before = wgsl.split("_visibility(").collect::<Vec<_>>();
    let in_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let maps = before.iter().take(before.len() - 1);
    maps.map(|text| &text[text.rfind(|c| !in_name(c)).map_or(0, |i| i + 1)..]).collect()
}

/// Whether a text tells lights apart: it hands `_visibility` a fifth argument.
fn tells_lights(wgsl: &str) -> bool {
    let arguments = |call: &str| {
        let mut depth = 0;
        let within = call.chars().take_while(|c| {
            depth += i32::from(*c == '(') - i32::from(*c == ')');
            depth >= 0
        });
        let within: String = within.collect();
        let mut depth = 0;
        1 + within
            .chars()
            .filter(|c| {
                depth += i32::from(*c == '(') - i32::from(*c == ')');
                depth == 0 && *c == ','
            })
            .count()
    };
    wgsl.split("_visibility(").skip(1).any(|call| arguments(call) == 5)
}

fn add_document(shaders: &mut Shaders, name: &str, wgsl: &str) {
    let lights = if tells_lights(wgsl) { 2 } else { 1 };
    let (device, options) =
        (capabilities(Needs::LEAST), Options::from(Size::square(64)).views(4).lights(lights));
    let caster = if wgsl.contains("caster_pancaked(") { CASTER_WGSL } else { "" };
    for technique in technique::all() {
        let name = format!("{name}: {}", technique.about().name);
        if wgsl.contains("fn caster_covers(") {
            let all = Shader::all(technique.as_ref(), &device, &options, Some(wgsl)).unwrap();
            for shader in all.into_iter().filter(|shader| shader.pass == "cut-out") {
                shaders.add(&name, shader.text, &shader.targets, Needs::LEAST);
            }
            continue;
        }
        let at = |group| ShaderText::receiver(technique.as_ref(), &device, &options, group).unwrap();
        // The last groups, which none of the shaders has something in.
        let receivers = visibilities(wgsl).into_iter().zip((1..=3).rev());
        let receivers: String = receivers.map(|(map, group)| at(group).named(map).unwrap().text()).collect();
        shaders.add(&name, [wgsl, caster, &receivers].join("\n"), &[], Needs::LEAST);
    }
}

fn strings_are_found_in_code_and_comments() {
    let found = wgsl_in(
        "//! const A: &str = \"\n//!     @vertex fn a() {}\";\nlet b: &str = r#\"@fragment fn b() { c(); } \"b\" \"#;\nlet c: &str = \"fn c() {} \";\nlet d: &str = \"no\";",
    );
    assert_eq!(found, ["\n    @vertex fn a() {}", "fn c() {} @fragment fn b() { c(); } \"b\" "]);
    assert!(tells_lights("shadow_visibility(i, p, n, dpdx(p), f(p, p))"));
    assert!(!tells_lights("lamp_visibility(p, n, f(p, p), dpdy(p)) + f(i, p)"));
}

fn naga_accepts_every_shader() {
    let shaders = library();
    let pages = documents();
    println!("{} shaders, {} in documents", shaders.len(), pages.len());
    shaders.check("library").unwrap();
    pages.check("documents").unwrap();
}

fn maps_compile_what_is_listed(gpu: &Gpu) {
    let device = Capabilities::of(&gpu.device);
    let mut compiled = 0;
    for technique in technique::all() {
        let pipelines = Pipelines::new(&gpu.device);
        let options = Options::from(Size::square(64)).views(2).pipelines(&pipelines);
        let map = ShadowMap::new(&gpu.device, technique.as_ref(), options.clone()).unwrap();
        let listed = Shader::all(technique.as_ref(), &device, &options, None).unwrap();
        for text in pipelines.shaders() {
            let name = technique.about().name;
            assert!(listed.iter().any(|shader| shader.text == text), "{name} compiles another:\n{text}");
            compiled += 1;
        }
        let receiver = ShaderText::receiver(technique.as_ref(), &device, &options, 1).unwrap().text();
        assert_eq!(map.wgsl(1).text(), receiver);
    }
    assert!(compiled > technique::all().len(), "{compiled}");
}

fn main() {
    let mut trials = Trials::default();
    trials.add_plain("naga accepts every shader", naga_accepts_every_shader);
    trials.add_plain("strings are found in code and comments", strings_are_found_in_code_and_comments);
    trials.add("maps compile what is listed", maps_compile_what_is_listed);
    trials.run();
}
