//! What is wrong is refused with exit code 2 and a message that names the thing, its value and what
//! is allowed; nothing is written. What is merely odd works.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_testing::Trials;
use common::{Folder, INDICES, glb, positions};
use serde_json::json;
use std::fs;

fn main() {
    let mut trials = Trials::default();
    files(&mut trials);
    settings(&mut trials);
    numbers(&mut trials);
    views(&mut trials);
    outputs(&mut trials);
    odd_but_good(&mut trials);
    odd_files(&mut trials);
    odd_ends(&mut trials);
    trials.add_plain("no_adapter_tells_how_to_install_one", no_adapter);
    trials.run();
}

/// `render` and `compare` with these arguments are refused in these words and leave nothing behind.
fn refused(arguments: &[&str], words: &[&str]) {
    refused_in(&Folder::new(), arguments, words);
}

fn refused_in(folder: &Folder, arguments: &[&str], words: &[&str]) {
    let before = folder.names();
    for (command, output) in [("render", "picture.png"), ("compare", "report")] {
        let arguments: Vec<&str> =
            [command].into_iter().chain(arguments.iter().copied()).chain(["-o", output]).collect();
        folder.run(&arguments).refusal(words);
        assert_eq!(folder.names(), before, "{arguments:?}");
    }
}

/// A trial without GPU: the file `scene.glb` (or another name) is refused in these words.
fn file(trials: &mut Trials, trial: &str, name: &'static str, bytes: Vec<u8>, words: &'static [&str]) {
    trials.add_plain(format!("file_{trial}"), move || {
        let folder = Folder::new();
        folder.write(name, &bytes);
        refused_in(&folder, &[name], &[&[name], words].concat());
    });
}

