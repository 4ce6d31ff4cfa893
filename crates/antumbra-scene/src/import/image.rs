//! PNG, JPEG and WebP to 8-bit RGBA.

use crate::Image;
use std::io::Cursor;
use zune_jpeg::{
    JpegDecoder,
    zune_core::{colorspace::ColorSpace, options::DecoderOptions},
};

/// Most pixels that are decoded: 256 MiB of RGBA.
const MAX_PIXELS: u64 = 1 << 26;
/// No PNG (deflate reaches 1032:1) and no sensible JPEG packs more pixels into a byte of file, so
/// what claims more is refused before its pixels are allocated. One-bit PNGs hold 8 in a byte.
const MAX_PIXELS_PER_BYTE: u64 = 8 * 1032;

/// Decodes a file by its first bytes; the name and the addressing are filled in by the caller.
pub(super) fn decode(bytes: &[u8]) -> Result<Image, String> {
    if bytes.starts_with(b"\x89PNG\r\n\x1a\n") {
        png(bytes)
    } else if bytes.starts_with(b"\xff\xd8\xff") {
        jpeg(bytes)
    } else if bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP") {
        webp(bytes)
    } else {
        Err("it is neither PNG nor JPEG nor WebP by its first bytes".into())
    }
}

/// What a sound file that is not decoded here is, by its first bytes.
pub(super) fn other_format(bytes: &[u8]) -> Option<&'static str> {
    let starts = |mark: &[u8]| bytes.starts_with(mark);
    match bytes {
        _ if starts(b"\xabKTX 20\xbb\r\n\x1a\n") => Some(KTX2),
        _ if starts(b"\xabKTX 11\xbb\r\n\x1a\n") => Some("KTX"),
        _ if starts(b"DDS ") => Some("DDS"),
        _ if starts(b"GIF8") => Some("GIF"),
        _ if starts(b"II*\0") || starts(b"MM\0*") => Some("TIFF"),
        _ if starts(b"#?RADIANCE") => Some("HDR"),
        _ if starts(b"v/1\x01") => Some("EXR"),
        _ if bytes.get(4..12) == Some(b"ftypavif") => Some("AVIF"),
        [b'B', b'M', ..] if bytes.len() > 26 => Some("BMP"),
        _ => None,
    }
}

const KTX2: &str = "KTX2";

/// The program that converts a format within a glTF file, for messages; empty if there is none.
pub(super) fn converter(format: &str) -> &'static str {
    if format == KTX2 { " with `gltf-transform ktxdecompress in.glb out.glb`" } else { "" }
}

fn check_size(width: u64, height: u64, bytes: usize) -> Result<(), String> {
    let pixels = width.saturating_mul(height);
    if pixels == 0 || pixels > MAX_PIXELS || pixels / MAX_PIXELS_PER_BYTE > bytes as u64 {
        return Err(format!(
            "it claims {width}x{height} pixels in {bytes} bytes; allowed are 1 to {MAX_PIXELS} pixels and at \
             most {MAX_PIXELS_PER_BYTE} a byte"
        ));
    }
    Ok(())
}

fn image(width: u32, height: u32, rgba: Vec<u8>) -> Image {
    Image { name: String::new(), width, height, rgba, repeat: [true; 2] }
}

fn png(bytes: &[u8]) -> Result<Image, String> {
    let limits = png::Limits { bytes: 4 * MAX_PIXELS as usize };
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), limits);
    decoder.set_transformations(png::Transformations::normalize_to_color8() | png::Transformations::ALPHA);
    let header = decoder.read_header_info().map_err(|e| e.to_string())?;
    check_size(header.width.into(), header.height.into(), bytes.len())?;
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let size = reader.output_buffer_size().ok_or("its size overflows")?;
    let mut pixels = vec![0; size];
    let info = reader.next_frame(&mut pixels).map_err(|e| e.to_string())?;
    pixels.truncate(info.buffer_size());
    let rgba = match info.color_type {
        png::ColorType::Rgba => pixels,
        png::ColorType::GrayscaleAlpha => {
            pixels.chunks_exact(2).flat_map(|p| [p[0], p[0], p[0], p[1]]).collect()
        }
        png::ColorType::Rgb => pixels.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect(),
        other => return Err(format!("its colours come out as {other:?}")),
    };
    Ok(image(info.width, info.height, rgba))
}

fn webp(bytes: &[u8]) -> Result<Image, String> {
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions();
    let size = decoder.output_buffer_size().ok_or("its size overflows")?;
    if u64::from(width) * u64::from(height) > MAX_PIXELS {
        return Err(format!("it claims {width}x{height} pixels; allowed are 1 to {MAX_PIXELS}"));
    }
    let mut pixels = vec![0; size];
    decoder.read_image(&mut pixels).map_err(|e| e.to_string())?;
    let rgba = if decoder.has_alpha() {
        pixels
    } else {
        pixels.chunks_exact(3).flat_map(|p| [p[0], p[1], p[2], 255]).collect()
    };
    Ok(image(width, height, rgba))
}

fn jpeg(bytes: &[u8]) -> Result<Image, String> {
    let options = DecoderOptions::default().jpeg_set_out_colorspace(ColorSpace::RGBA);
    let mut decoder = JpegDecoder::new_with_options(Cursor::new(bytes), options);
    decoder.decode_headers().map_err(|e| e.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("it has no size")?;
    check_size(width as u64, height as u64, bytes.len())?;
    let rgba = decoder.decode().map_err(|e| e.to_string())?;
    if rgba.len() != 4 * width * height {
        return Err(format!("{} bytes came out for {width}x{height} pixels", rgba.len()));
    }
    Ok(image(width as u32, height as u32, rgba))
}
