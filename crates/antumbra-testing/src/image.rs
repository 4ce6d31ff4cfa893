//! Eight-bit images: files, differences, and references that a test compares with.

use std::{
    fs::File,
    io::{BufReader, BufWriter},
    path::Path,
};

/// Rows of pixels without padding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// 1 (grey), 3 (RGB) or 4 (RGBA).
    pub channels: usize,
    /// Channel after channel, pixel after pixel.
    pub bytes: Vec<u8>,
}

/// How far two images may be apart, in levels of 255.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerance {
    /// Mean over all channels.
    pub mean: f64,
    /// Largest.
    pub max: u8,
}

impl Image {
    /// Grey levels of values from 0 to 1.
    #[must_use]
    pub fn grey(width: u32, values: &[f32]) -> Self {
        let bytes: Vec<u8> = values.iter().map(|v| (v * 255.0).round() as u8).collect();
        Self { width, height: bytes.len() as u32 / width, channels: 1, bytes }
    }

    /// Reads a PNG file.
    ///
    /// # Errors
    /// What is wrong with the file.
    pub fn read(path: &Path) -> Result<Self, String> {
        let at = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
        let file = File::open(path).map_err(|e| at(&e))?;
        let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(|e| at(&e))?;
        let mut bytes = vec![0; reader.output_buffer_size().unwrap_or(0)];
        let info = reader.next_frame(&mut bytes).map_err(|e| at(&e))?;
        bytes.truncate(info.buffer_size());
        let channels = info.color_type.samples();
        Ok(Self { width: info.width, height: info.height, channels, bytes })
    }

    /// Writes a PNG file and the folders above it.
    ///
    /// # Errors
    /// What prevents it.
    pub fn write(&self, path: &Path) -> Result<(), String> {
        let at = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder).map_err(|e| at(&e))?;
        }
        let file = BufWriter::new(File::create(path).map_err(|e| at(&e))?);
        let mut encoder = png::Encoder::new(file, self.width, self.height);
        encoder.set_color(match self.channels {
            1 => png::ColorType::Grayscale,
            3 => png::ColorType::Rgb,
            _ => png::ColorType::Rgba,
        });
        let mut writer = encoder.write_header().map_err(|e| at(&e))?;
        writer.write_image_data(&self.bytes).map_err(|e| at(&e))
    }

    /// Whether the images are alike.
    ///
    /// # Errors
    /// By how much they are not.
    pub fn compare(&self, other: &Self, tolerance: Tolerance) -> Result<(), String> {
        let shape = |i: &Self| (i.width, i.height, i.channels);
        if shape(self) != shape(other) {
            return Err(format!("{:?} and {:?} are different shapes", shape(self), shape(other)));
        }
        let differences = || self.bytes.iter().zip(&other.bytes).map(|(a, b)| a.abs_diff(*b));
        let max = differences().max().unwrap_or(0);
        let mean = differences().map(f64::from).sum::<f64>() / self.bytes.len().max(1) as f64;
        if max > tolerance.max || mean > tolerance.mean {
            return Err(format!(
                "differs by {mean:.2} on average (allowed {}) and at most {max} (allowed {}) of 255",
                tolerance.mean, tolerance.max
            ));
        }
        Ok(())
    }

    /// Compares with the reference at `path`; a missing reference is a failure. With
    /// `ANTUMBRA_BLESS=1` in the environment the reference is written instead.
    ///
    /// # Errors
    /// What differs or is missing.
    pub fn compare_with_reference(&self, path: &Path, tolerance: Tolerance) -> Result<(), String> {
        if std::env::var_os("ANTUMBRA_BLESS").is_some_and(|v| v == "1") {
            return self.write(path);
        }
        let reference = Self::read(path)
            .map_err(|e| format!("{e}; run with ANTUMBRA_BLESS=1 to write it, then look at it"))?;
        self.compare(&reference, tolerance).map_err(|e| format!("{}: {e}", path.display()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_and_missing_references_are_found() {
        let tolerance = Tolerance { mean: 2.0, max: 10 };
        let a = Image::grey(4, &[0.5; 8]);
        assert_eq!(a.height, 2);
        a.compare(&a, tolerance).unwrap();
        let mut b = a.clone();
        b.bytes[3] += 9;
        a.compare(&b, tolerance).unwrap();
        b.bytes[3] += 9;
        a.compare(&b, tolerance).unwrap_err();
        a.compare(&Image::grey(4, &[0.52; 8]), tolerance).unwrap_err();
        a.compare(&Image::grey(2, &[0.5; 8]), tolerance).unwrap_err();
        a.compare_with_reference(Path::new("no such file.png"), tolerance).unwrap_err();
    }

    #[test]
    fn files_keep_every_byte() {
        let path = std::env::temp_dir().join(format!("antumbra-image-{}.png", std::process::id()));
        for channels in [1, 3, 4] {
            let bytes = (0..6 * channels as u8).map(|i| i * 7).collect();
            let image = Image { width: 3, height: 2, channels, bytes };
            image.write(&path).unwrap();
            assert_eq!(Image::read(&path).unwrap(), image);
        }
        std::fs::remove_file(path).unwrap();
    }
}
