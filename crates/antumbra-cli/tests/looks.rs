//! A technique looked at alone: its curve, its maps.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_lab::results::Results;
use antumbra_testing::Trials;
use common::{Folder, png_size};
use serde_json::Value;
use std::fs;

fn main() {
    let mut trials = Trials::default();
    trials.add("curves", |_| curves());
    trials.add("maps", |_| maps());
    trials.add("classes", |_| classes());
    trials.add("cascades", |_| cascades());
    trials.add("biases", |_| biases());
    trials.add("kernels", |_| kernels());
    trials.add_plain("refusals", refusals);
    trials.run();
}

fn curves() {
    let folder = Folder::new();
    let plain = folder.run(&["curve", "hard", "esm", "/", "csm.lift=none", "--points", "3"]).good();
    assert_eq!(plain, "curve.svg\n");
    let svg = fs::read_to_string(folder.0.join("curve.svg")).unwrap();
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n") && svg.contains(">csm.lift=none<"));
    let some = ["curve", "hard", "csm.lift=none", "--range", "-0.1,0.3", "--points", "3", "--json"];
    let values = folder.run(&[&some[..], &["-o", "new/x.png"]].concat()).good();
    assert!(png_size(&folder.0.join("new/x.png"))[0] > 600);
    let values: Value = serde_json::from_str(&values).unwrap();
    assert_eq!(values["schema"], "antumbra-curve/1");
    let [hard, csm] = [0, 1].map(|i| &values["panels"][0][i]);
    assert_eq!(
        (hard["technique"].as_str(), csm["technique"].as_str()),
        (Some("hard"), Some("csm.lift=none"))
    );
    let numbers = |curve: &Value, key: &str| -> Vec<f64> {
        curve[key].as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
    };
    let close = |a: &[f64], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 0.05);
    assert!(close(&numbers(hard, "behind"), [-0.1, 0.1, 0.3]), "{hard}");
    for curve in [hard, csm] {
        assert!(close(&numbers(curve, "visibility"), [1.0, 0.0, 0.0]), "{curve}");
    }
    assert_eq!(folder.names().len(), 3, "{:?}", folder.names());
}

/// In every command that draws: as many views as were asked for, and pictures in their colours.
fn cascades() {
    let folder = Folder::new();
    let small = ["--resolution", "64x48", "--size", "128", "--cascades", "3"];
    let run = |arguments: &[&str]| folder.run(&[arguments, &small[..]].concat()).good();
    let drawn = run(&["render", "contact", "-t", "pcf", "--show", "cascades", "-o", "cascades.png"]);
    assert_eq!(drawn.matches("of the pixels that see geometry").count(), 3, "{drawn}");
    assert_eq!(png_size(&folder.0.join("cascades.png")), [64, 48]);
    let json =
        run(&["compare", "contact", "--techniques", "hard", "vsm", "--grid=1", "--rounds=1", "--json"]);
    let results: Results = serde_json::from_str(&json).unwrap();
    assert_eq!((results.run.views.len(), results.cascades.as_deref()), (3, Some("cascades.png")));
    assert!(folder.0.join("report/cascades.png").is_file());
    let page = fs::read_to_string(folder.0.join("report/index.html")).unwrap();
    assert!(page.contains("Cascades in colour") && page.contains("3 cascades"));
    let bench: Value =
        serde_json::from_str(&run(&["bench", "contact", "--techniques", "hard", "pcf", "--json"])).unwrap();
    assert_eq!(bench["views"].as_array().unwrap().len(), 3);
    assert_eq!(bench["techniques"][0]["time"]["frame_ratio_to_hard"], 1.0);
    assert!(bench["techniques"][1]["time"]["frame_ratio_to_hard"].is_number(), "{bench}");
    let names: Vec<&str> = ["name", "spec", "title", "family", "time", "memory", "work"].into();
    assert!(names.iter().all(|name| !bench["techniques"][1][name].is_null()), "{bench}");
    let flicker = run(&["flicker", "contact", "--techniques", "hard", "--frames=2", "--json"]);
    assert_eq!(serde_json::from_str::<Value>(&flicker).unwrap()["cascades"], 3);
    run(&["maps", "contact", "-t", "vsm"]);
    for name in ["cascade-0-depth.png", "cascade-2-depth.png", "cascade-2-moments-0-r.png"] {
        assert!(folder.0.join("maps").join(name).is_file(), "{name}: {:?}", folder.names());
    }
    let bias = run(&["bias", "contact", "--techniques", "hard", "--settings", "auto", "none"]);
    assert!(bias.contains("RMSE of auto"), "{bias}");
    let truth = ["render", "contact", "-t", "truth", "--show", "cascades", "-o", "x.png"];
    folder.run(&truth).refusal(&["--show cascades", "--technique"]);
    // A spot has one view, and says so.
    let spot = folder.run(&[&["render", "spot", "-t", "pcf", "-o", "spot.png"][..], &small[..]].concat());
    assert!(spot.code == Some(0) && spot.err.contains("a spot has one view"), "{spot:?}");
}

