//! Which scene of a file is shown, and in which pose.

#![allow(clippy::unwrap_used, reason = "a failed load is a failed test")]

mod common;

use antumbra_scene::{
    Scene,
    import::{self, Options},
};
use common::{floats, quad, with_accessors};
use glam::Vec3;
use serde_json::{Value, json};

/// What is done to a good document.
type Change = fn(&mut Value);

const FLOAT: u32 = 5126;

fn options(change: impl FnOnce(&mut Options)) -> Options {
    let mut options = Options::default();
    change(&mut options);
    options
}

fn try_load(document: &Value, options: &Options) -> Result<Scene, String> {
    import::gltf_bytes_with(document.to_string().as_bytes(), "test", options).map_err(|e| e.to_string())
}

/// Largest corner of the scene at a moment.
fn max_at(document: &Value, time: f64) -> Vec3 {
    let scene = try_load(document, &options(|o| o.time = Some(time))).unwrap();
    scene.flatten().bounds().unwrap().max
}

/// The quad with an animation of one channel, keys at 1 s and 3 s.
fn animated(path: &str, interpolation: &str, values: &[f32], shape: &str) -> Value {
    let count = match shape {
        "VEC3" => values.len() / 3,
        "VEC4" => values.len() / 4,
        _ => values.len(),
    };
    let pieces = [(floats(&[1.0, 3.0]), FLOAT, 2, "SCALAR"), (floats(values), FLOAT, count, shape)];
    let mut document = with_accessors(quad(), &pieces);
    document["animations"] = json!([{
        "name": "move",
        "samplers": [{"input": 2, "output": 3, "interpolation": interpolation}],
        "channels": [{"sampler": 0, "target": {"node": 0, "path": path}}],
    }]);
    document
}

#[test]
fn steps_lines_and_splines() {
    let step = animated("translation", "STEP", &[0.0, 0.0, 1.0, 0.0, 0.0, 5.0], "VEC3");
    let line = animated("translation", "LINEAR", &[0.0, 0.0, 1.0, 0.0, 0.0, 5.0], "VEC3");
    // Tangents of 2 a second at both keys, whose values are 1 and 5: a straight line once more; and
    // flat tangents: 3t² − 2t³ at a quarter of the way.
    let spline = |slope: f32| {
        let key = |z: f32| [0.0, 0.0, slope, 0.0, 0.0, z, 0.0, 0.0, slope];
        animated("translation", "CUBICSPLINE", &[key(1.0), key(5.0)].concat(), "VEC3")
    };
    for (time, [stepped, straight]) in [
        (0.0, [1.0, 1.0]),
        (1.0, [1.0, 1.0]),
        (1.5, [1.0, 2.0]),
        (2.9, [1.0, 4.8]),
        (3.0, [5.0, 5.0]),
        (9.0, [5.0, 5.0]),
    ] {
        assert!((max_at(&step, time).z - stepped).abs() < 1e-6, "{time}");
        assert!((max_at(&line, time).z - straight).abs() < 1e-6, "{time}");
        assert!((max_at(&spline(2.0), time).z - straight).abs() < 1e-6, "{time}");
    }
    assert!((max_at(&spline(0.0), 1.5).z - (1.0 + 4.0 * 0.156_25)).abs() < 1e-6);
}

