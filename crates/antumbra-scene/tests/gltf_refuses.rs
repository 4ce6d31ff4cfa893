//! Broken files: each is refused with the element, its value and what is allowed; none panics.

#![allow(clippy::unwrap_used, reason = "a load that succeeds is a failed test")]

mod common;

use antumbra_scene::import;
use common::{SQUARE, floats, glb, quad, quad_bytes, shorts, with_buffer};
use serde_json::{Value, json};

type Change = fn(&mut Value);

fn refusal(bytes: &[u8]) -> String {
    import::gltf_bytes(bytes, "test.gltf").unwrap_err().to_string()
}

/// The message for the quad after one change.
fn after(change: impl FnOnce(&mut Value)) -> String {
    let mut document = quad();
    change(&mut document);
    refusal(document.to_string().as_bytes())
}

#[test]
fn not_gltf() {
    assert_eq!(refusal(b""), "test.gltf: file is empty; a GLB or a JSON document is needed");
    assert_eq!(
        refusal(b"\x89PNG\r\n"),
        r#"test.gltf: file is "\x89PNG" at its start; a GLB starts with glTF, JSON with {"#
    );
    assert!(refusal(b"{}").contains("missing field `asset`"));
    assert_eq!(
        refusal(br#"{"asset": {"version": "2.0"}}"#),
        "test.gltf: scene 'test.gltf' has no triangles: 0 meshes in 0 instances; at least one is needed"
    );
    assert_eq!(
        after(|d| d["asset"]["version"] = json!("1.0")),
        "test.gltf: asset.version is '1.0'; only 2.x is supported; convert it with `gltf-pipeline -i old.gltf -o \
         new.gltf`"
    );
    assert!(
        after(|d| d["nodes"][0]["mesh"] = json!("zero"))
            .starts_with("test.gltf: nodes[0].mesh: invalid type")
    );
}

#[test]
fn unknown_required_extensions() {
    for (name, remedy) in [
        ("KHR_draco_mesh_compression", "`gltf-transform copy in.glb out.glb`"),
        ("FAKE_thing", "write the file again without it"),
    ] {
        let message = after(|d| d["extensionsRequired"] = json!(["KHR_materials_unlit", name]));
        assert!(message.contains(&format!("extensionsRequired names {name}, which is not supported")));
        assert!(message.contains(remedy), "{message}");
    }
}

#[test]
fn references_that_lead_nowhere() {
    let cases: [(Change, &str); 9] = [
        (|d| d["scene"] = json!(3), "scene is 3; scenes has the indices 0 to 0"),
        (|d| d["scenes"][0]["nodes"] = json!([9]), "scenes[0].nodes[0] is 9; nodes has the indices 0 to 0"),
        (|d| d["nodes"][0]["mesh"] = json!(1), "nodes[0].mesh is 1; meshes has the indices 0 to 0"),
        (|d| d["nodes"][0]["skin"] = json!(0), "a node's skin is 0; there are no skins"),
        (
            |d| d["meshes"][0]["primitives"][0]["material"] = json!(0),
            "meshes[0].primitives[0].material is 0; there are no materials",
        ),
        (
            |d| d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(7),
            "meshes[0].primitives[0].attributes.POSITION is 7; accessors has the indices 0 to 1",
        ),
        (
            |d| d["meshes"][0]["primitives"][0]["indices"] = json!(4_000_000_000_u32),
            "meshes[0].primitives[0].indices is 4000000000; accessors has the indices 0 to 1",
        ),
        (
            |d| d["accessors"][0]["bufferView"] = json!(2),
            "accessors[0].bufferView is 2; bufferViews has the indices 0 to 1",
        ),
        (
            |d| d["bufferViews"][0]["buffer"] = json!(1),
            "bufferViews[0].buffer is 1; buffers has the indices 0 to 0",
        ),
    ];
    for (change, message) in cases {
        assert_eq!(after(change), format!("test.gltf: {message}"));
    }
}

#[test]
fn lengths_beyond_the_data() {
    assert_eq!(
        after(|d| d["buffers"][0]["byteLength"] = json!(4_000_000_000_u32)),
        "test.gltf: buffers[0].byteLength is 4000000000; its data has only 60 bytes"
    );
    assert_eq!(
        after(|d| d["bufferViews"][0]["byteLength"] = json!(u64::MAX)),
        format!("test.gltf: bufferViews[0] is {} bytes at 0; buffers[0] has 60 bytes", u64::MAX)
    );
    assert_eq!(
        after(|d| d["accessors"][0]["count"] = json!(u64::MAX)),
        format!(
            "test.gltf: accessors[0] is {} elements of 12 bytes, 12 apart, from byte 0; bufferViews[0] has 48 bytes",
            u64::MAX
        )
    );
    // Zeros without bytes behind them must not fill the memory either.
    let huge = json!({"componentType": 5126, "count": 4_000_000_000_u32, "type": "VEC3"});
    assert_eq!(
        after(|d| d["accessors"][0] = huge),
        "test.gltf: accessors[0].count is 4000000000; without a bufferView at most 65596 are allowed"
    );
}

#[test]
fn numbers_that_break_the_format() {
    let cases: [(Change, &str); 9] = [
        (|d| d["accessors"][0]["type"] = json!("VEC5"), "accessors[0].type is 'VEC5'; allowed are SCALAR"),
        (
            |d| d["accessors"][0]["componentType"] = json!(5127),
            "accessors[0].componentType is 5127; allowed are",
        ),
        (|d| d["accessors"][0]["count"] = json!(0), "accessors[0].count is 0; at least 1 is needed"),
        (
            |d| d["bufferViews"][0]["byteStride"] = json!(0),
            "bufferViews[0].byteStride is 0; allowed are 4 to 252",
        ),
        (
            |d| d["bufferViews"][0]["byteStride"] = json!(8),
            "bufferViews[0].byteStride is 8; accessors[0] needs at least 12",
        ),
        (
            |d| d["meshes"][0]["primitives"][0]["mode"] = json!(7),
            "meshes[0].primitives[0].mode is 7; allowed are 0 to 6",
        ),
        (
            |d| d["accessors"][1]["componentType"] = json!(5122),
            "meshes[0].primitives[0].indices is I16; allowed are U8, U16, U32",
        ),
        (
            |d| d["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(1),
            "meshes[0].primitives[0].attributes.NORMAL is SCALAR; allowed are VEC3",
        ),
        (
            |d| d["nodes"][0]["rotation"] = json!([0, 0, 0, 0]),
            "nodes[0].rotation is [0, 0, 0, 0]; its length must be 1",
        ),
    ];
    for (change, message) in cases {
        let found = after(change);
        assert!(found.starts_with(&format!("test.gltf: {message}")), "{found}");
    }
}

#[test]
fn bad_vertices_and_indices() {
    let with = |positions: &[f32], indices: &[u16]| {
        let document = with_buffer(quad(), &[floats(positions), shorts(indices)].concat());
        refusal(document.to_string().as_bytes())
    };
    let mut positions = SQUARE;
    positions[7] = f32::NAN;
    assert_eq!(
        with(&positions, &[0, 1, 2, 0, 2, 3]),
        "test.gltf: meshes[0].primitives[0].attributes.POSITION[2] is [1.0, NaN, 0.0]; it must be finite"
    );
    assert_eq!(
        with(&SQUARE, &[0, 1, 2, 0, 2, 4]),
        "test.gltf: meshes[0].primitives[0].indices[5] is 4; it must be below 4, the number of vertices"
    );
    assert!(
        with(&SQUARE, &[0, 1, 65535, 0, 2, 3])
            .contains("indices[2] is 65535; that value restarts primitives")
    );
    assert!(
        after(|d| d["nodes"][0]["scale"] = json!([1e300, 1, 1])).contains("world positions must be finite")
    );
}

#[test]
fn nodes_must_form_trees() {
    assert!(after(|d| d["nodes"] = json!([{"mesh": 0, "children": [0]}])).contains("nodes[0]"));
    assert!(
        after(|d| d["nodes"] = json!([{"mesh": 0}, {"children": [2]}, {"children": [1]}]))
            .contains("nodes[1].children is part of a loop; nodes must form trees")
    );
    assert!(
        after(|d| d["nodes"] = json!([{"mesh": 0, "children": [1]}, {}, {"children": [1]}]))
            .contains("nodes[2].children[0] is 1; that node is already a child of nodes[0]")
    );
    assert!(after(|d| d["scenes"][0]["nodes"] = json!([0, 0])).contains("each node may appear once"));
}

#[test]
fn resources() {
    let uri = |uri: &str| after(|d| d["buffers"][0]["uri"] = json!(uri));
    assert!(uri("data:;base64,????").contains("its data must be base64"));
    assert!(
        uri("https://example.com/a.bin").contains("allowed are data URIs and paths relative to the file")
    );
    assert!(uri("/etc/hostname").contains("allowed are data URIs and paths relative to the file"));
    assert!(uri("a.bin").contains("a file in memory may use data URIs only"));
}

#[test]
fn images_that_decide_about_shape() {
    let message = |data: &str, mode: &str| {
        let mut document = quad();
        document["images"] = json!([{"uri": format!("data:image/png;base64,{data}")}]);
        document["textures"] = json!([{"source": 0}]);
        document["materials"] =
            json!([{"alphaMode": mode, "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
        document["meshes"][0]["primitives"][0]["material"] = json!(0);
        match import::gltf_bytes(document.to_string().as_bytes(), "test.gltf") {
            Ok(scene) => scene.notes.join(""),
            Err(error) => error.to_string(),
        }
    };
    let neither =
        "images[0]: the image cannot be decoded: it is neither PNG nor JPEG nor WebP by its first bytes";
    assert_eq!(message("AAAA", "MASK"), format!("test.gltf: {neither}"));
    assert_eq!(message("AAAA", "OPAQUE"), format!("{neither}; the plain colour is used"));
    // A header that claims 2³¹−1 by 2³¹−1 pixels.
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff\x08\x06\0\0\0".to_vec();
    png.extend([0; 8]);
    let found = message(&common::base64(&png), "MASK");
    assert!(found.starts_with("test.gltf: images[0]: the image cannot be decoded"), "{found}");
}

#[test]
fn binary_containers() {
    let file = glb(quad(), &quad_bytes());
    assert!(import::gltf_bytes(&file, "test").is_ok());
    assert!(refusal(&file[..9]).contains("GLB header is 9 bytes long; it needs 12"));
    assert!(refusal(&file[..40]).contains("the file has only 40 bytes"));
    let patched = |at: usize, word: u32| {
        let mut file = file.clone();
        file[at..at + 4].copy_from_slice(&word.to_le_bytes());
        refusal(&file)
    };
    assert!(patched(4, 1).contains("GLB version is 1; only 2 is supported"));
    assert!(patched(12, u32::MAX).contains("GLB chunk length is 4294967295"));
    assert!(patched(16, 0).contains("first GLB chunk"));
}

/// Thousands of damaged files: each loads or is refused, none panics.
#[test]
fn damage_never_panics() {
    let mut state = 1_u64;
    let mut random = |below: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as usize % below
    };
    let whole = glb(quad(), &quad_bytes());
    let numbers: Vec<usize> = (0..whole.len()).filter(|&i| whole[i].is_ascii_digit()).collect();
    let mut loaded = 0;
    for round in 0..20_000 {
        let mut file = whole.clone();
        for _ in 0..=random(3) {
            if round % 2 == 0 {
                file[numbers[random(numbers.len())]] = b'0' + random(10) as u8;
            } else {
                let at = random(file.len());
                file[at] = random(256) as u8;
            }
        }
        if round % 50 == 0 {
            file.truncate(random(file.len()));
        }
        loaded +=
            usize::from(import::gltf_bytes(&file, "damaged").is_ok_and(|s| s.flatten().bounds().is_some()));
    }
    assert!(loaded > 100, "some damage does no harm: {loaded}");
}
