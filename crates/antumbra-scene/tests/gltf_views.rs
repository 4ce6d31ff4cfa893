//! Cameras and lights under the numbers that the file gives them, and how wide spots may be.

#![allow(clippy::unwrap_used, reason = "a failed load is a failed test")]

mod common;

use antumbra_scene::{Light, Scene, import};
use common::quad;
use glam::Vec3;
use serde_json::{Value, json};

fn load(document: &Value) -> Scene {
    import::gltf_bytes(document.to_string().as_bytes(), "test").unwrap()
}

/// The quad with lights, one node for each entry of `uses`.
fn lit(lights: Value, uses: &[u32]) -> Value {
    let mut document = quad();
    document["extensions"] = json!({"KHR_lights_punctual": {"lights": lights}});
    for (i, light) in uses.iter().enumerate() {
        let node = json!({"translation": [i, 0, 0], "extensions": {"KHR_lights_punctual": {"light": light}}});
        document["nodes"].as_array_mut().unwrap().push(node);
        document["scenes"][0]["nodes"].as_array_mut().unwrap().push(json!(i + 1));
    }
    document
}

#[test]
fn lights_keep_the_numbers_of_the_file() {
    let lights = json!([
        {"type": "point", "name": "bulb"},
        {"type": "spot", "name": "lamp", "spot": {"outerConeAngle": 0.5}},
        {"type": "directional"},
        {"type": "directional", "name": "spare"},
    ]);
    let scene = load(&lit(lights, &[2, 1, 0, 1]));
    assert_eq!(scene.light_of_file(2, 0), Ok(Light::Directional { direction: Vec3::NEG_Z }));
    let x = |copy| match scene.light_of_file(1, copy) {
        Ok(Light::Spot { position, .. }) => position.x,
        other => panic!("{other:?}"),
    };
    assert_eq!((x(0), x(1)), (1.0, 3.0), "one lamp in two places");
    let refused = |number, copy| scene.light_of_file(number, copy).unwrap_err();
    assert_eq!(refused(1, 2), "light 1 'lamp' stands in 2 places, 1.0 to 1.1");
    assert_eq!(
        refused(0, 0),
        "light 0 'bulb' (not taken) of type 'point' is left out: only directional lights and spots with a cone of 0 to \
         π/2 are taken; usable are: 1 'lamp', 2"
    );
    assert!(refused(3, 0).contains("is used by no node of the scene that is shown"), "{}", refused(3, 0));
    assert_eq!(
        refused(4, 0),
        "the scene has 4 lights: 0 'bulb' (not taken), 1 'lamp', 2, 3 'spare' (not taken)"
    );
    assert_eq!(scene.notes.len(), 1, "the bulb: {:?}", scene.notes);
}

#[test]
fn cameras_keep_the_numbers_of_the_file() {
    let mut document = quad();
    document["cameras"] = json!([
        {"type": "perspective", "name": "broken", "perspective": {"yfov": 0, "znear": 0.1}},
        {"type": "perspective", "name": "front", "perspective": {"yfov": 0.6, "znear": 0.1}},
    ]);
    document["nodes"] = json!([{"mesh": 0}, {"camera": 1, "translation": [0, 0, 7]}, {"camera": 0}]);
    document["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let scene = load(&document);
    assert_eq!(scene.camera_of_file(1, 0).unwrap().position.z, 7.0);
    let refusal = scene.camera_of_file(0, 0).unwrap_err();
    assert!(
        refusal.starts_with("camera 0 'broken'") && refusal.ends_with("usable are: 1 'front'"),
        "{refusal}"
    );
}

#[test]
fn scenes_without_a_file_number_from_zero() {
    let scene = antumbra_scene::procedural::by_name("contact").unwrap().scene(1);
    assert_eq!(scene.camera_of_file(0, 0), Ok(scene.cameras[0]));
    assert_eq!(scene.light_of_file(7, 0).unwrap_err(), "the scene has 1 light: 0");
    assert_eq!(Scene::default().light_of_file(0, 0).unwrap_err(), "the scene has 0 lights");
}

#[test]
fn wide_spots_are_narrowed_to_what_one_map_holds() {
    let spot = |angle: f64| load(&lit(json!([{"type": "spot", "spot": {"outerConeAngle": angle}}]), &[0]));
    let right = std::f64::consts::FRAC_PI_2;
    for (asked, wanted) in [
        (0.3, 0.3),
        // In single precision less than in double: rounding narrows nothing.
        (1.466, 1.466),
        (84_f64.to_radians(), 84_f32.to_radians()),
        (85_f64.to_radians(), Light::MAX_OUTER_ANGLE),
        (right, Light::MAX_OUTER_ANGLE),
        // Single precision's π/2 is more than π/2.
        (f64::from(right as f32), Light::MAX_OUTER_ANGLE),
    ] {
        let scene = spot(asked);
        let Some(Light::Spot { outer_angle, .. }) = scene.lights.first() else {
            panic!("{asked}: {scene:?}")
        };
        assert!((outer_angle - wanted).abs() < 1e-6, "{asked}: {outer_angle}");
        let narrowed = asked > f64::from(Light::MAX_OUTER_ANGLE);
        assert_eq!(scene.notes.len(), usize::from(narrowed), "{:?}", scene.notes);
    }
    assert_eq!(
        spot(right).notes,
        [
            "lights[0]: the spot's half angle of 90.0° is narrowed to 84.8°, the most that one shadow map holds"
        ]
    );
    assert!(spot(1.7).lights.is_empty(), "no spot any more");
    let mut wide = spot(1.0);
    wide.lights[0] = Light::Spot { position: Vec3::ZERO, direction: Vec3::NEG_Z, outer_angle: 1.5 };
    assert!(wide.validate().unwrap_err().to_string().contains("Light::MAX_OUTER_ANGLE"));
}
