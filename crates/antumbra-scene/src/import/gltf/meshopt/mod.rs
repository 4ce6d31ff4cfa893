//! Buffer views compressed by meshoptimizer (`EXT_meshopt_compression`, `KHR_meshopt_compression`):
//! after Kapoulkine, "`EXT_meshopt_compression`", Khronos glTF registry 2020, appendices A and B; the
//! vertex codec's version 1 and the colour filter after `KHR_meshopt_compression`, 2025.
//!
//! Decoders allocate as they read: at most 1 KiB for each byte that is there.

mod filter;
mod index;
mod vertex;

use super::accessor::{Asset, follow};
use super::container;
use super::document::Extensions;
use crate::import::error::{Problem, invalid};
use serde::Deserialize;

const NAMES: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// What a compressed view says of itself.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer: usize,
    #[serde(default)]
    byte_offset: usize,
    byte_length: usize,
    byte_stride: usize,
    count: usize,
    mode: String,
    #[serde(default = "no_filter")]
    filter: String,
}

fn no_filter() -> String {
    "NONE".into()
}

/// Why bytes could not be decoded.
type Reason = &'static str;

const SHORT: Reason = "they end too early";
const LONG: Reason = "bytes are left over";
const VERSION: Reason = "their first byte names another codec or a newer version";

/// Bytes that are read from the front.
#[derive(Debug)]
struct Reader<'a>(&'a [u8]);

impl<'a> Reader<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], Reason> {
        let (taken, rest) = self.0.split_at_checked(count).ok_or(SHORT)?;
        self.0 = rest;
        Ok(taken)
    }

    fn byte(&mut self) -> Result<u8, Reason> {
        self.take(1).map(|bytes| bytes[0])
    }

    /// A number in groups of seven bits, lowest first, at most five of them.
    fn number(&mut self) -> Result<u32, Reason> {
        let mut value = 0;
        for group in 0..5 {
            let byte = self.byte()?;
            value |= u32::from(byte & 127) << (7 * group);
            if byte < 128 {
                break;
            }
        }
        Ok(value)
    }

    fn finish(self) -> Result<(), Reason> {
        if self.0.is_empty() { Ok(()) } else { Err(LONG) }
    }
}

/// Undoes the folding of signed numbers into unsigned ones: 0, 1, 2, 3 are 0, −1, 1, −2.
fn unfold(value: u32) -> u32 {
    (value >> 1) ^ (value & 1).wrapping_neg()
}

/// The first byte is a codec's mark and a version; the version, if it is at most `newest`.
fn version(header: u8, mark: u8, newest: u8) -> Result<u8, Reason> {
    if header & 0xf0 == mark && header & 15 <= newest { Ok(header & 15) } else { Err(VERSION) }
}

impl Asset {
    /// Decodes every compressed buffer view whose bytes are there.
    pub(super) fn decompress(&mut self) -> Result<(), Problem> {
        let mut decoded = Vec::with_capacity(self.document.buffer_views.len());
        for (i, view) in self.document.buffer_views.iter().enumerate() {
            decoded.push(self.decompressed(&view.extensions, i)?);
        }
        self.decoded = decoded;
        Ok(())
    }

    fn decompressed(&self, extensions: &Extensions, index: usize) -> Result<Option<Vec<u8>>, Problem> {
        let Some(name) = NAMES.into_iter().find(|name| extensions.contains_key(*name)) else {
            return Ok(None);
        };
        let element = format!("bufferViews[{index}]");
        let Some(compressed) = container::extension::<Compressed>(extensions, name, &element)? else {
            return Ok(None);
        };
        let element = format!("{element}.extensions.{name}");
        let whole = self.document.buffer_views[index].byte_length;
        if compressed.count.checked_mul(compressed.byte_stride) != Some(whole) {
            let value = format!("{} × {} bytes", compressed.count, compressed.byte_stride);
            return Err(invalid(element, value, format!("the view's byteLength is {whole}")));
        }
        follow(&self.document.buffers, "buffers", compressed.buffer, &format!("{element}.buffer"))?;
        let buffer = self.buffers.get(compressed.buffer).and_then(Option::as_deref).unwrap_or_default();
        let end = compressed.byte_offset.saturating_add(compressed.byte_length);
        let Some(bytes) = buffer.get(compressed.byte_offset..end) else {
            let value = format!("{} bytes at {}", compressed.byte_length, compressed.byte_offset);
            let allowed = format!("buffers[{}] has {} bytes", compressed.buffer, buffer.len());
            return Err(invalid(element, value, allowed));
        };
        compressed.decode(bytes).map(Some).map_err(|reason| {
            let Compressed { count, byte_stride, mode, filter, .. } = &compressed;
            invalid(
                element,
                format!("{} bytes of mode {mode}, filter {filter}, for {count} × {byte_stride}", bytes.len()),
                format!(
                    "{reason}; write the file again, or decode it with `gltf-transform copy in.glb out.glb`"
                ),
            )
        })
    }
}

impl Compressed {
    fn decode(&self, bytes: &[u8]) -> Result<Vec<u8>, Reason> {
        let (count, stride) = (self.count, self.byte_stride);
        let mut decoded = match self.mode.as_str() {
            "ATTRIBUTES" if (4..=256).contains(&stride) && stride.is_multiple_of(4) => {
                vertex::decode(bytes, count, stride)?
            }
            "ATTRIBUTES" => return Err("vertices must have 4 to 256 bytes, in steps of 4"),
            "TRIANGLES" | "INDICES" if stride != 2 && stride != 4 => {
                return Err("indices must have 2 or 4 bytes");
            }
            "TRIANGLES" if !count.is_multiple_of(3) => return Err("triangles need a multiple of 3 indices"),
            "TRIANGLES" => narrow(index::triangles(bytes, count)?, stride),
            "INDICES" => narrow(index::sequence(bytes, count)?, stride),
            _ => return Err("allowed modes are ATTRIBUTES, TRIANGLES and INDICES"),
        };
        match (self.filter.as_str(), stride) {
            ("NONE", _) => {}
            ("OCTAHEDRAL", 4) => filter::octahedral_8(&mut decoded),
            ("OCTAHEDRAL", 8) => filter::octahedral_16(&mut decoded),
            ("QUATERNION", 8) => filter::quaternion(&mut decoded),
            ("EXPONENTIAL", _) => filter::exponential(&mut decoded),
            ("COLOR", 4) => filter::color_8(&mut decoded),
            ("COLOR", 8) => filter::color_16(&mut decoded),
            ("OCTAHEDRAL" | "QUATERNION" | "COLOR", _) => {
                return Err("that filter needs elements of 4 or 8 bytes, QUATERNION of 8");
            }
            _ => return Err("allowed filters are NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL and COLOR"),
        }
        Ok(decoded)
    }
}

/// Indices as bytes, two or four each.
fn narrow(indices: Vec<u32>, stride: usize) -> Vec<u8> {
    indices.into_iter().flat_map(|i| i.to_le_bytes().into_iter().take(stride)).collect()
}

#[cfg(test)]
mod tests;
