//! Builds small glTF documents: a quad of two triangles whose every part a test may change.

#![allow(dead_code, reason = "each test program uses a part of it")]

use serde_json::{Value, json};

/// Standard base64.
pub(crate) fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for three in bytes.chunks(3) {
        let word = three.iter().chain(&[0, 0]).take(3).fold(0_u32, |w, &b| w << 8 | u32::from(b));
        for place in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * place) & 63) as usize] as char;
            text.push(if place <= three.len() { digit } else { '=' });
        }
    }
    text
}

pub(crate) fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

pub(crate) fn shorts(values: &[u16]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// Corners of the unit square in the xy plane, counter-clockwise from the origin.
pub(crate) const SQUARE: [f32; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 1.0, 0.0];

/// The buffer of [`quad`]: four positions, then six 16-bit indices.
pub(crate) fn quad_bytes() -> Vec<u8> {
    [floats(&SQUARE), shorts(&[0, 1, 2, 0, 2, 3])].concat()
}

/// A document with one node, one mesh, one primitive: positions in accessor 0, indices in accessor 1.
pub(crate) fn quad() -> Value {
    with_buffer(
        json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [
                {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
            ],
            "bufferViews": [
                {"buffer": 0, "byteLength": 48},
                {"buffer": 0, "byteOffset": 48, "byteLength": 12},
            ],
        }),
        &quad_bytes(),
    )
}

/// The document with that data as its only buffer.
pub(crate) fn with_buffer(mut document: Value, bytes: &[u8]) -> Value {
    let uri = format!("data:application/octet-stream;base64,{}", base64(bytes));
    document["buffers"] = json!([{"byteLength": bytes.len(), "uri": uri}]);
    document
}

/// The binary form of a document whose buffer moves to the binary chunk.
pub(crate) fn glb(mut document: Value, binary: &[u8]) -> Vec<u8> {
    document["buffers"] = json!([{"byteLength": binary.len()}]);
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes();
    let mut file = [b"glTF".as_slice(), &word(2), &word(12 + 8 + json.len() + 8 + binary.len())].concat();
    file.extend([&word(json.len()), b"JSON".as_slice(), &json].concat());
    file.extend([&word(binary.len()), b"BIN\0".as_slice(), &binary].concat());
    file
}

/// The document with more data behind [`quad_bytes`]: each piece is one more view (from number 2) and
/// one more accessor (from number 2) of the given component type, count and shape.
pub(crate) fn with_accessors(mut document: Value, pieces: &[(Vec<u8>, u32, usize, &str)]) -> Value {
    let mut bytes = quad_bytes();
    for (data, kind, count, shape) in pieces {
        let views = document["bufferViews"].as_array().map_or(0, Vec::len);
        let view = json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": data.len()});
        let accessor = json!({"bufferView": views, "componentType": kind, "count": count, "type": shape});
        for (list, entry) in [("bufferViews", view), ("accessors", accessor)] {
            if let Some(list) = document[list].as_array_mut() {
                list.push(entry);
            }
        }
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(4), 0);
    }
    with_buffer(document, &bytes)
}

/// A PNG of one row of pixels.
pub(crate) fn png_row(pixels: &[[u8; 4]]) -> String {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, pixels.len() as u32, 1);
    encoder.set_color(png::ColorType::Rgba);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(&pixels.concat()));
    assert!(written.is_ok());
    format!("data:image/png;base64,{}", base64(&file))
}
