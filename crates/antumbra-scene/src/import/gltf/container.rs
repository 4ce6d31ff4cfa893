//! From bytes to a document and its buffers: GLB chunks, JSON, URIs.

use super::document::{Buffer, Document};
use crate::import::error::{Problem, invalid};
use serde::de::DeserializeOwned;
use serde_json::Value;
use std::path::Path;

/// Splits a file into its JSON and, for GLB, its binary chunk.
pub(super) fn split(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), Problem> {
    // Some editors put a byte order mark before a text.
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if !bytes.starts_with(b"glTF") {
        return match bytes.trim_ascii_start() {
            [b'{', ..] => Ok((bytes, None)),
            [] => Err(invalid("file", "empty", "a GLB or a JSON document is needed")),
            [..] => {
                let start = bytes[..bytes.len().min(4)].escape_ascii();
                Err(invalid(
                    "file",
                    format!("\"{start}\" at its start"),
                    "a GLB starts with glTF, JSON with {",
                ))
            }
        };
    }
    let word = |at: usize| {
        bytes.get(at..at + 4).and_then(|b| b.try_into().ok()).map(|b| u32::from_le_bytes(b) as usize)
    };
    let (Some(version), Some(length)) = (word(4), word(8)) else {
        return Err(invalid("GLB header", format!("{} bytes long", bytes.len()), "it needs 12"));
    };
    if version != 2 {
        return Err(invalid("GLB version", version, "only 2 is supported"));
    }
    if length > bytes.len() {
        return Err(invalid("GLB length", length, format!("the file has only {} bytes", bytes.len())));
    }
    let (mut json, mut binary) = (None, None);
    let mut at = 12;
    while at < length {
        let (Some(size), Some(kind)) = (word(at), bytes.get(at + 4..at + 8)) else {
            return Err(invalid("GLB chunk header", format!("cut off at byte {at}"), "it needs 8 bytes"));
        };
        let Some(data) = bytes[..length].get(at + 8..).and_then(|rest| rest.get(..size)) else {
            return Err(invalid(
                "GLB chunk length",
                size,
                format!("only {} bytes follow its header", length.saturating_sub(at + 8)),
            ));
        };
        match (kind, json) {
            (b"JSON", None) => json = Some(data),
            (_, None) => {
                return Err(invalid("first GLB chunk", format!("{kind:?}"), "it must be the JSON chunk"));
            }
            (b"BIN\0", Some(_)) if binary.is_none() => binary = Some(data),
            _ => {} // Chunks of other kinds are to be ignored.
        }
        at += 8 + size;
    }
    match json {
        Some(json) => Ok((json, binary)),
        None => Err(invalid("GLB", "without chunks", "it needs a JSON chunk")),
    }
}

/// Reads JSON; errors name the element. Whole numbers may be written with a fraction of zero, and what
/// is absent as null.
pub(super) fn parse<T: DeserializeOwned>(json: &[u8]) -> Result<T, Problem> {
    let mut reader = serde_json::Deserializer::from_slice(json);
    let problem = |e: serde_path_to_error::Error<serde_json::Error>| Problem::Json {
        element: Some(e.path().to_string()).filter(|p| p != ".").unwrap_or("JSON".into()),
        source: e.into_inner(),
    };
    match serde_path_to_error::deserialize(&mut reader) {
        Ok(value) => {
            reader.end().map_err(|source| Problem::Json { element: "end of file".into(), source })?;
            Ok(value)
        }
        // Rare, so the costly way is the second one.
        Err(error) => match serde_json::from_slice::<Value>(json) {
            Ok(mut value) => {
                mend(&mut value);
                serde_path_to_error::deserialize(value).map_err(|_| problem(error))
            }
            Err(_) => Err(problem(error)),
        },
    }
}

/// Turns numbers such as 3.0 into 3 and drops what is said to be null, which means nothing.
fn mend(value: &mut Value) {
    match value {
        Value::Number(number) => {
            if let Some(float) = number.as_f64().filter(|f| f.fract() == 0.0 && f.abs() < 9e15) {
                *value = (float as i64).into();
            }
        }
        Value::Array(values) => values.iter_mut().for_each(mend),
        Value::Object(entries) => {
            entries.retain(|_, value| !value.is_null());
            entries.values_mut().for_each(mend);
        }
        _ => {}
    }
}

/// Reads an extension object; `element` is the path of its owner.
pub(super) fn extension<T: DeserializeOwned>(
    owner: &super::document::Extensions,
    name: &str,
    element: &str,
) -> Result<Option<T>, Problem> {
    let Some(found) = owner.get(name) else { return Ok(None) };
    value(found, &format!("{element}.extensions.{name}")).map(Some)
}

/// Reads a part of the document; `element` is its path.
pub(super) fn value<T: DeserializeOwned>(found: &Value, element: &str) -> Result<T, Problem> {
    serde_path_to_error::deserialize(found).map_err(|e| Problem::Json {
        element: Some(e.path().to_string())
            .filter(|p| p != ".")
            .map_or(element.into(), |p| format!("{element}.{p}")),
        source: e.into_inner(),
    })
}

