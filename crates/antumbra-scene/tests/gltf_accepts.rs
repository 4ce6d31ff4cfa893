//! Every form of glTF that makes triangles, from documents made here.

#![allow(clippy::unwrap_used, reason = "a failed load is a failed test")]

mod common;

use antumbra_scene::{AlphaMode, Geometry, Light, Projection, Scene, import};
use common::{SQUARE, base64, floats, glb, quad, quad_bytes, shorts, with_buffer};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

fn load(document: &Value) -> Scene {
    import::gltf_bytes(document.to_string().as_bytes(), "test").unwrap()
}

fn geometry(document: &Value) -> Geometry {
    load(document).flatten()
}

fn assert_is_quad(geometry: &Geometry) {
    assert_eq!(geometry.triangle_count(), 2);
    for t in 0..2 {
        let [a, b, c] = geometry.triangle(t);
        assert_eq!((b - a).cross(c - a), Vec3::Z, "triangle {t} faces +z");
        assert!(geometry.corners(t).iter().all(|&i| geometry.normals[i] == Vec3::Z));
    }
    let bounds = geometry.bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), (Vec3::ZERO, Vec3::new(1.0, 1.0, 0.0)));
}

#[test]
fn text_and_binary_agree() {
    let text = geometry(&quad());
    assert_is_quad(&text);
    let binary = import::gltf_bytes(&glb(quad(), &quad_bytes()), "test").unwrap().flatten();
    assert_eq!(text.positions, binary.positions);
}

#[test]
fn files_find_their_buffers() {
    let folder = std::env::temp_dir().join(format!("antumbra-scene-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut document = quad();
    document["buffers"] = json!([{"byteLength": 60, "uri": "my%20data.bin"}]);
    std::fs::write(folder.join("my data.bin"), quad_bytes()).unwrap();
    std::fs::write(folder.join("quad.GLTF"), document.to_string()).unwrap();
    std::fs::write(folder.join("quad.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").unwrap();
    let gltf = import::load(folder.join("quad.GLTF"));
    let obj = import::load(folder.join("quad.obj"));
    let unknown = import::load(folder.join("quad.fbx")).unwrap_err().to_string();
    std::fs::remove_file(folder.join("my data.bin")).unwrap();
    let lost = import::load(folder.join("quad.GLTF")).unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    let gltf = gltf.unwrap();
    assert_eq!(gltf.name, "quad");
    assert_is_quad(&gltf.flatten());
    assert_is_quad(&obj.unwrap().flatten());
    assert!(
        unknown.ends_with("files that end in '.fbx' are not supported; allowed are .gltf, .glb and .obj")
    );
    assert!(lost.contains("buffers[0] names 'my%20data.bin', which cannot be read"), "{lost}");
}

#[test]
fn lists_strips_and_fans() {
    for (mode, order) in [(4, vec![0, 1, 2, 0, 2, 3]), (5, vec![0, 1, 3, 2]), (6, vec![0, 1, 2, 3])] {
        let mut document = with_buffer(quad(), &[floats(&SQUARE), shorts(&order)].concat());
        document["meshes"][0]["primitives"][0]["mode"] = json!(mode);
        document["accessors"][1]["count"] = json!(order.len());
        document["bufferViews"][1]["byteLength"] = json!(2 * order.len());
        assert_is_quad(&geometry(&document));
    }
}

#[test]
fn without_indices() {
    let mut document = quad();
    document["meshes"][0]["primitives"][0] = json!({"attributes": {"POSITION": 0}, "mode": 6});
    assert_is_quad(&geometry(&document));
}

#[test]
fn points_and_lines_are_left_out() {
    let mut document = quad();
    let triangles = document["meshes"][0]["primitives"][0].clone();
    let points = json!({"attributes": {"POSITION": 0}, "mode": 0});
    document["meshes"][0]["primitives"] = json!([triangles, points]);
    let scene = load(&document);
    assert_is_quad(&scene.flatten());
    assert_eq!(scene.notes, ["1 primitives without triangles or positions are left out"]);
}

#[test]
fn sparse_positions() {
    // Zeros but for three corners, so the base accessor needs no bytes.
    let indices = [1_u8, 2, 3, 0];
    let bytes = [floats(&SQUARE[3..]), shorts(&[0, 1, 2, 0, 2, 3]), indices.to_vec()].concat();
    let mut document = with_buffer(quad(), &bytes);
    document["accessors"][0] = json!({
        "componentType": 5126, "count": 4, "type": "VEC3",
        "sparse": {
            "count": 3,
            "indices": {"bufferView": 2, "componentType": 5121},
            "values": {"bufferView": 0},
        },
    });
    document["bufferViews"] = json!([
        {"buffer": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": 12},
        {"buffer": 0, "byteOffset": 48, "byteLength": 3},
    ]);
    assert_is_quad(&geometry(&document));
}

#[test]
fn quantized_positions_with_a_stride() {
    let square: Vec<u8> =
        [[0, 0], [127, 0], [127, 127], [0, 127]].iter().flat_map(|&[x, y]| [x, y, 0, 99]).collect();
    let mut document = with_buffer(quad(), &[square, shorts(&[0, 1, 2, 0, 2, 3])].concat());
    document["accessors"][0] =
        json!({"bufferView": 0, "componentType": 5120, "normalized": true, "count": 4, "type": "VEC3"});
    document["bufferViews"] = json!([
        {"buffer": 0, "byteLength": 16, "byteStride": 4},
        {"buffer": 0, "byteOffset": 16, "byteLength": 12},
    ]);
    document["extensionsUsed"] = json!(["KHR_mesh_quantization"]);
    document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    assert_is_quad(&geometry(&document));
}

#[test]
fn mirrored_nodes_keep_their_front() {
    let mut document = quad();
    document["nodes"] = json!([
        {"children": [1], "scale": [2, -1, 1]},
        {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 3,1,0,1]},
    ]);
    let geometry = geometry(&document);
    let bounds = geometry.bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), (Vec3::new(6.0, -2.0, 0.0), Vec3::new(8.0, -1.0, 0.0)));
    for t in 0..2 {
        let [a, b, c] = geometry.triangle(t);
        assert!((b - a).cross(c - a).z > 0.0);
    }
    assert!(geometry.normals.iter().all(|&n| n == Vec3::Z));
}

#[test]
fn nodes_and_instances_share_meshes() {
    let bytes = [quad_bytes(), floats(&[0.0, 0.0, 5.0, 0.0, 0.0, 7.0])].concat();
    let mut document = with_buffer(quad(), &bytes);
    document["bufferViews"]
        .as_array_mut()
        .unwrap()
        .push(json!({"buffer": 0, "byteOffset": 60, "byteLength": 24}));
    document["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}));
    let attributes = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 2}}});
    document["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "extensions": attributes}]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    let scene = load(&document);
    assert_eq!((scene.meshes.len(), scene.instances.len()), (1, 3));
    assert_eq!(scene.bounds().unwrap().max.z, 7.0);
}

