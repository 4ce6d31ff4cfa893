//! The program from end to end: a comparison with its report, pictures, lists.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_lab::results::{Results, SCHEMA, TechniqueResult};
use antumbra_testing::Trials;
use common::{Folder, png_size};
use serde_json::Value;
use std::{collections::BTreeSet, fs, path::Path};

/// Largest RMSE on `contact` of techniques that are not in the list.
const BOUND: f64 = 0.075;

/// Largest RMSE against the light-space ideal on the scene `contact`, measured plus a third.
const BOUNDS: [(&str, f64); 8] = [
    ("hard", 0.075),
    ("pcf", 0.027),
    ("vsm", 0.027),
    ("csm", 0.097),
    ("esm", 0.016),
    ("evsm", 0.024),
    ("msm", 0.050),
    ("lvsm", 0.026),
];

fn main() {
    let mut trials = Trials::default();
    trials.add("comparison_and_its_report", |_| comparison());
    trials.add("pictures", |_| pictures());
    trials.add("capacity_follows_from_the_scene", |_| capacity());
    trials.add("what_is_refused_is_left_out", |gpu| refused(gpu.is_software()));
    trials.add("times", |_| times());
    trials.add("info", |_| {
        let info = json(&["info", "--json"]);
        assert!(info["adapter"]["name"].is_string() && info["missing_features"].is_array());
        let named = BOUNDS.iter().all(|(name, _)| info["choices"][name].is_array());
        assert!(named, "{info}");
    });
    trials.add("flicker_and_its_page", |_| flicker());
    trials.add_plain("lists_and_completions", lists);
    trials.add_plain("scenes_are_exported", export);
    trials.run();
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&Folder::new().run(arguments).good()).unwrap()
}

fn flicker() {
    let folder = Folder::new();
    let small = ["flicker", "contact", "--frames", "3", "--resolution", "48x36", "--size", "64"];
    let both = [&small[..], &["--techniques", "hard", "pcf", "--json", "-o", "page"]].concat();
    for _ in 0..2 {
        let results: Value = serde_json::from_str(&folder.run(&both).good()).unwrap();
        assert_eq!(results["schema"], "antumbra-flicker/1");
        assert_eq!(results["techniques"][1]["flicker"]["light_space"]["frames"].as_array().unwrap().len(), 2);
        assert_eq!(results["techniques"][0]["ratio_to_hard"], 1.0);
    }
    assert_eq!(png_size(&folder.0.join("page/strip.png"))[0], 3 * 2 * 48 + 2 * 4);
    let text = folder.run(&[&small[..], &["--path", "recede", "--techniques", "pcf", "-o", "page"]].concat());
    assert!(text.good().contains("moves away"));
}

fn lists() {
    let techniques = json(&["techniques", "--json"]);
    let names: Vec<&str> = techniques.as_array().unwrap().iter().filter_map(|t| t["name"].as_str()).collect();
    assert_eq!(names[0], "hard");
    assert!(BOUNDS.iter().all(|(name, _)| names.contains(name)), "{names:?}");
    let csm = names.iter().position(|name| *name == "csm").unwrap();
    let terms = &techniques[csm]["parameters"][0];
    assert_eq!((terms["name"].as_str(), terms["default"].as_str()), (Some("terms"), Some("16")));
    assert!(terms["allowed"].is_string() && terms["meaning"].is_string());
    let scenes = json(&["scenes", "--json"]);
    assert_eq!(scenes[2]["name"], "contact");
    assert_eq!(scenes[2]["triangles"], 17);
    let folder = Folder::new();
    for name in names {
        assert!(folder.run(&["techniques"]).good().contains(name));
    }
    assert!(folder.run(&["scenes"]).good().contains("fence"));
    for shell in ["bash", "zsh", "fish"] {
        assert!(folder.run(&["completions", shell]).good().contains("antumbra"));
    }
    folder.run(&["completions", "sh"]).refusal(&["'sh'", "bash"]);
}

