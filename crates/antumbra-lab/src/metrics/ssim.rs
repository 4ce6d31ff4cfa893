//! Structural similarity [Wang, Bovik, Sheikh and Simoncelli 2004, Eq. 13] with the paper's window
//! (11×11, Gaussian, σ = 1.5) and constants (K₁ = 0.01, K₂ = 0.03, range 1).
//!
//! Pixels that are not shadowable have no visibility to compare. The window gives them weight 0 and
//! is scaled to sum 1 over the rest, at the image's border likewise.

use super::convolve::{Border, Field, gaussian};
use crate::image::GrayImage;

const RADIUS: usize = 5;
const SIGMA: f64 = 1.5;
const C1: f32 = 0.01 * 0.01;
const C2: f32 = 0.03 * 0.03;

/// Mean over shadowable pixels; 1 for equal images.
pub(super) fn mean(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> f64 {
    let counted = || map(test, truth, shadowable).into_iter().zip(shadowable).filter(|&(_, &s)| s);
    let (sum, pixels) = counted().fold((0.0, 0.0), |(sum, n), (v, _)| (sum + f64::from(v), n + 1.0));
    sum / pixels
}

/// Structural similarity of each pixel's window; only shadowable pixels mean anything.
fn map(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> Vec<f32> {
    let width = test.width as usize;
    let weight = Field { width, values: shadowable.iter().map(|&s| f32::from(u8::from(s))).collect() };
    let kernel = gaussian(SIGMA, RADIUS);
    let window = |field: &Field| field.correlate(&kernel, &kernel, Border::Zero);
    let total = window(&weight);
    let average = |f: &Field| {
        window(&f.zip(&weight, |v, w| if w > 0.0 { v * w } else { 0.0 })).zip(&total, |v, w| v / w)
    };
    let x = Field { width, values: test.values.clone() };
    let y = Field { width, values: truth.values.clone() };
    let (mean_x, mean_y) = (average(&x), average(&y));
    let xx = average(&x.zip(&x, |a, b| a * b)).zip(&mean_x, |s, m| s - m * m);
    let yy = average(&y.zip(&y, |a, b| a * b)).zip(&mean_y, |s, m| s - m * m);
    let means = mean_x.zip(&mean_y, |a, b| a * b);
    let xy = average(&x.zip(&y, |a, b| a * b)).zip(&means, |s, m| s - m);
    let luminance = mean_x.zip(&mean_y, |a, b| (2.0 * a * b + C1) / (a * a + b * b + C1));
    let spread = xx.zip(&yy, |a, b| a + b + C2);
    let structure = xy.zip(&spread, |c, s| (2.0 * c + C2) / s);
    luminance.zip(&structure, |l, s| l * s).values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc(soft: f32) -> GrayImage {
        GrayImage::from_fn(96, 64, |x, y| {
            let d = (x as f32 - 48.0).hypot(y as f32 - 32.0) - 20.0;
            if soft > 0.0 { (d / soft + 0.5).clamp(0.0, 1.0) } else { f32::from(u8::from(d > 0.0)) }
        })
    }

    /// Mean over the pixels whose window lies in the image: there, and only there, the reference
    /// and this module do the same.
    fn interior(test: &GrayImage, truth: &GrayImage) -> f64 {
        let map = map(test, truth, &[true; 96 * 64]);
        let inside = |i: &usize| (5..91).contains(&(i % 96)) && (5..59).contains(&(i / 96));
        let values: Vec<f64> = (0..map.len()).filter(inside).map(|i| f64::from(map[i])).collect();
        values.iter().sum::<f64>() / values.len() as f64
    }

    /// The numbers are those of scikit-image 0.26: `structural_similarity(test, disc, sigma=1.5,
    /// gaussian_weights=True, use_sample_covariance=False, data_range=1, full=True)`, border of 5 cut.
    #[test]
    fn equals_scikit_image() {
        let near = |ours: f64, theirs: f64| assert!((ours - theirs).abs() < 1e-4, "{ours} is not {theirs}");
        let truth = disc(0.0);
        near(interior(&disc(8.0), &truth), 0.758_126);
        near(interior(&GrayImage::filled(96, 64, 1.0), &truth), 0.593_941);
        let bands = GrayImage::from_fn(96, 64, |x, y| 0.5 + 0.5 * (x as f32 * 0.7 + y as f32 * 0.3).sin());
        near(interior(&bands, &truth), 0.018_926);
    }

    #[test]
    fn constants_differ_by_the_luminance_term_only() {
        let ssim = mean(&GrayImage::filled(20, 20, 0.5), &GrayImage::filled(20, 20, 1.0), &[true; 400]);
        let by_hand = (2.0 * 0.5 + 1e-4) / (0.25 + 1.0 + 1e-4);
        assert!((ssim - by_hand).abs() < 1e-5, "{ssim} is not {by_hand}");
    }

    #[test]
    fn pixels_without_shadow_add_nothing() {
        let mut noisy = disc(0.0);
        noisy.values[..960].fill(0.3);
        let mask: Vec<bool> = (0..96 * 64).map(|i| i >= 960).collect();
        assert_eq!(mean(&noisy, &disc(0.0), &mask), 1.0);
        assert!(mean(&noisy, &disc(0.0), &[true; 96 * 64]) < 0.95);
    }
}