/// Checks the version.
pub(super) fn check(document: &Document) -> Result<(), Problem> {
    let asset = &document.asset;
    for (element, version) in
        [("asset.version", Some(&asset.version)), ("asset.minVersion", asset.min_version.as_ref())]
    {
        if let Some(version) = version
            && !version.starts_with("2.")
        {
            let remedy = if version.starts_with("1.") || version == "1" {
                "; convert it with `gltf-pipeline -i old.gltf -o new.gltf`"
            } else {
                ""
            };
            let allowed = format!("only 2.x is supported{remedy}");
            return Err(invalid(element, format!("'{version}'"), allowed));
        }
    }
    Ok(())
}

/// Loads every buffer, cut to its `byteLength`; `None` for one whose data is defined elsewhere.
pub(super) fn buffers(
    document: &Document,
    binary: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<Option<Vec<u8>>>, Problem> {
    let load = |(i, buffer): (usize, &Buffer)| {
        let element = format!("buffers[{i}]");
        let data = match (&buffer.uri, binary) {
            (Some(uri), _) => Some(resource(uri, &element, folder)?),
            (None, Some(binary)) if i == 0 => Some(binary.to_vec()),
            _ => None,
        };
        let Some(mut data) = data else { return Ok(None) };
        if data.len() < buffer.byte_length {
            return Err(invalid(
                format!("{element}.byteLength"),
                buffer.byte_length,
                format!("its data has only {} bytes", data.len()),
            ));
        }
        data.truncate(buffer.byte_length);
        Ok(Some(data))
    };
    document.buffers.iter().enumerate().map(load).collect()
}

/// The bytes behind a URI: base64 data, or a file relative to `folder`.
pub(super) fn resource(uri: &str, element: &str, folder: Option<&Path>) -> Result<Vec<u8>, Problem> {
    let shown: String = uri.chars().take(60).collect();
    let refuse = |allowed: &str| Err(invalid(format!("{element}.uri"), format!("'{shown}'"), allowed));
    if let Some(data) = uri.strip_prefix("data:") {
        return match data.split_once(',').map(|(kind, data)| (kind.ends_with(";base64"), data)) {
            Some((true, data)) => match base64(data) {
                Some(bytes) => Ok(bytes),
                None => refuse("its data must be base64 (A-Z a-z 0-9 + / =)"),
            },
            Some((false, data)) => match percent_decode(data) {
                Some(bytes) => Ok(bytes),
                None => refuse("after % two hexadecimal digits must follow"),
            },
            None => refuse("data URIs must have the form data:<type>;base64,<data>"),
        };
    }
    let Some(path) = percent_decode(uri).and_then(|bytes| String::from_utf8(bytes).ok()) else {
        return refuse("after % two hexadecimal digits must follow, and the result must be UTF-8");
    };
    let scheme = uri.split(['/', '?', '#']).next().is_some_and(|first| first.contains(':'));
    if scheme || path.is_empty() || path.contains('\0') || Path::new(&path).has_root() {
        return refuse("allowed are data URIs and paths relative to the file");
    }
    let Some(folder) = folder else { return refuse("a file in memory may use data URIs only") };
    // Paths of Windows are no URIs, but some programs write them.
    let turned = || std::fs::read(folder.join(path.replace('\\', "/")));
    std::fs::read(folder.join(&path))
        .or_else(|e| turned().map_err(|_| e))
        .map_err(|source| Problem::Resource { element: element.into(), uri: shown, source })
}

fn percent_decode(text: &str) -> Option<Vec<u8>> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.bytes();
    while let Some(byte) = rest.next() {
        bytes.push(if byte == b'%' {
            let mut digit = || rest.next().and_then(|d| char::from(d).to_digit(16));
            (digit()? * 16 + digit()?) as u8
        } else {
            byte
        });
    }
    Some(bytes)
}

/// Decodes base64, standard alphabet, padding optional; `None` if anything else is in it.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=');
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    let (mut held, mut bits) = (0_u32, 0);
    for digit in text.bytes() {
        let value = match digit {
            b'A'..=b'Z' => digit - b'A',
            b'a'..=b'z' => digit - b'a' + 26,
            b'0'..=b'9' => digit - b'0' + 52,
            b'+' => 62,
            b'/' => 63,
            _ => return None,
        };
        held = (held << 6 | u32::from(value)) & 0xfff;
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((held >> bits) as u8);
        }
    }
    (text.len() % 4 != 1).then_some(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_follows_rfc_4648() {
        for (text, want) in [("", ""), ("Zg==", "f"), ("Zm8=", "fo"), ("Zm9v", "foo"), ("Zm9vYmFy", "foobar")]
        {
            assert_eq!(base64(text).as_deref(), Some(want.as_bytes()));
        }
        assert_eq!(base64("Zm9v!"), None);
        assert_eq!(base64("A"), None);
    }

    #[test]
    fn uris_are_decoded() {
        assert_eq!(percent_decode("a%20b%C3%A4"), Some("a bä".into()));
        assert_eq!(percent_decode("a%2"), None);
        assert_eq!(percent_decode("%+1"), None);
    }
}
