//! LDR-ꟻLIP of gray images [Andersson et al. 2020]: the difference that a person sees when flipping
//! between two images, at 67 pixels per degree (0.7 m from a 0.7 m wide 4K screen).
//!
//! Visibility v is taken as the linear light of a white surface. Gray images have no chroma, before
//! and after every linear filter, so the paper's colour pipeline keeps its achromatic channel only:
//! Y = 116 v − 16 before the contrast-sensitivity filter, L* after it. Pixels that are not
//! shadowable are filled with 1 in both images, so that they add no difference of their own.

use super::convolve::{Border, Field, gaussian};
use crate::image::GrayImage;

/// The paper's standard viewing condition.
const PIXELS_PER_DEGREE: f64 = 67.0;
/// Exponents q_c, q_f and the remapping knee p_c, p_t [table 1 and §4].
const QC: f32 = 0.7;
const QF: f32 = 0.5;
const PC: f32 = 0.4;
const PT: f32 = 0.95;
/// Width of the feature detectors, degrees [§4.2].
const FEATURE_WIDTH: f64 = 0.082;
/// Hunt-adjusted HyAB distance from green to blue, the largest in sRGB, to the power q_c: 203.3017^0.7.
const LARGEST_DISTANCE: f32 = 41.276_1;

/// Mean over shadowable pixels, 0..1; 0 for equal images.
pub(super) fn mean(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> f64 {
    let counted = map(test, truth, shadowable).into_iter().zip(shadowable).filter(|&(_, &s)| s);
    let (sum, pixels) = counted.fold((0.0, 0.0), |(sum, n), (v, _)| (sum + f64::from(v), n + 1.0));
    sum / pixels
}

fn map(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> Vec<f32> {
    let fill = |plane: &GrayImage| {
        let values = plane.values.iter().zip(shadowable);
        let values = values.map(|(&v, &s)| if s { v.clamp(0.0, 1.0) } else { 1.0 }).collect();
        Field { width: plane.width as usize, values }
    };
    let (test, truth) = (fill(test), fill(truth));
    let color = lightness(&test).zip(&lightness(&truth), |a, b| remap((a - b).abs().powf(QC)));
    let ([edge_a, point_a], [edge_b, point_b]) = (features(&test), features(&truth));
    let edges = edge_a.zip(&edge_b, |a, b| (a - b).abs());
    let points = point_a.zip(&point_b, |a, b| (a - b).abs());
    let feature = edges.zip(&points, |e, p| (e.max(p) * std::f32::consts::FRAC_1_SQRT_2).powf(QF));
    color.zip(&feature, |c, f| c.powf(1.0 - f)).values
}

/// L* after the contrast-sensitivity filter of the achromatic channel.
fn lightness(linear: &Field) -> Field {
    // The paper's filter is exp(−π² d²/b) with d in degrees and b = 0.0047 for the achromatic
    // channel: a Gaussian with σ² = b/2π². Its radius is that of the widest channel, b = 0.04.
    let sigma = |b: f64| (b / 2.0).sqrt() / std::f64::consts::PI * PIXELS_PER_DEGREE;
    let kernel = gaussian(sigma(0.0047), (3.0 * sigma(0.04)).ceil() as usize);
    let filtered = linear.correlate(&kernel, &kernel, Border::Clamp);
    filtered.zip(&filtered, |v, _| {
        let v = v.clamp(0.0, 1.0);
        let delta = 6.0_f32 / 29.0;
        let f = if v > delta.powi(3) { v.cbrt() } else { v / (3.0 * delta * delta) + 4.0 / 29.0 };
        116.0 * f - 16.0
    })
}

/// Maps a distance to the power q_c to 0..1: small ones stretched to p_t, the rest compressed.
fn remap(distance: f32) -> f32 {
    let knee = PC * LARGEST_DISTANCE;
    if distance < knee {
        distance * PT / knee
    } else {
        PT + (distance - knee) / (LARGEST_DISTANCE - knee) * (1.0 - PT)
    }
}

/// Strength of edges and of points: lengths of the gradients that the first and second derivative
/// of a Gaussian measure.
fn features(linear: &Field) -> [Field; 2] {
    let sigma = 0.5 * FEATURE_WIDTH * PIXELS_PER_DEGREE;
    let radius = (3.0 * sigma).ceil() as usize;
    let smooth = gaussian(sigma, radius);
    let derivative = |shape: &dyn Fn(f64) -> f64| {
        let weight = |i: usize| shape(i as f64 - radius as f64) * f64::from(smooth[i]);
        balance((0..=2 * radius).map(weight).collect())
    };
    let edge = derivative(&|x| -x);
    let point = derivative(&|x| x * x / (sigma * sigma) - 1.0);
    [edge, point].map(|kernel| {
        let across = linear.correlate(&kernel, &smooth, Border::Clamp);
        across.zip(&linear.correlate(&smooth, &kernel, Border::Clamp), f32::hypot)
    })
}

/// Scales positive weights to sum 1 and negative ones to sum −1.
fn balance(weights: Vec<f64>) -> Vec<f32> {
    let sum = |sign: f64| weights.iter().map(|w| (w * sign).max(0.0)).sum::<f64>();
    let (positive, negative) = (sum(1.0), sum(-1.0));
    weights.iter().map(|&w| (if w > 0.0 { w / positive } else { w / negative }) as f32).collect()
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

    fn against_disc(test: &GrayImage) -> f64 {
        mean(test, &disc(0.0), &[true; 96 * 64])
    }

    /// The numbers are those of the authors' Python package: flip-evaluator 1.7,
    /// `evaluate(disc, test, "LDR", inputsRGB=False)`, both images repeated to three channels.
    #[test]
    fn equals_the_authors_program() {
        let near = |ours: f64, theirs: f64| assert!((ours - theirs).abs() < 1e-4, "{ours} is not {theirs}");
        near(against_disc(&disc(8.0)), 0.106_495);
        near(
            against_disc(&GrayImage::from_fn(96, 64, |x, y| disc(0.0).get((x + 95) % 96, y).unwrap())),
            0.046_319,
        );
        let bands = GrayImage::from_fn(96, 64, |x, y| 0.5 + 0.5 * (x as f32 * 0.7 + y as f32 * 0.3).sin());
        near(against_disc(&bands), 0.760_872);
        near(against_disc(&GrayImage::filled(96, 64, 1.0)), 0.238_659);
        near(against_disc(&GrayImage::from_fn(96, 64, |x, _| x as f32 / 95.0)), 0.690_380);
    }

    #[test]
    fn equal_images_score_zero_and_black_against_white_one() {
        assert_eq!(against_disc(&disc(0.0)), 0.0);
        let largest = mean(&GrayImage::filled(30, 30, 0.0), &GrayImage::filled(30, 30, 1.0), &[true; 900]);
        // Lightness alone: 100^0.7 of the largest colour distance.
        assert!((largest - f64::from(remap(100.0_f32.powf(QC)))).abs() < 1e-4, "{largest}");
    }

    #[test]
    fn pixels_without_shadow_add_nothing() {
        let mut noisy = disc(0.0);
        noisy.values[..960].fill(0.3);
        let mask: Vec<bool> = (0..96 * 64).map(|i| i >= 960).collect();
        assert_eq!(mean(&noisy, &disc(0.0), &mask), 0.0);
        assert!(against_disc(&noisy) > 0.01);
    }
}