#[test]
fn rotations_go_the_short_way_round_at_even_speed() {
    // From 0° to 90° about z, the second key negated, and neither of length 1 as rounding has it.
    let half = std::f32::consts::FRAC_PI_8 * 2.0;
    let keys = [0.0, 0.0, 0.0, 1.0001, 0.0, 0.0, -half.sin(), -half.cos()];
    let document = animated("rotation", "LINEAR", &keys, "VEC4");
    // A third of the way is 30°: the corner (1, 0) is at (cos 30°, sin 30°), (0, 1) at (−sin 30°, cos 30°).
    let found = max_at(&document, 1.0 + 2.0 / 3.0);
    let angle = 30_f32.to_radians();
    assert!((found.x - angle.cos()).abs() < 1e-5, "{found}");
    assert!((found.y - (angle.cos() + angle.sin())).abs() < 1e-5, "{found}");
    // Matrices give way to what moves them.
    let mut with_matrix = document.clone();
    with_matrix["nodes"][0]["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 0, 0, 1]);
    assert!((max_at(&with_matrix, 1.0).x - 8.0).abs() < 1e-5);
}

#[test]
fn morph_weights_scales_and_skins_follow() {
    let lift: Vec<f32> = [0.0, 0.0, 2.0].repeat(4);
    let weights: Vec<f32> = [1.0, 0.0, 0.0, 0.0].repeat(4);
    let pieces = [
        (floats(&[0.0, 1.0]), FLOAT, 2, "SCALAR"),
        (floats(&[0.0, 1.0]), FLOAT, 2, "SCALAR"),
        (floats(&[1.0, 1.0, 1.0, 3.0, 1.0, 1.0]), FLOAT, 2, "VEC3"),
        (floats(&lift), FLOAT, 4, "VEC3"),
        (floats(&weights), FLOAT, 4, "VEC4"),
        (vec![0; 16], 5121, 4, "VEC4"),
    ];
    let mut document = with_accessors(quad(), &pieces);
    document["meshes"][0]["primitives"][0] = json!({
        "attributes": {"POSITION": 0, "WEIGHTS_0": 6, "JOINTS_0": 7}, "indices": 1, "targets": [{"POSITION": 5}],
    });
    document["skins"] = json!([{"joints": [1]}]);
    document["nodes"] = json!([{"mesh": 0, "skin": 0}, {"translation": [10, 0, 0]}]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    document["animations"] = json!([{
        "samplers": [{"input": 2, "output": 3}, {"input": 2, "output": 4}],
        "channels": [
            {"sampler": 0, "target": {"node": 0, "path": "weights"}},
            {"sampler": 1, "target": {"node": 1, "path": "scale"}},
        ],
    }]);
    assert_eq!(max_at(&document, 0.0), Vec3::new(11.0, 1.0, 0.0));
    assert_eq!(max_at(&document, 0.5), Vec3::new(12.0, 1.0, 1.0));
    assert_eq!(max_at(&document, 1.0), Vec3::new(13.0, 1.0, 2.0));
}

#[test]
fn the_pose_is_told_and_can_be_chosen() {
    let mut document = animated("translation", "LINEAR", &[0.0, 0.0, 1.0, 0.0, 0.0, 5.0], "VEC3");
    let rest = try_load(&document, &Options::default()).unwrap();
    assert_eq!(rest.flatten().bounds().unwrap().max.z, 0.0);
    assert_eq!(
        rest.notes,
        ["the file has 1 animation: 0 'move'; the pose at rest is shown; another with --time SECONDS"]
    );
    let late = try_load(&document, &options(|o| o.time = Some(4.0))).unwrap();
    assert_eq!(late.notes, ["animations[0] lasts from 1 to 3 s; at 4 s it shows the pose of its end"]);
    let still = document["animations"][0].clone();
    document["animations"]
        .as_array_mut()
        .unwrap()
        .insert(0, json!({"name": "still", "channels": [], "samplers": []}));
    assert_eq!(max_at(&document, 3.0).z, 0.0, "the first of two");
    let named = |name: &str| {
        try_load(&document, &options(|o| (o.animation, o.time) = (Some(name.into()), Some(3.0))))
    };
    for name in ["1", "move"] {
        assert_eq!(named(name).unwrap().flatten().bounds().unwrap().max.z, 5.0);
    }
    assert_eq!(
        named("jump").unwrap_err(),
        "test: option animation is 'jump'; allowed is the number or name of one of the file's animations: 0 \
         'still', 1 'move'"
    );
    let pointer = json!({"sampler": 0, "target": {"path": "pointer", "extensions": {}}});
    document["animations"] = json!([still]);
    document["animations"][0]["channels"] = json!([pointer, pointer]);
    let told = try_load(&document, &options(|o| o.time = Some(2.0))).unwrap().notes.join("");
    assert_eq!(
        told,
        "animations[0].channels[0], animations[0].channels[1]: left out: channels with the path 'pointer' are not \
         read"
    );
}

#[test]
fn broken_animations_are_refused_where_they_are_asked_for() {
    let good = || animated("translation", "LINEAR", &[0.0, 0.0, 1.0, 0.0, 0.0, 5.0], "VEC3");
    let refusal = |change: fn(&mut Value)| {
        let mut document = good();
        change(&mut document);
        assert!(try_load(&document, &Options::default()).is_ok(), "at rest it does not matter");
        try_load(&document, &options(|o| o.time = Some(2.0))).unwrap_err()
    };
    let cases: [(Change, &str); 7] = [
        (|d| d["animations"] = json!([]), "option time is 2; the file has no animations; leave it out"),
        (
            |d| d["animations"][0]["channels"][0]["sampler"] = json!(4),
            "animations[0].channels[0].sampler is 4; samplers has the indices 0 to 0",
        ),
        (
            |d| d["animations"][0]["channels"][0]["target"]["node"] = json!(4),
            "animations[0].channels[0].target.node is 4; nodes has the indices 0 to 0",
        ),
        (
            |d| d["animations"][0]["samplers"][0]["interpolation"] = json!("BEZIER"),
            "animations[0].samplers[0].interpolation: unknown variant `BEZIER`",
        ),
        (
            |d| d["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE"),
            "animations[0].samplers[0].output is 2 elements; 2 times of 3 values each are needed",
        ),
        (
            |d| d["animations"][0]["channels"][0]["target"]["path"] = json!("rotation"),
            "animations[0].samplers[0].output is VEC3 F32; a Rotation must be VEC4",
        ),
        (
            |d| d["animations"][0]["samplers"][0]["input"] = json!(0),
            "animations[0].samplers[0].input is VEC3 F32; it must be SCALAR F32",
        ),
    ];
    for (change, message) in cases {
        let found = refusal(change);
        assert!(found.starts_with(&format!("test: {message}")), "{found}");
    }
    let mut document = good();
    document["accessors"][2]["count"] = json!(1);
    document["accessors"][3]["count"] = json!(1);
    assert_eq!(max_at(&document, 2.0).z, 1.0, "one key holds for ever");
    let backwards = [(floats(&[3.0, 1.0]), FLOAT, 2, "SCALAR"), (floats(&[0.0; 6]), FLOAT, 2, "VEC3")];
    let mut document = with_accessors(quad(), &backwards);
    document["animations"] = good()["animations"].clone();
    let found = try_load(&document, &options(|o| o.time = Some(2.0))).unwrap_err();
    assert!(
        found.contains("animations[0].samplers[0].input[1] is 1; times must be finite and increase"),
        "{found}"
    );
}

#[test]
fn scenes_are_told_and_can_be_chosen() {
    let mut document = quad();
    document["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "translation": [0, 0, 4]}]);
    document["scenes"] =
        json!([{"name": "Scratch", "nodes": []}, {"name": "House", "nodes": [0, 1]}, {"nodes": [0]}]);
    let choose = |scene: &str| {
        try_load(&document, &options(|o| o.scene = Some(scene.into()))).map(|s| s.flatten().triangle_count())
    };
    assert_eq!((choose("1"), choose("House"), choose("2")), (Ok(4), Ok(4), Ok(2)));
    let empty = choose("0").unwrap_err();
    assert!(empty.contains("has no triangles"), "{empty}");
    assert_eq!(
        choose("Home").unwrap_err(),
        "test: option scene is 'Home'; allowed is the number or name of one of the file's scenes: 0 'Scratch', 1 \
         'House', 2"
    );
    // The default one is empty: the refusal says which others there are.
    let refusal = try_load(&document, &Options::default()).unwrap_err();
    assert!(refusal.contains("has no triangles"), "{refusal}");
    assert!(
        refusal.contains("3 scenes: 0 'Scratch', 1 'House', 2; 0 'Scratch' is shown (the default)"),
        "{refusal}"
    );
    assert!(refusal.contains("another one with --scene"), "{refusal}");
    document["scenes"].as_array_mut().unwrap().remove(0);
    document.as_object_mut().unwrap().remove("scene");
    let scene = try_load(&document, &Options::default()).unwrap();
    assert_eq!(scene.flatten().triangle_count(), 4);
    assert!(
        scene.notes[0].contains("0 'House' is shown (the first, none is the default)"),
        "{:?}",
        scene.notes
    );
}

#[test]
fn other_formats_have_no_scenes() {
    let file = std::env::temp_dir().join(format!("antumbra-poses-{}.obj", std::process::id()));
    std::fs::write(&file, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let found = import::load_with(&file, &options(|o| o.time = Some(0.5)));
    let plain = import::load_with(&file, &Options::default());
    std::fs::remove_file(&file).unwrap();
    assert!(plain.is_ok());
    let found = found.unwrap_err().to_string();
    assert!(
        found.ends_with("option time is '0.5'; OBJ files have neither scenes nor animations; leave it out")
    );
}
