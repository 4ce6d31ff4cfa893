//! Pictures of the lab: linear images and 8-bit colour, and the files they become.
//!
//! A [`GrayImage`] holds one number per pixel, here nearly always a visibility: 1 lit, 0 shadowed.
//! It stays linear on its way to a file. [`GrayImage::to_gray_png`] maps 0..1 straight to 0..255, with
//! no sRGB curve: a visibility of 0.5 is the byte 128, and the bytes can be measured again.

use std::io::{Cursor, Write};

/// A linear single-channel image, row by row from the top left.
#[derive(Debug, Clone, PartialEq)]
pub struct GrayImage {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `width · height` values.
    pub values: Vec<f32>,
}

/// 8-bit sRGB colour with straight alpha, row by row from the top left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Rgba8Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// `4 · width · height` bytes.
    pub rgba: Vec<u8>,
}

/// Why an image could not be made or encoded.
#[derive(Debug, thiserror::Error)]
pub enum ImageError {
    /// The number of values is not what the size asks for.
    #[error(
        "{width}×{height} pixels need {expected} values, got {got}: pass one value per pixel (and channel)"
    )]
    Length {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Values that the size asks for.
        expected: usize,
        /// Values that were given.
        got: usize,
    },
    /// A rectangle leaves the image or holds no pixel.
    #[error(
        "rectangle at ({x}, {y}) of {width}×{height} is empty or leaves an image of {image_width}×{image_height}"
    )]
    Rectangle {
        /// Left column.
        x: u32,
        /// Top row.
        y: u32,
        /// Columns.
        width: u32,
        /// Rows.
        height: u32,
        /// Pixels across the image.
        image_width: u32,
        /// Pixels down the image.
        image_height: u32,
    },
    /// The PNG encoder refused.
    #[error("cannot encode a {width}×{height} PNG: {source}")]
    Png {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// What the encoder said.
        source: png::EncodingError,
    },
    /// The EXR encoder refused.
    #[error("cannot encode a {width}×{height} EXR: {source}")]
    Exr {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// What the encoder said.
        source: exr::error::Error,
    },
}

fn check_length(width: u32, height: u32, channels: usize, got: usize) -> Result<(), ImageError> {
    let expected = width as usize * height as usize * channels;
    if expected == got { Ok(()) } else { Err(ImageError::Length { width, height, expected, got }) }
}

impl GrayImage {
    /// Wraps values, row by row from the top left.
    ///
    /// # Errors
    /// [`ImageError::Length`] unless there are `width · height` of them.
    pub fn new(width: u32, height: u32, values: Vec<f32>) -> Result<Self, ImageError> {
        check_length(width, height, 1, values.len())?;
        Ok(Self { width, height, values })
    }

    /// A gray with one value everywhere.
    #[must_use]
    pub fn filled(width: u32, height: u32, value: f32) -> Self {
        Self { width, height, values: vec![value; width as usize * height as usize] }
    }

    /// A gray computed from column and row.
    #[must_use]
    pub fn from_fn(width: u32, height: u32, mut value: impl FnMut(u32, u32) -> f32) -> Self {
        let values = (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| value(x, y));
        Self { width, height, values: values.collect() }
    }

    /// The value at column `x`, row `y`; `None` outside.
    #[must_use]
    pub fn get(&self, x: u32, y: u32) -> Option<f32> {
        if x >= self.width || y >= self.height {
            return None;
        }
        self.values.get(y as usize * self.width as usize + x as usize).copied()
    }

    /// A copy of the rectangle whose left top pixel is (`x`, `y`).
    ///
    /// # Errors
    /// [`ImageError::Rectangle`] if it is empty or leaves the gray.
    pub fn crop(&self, x: u32, y: u32, width: u32, height: u32) -> Result<Self, ImageError> {
        let values = crop(&self.values, [self.width, self.height], [x, y, width, height])?;
        Ok(Self { width, height, values })
    }

    /// An 8-bit gray PNG. Linear: 0..1 becomes 0..255 with rounding and without the sRGB curve,
    /// outside values are clamped, NaN becomes 0.
    ///
    /// # Errors
    /// [`ImageError::Png`] for an empty image.
    pub fn to_gray_png(&self) -> Result<Vec<u8>, ImageError> {
        let bytes: Vec<u8> = self.values.iter().map(|v| (v * 255.0).round() as u8).collect();
        encode_png([self.width, self.height], png::ColorType::Grayscale, &bytes)
    }

