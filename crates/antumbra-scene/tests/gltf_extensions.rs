//! Extensions: those that are read, those that move no triangle, those that are refused; and other
//! liberties that files take.

#![allow(clippy::unwrap_used, reason = "a failed load is a failed test")]

mod common;

use antumbra_scene::{Scene, import};
use common::{base64, png_row, quad, quad_bytes, with_buffer};
use glam::Vec3;
use serde_json::{Value, json};

/// What is done to a good document.
type Change = fn(&mut Value);

fn try_load(document: &Value) -> Result<Scene, String> {
    import::gltf_bytes(document.to_string().as_bytes(), "test").map_err(|e| e.to_string())
}

fn load(document: &Value) -> Scene {
    try_load(document).unwrap()
}

fn triangles(document: &Value) -> usize {
    load(document).flatten().triangle_count()
}

#[test]
fn what_moves_no_triangle_may_be_required() {
    let harmless = [
        "KHR_materials_unlit",
        "KHR_materials_variants",
        "KHR_lights_image_based",
        "EXT_lights_ies",
        "KHR_texture_basisu",
        "EXT_texture_avif",
        "EXT_structural_metadata",
        "EXT_mesh_features",
        "KHR_xmp_json_ld",
        "KHR_animation_pointer",
    ];
    for name in harmless {
        let mut document = quad();
        document["extensionsRequired"] = json!([name]);
        document["extensionsUsed"] = json!([name]);
        let scene = load(&document);
        let said =
            format!("extensionsRequired: {name} is not read; what such extensions say moves no triangle");
        assert_eq!(scene.notes, [said]);
    }
    let mut document = quad();
    let read =
        ["KHR_node_visibility", "MSFT_lod", "CESIUM_RTC", "EXT_meshopt_compression", "EXT_texture_webp"];
    document["extensionsRequired"] = json!(read);
    document["extensionsUsed"] = json!([&read[..], &["FAKE_thing", "FAKE_other"]].concat());
    let notes = load(&document).notes;
    assert_eq!(notes.len(), 1, "{notes:?}");
    assert!(
        notes[0].starts_with("FAKE_thing, FAKE_other: this extension is not known and not read"),
        "{notes:?}"
    );
}