/// More triangles share the texels of so small a map than there is memory for at first.
fn capacity() {
    let command = "compare spheres --techniques hard exact dpm --resolution 64x48 --size 24 --rounds 1 --grid 1 \
                   -o report --json";
    let arguments: Vec<&str> = command.split_whitespace().collect();
    let results: Results = serde_json::from_str(&Folder::new().run(&arguments).good()).unwrap();
    assert!(results.techniques.iter().all(|t| t.invalid.is_none()) && results.left_out.is_empty());
    let exact = technique(&results, "exact");
    let held = exact.explain.iter().find(|line| line.starts_with("lists held")).unwrap();
    let mean: f64 = held.split(", ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
    assert!(mean > 6.0, "the first guess would have done: {held}");
    assert!(exact.scores.hard.pixel_match > 0.995, "{}", exact.scores.hard.pixel_match);
}

/// A map that the device refuses ends nothing: 2 GiB of keys, in more buffers than an array may have.
fn refused(software: bool) {
    let run = |command: &str| {
        let common = "contact --resolution 16x12 --size 4096 --rounds 1 --techniques hard dpm.keeps=32";
        let folder = Folder::new();
        let answer = folder.run(&[command, common].join(" ").split(' ').collect::<Vec<_>>());
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        (folder, answer)
    };
    let (_, table) = run("bench");
    assert!(table.out.contains("\nhard "), "{}", table.out);
    // Graphics cards may have larger bindings.
    if software {
        assert!(table.out.contains("\ndpm.keeps=32  left out: dpm needs "), "{}", table.out);
        assert!(table.err.contains("note: left out: dpm.keeps=32: "), "{}", table.err);
        let only = ["bench", "contact", "--size", "4096", "--techniques", "dpm.keeps=32"];
        Folder::new().run(&only).refusal(&["left out: dpm.keeps=32", "storage buffers"]);
    }
}

fn export() {
    let folder = Folder::new();
    assert!(folder.run(&["scenes", "export", "contact", "out/contact.glb"]).good().contains("contact.glb"));
    let scene = antumbra_scene::import::load(folder.0.join("out/contact.glb")).unwrap();
    assert_eq!(scene.flatten().triangle_count(), 17);
    // A file is a scene too.
    folder.run(&["scenes", "export", "out/contact.glb", "again.glb", "--seed", "3"]).good();
    folder.run(&["scenes", "export", "contact", "contact.obj"]).refusal(&["contact.obj", ".glb"]);
    folder.run(&["scenes", "export", "contcat", "x.glb"]).refusal(&["'contcat'", "did you mean contact?"]);
    let names = ["again.glb", "out", "out/contact.glb"].map(std::path::PathBuf::from);
    assert_eq!(folder.names(), names);
}

fn comparison() {
    let folder = Folder::new();
    let command = "compare contact --resolution 160x120 --size 256 --rounds 1 --grid 2 -o out/report --json";
    let arguments: Vec<&str> = command.split(' ').collect();
    let out = folder.run(&arguments).good();
    let results: Results = serde_json::from_str(&out).unwrap();
    assert_eq!(results.schema, SCHEMA);
    assert_eq!(results.run.command.join(" "), format!("antumbra {command}"));
    assert_eq!(
        (results.run.resolution, results.run.map_size, results.run.kernel_texels),
        ([160, 120], 256, 5)
    );
    assert!(results.truth.coverage_agreement >= 0.999, "{}", results.truth.coverage_agreement);
    assert_eq!(results.truth.coverage_explained["unexplained"], 0);
    scores(&results);
    for (name, bytes_per_texel) in [("esm", 4), ("vsm", 8), ("csm", 32)] {
        kept(technique(&results, name), bytes_per_texel);
    }
    work(&results);
    let report = folder.0.join("out/report");
    is_complete(&report, &results);
    // A second run replaces the first.
    let again: Vec<&str> = [&arguments[..], &["--techniques", "hard", "esm.c=40"]].concat();
    let second: Results = serde_json::from_str(&folder.run(&again).good()).unwrap();
    let specs: Vec<&str> = second.techniques.iter().map(|t| t.spec.as_str()).collect();
    assert_eq!(specs, ["hard", "esm.c=40,kernel=5"]);
    is_complete(&report, &second);
    let left: Vec<_> = fs::read_dir(folder.0.join("out")).unwrap().collect();
    assert_eq!(left.len(), 1, "nothing is left beside the report: {left:?}");
}

fn technique<'a>(results: &'a Results, name: &str) -> &'a TechniqueResult {
    results.techniques.iter().find(|t| t.name == name).unwrap()
}

fn scores(results: &Results) {
    assert!(results.techniques.len() >= BOUNDS.len());
    for entry in &results.techniques {
        let name = entry.name.as_str();
        let bound = BOUNDS.iter().find(|(n, _)| *n == name).map_or(BOUND, |(_, bound)| *bound);
        let scores = &entry.scores;
        let rmse = scores.light_space.rmse;
        assert!(rmse <= bound, "{name}: RMSE {rmse} is above {bound}");
        assert!(scores.hard.rmse < 0.5 * results.truth.no_shadow.rmse, "{name}: {}", scores.hard.rmse);
        assert!(scores.hard.pixel_match > results.truth.no_shadow.pixel_match);
    }
    let contact = |name| technique(results, name).regions["contact"].rmse;
    assert!(contact("esm") < contact("csm"), "ESM {}, CSM {}", contact("esm"), contact("csm"));
}

/// One texture of 256² texels with all its mips, 4/3 of the finest, and next to nothing else.
fn kept(technique: &TechniqueResult, bytes_per_texel: u64) {
    let texels: u64 = (0..=8).map(|mip| (256_u64 >> mip).pow(2)).sum();
    assert_eq!(texels, (4 * 256 * 256 - 1) / 3);
    let memory = &technique.memory;
    let largest = memory.items.iter().filter(|i| i.format != "buffer").map(|i| i.bytes).max();
    let textures: Vec<u64> =
        memory.items.iter().filter(|i| i.format != "buffer" && i.mips > 1).map(|i| i.bytes).collect();
    assert_eq!(textures, [bytes_per_texel * texels], "{}", technique.name);
    assert_eq!(largest, textures.first().copied());
    assert!((textures[0]..textures[0] + 4096).contains(&memory.kept_bytes), "{}", memory.kept_bytes);
}