    /// An OpenEXR file with one f32 channel "V", ZIP-compressed without loss: every value as it is.
    ///
    /// # Errors
    /// [`ImageError::Exr`] for an empty image.
    pub fn to_exr(&self) -> Result<Vec<u8>, ImageError> {
        use exr::prelude::{AnyChannel, AnyChannels, Encoding, FlatSamples, Image, Layer, LayerAttributes};
        use exr::prelude::{SmallVec, WritableImage};
        let samples = FlatSamples::F32(self.values.clone());
        let channels = AnyChannels::sort(SmallVec::from_vec(vec![AnyChannel::new("V", samples)]));
        let size = (self.width as usize, self.height as usize);
        let attributes = LayerAttributes::named("visibility");
        let encoding = Encoding::SMALL_LOSSLESS;
        let layer = Layer::new(size, attributes, encoding, channels);
        let mut file = Cursor::new(Vec::new());
        Image::from_layer(layer)
            .write()
            .non_parallel()
            .to_buffered(&mut file)
            .map_err(|source| ImageError::Exr { width: self.width, height: self.height, source })?;
        Ok(file.into_inner())
    }
}

impl Rgba8Image {
    /// Wraps bytes, four per pixel.
    ///
    /// # Errors
    /// [`ImageError::Length`] unless there are `4 · width · height` of them.
    pub fn new(width: u32, height: u32, rgba: Vec<u8>) -> Result<Self, ImageError> {
        check_length(width, height, 4, rgba.len())?;
        Ok(Self { width, height, rgba })
    }

    /// An 8-bit RGBA PNG, tagged sRGB.
    ///
    /// # Errors
    /// [`ImageError::Png`] for an empty image.
    pub fn to_png(&self) -> Result<Vec<u8>, ImageError> {
        encode_png([self.width, self.height], png::ColorType::Rgba, &self.rgba)
    }
}

/// A copy of the rectangle `[x, y, width, height]` of anything with one entry per pixel, such as a
/// shadowable mask.
///
/// # Errors
/// [`ImageError::Rectangle`] if it is empty or leaves the image.
pub fn crop<T: Copy>(entries: &[T], size: [u32; 2], rectangle: [u32; 4]) -> Result<Vec<T>, ImageError> {
    let [image_width, image_height] = size;
    check_length(image_width, image_height, 1, entries.len())?;
    let [x, y, width, height] = rectangle;
    let fits = |start: u32, length: u32, limit: u32| {
        length > 0 && u64::from(start) + u64::from(length) <= u64::from(limit)
    };
    if !fits(x, width, image_width) || !fits(y, height, image_height) {
        return Err(ImageError::Rectangle { x, y, width, height, image_width, image_height });
    }
    let rows = entries.chunks_exact(image_width as usize).skip(y as usize).take(height as usize);
    Ok(rows.flat_map(|row| &row[x as usize..(x + width) as usize]).copied().collect())
}

/// The signed error `test − truth` of visibilities as colour: blue where the test is too dark, red
/// where it is too bright, white where it agrees, mid-gray where the pixel is not shadowable.
///
/// CIELAB lightness falls with |error|^0.7 on both sides alike, so that equal errors look equally
/// large, small ones stay visible, and blue against red survives the common colour deficiencies.
///
/// # Errors
/// [`ImageError::Length`] if the three do not have the same number of pixels.
pub fn error_heat_map(
    test: &GrayImage,
    truth: &GrayImage,
    shadowable: &[bool],
) -> Result<Rgba8Image, ImageError> {
    let GrayImage { width, height, .. } = *truth;
    check_length(width, height, 1, test.values.len())?;
    check_length(width, height, 1, truth.values.len())?;
    check_length(width, height, 1, shadowable.len())?;
    let errors = test.values.iter().zip(&truth.values).map(|(v, t)| v - t);
    let pixels = errors.zip(shadowable).map(|(e, &shadowable)| {
        let [r, g, b] = if shadowable { diverging(e) } else { [128; 3] };
        [r, g, b, 255]
    });
    Ok(Rgba8Image { width, height, rgba: pixels.flatten().collect() })
}

/// Colour of a signed error in [−1, 1] (clamped; NaN is magenta, which the map never makes).
#[must_use]
pub fn diverging(error: f32) -> [u8; 3] {
    if error.is_nan() {
        return [255, 0, 255];
    }
    // CIELAB (D65) of the two ends, at one lightness; white is L = 100, a = b = 0. Errors under a
    // tenth matter, so the ramp is steeper near zero; √|e| would show the noise of the truth.
    const TOO_DARK: [f32; 3] = [36.0, 14.0, -58.0];
    const TOO_BRIGHT: [f32; 3] = [36.0, 56.0, 44.0];
    let end = if error < 0.0 { TOO_DARK } else { TOO_BRIGHT };
    let t = error.abs().min(1.0).powf(0.7);
    srgb_from_lab([100.0 + t * (end[0] - 100.0), t * end[1], t * end[2]])
}