fn files(trials: &mut Trials) {
    let plain = |change: fn(&mut serde_json::Value)| glb(&positions(), &INDICES, change);
    let whole = plain(|_| ());
    let with_nan = [&positions()[..7], &[f32::NAN], &positions()[8..]].concat();
    let out_of_range: Vec<u16> = INDICES.iter().map(|i| if *i == 7 { 8 } else { *i }).collect();
    trials.add_plain("file_missing", || refused(&["gone.glb"], &["gone.glb", "cannot be read"]));
    trials.add_plain("file_is_a_folder", || {
        let folder = Folder::new();
        fs::create_dir(folder.0.join("models")).unwrap();
        refused_in(&folder, &["models"], &["models is a folder", ".glb, .gltf or .obj"]);
    });
    file(trials, "empty", "empty.glb", Vec::new(), &[]);
    file(trials, "truncated", "half.glb", whole[..whole.len() - 40].to_vec(), &["bytes"]);
    file(trials, "garbage", "noise.glb", b"certainly no model".to_vec(), &[]);
    file(trials, "of_unknown_kind", "model.fbx", whole.clone(), &["'.fbx'", ".gltf, .glb and .obj"]);
    file(trials, "with_nan", "nan.glb", glb(&with_nan, &INDICES, |_| ()), &["POSITION[2]", "NaN", "finite"]);
    file(
        trials,
        "with_index_out_of_range",
        "index.glb",
        glb(&positions(), &out_of_range, |_| ()),
        &["indices", "8"],
    );
    let points = plain(|d| d["meshes"][0]["primitives"][0]["mode"] = json!(0));
    file(trials, "without_triangles", "points.glb", points, &["no triangles", "at least one"]);
    let draco = plain(|d| {
        d["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
        d["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    });
    file(
        trials,
        "that_needs_an_extension",
        "draco.glb",
        draco,
        &["KHR_draco_mesh_compression", "gltf-transform copy", "allowed are"],
    );
    trials.add_plain("scene_of_unknown_name", || {
        refused(&["contcat"], &["'contcat'", "fence, spheres, contact, spot", "did you mean contact?"]);
    });
}

fn settings(trials: &mut Trials) {
    let cases: &[(&str, &[&str])] = &[
        ("vms", &["'vms'", "hard, pcf, poisson", "did you mean vsm?"]),
        ("esm.k=3", &["esm", "'k'", "c, storage", "did you mean"]),
        ("esm.c=100", &["esm.c = 100", "0 to 87"]),
        ("esm.c=NaN", &["esm.c = NaN", "0 to 87"]),
        ("esm.c=inf", &["esm.c = inf", "0 to 87"]),
        ("csm.terms=0", &["csm.terms = 0", "1 to 32"]),
        ("csm.terms=2.5", &["csm.terms = 2.5", "whole"]),
        ("vsm.kernel=4", &["vsm.kernel = 4", "odd, 1 to 31"]),
        ("pcf.kernel=17", &["pcf.kernel = 17", "1 to 16"]),
        ("vsm.sampling=sharp", &["vsm.sampling = sharp", "trilinear"]),
        ("esm.c", &["'esm.c'", "no '='", "for example"]),
        ("", &["''", "hard, pcf"]),
    ];
    for (spec, words) in cases {
        trials.add_plain(format!("technique_{spec}"), move || {
            let folder = Folder::new();
            folder.run(&["render", "contact", "--technique", spec, "-o", "x.png"]).refusal(words);
            folder.run(&["compare", "contact", "--techniques", "hard", spec, "-o", "x"]).refusal(words);
            folder.run(&["bench", "contact", "--techniques", "hard", spec]).refusal(words);
            assert_eq!(folder.names().len(), 0);
        });
    }
    trials.add_plain("techniques_listed_twice", || {
        let folder = Folder::new();
        let twice = ["compare", "contact", "--techniques", "esm.c=40", "hard", "esm.c=40"];
        folder.run(&twice).refusal(&["esm.c=40", "twice"]);
        let group = ["compare", "contact", "--techniques", "all-sorts"];
        folder.run(&group).refusal(&["'all-sorts'", "all-basis, all-comparison"]);
        let several = ["render", "contact", "--technique", "all"];
        folder.run(&several).refusal(&["--technique all", "one technique"]);
        assert_eq!(folder.names().len(), 0);
    });
}

fn numbers(trials: &mut Trials) {
    let numbers: &[(&[&str], &[&str])] = &[
        (&["--size", "0"], &["--size 0", "at least 1"]),
        (&["--size=-1"], &["-1", "--size"]),
        (&["--resolution", "0x5"], &["--resolution 0x5", "1024x768", "1 to 16384"]),
        (&["--resolution", "640"], &["--resolution 640", "1024x768"]),
        (&["--resolution", "99999x10"], &["--resolution 99999x10", "16384"]),
        (&["--kernel", "0"], &["--kernel 0", "1 to 31"]),
        (&["--cascades", "0"], &["--cascades 0", "1 to 8"]),
        (&["--cascades", "9"], &["--cascades 9", "1 to 8"]),
        (&["--bias", "some"], &["--bias some", "auto, none"]),
        (&["--kernel", "99"], &["--kernel 99", "1 to 31"]),
        (&["--seed", "x"], &["'x'", "--seed"]),
    ];
    for (arguments, words) in numbers {
        trials.add_plain(arguments.join("_"), move || refused(&[&["contact"], *arguments].concat(), words));
    }
    trials.add_plain("rounds_and_grid", || {
        let folder = Folder::new();
        for (option, words) in
            [("--rounds=0", ["--rounds 0", "at least 1"]), ("--grid=0", ["--grid 0", "1 to 16"])]
        {
            folder.run(&["compare", "contact", option]).refusal(&words);
        }
        folder.run(&["compare", "contact", "--grid=17"]).refusal(&["--grid 17", "1 to 16"]);
        folder.run(&["bench", "contact", "--rounds=0"]).refusal(&["--rounds 0", "at least 1"]);
        assert_eq!(folder.names().len(), 0);
    });
    trials.add_plain("motion", || {
        let folder = Folder::new();
        let cases: [(&str, &[&str]); 6] = [
            ("--frames=0", &["--frames 0", "0 frames", "2 to 10000"]),
            ("--frames=1", &["--frames 1", "no motion", "2 to 10000"]),
            ("--frames=99999", &["--frames 99999", "2 to 10000"]),
            ("--stride=0", &["--stride 0", "1 to 360"]),
            ("--grid=17", &["--grid 17", "1 to 16"]),
            ("--path=round", &["'round'", "recede"]),
        ];
        for (option, words) in cases {
            folder.run(&["flicker", "contact", option]).refusal(words);
        }
        assert_eq!(folder.names().len(), 0);
    });
    trials.add("size_beyond_the_device", |gpu| {
        let max = gpu.device.limits().max_texture_dimension_2d.to_string();
        refused(&["contact", "--size", "999999"], &["999999", &format!("1 to {max}")]);
    });
    trials.add("kernel_wider_than_the_map", |_| {
        refused(&["contact", "--size", "4"], &["4 texels", "margin"]);
    });
}

fn views(trials: &mut Trials) {
    let cases: &[(&str, &str, &[&str])] = &[
        ("--camera", "1,2", &["for example"]),
        ("--camera", "1,2:3,4,5", &["'1,2'", "x,y,z"]),
        ("--camera", "1,2,nan:0,0,0", &["'1,2,nan'", "finite"]),
        ("--camera", "1,2,3:1,2,3", &["same point"]),
        ("--camera", "3e38,0,0:-3e38,0,0", &["too far"]),
        ("--camera", "1,2,3:0,0,0:0", &["'0'", "170 degrees"]),
        ("--camera", "1,2,3:0,0,0:50:x", &["roll 'x'", "360 degrees"]),
        ("--camera", "ortho:1,2,3:0,0,0", &["for example", "ortho:"]),
        ("--camera", "ortho:1,2,3:0,0,0:-1", &["height '-1'", "above 0"]),
        ("--camera", "7", &["has 1 camera: 0"]),
        ("--light", "0,0,0", &["no length"]),
        ("--light", "1,2,x", &["'1,2,x'", "x,y,z"]),
        ("--light", "spot:0,4,0:0,-1,0", &["for example"]),
        ("--light", "spot:0,4,0:0,0,0:35", &["no length"]),
        ("--light", "spot:0,4,0:0,-1,0:95", &["'95'", "90 degrees"]),
        ("--light", "3", &["has 1 light: 0"]),
        ("--leave-out", "grond", &["nothing in the scene", "similar are ground"]),
        ("--leave-out", "*", &["leaves out all 3 parts"]),
    ];
    for (option, value, words) in cases {
        trials.add_plain(format!("{option}_{value}"), move || {
            let named = format!("{option} {value}");
            let words: Vec<&str> = [named.as_str()].into_iter().chain(words.iter().copied()).collect();
            refused(&["contact", option, value], &words);
        });
    }
}

fn outputs(trials: &mut Trials) {
    trials.add_plain("output_folder_of_somebody_else", || {
        let folder = Folder::new();
        fs::create_dir(folder.0.join("thesis")).unwrap();
        folder.write("thesis/chapter1.tex", b"years of work");
        let before = folder.names();
        let words = ["thesis", "not an earlier report", "choose another folder"];
        folder.run(&["compare", "contact", "-o", "thesis"]).refusal(&words);
        assert_eq!(folder.names(), before);
        assert_eq!(fs::read(folder.0.join("thesis/chapter1.tex")).unwrap(), b"years of work");
    });
    trials.add_plain("output_folder_is_a_file", || {
        let folder = Folder::new();
        folder.write("report", b"mine");
        folder.run(&["compare", "contact", "-o", "report"]).refusal(&["report", "it is a file"]);
        assert_eq!(fs::read(folder.0.join("report")).unwrap(), b"mine");
        assert_eq!(folder.names().len(), 1);
    });
    trials.add_plain("output_of_unknown_kind", || {
        let folder = Folder::new();
        folder.run(&["render", "contact", "-o", "x.jpg"]).refusal(&["x.jpg", ".png or .exr"]);
        folder.run(&["render", "contact", "-o", "x"]).refusal(&["x", ".png or .exr"]);
        let picture = ["render", "contact", "--show", "picture", "-o", "x.exr"];
        folder.run(&picture).refusal(&["EXR", "--show visibility", ".png"]);
        assert_eq!(folder.names().len(), 0);
    });
    trials.add("output_in_what_is_no_folder", |_| {
        let folder = Folder::new();
        folder.write("file", b"mine");
        let small = ["contact", "--resolution", "32x24", "--size", "32"];
        let render = [&["render"], &small[..], &["-o", "file/x.png"]].concat();
        folder.run(&render).refusal(&["nothing was written", "file", "in its way"]);
        let quick = ["--techniques", "hard", "--rounds", "1", "--grid", "1"];
        let compare = [&["compare"], &small[..], &quick[..], &["-o", "file/report"]].concat();
        folder.run(&compare).refusal(&["file", "in its way"]);
        assert_eq!(fs::read(folder.0.join("file")).unwrap(), b"mine");
        assert_eq!(folder.names().len(), 1);
    });
    trials.add("output_is_a_folder", |_| {
        let folder = Folder::new();
        fs::create_dir(folder.0.join("x.png")).unwrap();
        let small = ["render", "contact", "--resolution", "32x24", "--size", "32", "-o", "x.png"];
        folder.run(&small).refusal(&["nothing was written", "x.png", "folder"]);
        assert_eq!(folder.names().len(), 1);
    });
}

fn odd_but_good(trials: &mut Trials) {
    trials.add("light_along_the_ground", |_| {
        let folder = Folder::new();
        let light = ["contact", "--light", "-1,0,0", "--resolution", "80x60", "--size", "64"];
        folder.run(&[&["render"], &light[..], &["-o", "x.png"]].concat()).good();
        let quick = ["--rounds", "1", "--grid", "1", "-o", "report"];
        folder.run(&[&["compare"], &light[..], &quick[..]].concat()).good();
        assert!(folder.0.join("report/index.html").is_file());
    });
    trials.add("light_that_nothing_faces", |_| {
        let folder = Folder::new();
        let light = ["contact", "--light", "0,1,0", "--resolution", "80x60", "--size", "64"];
        let quick = ["--camera", "0,3,0.1:0,0,0", "--techniques", "hard", "--rounds", "1", "--grid", "1"];
        let words = ["4800 pixels", "faces the light", "move the camera"];
        folder.run(&[&["compare"], &light[..], &quick[..]].concat()).refusal(&words);
        assert_eq!(folder.names().len(), 0);
    });
    trials.add("triangles_without_area", |_| {
        let folder = Folder::new();
        let flat = [&INDICES[..], &[0, 0, 1, 4, 5, 4, 2, 2, 2]].concat();
        folder.write("flat.glb", &glb(&positions(), &flat, |_| ()));
        let small = ["flat.glb", "--resolution", "80x60", "--size", "128", "--rounds", "1", "--grid", "1"];
        let view = ["--camera", "4,4,6:0,0,0", "--light", "0.3,-1,-0.2", "--json"];
        let out = folder.run(&[&["compare"], &small[..], &view[..]].concat()).good();
        let results: serde_json::Value = serde_json::from_str(&out).unwrap();
        assert_eq!(results["scene"]["triangles"], 7);
        assert_eq!(results["truth"]["coverage_explained"]["unexplained"], 0);
        for technique in results["techniques"].as_array().unwrap() {
            assert!(technique["scores"]["hard"]["pixel_match"].as_f64().unwrap() > 0.95, "{technique}");
        }
    });
}

/// What files say or are is taken as far as it can be, and never in silence.
fn odd_files(trials: &mut Trials) {
    trials.add("what_the_importer_changed_is_said", |_| {
        let folder = Folder::new();
        let blend = |d: &mut serde_json::Value| {
            d["materials"] = json!([{"name": "pane", "alphaMode": "BLEND"}]);
            d["meshes"][0]["primitives"][0]["material"] = json!(0);
        };
        folder.write("blend.glb", &glb(&positions(), &INDICES, blend));
        let answer = folder.run(&["render", "blend.glb", "--resolution", "32x24", "--size", "32"]);
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert!(answer.err.starts_with("note: ") && answer.err.contains("pane"), "{}", answer.err);
    });
    trials.add("files_choose_scene_pose_and_light", |_| {
        let folder = Folder::new();
        let change = |d: &mut serde_json::Value| {
            d["scenes"] = json!([{"name": "Scratch", "nodes": []}, {"name": "House", "nodes": [0, 1]}]);
            let light = json!({"KHR_lights_punctual": {"light": 1}});
            d["nodes"].as_array_mut().unwrap().push(json!({"extensions": light}));
            let lights = json!([{"type": "point"}, {"type": "directional"}]);
            d["extensions"] = json!({"KHR_lights_punctual": {"lights": lights}});
        };
        folder.write("house.glb", &glb(&positions(), &INDICES, change));
        folder.run(&["render", "house.glb"]).refusal(&["no triangles", "1 'House'", "--scene"]);
        let view = ["--camera", "4,4,4:0,0,0", "--resolution", "32x24", "--size", "32"];
        let house = [&["render", "house.glb", "--scene", "House"], &view[..]].concat();
        folder.run(&[&house[..], &["--light", "1"]].concat()).good();
        folder.run(&[&house[..], &["--light", "0"]].concat()).refusal(&[
            "--light 0",
            "no node",
            "usable are: 1",
        ]);
        folder.run(&[&house[..], &["--time", "1"]].concat()).refusal(&["option time is 1", "no animations"]);
        folder.run(&["render", "contact", "--time", "1"]).refusal(&["--time 1", "built in"]);
    });
    trials.add("spots_of_ninety_degrees", |_| {
        let folder = Folder::new();
        let light = ["render", "contact", "--light", "spot:0,4,0:0,-1,0:90"];
        let answer = folder.run(&[&light[..], &["--resolution", "32x24", "--size", "32"]].concat());
        assert_eq!(answer.code, Some(0), "{}", answer.err);
        assert!(answer.err.starts_with("note: ") && answer.err.contains("90.0° is narrowed to 84.8°"));
    });
}

/// Sizes and names at the ends of what there is.
fn odd_ends(trials: &mut Trials) {
    trials.add("scenes_of_extreme_size", |_| {
        for scale in [1e-30_f32, 1e-12, 1e12, 1e18, 1e30] {
            let folder = Folder::new();
            let scaled: Vec<f32> = positions().iter().map(|v| v * scale).collect();
            folder.write("scaled.glb", &glb(&scaled, &INDICES, |_| ()));
            let small = ["scaled.glb", "--resolution", "32x24", "--size", "32", "--rounds", "1"];
            let answer = folder.run(&[&["compare"], &small[..], &["--grid", "1"]].concat());
            assert_eq!(answer.code, Some(0), "{scale}: {}", answer.err);
            // Nothing degrades in silence: the terminal, the table, the data and the page say so.
            let extreme = !(1e-19..1e14).contains(&scale);
            let page = fs::read_to_string(folder.0.join("report/index.html")).unwrap();
            let data = fs::read_to_string(folder.0.join("report/results.json")).unwrap();
            for text in [&answer.err, &answer.out, &page, &data] {
                assert_eq!(text.contains("do not trust these numbers"), extreme, "{scale}: {text}");
            }
        }
    });
    #[cfg(unix)]
    trials.add("names_that_are_no_unicode", |_| {
        use std::os::unix::ffi::OsStrExt;
        let folder = Folder::new();
        let output = std::ffi::OsStr::from_bytes(b"report-\xff");
        let small = ["compare", "contact", "--resolution", "32x24", "--size", "32", "--rounds", "1"];
        let quick = ["--techniques", "hard", "--grid", "1", "--json", "-o"];
        let arguments = small.iter().chain(&quick).map(|a| std::ffi::OsStr::new(*a)).chain([output]);
        folder.run(&arguments.collect::<Vec<_>>()).good();
        assert!(folder.0.join(output).join("index.html").is_file());
    });
}

fn no_adapter() {
    let folder = Folder::new();
    let hidden = [("VK_DRIVER_FILES", "/nonexistent"), ("VK_ICD_FILENAMES", "/nonexistent")];
    let commands: [&[&str]; 4] =
        [&["render", "contact"], &["compare", "contact"], &["bench", "contact"], &["info"]];
    // Only Vulkan's drivers can be hidden.
    if cfg!(target_os = "linux") {
        for command in commands {
            let words = ["no graphics adapter found", "apt-get install mesa-vulkan-drivers"];
            folder.run_with(command, &hidden).refusal(&words);
            assert_eq!(folder.names().len(), 0);
        }
        for command in ["techniques", "scenes"] {
            folder.run_with(&[command], &hidden).good();
        }
    }
}
