//! How far a visibility image is from the truth.
//!
//! Every number is over *shadowable* pixels, those that see geometry facing the light: the others
//! are dark or empty whatever the shadow map says, and would flatter every technique. Visibility is
//! linear, 1 lit and 0 shadowed.

use crate::image::GrayImage;
use serde::{Deserialize, Serialize};

mod convolve;
mod distance;
mod flip;
mod ssim;

/// Answers are lit from this visibility on.
pub const LIT_THRESHOLD: f32 = 0.5;

/// Pixels this close to a truth shadow edge count as near it, pixels.
pub const EDGE_PIXELS: u32 = 2;

/// Leak and over-darkening look only this far from any pixel of the other kind, pixels (the r of
/// the definitions): closer by, blur and aliasing are counted by the other metrics.
pub const DEEP_PIXELS: u32 = 4;

/// Smallest number of pixels over which leak and over-darkening are given. A mean of n values between 0 and 1
/// that are as different as can be is known to ½/√n: to 2.5 % with 400 pixels, a square of 20 × 20. Over
/// fewer, one small spot decides.
pub const MIN_DEEP_PIXELS: u64 = 400;

/// Tolerance within which a truth counts as fully lit (1) or fully shadowed (0), and by which an
/// answer may leave 0..1: rounding of sums of kernel weights.
const ROUNDING: f32 = 1e-3;

/// Error of one image against one truth, over shadowable pixels. `None` (`null` in JSON) where the
/// truth has no pixel of the kind that the metric asks about.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Score {
    /// Share of pixels with the same lit or shadowed answer, threshold ½; 0..1, 1 is best.
    pub pixel_match: f64,
    /// The same over pixels within [`EDGE_PIXELS`] of a truth shadow edge; 0..1, 1 is best.
    pub pixel_match_near_edges: Option<f64>,
    /// Root of the mean squared error; 0..1, 0 is best.
    pub rmse: f64,
    /// Mean absolute error; 0..1, 0 is best.
    pub mae: f64,
    /// Peak signal-to-noise ratio −20 log₁₀ RMSE, dB, higher is better; `None` if the RMSE is 0.
    pub psnr: Option<f64>,
    /// Structural similarity, 11×11 Gaussian window with σ = 1.5 pixels; −1..1, 1 is best.
    pub ssim: f64,
    /// Mean LDR-ꟻLIP at 67 pixels per degree; 0..1, 0 is best.
    pub flip: f64,
    /// Mean visibility over pixels that are fully shadowed in truth and at least [`DEEP_PIXELS`]
    /// from any that is not; 0..1, 0 is best.
    pub leak: Option<f64>,
    /// Mean 1 − visibility over pixels that are fully lit in truth and at least [`DEEP_PIXELS`]
    /// from any that is not; 0..1, 0 is best.
    pub over_darkening: Option<f64>,
    /// Share of fully lit pixels (truth 1) that are answered shadowed; 0..1, 0 is best.
    pub acne: Option<f64>,
    /// Pixels that were scored.
    pub shadowable_pixels: u64,
    /// Pixels near a truth shadow edge.
    pub edge_pixels: u64,
    /// Pixels that are fully lit in truth.
    pub lit_pixels: u64,
    /// Pixels that `leak` is the mean over. Added later.
    #[serde(default)]
    pub deep_shadow_pixels: u64,
    /// Pixels that `over_darkening` is the mean over. Added later.
    #[serde(default)]
    pub deep_lit_pixels: u64,
}

impl Score {
    /// The same without leak and over-darkening where they are means over fewer than [`MIN_DEEP_PIXELS`]
    /// pixels.
    #[must_use]
    pub fn reliable(self) -> Self {
        Self {
            leak: self.leak.filter(|_| self.deep_shadow_pixels >= MIN_DEEP_PIXELS),
            over_darkening: self.over_darkening.filter(|_| self.deep_lit_pixels >= MIN_DEEP_PIXELS),
            ..self
        }
    }
}