fn srgb_from_lab([l, a, b]: [f32; 3]) -> [u8; 3] {
    let inverse = |t: f32| if t > 6.0 / 29.0 { t * t * t } else { (t - 4.0 / 29.0) * 108.0 / 841.0 };
    let fy = (l + 16.0) / 116.0;
    let [x, y, z] = [0.95047 * inverse(fy + a / 500.0), inverse(fy), 1.08883 * inverse(fy - b / 200.0)];
    let linear = [
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    ];
    linear.map(|v| {
        let v = v.clamp(0.0, 1.0);
        let encoded = if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 };
        (encoded * 255.0).round() as u8
    })
}

fn encode_png(size: [u32; 2], color: png::ColorType, bytes: &[u8]) -> Result<Vec<u8>, ImageError> {
    let [width, height] = size;
    let encode = || -> Result<Vec<u8>, png::EncodingError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, width, height);
        encoder.set_color(color);
        encoder.set_depth(png::BitDepth::Eight);
        if color == png::ColorType::Rgba {
            encoder.set_source_srgb(png::SrgbRenderingIntent::RelativeColorimetric);
        }
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()?;
        file.flush()?;
        Ok(file)
    };
    encode().map_err(|source| ImageError::Png { width, height, source })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_visibility_is_byte_128_in_a_linear_png() {
        let gray = GrayImage::new(4, 1, vec![0.0, 0.5, 1.0, 7.0]).unwrap();
        let png = gray.to_gray_png().unwrap();
        let mut reader = png::Decoder::new(Cursor::new(png)).read_info().unwrap();
        let mut bytes = vec![0; 4];
        reader.next_frame(&mut bytes).unwrap();
        assert_eq!(bytes, [0, 128, 255, 255]);
    }

    #[test]
    fn exr_returns_every_value() {
        use exr::prelude::{ReadChannels, ReadLayers};
        let gray = GrayImage::from_fn(37, 19, |x, y| (x as f32 * 0.1 - y as f32 / 7.0).sin());
        let file = gray.to_exr().unwrap();
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .all_channels()
            .first_valid_layer()
            .all_attributes()
            .from_buffered(Cursor::new(file))
            .unwrap();
        let channel = &image.layer_data.channel_data.list[0];
        assert_eq!(channel.name.to_string(), "V");
        assert_eq!(channel.sample_data.values_as_f32().collect::<Vec<_>>(), gray.values);
    }

    #[test]
    fn heat_map_has_a_side_for_each_sign() {
        let truth = GrayImage::filled(4, 1, 0.5);
        let test = GrayImage::new(4, 1, vec![0.0, 0.5, 1.0, 1.0]).unwrap();
        let map = error_heat_map(&test, &truth, &[true, true, true, false]).unwrap();
        let pixel = |i: usize| [map.rgba[4 * i], map.rgba[4 * i + 1], map.rgba[4 * i + 2]];
        assert!(pixel(0)[2] > pixel(0)[0], "too dark is blue: {:?}", pixel(0));
        assert_eq!(pixel(1), [255, 255, 255]);
        assert!(pixel(2)[0] > pixel(2)[2], "too bright is red: {:?}", pixel(2));
        assert_eq!(pixel(3), [128, 128, 128]);
    }

    #[test]
    fn heat_map_rejects_other_sizes() {
        let small = GrayImage::filled(3, 1, 0.5);
        assert!(error_heat_map(&small, &GrayImage::filled(4, 1, 0.5), &[true; 4]).is_err());
    }

    #[test]
    fn crop_takes_the_right_pixels_and_stays_inside() {
        let gray = GrayImage::from_fn(4, 3, |x, y| (10 * y + x) as f32);
        assert_eq!(gray.crop(1, 1, 2, 2).unwrap().values, [11.0, 12.0, 21.0, 22.0]);
        assert!(gray.crop(3, 0, 2, 1).is_err());
        assert!(gray.crop(u32::MAX, 0, 2, 1).is_err());
        assert_eq!(gray.get(3, 2), Some(23.0));
        assert_eq!(gray.get(4, 0), None);
    }
}