fn maps() {
    let folder = Folder::new();
    let small = ["maps", "contact", "--resolution", "32x24", "--size", "64"];
    let table = folder.run(&[&small[..], &["-t", "csm.terms=4", "-o", "out"]].concat()).good();
    let sizes = |names: &[&str]| names.iter().all(|n| png_size(&folder.0.join("out").join(n)) == [64, 64]);
    let channels = ["basis-0-r.png", "basis-0-a.png", "basis-1-b.png", "depth.png"];
    assert!(sizes(&channels) && channels.iter().all(|name| table.contains(name)), "{table}");
    // Folder, depth, two layers of four channels, sheet, index.
    assert_eq!(folder.names().len(), 1 + 1 + 8 + 1 + 1, "{:?}", folder.names());
    // Another technique takes their place.
    // Seen along the light, spheres are deeper than a box on a floor: the map spans many powers of ten.
    let spheres = ["maps", "spheres", "--resolution", "32x24", "--size", "64"];
    let esm = ["-t", "esm", "--level", "1", "-o", "out", "--json"];
    let index: Value = serde_json::from_str(&folder.run(&[&spheres[..], &esm].concat()).good()).unwrap();
    assert_eq!(folder.names().len(), 1 + 1 + 1 + 1 + 1, "{:?}", folder.names());
    assert_eq!(png_size(&folder.0.join("out/exponentials-0-r.png")), [32, 32]);
    let exponentials = &index["pictures"][1];
    assert_eq!((exponentials["scale"].as_str(), index["level"].as_u64()), (Some("log"), Some(1)));
    assert!(exponentials["largest"].as_f64() <= Some(80_f64.exp() * 1.001), "{exponentials}");
    let alone = folder.run(&[&small[..], &["-t", "hard", "-o", "alone"]].concat()).good();
    assert!(alone.contains("depth.png"), "{alone}");
    let deep = [&small[..], &["-t", "esm", "--level", "9", "-o", "deep"]].concat();
    folder.run(&deep).refusal(&["--level 9", "exponentials of esm", "0 to 6"]);
    assert!(!folder.0.join("deep").exists());
}

fn classes() {
    let folder = Folder::new();
    // From overhead, so that the ground is at one depth and never fails by itself.
    let small = ["layers", "--light", "0,-1,0", "--resolution", "160x120", "--size", "256"];
    let spec = "esm.kernel=7";
    let picture = ["render", "-t", spec, "--show", "classes", "-o", "red.png"];
    let told = folder.run(&[&picture[..], &small[..]].concat()).good();
    let share = told.split_once("assumption violated: ").unwrap().1.split_once(" %").unwrap().0;
    let share: f64 = share.parse().unwrap();
    assert!((0.5..20.0).contains(&share), "{told}");
    let [width, height] = png_size(&folder.0.join("red.png"));
    assert_eq!([width, height], [160, 120]);
    let quick = ["compare", "--techniques", spec, "hard", "--rounds", "1", "--grid", "1", "-o", "report"];
    let table = folder.run(&[&quick[..], &small[..]].concat()).good();
    assert!(table.contains(&format!("{spec}: assumption violated in {share:.2} %")), "{table}");
    let results = Results::read(&folder.0.join("report/results.json")).unwrap();
    let [esm, hard] = [0, 1].map(|i| &results.techniques[i]);
    assert!((100.0 * esm.classes[0].share - share).abs() < 0.01 && hard.classes.is_empty());
    assert!(hard.images.classes.is_none());
    assert_eq!(png_size(&folder.0.join("report").join(esm.images.classes.as_ref().unwrap())), [160, 120]);
    let page = fs::read_to_string(folder.0.join("report/index.html")).unwrap();
    assert!(page.contains("Kinds of pixels") && page.contains("assumption violated"));
}