/// Cost in bytes, lookups and passes, of maps of 256² texels with nine levels.
fn work(results: &Results) {
    for (name, bytes, mips, lookups) in
        [("hard", 4.0, false, 1), ("pcf", 4.0, false, 9), ("esm", 4.0, true, 1), ("csm", 32.0, true, 8)]
    {
        let work = technique(results, name).work.as_ref().unwrap();
        let levels = if mips { 4.0 / 3.0 } else { 1.0 };
        assert!((work.bytes_per_texel - bytes).abs() < 1e-6, "{name}: {work:?}");
        assert!((work.bytes_per_texel_with_mips - bytes * levels).abs() < 1e-3 * bytes, "{name}: {work:?}");
        assert_eq!((work.lookups, work.passes.is_empty()), (lookups, !mips), "{name}: {work:?}");
        assert!(!mips || work.passes.contains(&"blur".to_string()), "{name}: {work:?}");
    }
}

/// Page, data, table and exactly the images that the results name, each of the right size.
fn is_complete(report: &Path, results: &Results) {
    let stored = Results::read(&report.join("results.json")).unwrap();
    assert_eq!(Results { files: Vec::new(), ..stored.clone() }, *results, "printed and stored are one");
    let truth = &results.truth.images;
    let mut images = vec![&truth.hard, &truth.light_space, &truth.screen_space];
    for t in &results.techniques {
        let i = &t.images;
        images.extend([&i.picture, &i.visibility, &i.error_hard, &i.error_light_space]);
        images.extend(&i.classes);
    }
    for image in &images {
        assert_eq!(png_size(&report.join(image)), results.run.resolution, "{image}");
    }
    let own = ["index.html", "results.json", "results.csv"].map(String::from);
    let expected: BTreeSet<String> = images.into_iter().cloned().chain(own).collect();
    let entries = fs::read_dir(report).unwrap();
    let found: BTreeSet<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    assert_eq!(found, expected);
    let listed: BTreeSet<String> = stored.files.into_iter().chain(["results.json".into()]).collect();
    assert_eq!(listed, expected);
    let csv = fs::read_to_string(report.join("results.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + results.techniques.len());
    let page = fs::read_to_string(report.join("index.html")).unwrap();
    assert!(results.techniques.iter().all(|t| page.contains(&t.title)) && page.ends_with("</html>\n"));
}

fn pictures() {
    let folder = Folder::new();
    let small = ["render", "contact", "--resolution", "160x120", "--size", "256"];
    let render = |more: &[&str]| folder.run(&[&small[..], more].concat()).good();
    assert_eq!(render(&["-o", "new/esm.png"]), "new/esm.png\n", "missing folders are made");
    render(&["--technique", "truth", "-o", "truth.png"]);
    render(&["--technique", "esm", "--show", "visibility", "-o", "seen.png"]);
    render(&["--technique", "esm", "--show", "visibility", "-o", "seen.exr"]);
    for name in ["new/esm.png", "truth.png", "seen.png"] {
        assert_eq!(png_size(&folder.0.join(name)), [160, 120]);
    }
    let bytes = |name: &str| fs::read(folder.0.join(name)).unwrap();
    assert_eq!(bytes("seen.exr")[..4], [0x76, 0x2f, 0x31, 0x01]);
    assert_ne!(bytes("new/esm.png"), bytes("truth.png"));
    // The second picture replaces the first.
    render(&["--technique", "truth", "-o", "new/esm.png"]);
    assert_eq!(bytes("new/esm.png"), bytes("truth.png"));
    assert_eq!(folder.names().len(), 5, "{:?}", folder.names());
}

fn times() {
    let small = ["bench", "contact", "--resolution", "160x120", "--size", "256", "--rounds", "2"];
    let times = json(&[&small[..], &["--json"]].concat());
    assert!(times["truth"]["seconds_hard"].as_f64().unwrap() > 0.0);
    let of = |spec: &str| {
        let mut all = times["techniques"].as_array().unwrap().iter();
        all.find(|technique| technique["spec"] == spec).map(|technique| &technique["time"])
    };
    for (spec, time) in
        [("none", Some(&times["unshadowed"])), ("hard", of("hard")), ("esm.kernel=5", of("esm.kernel=5"))]
    {
        let frame = &time.unwrap()["frame"];
        let [min, median, max] = ["min_ms", "median_ms", "max_ms"].map(|k| frame[k].as_f64().unwrap());
        assert!(0.0 < min && min <= median && median <= max, "{spec}: {frame}");
    }
    let table = Folder::new().run(&small).good();
    assert!(table.contains("csm.kernel=5") && table.contains("ray-traced"), "{table}");
}