#[test]
fn draco_is_refused_only_where_nothing_else_is_there() {
    let mut document = quad();
    document["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    let compressed = json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}});
    document["meshes"][0]["primitives"][0]["extensions"] = compressed;
    assert_eq!(triangles(&document), 2, "plain vertices beside the compressed ones");
    for accessor in document["accessors"].as_array_mut().unwrap() {
        accessor.as_object_mut().unwrap().remove("bufferView");
    }
    let refusal = try_load(&document).unwrap_err();
    assert!(
        refusal.contains("meshes[0].primitives[0].extensions names KHR_draco_mesh_compression"),
        "{refusal}"
    );
    assert!(refusal.contains("decode it with `gltf-transform copy in.glb out.glb`"), "{refusal}");
}

#[test]
fn hidden_nodes_are_left_out_with_all_below() {
    let hidden = json!({"KHR_node_visibility": {"visible": false}});
    let light = json!({"KHR_lights_punctual": {"light": 0}, "KHR_node_visibility": {"visible": true}});
    let mut document = quad();
    document["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "directional"}]}});
    document["cameras"] = json!([{"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}}]);
    document["nodes"] = json!([
        {"mesh": 0},
        {"mesh": 0, "children": [2, 3], "extensions": hidden},
        {"mesh": 0, "extensions": light},
        {"camera": 0},
    ]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    let scene = load(&document);
    assert_eq!(scene.flatten().triangle_count(), 2);
    assert_eq!((scene.lights.len(), scene.cameras.len()), (0, 1), "cameras see even so");
    assert_eq!(scene.notes, ["nodes[1], nodes[2], nodes[3]: left out: hidden (KHR_node_visibility)"]);
    document["nodes"][1]["extensions"] = json!({"KHR_node_visibility": {}});
    assert_eq!(triangles(&document), 6, "visible unless it says otherwise");
}

#[test]
fn only_the_finest_level_of_detail_is_there() {
    let mut document = quad();
    document["nodes"] = json!([
        {"mesh": 0, "extensions": {"MSFT_lod": {"ids": [1, 2]}}},
        {"mesh": 0, "children": [3]},
        {"mesh": 0},
        {"mesh": 0},
    ]);
    document["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let scene = load(&document);
    assert_eq!(scene.flatten().triangle_count(), 2);
    assert_eq!(scene.notes, ["nodes[1], nodes[2]: left out: a coarser level of detail (MSFT_lod)"]);
    document["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = json!([9]);
    let refusal = try_load(&document).unwrap_err();
    assert!(
        refusal.contains("nodes[0].extensions.MSFT_lod.ids is 9; nodes has the indices 0 to 3"),
        "{refusal}"
    );
}

#[test]
fn a_relative_centre_moves_everything() {
    let mut document = quad();
    document["nodes"] = json!([{"children": [1], "scale": [2, 2, 2]}, {"mesh": 0}]);
    document["extensions"] = json!({"CESIUM_RTC": {"center": [10, 20, 30]}});
    let bounds = load(&document).flatten().bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), (Vec3::new(10.0, 20.0, 30.0), Vec3::new(12.0, 22.0, 30.0)));
}

/// The quad's positions and indices as meshoptimizer 1.3 packs them, vertices by versions 0 and 1.
const PACKED: [&str; 2] = [
    "oAAAATMAAAD//wEzAAAAfn0AAAEMAAAA/wEMAAAAfgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA==",
    "ofrqqgAAAP8AfwB+AAB/AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAEBAA==",
];
const PACKED_INDICES: &str = "4fAAAHaHVmd4qYZliWiYAWkAAA==";

fn compressed(name: &str, vertices: &str) -> Value {
    let mut document = quad();
    let uri = |data: &str| format!("data:;base64,{data}");
    let length = |data: &str| data.trim_end_matches('=').len() * 3 / 4;
    let packed = |buffer: usize, data: &str, stride: usize, count: usize, mode: &str| {
        json!({name: {
            "buffer": buffer, "byteLength": length(data), "byteStride": stride, "count": count, "mode": mode,
        }})
    };
    document["buffers"] = json!([
        {"byteLength": 60, "extensions": {name: {"fallback": true}}},
        {"byteLength": length(vertices), "uri": uri(vertices)},
        {"byteLength": length(PACKED_INDICES), "uri": uri(PACKED_INDICES)},
    ]);
    document["bufferViews"][0]["extensions"] = packed(1, vertices, 12, 4, "ATTRIBUTES");
    document["bufferViews"][1]["extensions"] = packed(2, PACKED_INDICES, 2, 6, "TRIANGLES");
    document["extensionsUsed"] = json!([name]);
    document["extensionsRequired"] = json!([name]);
    document
}

#[test]
fn meshoptimizer_buffers_are_decoded() {
    let plain = load(&quad()).flatten();
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        for vertices in PACKED {
            let found = load(&compressed(name, vertices));
            assert_eq!(found.notes, [""; 0]);
            let found = found.flatten();
            assert_eq!((found.positions, found.indices), (plain.positions.clone(), plain.indices.clone()));
        }
    }
    let refusal = |change: fn(&mut Value)| {
        let mut document = compressed("EXT_meshopt_compression", PACKED[0]);
        change(&mut document["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]);
        try_load(&document).unwrap_err()
    };
    let cases: [(Change, &str); 5] = [
        (
            |v| v["count"] = json!(5),
            "bufferViews[0].extensions.EXT_meshopt_compression is 5 × 12 bytes; the view's",
        ),
        (|v| v["buffer"] = json!(0), "bytes at 0; buffers[0] has 0 bytes"),
        (|v| v["buffer"] = json!(7), "EXT_meshopt_compression.buffer is 7; buffers has the indices 0 to 2"),
        (
            |v| v["mode"] = json!("POINTS"),
            "allowed modes are ATTRIBUTES, TRIANGLES and INDICES; write the file again",
        ),
        (
            |v| v["byteLength"] = json!(40),
            "they end too early; write the file again, or decode it with `gltf-transform",
        ),
    ];
    for (change, message) in cases {
        let found = refusal(change);
        assert!(found.contains(message), "{found}");
    }
}

/// A material whose base colour is texture 0, on the quad.
fn textured(mode: &str, texture: Value, images: Value) -> Value {
    let mut document = quad();
    document["images"] = images;
    document["textures"] = json!([texture]);
    document["materials"] =
        json!([{"alphaMode": mode, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    document
}

/// A lossless WebP of two pixels, one of them transparent.
fn webp() -> String {
    let mut file = Vec::new();
    let encoder = image_webp::WebPEncoder::new(&mut file);
    encoder.encode(&[9, 9, 9, 0, 9, 9, 9, 255], 2, 1, image_webp::ColorType::Rgba8).unwrap();
    format!("data:image/webp;base64,{}", base64(&file))
}

#[test]
fn other_image_formats() {
    let ktx = format!("data:image/ktx2;base64,{}", base64(b"\xabKTX 20\xbb\r\n\x1a\n and more"));
    let basisu = json!({"extensions": {"KHR_texture_basisu": {"source": 0}}});
    let opaque = load(&textured("OPAQUE", basisu.clone(), json!([{"uri": ktx}])));
    assert_eq!(
        opaque.notes,
        [
            "images[0]: KTX2 is not decoded; convert it to PNG, JPEG or WebP with `gltf-transform ktxdecompress in.glb \
          out.glb`; the plain colour is used"
        ]
    );
    let mask = load(&textured("MASK", basisu, json!([{"uri": ktx}])));
    assert!(
        mask.notes[0].starts_with(
            "materials[0] base colour texture (images[0]): the mask is lost, so the whole surface is there and casts: \
             KTX2 is not decoded"
        ),
        "{:?}",
        mask.notes
    );
    // With a PNG beside it that is taken.
    let both = json!({"source": 1, "extensions": {"KHR_texture_basisu": {"source": 0}}});
    let images = json!([{"uri": ktx}, {"uri": png_row(&[[1, 2, 3, 255]])}]);
    let scene = load(&textured("MASK", both, images));
    assert_eq!((scene.images.len(), scene.notes.len()), (1, 0));
    for texture in [json!({"source": 0}), json!({"extensions": {"EXT_texture_webp": {"source": 0}}})] {
        let scene = load(&textured("MASK", texture, json!([{"uri": webp()}])));
        assert_eq!((scene.images[0].width, scene.images[0].height), (2, 1));
        assert_eq!([3, 7].map(|i| scene.images[0].rgba[i]), [0, 255]);
        assert_eq!(scene.notes, [""; 0]);
    }
}

#[test]
fn missing_images_are_counted() {
    let folder = std::env::temp_dir().join(format!("antumbra-missing-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut document = textured("OPAQUE", json!({"source": 0}), json!([{"uri": "a.png"}, {"uri": "b.png"}]));
    document["textures"] = json!([{"source": 0}, {"source": 1}]);
    let mut second = document["materials"][0].clone();
    second["pbrMetallicRoughness"]["baseColorTexture"]["index"] = json!(1);
    document["materials"].as_array_mut().unwrap().push(second);
    std::fs::write(folder.join("opaque.gltf"), document.to_string()).unwrap();
    document["materials"][0]["alphaMode"] = json!("MASK");
    std::fs::write(folder.join("mask.gltf"), document.to_string()).unwrap();
    let [opaque, mask] = ["opaque.gltf", "mask.gltf"].map(|name| import::load(folder.join(name)));
    std::fs::remove_dir_all(&folder).unwrap();
    let (opaque, mask) = (opaque.unwrap(), mask.unwrap());
    assert_eq!(opaque.notes.len(), 1, "{:?}", opaque.notes);
    assert!(opaque.notes[0].starts_with("images[0] 'a.png', images[1] 'b.png': the file cannot be read"));
    assert!(mask.notes[0].contains("(images[0] 'a.png'): the mask is lost"), "{:?}", mask.notes);
}

#[test]
fn rounded_matrices_are_taken_and_projections_are_not() {
    let with_row = |row: [f64; 4]| {
        let [x, y, z, w] = row;
        let mut document = quad();
        document["nodes"][0]["matrix"] = json!([2, 0, 0, x, 0, 2, 0, y, 0, 0, 2, z, 5, 0, 0, w]);
        try_load(&document)
    };
    for row in [[0.0, 0.0, 0.0, 0.999_999_94], [6e-8, -6e-8, 0.0, 1.0], [0.0, 1e-6, 0.0, 1.000_001]] {
        let bounds = with_row(row).unwrap().flatten().bounds().unwrap();
        assert_eq!((bounds.min.x, bounds.max), (5.0, Vec3::new(7.0, 2.0, 0.0)), "as without the rounding");
    }
    for row in [[0.0, 0.0, -1.0, 0.0], [0.001, 0.0, 0.0, 1.0], [0.0, 0.0, 0.0, 2.0]] {
        let refusal = with_row(row).unwrap_err();
        assert!(refusal.starts_with("test: nodes[0].matrix is ["), "{refusal}");
        assert!(refusal.contains("its last row must be 0, 0, 0, 1, since nodes cannot project"), "{refusal}");
    }
}

#[test]
fn empty_accessors_matter_only_where_they_are_used() {
    let mut document = quad();
    let empty = json!({"componentType": 5126, "count": 0, "type": "SCALAR"});
    document["accessors"].as_array_mut().unwrap().push(empty);
    assert_eq!(triangles(&document), 2);
    document["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(2);
    let refusal = try_load(&document).unwrap_err();
    assert!(refusal.contains("accessors[2].count is 0; at least 1 is needed where it is used"), "{refusal}");
}

#[test]
fn texts_of_careless_writers() {
    let text = quad().to_string();
    let marked = format!("\u{feff}{text}");
    assert!(import::gltf_bytes(marked.as_bytes(), "test").is_ok(), "a byte order mark");
    let mut document = quad();
    document["accessors"][0]["byteOffset"] = Value::Null;
    document["materials"] = json!([{"extensions": null, "pbrMetallicRoughness": null}]);
    assert_eq!(triangles(&document), 2, "null says nothing");
    let folder = std::env::temp_dir().join(format!("antumbra-careless-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("sub")).unwrap();
    std::fs::write(folder.join("sub/quad.bin"), quad_bytes()).unwrap();
    let mut document = with_buffer(quad(), &quad_bytes());
    document["buffers"][0]["uri"] = json!("sub\\quad.bin");
    std::fs::write(folder.join("quad.gltf"), document.to_string()).unwrap();
    let found = import::load(folder.join("quad.gltf"));
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(found.is_ok(), "backslashes");
}