fn biases() {
    let folder = Folder::new();
    let small = ["--resolution", "96x72", "--size", "256"];
    let bias = ["bias", "contact", "layers", "--techniques", "hard"];
    let table = folder.run(&[&bias[..], &small[..]].concat()).good();
    assert!(table.contains("contact\n") && table.contains("layers\n"), "{table}");
    // In both scenes, and over both.
    assert_eq!(table.matches("constant_texels=1,slope_texels=2  ").count(), 3, "{table}");
    let some = ["--settings", "none", "receiver_plane=1,constant_texels=2", "--json"];
    let rows: Value =
        serde_json::from_str(&folder.run(&[&bias[..], &small[..], &some[..]].concat()).good()).unwrap();
    assert_eq!((&rows["schema"], &rows["scenes"][1]["scene"]), (&"antumbra-bias/1".into(), &"layers".into()));
    let [none, plane] = [0, 1].map(|i| &rows["scenes"][0]["rows"][i]);
    assert_eq!(plane["bias"], "constant_texels=2,receiver_plane=1");
    assert!(none["acne"].as_f64().unwrap() > 0.2 && plane["acne"].as_f64().unwrap() < 0.01, "{rows}");
    // The same by eye.
    let dark = |bias: &str| {
        let picture =
            ["render", "contact", "-t", "hard", "--show", "visibility", "-o", "v.png", "--bias", bias];
        folder.run(&[&picture[..], &small[..]].concat()).good();
        fs::read(folder.0.join("v.png")).unwrap()
    };
    assert!(dark("none") != dark("auto") && dark("auto") == dark("auto"));
}

fn kernels() {
    let folder = Folder::new();
    let small =
        ["kernels", "contact", "--resolution", "96x72", "--size", "256", "--rounds", "1", "--grid", "1"];
    let more = ["--kernels", "3", "4", "--techniques", "pcf", "esm", "--json"];
    let rows: Value = serde_json::from_str(&folder.run(&[&small[..], &more[..]].concat()).good()).unwrap();
    let names: Vec<&str> =
        rows.as_array().unwrap().iter().map(|r| r["technique"].as_str().unwrap()).collect();
    // A blur has odd kernels only.
    assert_eq!(names, ["pcf", "esm", "pcf.kernel=4"]);
    assert_eq!((rows[0]["lookups"].as_u64(), rows[1]["lookups"].as_u64()), (Some(4), Some(1)));
    assert!(rows[2]["rmse_light_space"].as_f64().unwrap() > 0.0);
}

fn refusals() {
    let folder = Folder::new();
    let cases: &[(&[&str], &[&str])] = &[
        (&["curve"], &["<TECHNIQUE>"]),
        (&["curve", "cms"], &["'cms'", "did you mean csm?"]),
        (&["curve", "csm", "csm"], &["'csm'", "twice"]),
        (&["curve", "csm", "/"], &["panel is empty"]),
        (&["curve", "csm", "-o", "x.jpg"], &["x.jpg", ".svg or .png"]),
        (&["curve", "csm", "--range", "0.1,-0.1"], &["--range 0.1,-0.1", "rising"]),
        (&["curve", "csm", "--range", "-0.1,nan"], &["--range -0.1,nan", "two numbers"]),
        (&["curve", "csm", "--range", "-0.4,0.1", "--caster", "0.2"], &["--range -0.4,0.1", "-0.2 to 0.8"]),
        (&["curve", "csm", "--caster", "-1"], &["--caster -1", "0 to 1"]),
        (&["curve", "csm", "--points", "1"], &["--points 1", "2 to 65536"]),
        (&["maps", "contact", "-t", "all"], &["--technique all", "one technique"]),
        (&["maps", "contact", "-t", "cms"], &["'cms'", "did you mean csm?"]),
        (&["bias"], &["<SCENE>"]),
        (&["bias", "contact", "--settings", "slope=1"], &["'slope=1'", "no 'slope'", "slope_texels"]),
        (&["bias", "contact", "--settings", "slope_texels=inf"], &["bias.slope_texels", "inf", "finite"]),
        (&["bias", "contact", "--settings", "much"], &["'much'", "auto, none"]),
        (&["bias", "garden"], &["'garden'", "contact"]),
        (&["render", "contact", "--bias", "much"], &["'much'", "auto, none"]),
        (&["kernels", "contact", "--kernels", "0"], &["--kernel 0", "1 to 31"]),
        (&["kernels", "contact", "--techniques", "cms"], &["'cms'", "did you mean csm?"]),
        (&["kernels", "contact", "--rounds", "0"], &["--rounds 0"]),
        (&["maps", "garden"], &["'garden'", "contact"]),
        (&["render", "contact", "-t", "hard", "--show", "classes"], &["--show classes", "hard"]),
        (&["render", "contact", "-t", "truth", "--show", "classes"], &["--show classes", "truth"]),
        (&["render", "contact", "--show", "classes", "-o", "x.exr"], &["EXR", ".png"]),
    ];
    for (arguments, words) in cases {
        folder.run(arguments).refusal(words);
    }
    folder.write("taken", b"mine");
    folder.run(&["maps", "contact", "-o", "taken"]).refusal(&["taken", "it is a file"]);
    fs::create_dir(folder.0.join("thesis")).unwrap();
    folder.write("thesis/chapter1.tex", b"years of work");
    folder.run(&["maps", "contact", "-o", "thesis"]).refusal(&["thesis", "flicker.json of this program"]);
    assert_eq!(folder.names().len(), 3, "nothing is written: {:?}", folder.names());
}