/// Why images could not be scored.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ScoreError {
    /// The images do not cover the same pixels.
    #[error(
        "cannot compare a test of {test:?} with a truth of {truth:?} and a mask of {mask} pixels: render all at one size"
    )]
    Size {
        /// Width and height of the test.
        test: [u32; 2],
        /// Width and height of the truth.
        truth: [u32; 2],
        /// Entries of the shadowable mask.
        mask: usize,
    },
    /// A value is not a visibility.
    #[error(
        "{image} visibility at column {x}, row {y} is {value}, not in 0..1: the shader or tracer is wrong there"
    )]
    Value {
        /// "test" or "truth".
        image: &'static str,
        /// Column from the left.
        x: u32,
        /// Row from the top.
        y: u32,
        /// What is there.
        value: f32,
    },
    /// No pixel can be in shadow.
    #[error("none of the {0} pixels sees geometry that faces the light: move the camera or the light")]
    NothingShadowable(usize),
}

/// Scores the visibilities `test` against `truth`; `shadowable` has one entry per pixel, row by row.
///
/// Costs some 500 multiplications per pixel on all cores, nearly all of them for ꟻLIP and SSIM.
///
/// # Errors
/// [`ScoreError::Size`] for different sizes; [`ScoreError::Value`] naming the first NaN anywhere in
/// the test, or the first shadowable pixel outside 0..1; [`ScoreError::NothingShadowable`].
pub fn score(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> Result<Score, ScoreError> {
    check(test, truth, shadowable)?;
    let class = Classes::of(truth, shadowable);
    let pairs = || {
        let pairs = test.values.iter().zip(&truth.values).zip(shadowable);
        pairs.filter(|&(_, &counted)| counted).map(|((&v, &t), _)| (v.clamp(0.0, 1.0), t.clamp(0.0, 1.0)))
    };
    let shadowable_pixels = shadowable.iter().filter(|&&s| s).count() as u64;
    let mean = |sum: f64| sum / shadowable_pixels as f64;
    let rmse = mean(pairs().map(|(v, t)| f64::from(v - t).powi(2)).sum()).sqrt();
    let same = |v: f32, t: f32| f64::from(u8::from((v >= LIT_THRESHOLD) == (t >= LIT_THRESHOLD)));
    let over = |mask: &[bool], value: &dyn Fn(f32, f32) -> f64| {
        let chosen = test.values.iter().zip(&truth.values).zip(mask).filter(|&(_, &chosen)| chosen);
        let (sum, count) =
            chosen.fold((0.0, 0_u64), |(sum, n), ((&v, &t), _)| (sum + value(v.clamp(0.0, 1.0), t), n + 1));
        (count > 0).then(|| sum / count as f64)
    };
    Ok(Score {
        pixel_match: mean(pairs().map(|(v, t)| same(v, t)).sum()),
        pixel_match_near_edges: over(&class.near_edges, &same),
        rmse,
        mae: mean(pairs().map(|(v, t)| f64::from(v - t).abs()).sum()),
        psnr: (rmse > 0.0).then(|| 0.0 - 20.0 * rmse.log10()),
        ssim: ssim::mean(test, truth, shadowable),
        flip: flip::mean(test, truth, shadowable),
        leak: over(&class.deep_shadow, &|v, _| f64::from(v)),
        over_darkening: over(&class.deep_lit, &|v, _| 1.0 - f64::from(v)),
        acne: over(&class.lit, &|v, _| f64::from(u8::from(v < LIT_THRESHOLD))),
        shadowable_pixels,
        edge_pixels: count(&class.near_edges),
        lit_pixels: count(&class.lit),
        deep_shadow_pixels: count(&class.deep_shadow),
        deep_lit_pixels: count(&class.deep_lit),
    })
}

/// The score of the all-lit image: what drawing no shadow at all would get. A technique has to be
/// compared with this, since most of a picture is usually lit.
///
/// # Errors
/// As [`score`].
pub fn no_shadow_baseline(truth: &GrayImage, shadowable: &[bool]) -> Result<Score, ScoreError> {
    score(&GrayImage::filled(truth.width, truth.height, 1.0), truth, shadowable)
}

/// Pixels by what the truth says of them and of their surroundings.
struct Classes {
    /// Fully lit.
    lit: Vec<bool>,
    /// Within [`EDGE_PIXELS`], between centres, of a shadowable pixel with the other answer.
    near_edges: Vec<bool>,
    /// Fully shadowed and [`DEEP_PIXELS`] or more from every shadowable pixel that is not.
    deep_shadow: Vec<bool>,
    /// Fully lit and [`DEEP_PIXELS`] or more from every shadowable pixel that is not.
    deep_lit: Vec<bool>,
}

impl Classes {
    fn of(truth: &GrayImage, shadowable: &[bool]) -> Self {
        let select = |keep: &dyn Fn(f32) -> bool| -> Vec<bool> {
            truth.values.iter().zip(shadowable).map(|(&t, &s)| s && keep(t)).collect()
        };
        let squared = |seeds: &[bool]| distance::squared(seeds, truth.width, truth.height);
        let far = |mask: &[bool], seeds: &[bool]| -> Vec<bool> {
            let limit = u64::from(DEEP_PIXELS).pow(2);
            mask.iter().zip(squared(seeds)).map(|(&m, d)| m && d >= limit).collect()
        };
        let lit = select(&|t| t >= 1.0 - ROUNDING);
        let not_lit = select(&|t| t < 1.0 - ROUNDING);
        let shadowed = select(&|t| t <= ROUNDING);
        let not_shadowed = select(&|t| t > ROUNDING);
        let answered_lit = select(&|t| t >= LIT_THRESHOLD);
        let answered_shadowed = select(&|t| t < LIT_THRESHOLD);
        let edge = u64::from(EDGE_PIXELS).pow(2);
        let to_other = squared(&answered_lit).into_iter().zip(squared(&answered_shadowed));
        let near_edges = to_other.zip(shadowable).map(|((a, b), &s)| s && a.max(b) <= edge).collect();
        Self { near_edges, deep_shadow: far(&shadowed, &not_shadowed), deep_lit: far(&lit, &not_lit), lit }
    }
}

fn count(mask: &[bool]) -> u64 {
    mask.iter().filter(|&&m| m).count() as u64
}

fn check(test: &GrayImage, truth: &GrayImage, shadowable: &[bool]) -> Result<(), ScoreError> {
    let size = |plane: &GrayImage| [plane.width, plane.height];
    let whole = |plane: &GrayImage| plane.values.len() == plane.width as usize * plane.height as usize;
    let one_size = size(test) == size(truth) && shadowable.len() == truth.values.len();
    if !one_size || !whole(test) || !whole(truth) {
        return Err(ScoreError::Size { test: size(test), truth: size(truth), mask: shadowable.len() });
    }
    let allowed = -ROUNDING..=1.0 + ROUNDING;
    let value_error = |image, plane: &GrayImage, index: usize| {
        let (x, y) = (index as u32 % plane.width, index as u32 / plane.width);
        Err(ScoreError::Value { image, x, y, value: plane.values[index] })
    };
    let bad = |(v, &s): (&f32, &bool)| v.is_nan() || (s && !allowed.contains(v));
    if let Some(index) = test.values.iter().zip(shadowable).position(bad) {
        return value_error("test", test, index);
    }
    let bad = |(v, &s): (&f32, &bool)| s && !allowed.contains(v);
    if let Some(index) = truth.values.iter().zip(shadowable).position(bad) {
        return value_error("truth", truth, index);
    }
    if !shadowable.contains(&true) {
        return Err(ScoreError::NothingShadowable(shadowable.len()));
    }
    Ok(())
}