#[test]
fn skins_and_morph_targets_at_rest() {
    let weights: Vec<f32> = [1.0, 0.0, 0.0, 0.0].repeat(4);
    let lift: Vec<f32> = [0.0, 0.0, 2.0].repeat(4);
    let bytes = [quad_bytes(), floats(&lift), floats(&weights), vec![0; 16]].concat();
    let mut document = with_buffer(quad(), &bytes);
    document["bufferViews"] = json!([
        {"buffer": 0, "byteLength": 48},
        {"buffer": 0, "byteOffset": 48, "byteLength": 12},
        {"buffer": 0, "byteOffset": 60, "byteLength": 48},
        {"buffer": 0, "byteOffset": 108, "byteLength": 64},
        {"buffer": 0, "byteOffset": 172, "byteLength": 16},
    ]);
    let accessor = |view: u32, kind: u32, shape: &str| json!({"bufferView": view, "componentType": kind, "count": 4, "type": shape});
    let accessors = document["accessors"].as_array_mut().unwrap();
    accessors.extend([accessor(2, 5126, "VEC3"), accessor(3, 5126, "VEC4"), accessor(4, 5121, "VEC4")]);
    document["meshes"][0] = json!({
        "weights": [0.5],
        "primitives": [{
            "attributes": {"POSITION": 0, "WEIGHTS_0": 3, "JOINTS_0": 4},
            "indices": 1, "targets": [{"POSITION": 2}],
        }],
    });
    document["skins"] = json!([{"joints": [1]}]);
    document["nodes"] = json!([
        {"mesh": 0, "skin": 0, "translation": [100, 100, 100]},
        {"translation": [10, 0, 0]},
    ]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    let bounds = geometry(&document).bounds().unwrap();
    assert_eq!((bounds.min, bounds.max), (Vec3::new(10.0, 0.0, 1.0), Vec3::new(11.0, 1.0, 1.0)));
    document["nodes"][0]["weights"] = json!([0.0]);
    assert_eq!(geometry(&document).bounds().unwrap().max.z, 0.0);
}

#[test]
fn cut_outs_with_transformed_coordinates() {
    // A 2×1 image: left transparent, right opaque.
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 2, 1);
    encoder.set_color(png::ColorType::Rgba);
    encoder.write_header().unwrap().write_image_data(&[9, 9, 9, 0, 9, 9, 9, 255]).unwrap();
    let uvs = [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let mut document = with_buffer(quad(), &[quad_bytes(), floats(&uvs)].concat());
    document["bufferViews"]
        .as_array_mut()
        .unwrap()
        .push(json!({"buffer": 0, "byteOffset": 60, "byteLength": 32}));
    document["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({"bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2"}));
    document["meshes"][0]["primitives"][0] =
        json!({"attributes": {"POSITION": 0, "TEXCOORD_1": 2}, "indices": 1, "material": 0});
    document["images"] = json!([{"uri": format!("data:image/png;base64,{}", base64(&png))}]);
    document["textures"] = json!([{"source": 0, "sampler": 0}]);
    document["samplers"] = json!([{"wrapS": 33071, "wrapT": 33648}]);
    let texture = json!({"index": 0, "texCoord": 1});
    document["materials"] =
        json!([{"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorTexture": texture}}]);
    let plain = geometry(&document);
    assert_eq!(plain.materials[0].alpha, AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!((plain.images[0].width, plain.images[0].height), (2, 2), "mirrored below");
    assert_eq!(plain.images[0].repeat, [false, true]);
    // Triangle 0 has the corners (0,0), (1,0), (1,1): its middle lies right of the image's.
    assert!(!plain.is_cut(0, 0.3, 0.4) && plain.is_cut(0, 0.1, 0.1));
    let turn =
        json!({"KHR_texture_transform": {"offset": [0.25, 0.5], "rotation": 0.5 * std::f32::consts::PI}});
    document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = turn;
    let turned = load(&document);
    // (1, 0) turns counter-clockwise in an image whose v points down: to (0, −1).
    let want = [[0.25, 0.5], [0.25, -0.5], [1.25, -0.5], [1.25, 0.5]];
    for (uv, [u, v]) in turned.meshes[0].uvs.iter().zip([want[0], want[1], want[2]]) {
        assert!(uv.distance(Vec2::new(u, 0.5 * v)) < 1e-6, "{uv}; v is halved by the mirroring");
    }
}

#[test]
fn cameras_and_lights() {
    let mut document = quad();
    document["cameras"] = json!([
        {"type": "perspective", "perspective": {"yfov": 0.5, "znear": 0.1}},
        {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 1}},
    ]);
    let lights = json!([{"type": "directional"}, {"type": "spot", "spot": {"outerConeAngle": 0.3}}, {"type": "point"}]);
    document["extensions"] = json!({"KHR_lights_punctual": {"lights": lights}});
    let light = |i: u32| json!({"KHR_lights_punctual": {"light": i}});
    document["nodes"] = json!([
        {"mesh": 0, "camera": 0, "translation": [1, 2, 3], "extensions": light(0)},
        {"camera": 1, "extensions": light(1), "rotation": [-std::f32::consts::FRAC_1_SQRT_2, 0, 0, std::f32::consts::FRAC_1_SQRT_2]},
        {"extensions": light(2)},
    ]);
    document["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    let scene = load(&document);
    let camera = scene.main_camera();
    assert_eq!((camera.position, camera.target), (Vec3::new(1.0, 2.0, 3.0), Vec3::new(1.0, 2.0, 2.0)));
    assert_eq!(scene.lights[0], Light::Directional { direction: Vec3::NEG_Z });
    let Light::Spot { direction, outer_angle, .. } = scene.lights[1] else { panic!("not a spot") };
    assert!(direction.distance(Vec3::NEG_Y) < 1e-6 && outer_angle == 0.3);
    let down = scene.cameras[1];
    assert_eq!(down.projection, Projection::Orthographic { height: 2.0 });
    assert!(down.target.distance(Vec3::NEG_Y) < 1e-6 && down.up.distance(Vec3::NEG_Z) < 1e-6, "{down:?}");
    assert_eq!(scene.notes.len(), 1, "the point light: {:?}", scene.notes);
}

#[test]
fn whole_numbers_with_fractions_and_documents_without_nodes() {
    let mut document = quad();
    document["accessors"][0]["count"] = json!(4.0);
    for key in ["nodes", "scenes", "scene"] {
        document.as_object_mut().unwrap().remove(key);
    }
    let geometry = geometry(&document);
    assert_is_quad(&geometry);
}
