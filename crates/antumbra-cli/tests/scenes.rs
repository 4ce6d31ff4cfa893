//! Files whose origin, up axis or parts are not where a renderer wants them.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_testing::Trials;
use common::{Folder, INDICES, glb, positions};
use serde_json::json;

fn main() {
    let mut trials = Trials::default();
    trials.add("scenes_far_from_their_origin", far);
    trials.add("parts_that_stand_in_the_way", in_the_way);
    trials.run();
}

/// Scores of `hard` on a file, and what was said.
fn scores(folder: &Folder, arguments: &[&str]) -> (serde_json::Value, String) {
    let small = ["--resolution", "160x120", "--size", "256", "--rounds", "1", "--grid", "1", "--json"];
    let techniques = ["--techniques", "hard", "pcf"];
    let answer = folder.run(&[&["compare"], arguments, &small[..], &techniques[..]].concat());
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    (serde_json::from_str(&answer.out).unwrap(), answer.err)
}

/// The same scene under the same light, at the origin and at the coordinates of a map.
fn far(_: &antumbra_testing::Gpu) {
    let folder = Folder::new();
    let at = |place: [f64; 3]| glb(&positions(), &INDICES, |d| d["nodes"][0]["translation"] = json!(place));
    folder.write("near.glb", &at([0.0; 3]));
    folder.write("far.glb", &at([500_000.0, 0.0, -5_400_000.0]));
    let light = ["--light", "0.4,-1,-0.3"];
    let near = [&["near.glb", "--camera", "3,5,9:0,0.5,0:25"], &light[..]].concat();
    let far = [&["far.glb", "--camera", "500003,5,-5399991:500000,0.5,-5400000:25"], &light[..]].concat();
    let (near, silence) = scores(&folder, &near);
    let (far, note) = scores(&folder, &far);
    assert_eq!(silence, "");
    assert!(note.contains("note: the scene lies around 500000,0,-5400000"), "{note}");
    assert_eq!(far["scene"]["origin"], json!([500_000.0, 0.0, -5_400_000.0]));
    assert_eq!(near["truth"]["no_shadow"], far["truth"]["no_shadow"]);
    for k in 0..2 {
        assert_eq!(near["techniques"][k]["scores"], far["techniques"][k]["scores"]);
    }
    let shadowed = &near["truth"]["no_shadow"]["pixel_match"];
    assert!(shadowed.as_f64().unwrap() < 0.97, "there is a shadow: {shadowed}");
}

/// A lid over the scene, which has another node and another up axis in the file.
fn in_the_way(_: &antumbra_testing::Gpu) {
    let folder = Folder::new();
    let mut all = positions();
    all.extend([[-8.0, 7.0, -8.0], [-8.0, 7.0, 8.0], [8.0, 7.0, 8.0], [8.0, 7.0, -8.0]].iter().flatten());
    let with_lid = [&INDICES[..], &[8, 9, 10, 8, 10, 11]].concat();
    let two_nodes = |d: &mut serde_json::Value| {
        let indices = |offset: usize, count: usize| json!({"bufferView": 1, "byteOffset": offset, "componentType": 5123, "count": count, "type": "SCALAR"});
        d["accessors"][1] = indices(0, 12);
        d["accessors"].as_array_mut().unwrap().push(indices(24, 6));
        let lid = json!({"primitives": [{"attributes": {"POSITION": 0}, "indices": 2}]});
        d["meshes"].as_array_mut().unwrap().push(lid);
        // A quarter turn about x: the file's z points upwards.
        let turn = [std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2];
        d["nodes"] = json!([
            {"name": "house", "rotation": turn, "children": [1, 2]},
            {"name": "room", "mesh": 0},
            {"name": "roof lid", "mesh": 1},
        ]);
    };
    folder.write("lid.glb", &glb(&all, &with_lid, two_nodes));
    folder.write("open.glb", &glb(&positions(), &INDICES, |_| ()));
    let sun = |arguments: &[&str], light: &str| scores(&folder, &[arguments, &["--light", light]].concat());
    let (open, _) = sun(&["open.glb", "--camera", "3,5,9:0,0.5,0:25"], "0.4,-1,-0.3");
    let turned = ["lid.glb", "--camera", "3,-9,5:0,0,0.5:25", "--up", "z"];
    let (shut, _) = sun(&turned, "0.4,0.3,-1");
    let (left, note) = sun(&[&turned[..], &["--leave-out", "*lid"]].concat(), "0.4,0.3,-1");
    assert!(note.contains("1 of 2 parts are left out by name"), "{note}");
    let dark = |results: &serde_json::Value| results["truth"]["no_shadow"]["pixel_match"].as_f64().unwrap();
    assert!((dark(&open) - dark(&left)).abs() < 2e-3, "{} {}", dark(&open), dark(&left));
    assert!(dark(&shut) < dark(&open) - 0.1, "the lid shades the room: {}", dark(&shut));
}
