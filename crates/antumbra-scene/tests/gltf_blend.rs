//! Surfaces that let light through: what blends and what transmits.

#![allow(clippy::unwrap_used, reason = "a failed load is a failed test")]

mod common;

use antumbra_scene::{
    AlphaMode, Scene,
    import::{self, Blend, Options},
};
use common::{floats, png_row, quad, with_accessors};
use serde_json::{Value, json};

fn try_load(document: &Value, blend: Blend) -> Result<Scene, String> {
    let mut options = Options::default();
    options.blend = blend;
    import::gltf_bytes_with(document.to_string().as_bytes(), "test", &options).map_err(|e| e.to_string())
}

/// A plain quad and one with a material.
fn with_material(material: Value) -> Value {
    let uvs = floats(&[0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
    let mut document = with_accessors(quad(), &[(uvs, 5126, 4, "VEC2")]);
    document["materials"] = json!([material]);
    let primitive = json!({"attributes": {"POSITION": 0, "TEXCOORD_0": 2}, "indices": 1, "material": 0});
    document["meshes"].as_array_mut().unwrap().push(json!({"primitives": [primitive]}));
    document["nodes"] = json!([{"mesh": 0}, {"mesh": 1, "translation": [0, 0, 1]}]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    document
}

/// Triangles of the scene, the second quad's alpha mode, and the notes.
fn outcome(document: &Value, blend: Blend) -> (usize, AlphaMode, String) {
    let scene = try_load(document, blend).unwrap();
    (scene.flatten().triangle_count(), scene.materials[0].alpha, scene.notes.join("; "))
}

const HALF: AlphaMode = AlphaMode::Mask { cutoff: 0.5 };

#[test]
fn leaves_keep_their_outlines() {
    // Left half there, right half not.
    let mut leaf = with_material(json!({
        "name": "leaf", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
    }));
    leaf["images"] = json!([{"uri": png_row(&[[9, 9, 9, 255], [9, 9, 9, 0]])}]);
    leaf["textures"] = json!([{"source": 0, "sampler": 0}]);
    leaf["samplers"] = json!([{"wrapS": 33071, "wrapT": 33071}]);
    let (triangles, alpha, notes) = outcome(&leaf, Blend::Mask);
    assert_eq!((triangles, alpha), (4, HALF));
    assert!(
        notes.starts_with("material 'leaf': blends; it is there and casts where its alpha is ½"),
        "{notes}"
    );
    let geometry = try_load(&leaf, Blend::Mask).unwrap().flatten();
    // The masked triangles come last; triangle 2 has the corners (0,0), (1,0), (1,1).
    assert!(!geometry.is_cut(2, 0.2, 0.1) && geometry.is_cut(2, 0.3, 0.5));
    assert_eq!(outcome(&leaf, Blend::Cast), (4, AlphaMode::Opaque, String::new()));
    let (triangles, _, notes) = outcome(&leaf, Blend::Ignore);
    assert_eq!(triangles, 2);
    assert_eq!(notes, "material 'leaf': lets light through and is left out, as asked for");
}

#[test]
fn clear_panes_cast_nothing_and_dense_ones_all() {
    let pane = |alpha: f32| {
        with_material(json!({
            "name": "pane", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, alpha]},
        }))
    };
    for alpha in [0.0, 0.15, 0.49] {
        let (triangles, _, notes) = outcome(&pane(alpha), Blend::Mask);
        assert_eq!(triangles, 2, "{alpha}");
        assert!(notes.contains("material 'pane': lets half of the light or more through, so it is left out"));
        assert_eq!(outcome(&pane(alpha), Blend::Cast).0, 4);
    }
    for alpha in [0.5, 1.0] {
        let (triangles, mode, notes) = outcome(&pane(alpha), Blend::Mask);
        assert_eq!((triangles, mode), (4, AlphaMode::Opaque), "{alpha}: {notes}");
        assert!(notes.contains("material 'pane': blends; its alpha is ½ or more everywhere"), "{notes}");
    }
}

#[test]
fn glass_that_transmits_lets_light_through() {
    let glass = |factor: f32| {
        with_material(json!({
            "name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": factor}},
        }))
    };
    for (factor, blend, wanted) in [
        (1.0, Blend::Mask, 2),
        (1.0, Blend::Ignore, 2),
        (1.0, Blend::Cast, 4),
        (0.5, Blend::Mask, 2),
        (0.2, Blend::Mask, 4),
        (0.0, Blend::Mask, 4),
    ] {
        let (triangles, mode, notes) = outcome(&glass(factor), blend);
        assert_eq!((triangles, mode), (wanted, AlphaMode::Opaque), "{factor} {blend:?}");
        assert_eq!(notes.contains("glass"), wanted == 2, "{notes}");
    }
}

#[test]
fn labels_on_bottles_cast() {
    // The left half of the texture transmits, the right half is the label.
    let texture = json!({"index": 0});
    let transmission = json!({"transmissionFactor": 1, "transmissionTexture": texture});
    let mut bottle = with_material(json!({
        "name": "bottle", "extensions": {"KHR_materials_transmission": transmission},
    }));
    bottle["images"] = json!([{"uri": png_row(&[[255, 0, 0, 255], [0, 0, 0, 255]])}]);
    bottle["textures"] = json!([{"source": 0, "sampler": 0}]);
    bottle["samplers"] = json!([{"wrapS": 33071, "wrapT": 33071}]);
    let geometry = try_load(&bottle, Blend::Mask).unwrap().flatten();
    assert_eq!(geometry.triangle_count(), 4);
    assert!(geometry.is_cut(2, 0.2, 0.1) && !geometry.is_cut(2, 0.3, 0.5));
    // With a colour that lies otherwise the two cannot be one image.
    let turned = json!({"index": 0, "extensions": {"KHR_texture_transform": {"offset": [0.5, 0]}}});
    bottle["materials"][0]["pbrMetallicRoughness"] = json!({"baseColorTexture": turned});
    let (triangles, _, notes) = outcome(&bottle, Blend::Mask);
    assert_eq!(triangles, 2);
    assert!(
        notes.contains("material 'bottle': its transmission texture lies otherwise than its colour"),
        "{notes}"
    );
}

#[test]
fn a_scene_of_glass_alone_keeps_its_glass() {
    let mut document = with_material(json!({
        "name": "glass", "extensions": {"KHR_materials_transmission": {"transmissionFactor": 1}},
    }));
    document["scenes"] = json!([{"nodes": [1]}]);
    let (triangles, alpha, notes) = outcome(&document, Blend::Mask);
    assert_eq!((triangles, alpha), (2, AlphaMode::Opaque));
    assert!(notes.starts_with("everything lets half of the light or more through; it is kept"), "{notes}");
    let refusal = try_load(&document, Blend::Ignore).unwrap_err();
    assert!(refusal.contains("has no triangles"), "{refusal}");
    assert!(
        refusal.contains("material 'glass': lets light through and is left out, as asked for"),
        "{refusal}"
    );
}

#[test]
fn masks_are_as_before() {
    let mask = with_material(json!({"alphaMode": "MASK", "alphaCutoff": 0.3}));
    for blend in [Blend::Mask, Blend::Cast, Blend::Ignore] {
        assert_eq!(outcome(&mask, blend), (4, AlphaMode::Mask { cutoff: 0.3 }, String::new()));
    }
}
