//! Scenes at the coordinates of maps are what they are at the origin.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_scene::{Scene, import};
use common::{SQUARE, floats, quad, shorts, with_buffer};
use glam::{DVec3, Vec3};
use serde_json::{Value, json};

fn load(document: &Value) -> Scene {
    import::gltf_bytes(document.to_string().as_bytes(), "far").unwrap()
}

/// A quad on a node below one that stands at `place`, with a camera and a lamp beside it.
fn house(place: DVec3) -> Value {
    let mut document = quad();
    document["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]);
    let lamp = json!([{"type": "spot", "spot": {"outerConeAngle": 0.3}}]);
    document["extensions"] = json!({"KHR_lights_punctual": {"lights": lamp}});
    document["nodes"] = json!([
        {"name": "map", "translation": place.to_array(), "children": [1, 2, 3]},
        {"mesh": 0, "translation": [0.1, 0.2, 0.3], "rotation": [0.0, 0.6, 0.0, 0.8]},
        {"camera": 0, "translation": [1.1, 2.7, 3.3]},
        {"translation": [0.3, 4.1, 0.7], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    ]);
    document["scenes"] = json!([{"nodes": [0]}]);
    document["scene"] = json!(0);
    document
}

/// Everything that a scene places, relative to a point of the file.
fn places(scene: &Scene, around: DVec3) -> Vec<DVec3> {
    let camera = scene.cameras[0];
    let antumbra_scene::Light::Spot { position, .. } = scene.lights[0] else { panic!("not a spot") };
    let views = [camera.position, camera.target, position];
    let points = scene.flatten().positions.into_iter().chain(views);
    points.map(|p: Vec3| scene.placement.in_file(p) - around).collect()
}

#[test]
fn a_translated_root_loses_nothing() {
    let near = load(&house(DVec3::ZERO));
    assert_eq!(near.placement.origin, DVec3::ZERO);
    let expected = places(&near, DVec3::ZERO);
    // UTM, Web Mercator, Earth-centred.
    for place in [
        DVec3::new(500_000.0, 0.0, -5_400_000.0),
        DVec3::new(1_492_237.4, 35.0, -6_894_699.8),
        DVec3::new(4_180_374.2, 855_123.7, 4_725_812.9),
    ] {
        let far = load(&house(place));
        for (a, b) in places(&far, place).into_iter().zip(&expected) {
            assert!(a.distance(*b) < 2e-6, "{a} is not {b} at {place}");
        }
        assert!(far.notes.iter().any(|n| n.contains("in its file")), "{:?}", far.notes);
    }
}

#[test]
fn vertices_that_are_coarse_in_the_file_are_told_about() {
    // The quad's own positions, four million units away, brought back by its node.
    let far: Vec<f32> = SQUARE.chunks(3).flat_map(|p| [p[0] + 4e6, p[1], p[2]]).collect();
    let mut document = with_buffer(quad(), &[floats(&far), shorts(&[0, 1, 2, 0, 2, 3])].concat());
    document["nodes"][0]["translation"] = json!([-4e6, 0.0, 0.0]);
    let scene = load(&document);
    assert!(scene.notes.iter().any(|n| n.contains("steps of up to 0.25 units")), "{:?}", scene.notes);
    assert!(scene.flatten().positions.iter().all(|p| p.length() < 10.0));
}
