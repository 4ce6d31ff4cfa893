//! Pictures as they are kept, cut out and enlarged.

use crate::cache::packed;
use antumbra_lab::image::{self, GrayImage, Rgba8Image};
use anyhow::Result;
use serde::{Deserialize, Serialize};

/// 8-bit sRGB colour that can be kept on disk.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredImage {
    /// Pixels across and down.
    pub size: [u32; 2],
    #[serde(with = "packed")]
    rgba: Vec<u8>,
}

/// A rectangle of pixels: left, top, width, height.
pub type Window = [u32; 4];

impl From<Rgba8Image> for StoredImage {
    fn from(image: Rgba8Image) -> Self {
        Self { size: [image.width, image.height], rgba: image.rgba }
    }
}

impl StoredImage {
    /// As a PNG file.
    ///
    /// # Errors
    /// What the encoder says.
    pub fn png(&self) -> Result<Vec<u8>> {
        let [width, height] = self.size;
        Ok(Rgba8Image::new(width, height, self.rgba.clone())?.to_png()?)
    }

    /// A part of it, each pixel as a square of `zoom` by `zoom`.
    ///
    /// # Errors
    /// A window that is empty or leaves the picture.
    pub fn close_up(&self, window: Window, zoom: u32) -> Result<Self> {
        let pixels: Vec<&[u8]> = self.rgba.chunks_exact(4).collect();
        let cut = image::crop(&pixels, self.size, window)?;
        let [width, height] = [window[2], window[3]].map(|n| n * zoom);
        let at = |x: u32, y: u32| cut[((y / zoom) * window[2] + x / zoom) as usize];
        let rgba = (0..height).flat_map(|y| (0..width).flat_map(move |x| at(x, y).iter().copied()));
        Ok(Self { size: [width, height], rgba: rgba.collect() })
    }

    /// The same with a red frame around a window.
    #[must_use]
    pub fn framed(&self, [left, top, width, height]: Window) -> Self {
        let mut framed = self.clone();
        let thick = (self.size[0] / 300).max(1);
        for (i, pixel) in framed.rgba.chunks_exact_mut(4).enumerate() {
            let (x, y) = (i as u32 % self.size[0], i as u32 / self.size[0]);
            let within = |grow: u32| {
                (left.saturating_sub(grow)..left + width + grow).contains(&x)
                    && (top.saturating_sub(grow)..top + height + grow).contains(&y)
            };
            if within(thick) && !within(0) {
                pixel.copy_from_slice(&[214, 30, 30, 255]);
            }
        }
        framed
    }
}

/// How far two pictures of one size are apart in each pixel: squares of their differences in colour.
#[must_use]
pub fn difference(a: &StoredImage, b: &StoredImage) -> Vec<f64> {
    let pixel = |(a, b): (&[u8], &[u8])| {
        a.iter().zip(b).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2) / 65025.0).sum()
    };
    a.rgba.chunks_exact(4).zip(b.rgba.chunks_exact(4)).map(pixel).collect()
}

/// Visibility in linear grey, half of it being byte 128.
#[must_use]
pub fn gray(plane: &GrayImage) -> StoredImage {
    let byte = |v: &f32| (v.clamp(0.0, 1.0) * 255.0).round() as u8;
    let rgba = plane.values.iter().flat_map(|v| [byte(v), byte(v), byte(v), 255]);
    StoredImage { size: [plane.width, plane.height], rgba: rgba.collect() }
}

/// The window of that size in which the sum of `weights` (one per pixel) is largest; the first of
/// equals. A size beyond the picture's becomes the picture's.
#[must_use]
pub fn busiest(weights: &[f64], picture: [u32; 2], size: [u32; 2]) -> Window {
    let [width, height] = [0, 1].map(|i| picture[i] as usize);
    let [w, h] = [0, 1].map(|i| size[i].min(picture[i]).max(1) as usize);
    // Sums over all above and to the left.
    let mut sums = vec![0.0; (width + 1) * (height + 1)];
    for y in 0..height {
        for x in 0..width {
            let weight = weights.get(y * width + x).copied().unwrap_or(0.0);
            sums[(y + 1) * (width + 1) + x + 1] =
                weight + sums[y * (width + 1) + x + 1] + sums[(y + 1) * (width + 1) + x]
                    - sums[y * (width + 1) + x];
        }
    }
    let sum = |x: usize, y: usize| sums[y * (width + 1) + x];
    let mut best = ([0, 0], f64::NEG_INFINITY);
    for y in 0..=height - h {
        for x in 0..=width - w {
            let inside = sum(x + w, y + h) - sum(x, y + h) - sum(x + w, y) + sum(x, y);
            // Beyond the rounding of the sums.
            if inside > best.1 + 1e-9 {
                best = ([x as u32, y as u32], inside);
            }
        }
    }
    [best.0[0], best.0[1], w as u32, h as u32]
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests fail by panicking")]
mod tests {
    use super::*;

    #[test]
    fn the_busiest_window_covers_what_weighs_most() {
        let mut weights = vec![0.0; 80];
        weights[10 * 5 + 7] = 1.0;
        weights[10 * 6 + 8] = 2.0;
        let [x, y, w, h] = busiest(&weights, [10, 8], [3, 2]);
        assert_eq!([w, h], [3, 2]);
        assert!((6..=7).contains(&x) && y == 5, "{x} {y}");
        assert_eq!(busiest(&weights, [10, 8], [99, 99]), [0, 0, 10, 8]);
    }

    #[test]
    fn a_close_up_enlarges_its_window() {
        let plane = GrayImage::from_fn(4, 3, |x, y| (x + y) as f32 / 8.0);
        let cut = gray(&plane).close_up([1, 1, 2, 2], 3).unwrap();
        assert_eq!(cut.size, [6, 6]);
        assert_eq!(cut.rgba[..12], [64, 64, 64, 255].repeat(3));
        assert!(gray(&plane).close_up([3, 0, 2, 2], 1).is_err());
        let other = gray(&GrayImage::filled(4, 3, 0.0));
        assert_eq!(difference(&gray(&plane), &gray(&plane)), [0.0; 12]);
        assert!(difference(&gray(&plane), &other)[11] > difference(&gray(&plane), &other)[1]);
        assert!(gray(&plane).framed([1, 1, 2, 1]).rgba.chunks_exact(4).any(|p| p[0] == 214));
    }
}
