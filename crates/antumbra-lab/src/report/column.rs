//! The columns of the score table: what each holds, its unit, and which end is good.

use super::text;
use crate::results::TechniqueResult;

/// Which end of a column is good.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Better {
    Lower,
    Higher,
}

/// One column.
pub(super) struct Column {
    pub(super) group: &'static str,
    pub(super) label: &'static str,
    pub(super) meaning: &'static str,
    pub(super) better: Better,
    pub(super) value: fn(&TechniqueResult) -> Option<f64>,
    /// Pixels that the value is the mean over, told where they are too few for one.
    pub(super) pixels: Option<fn(&TechniqueResult) -> u64>,
    pub(super) format: fn(f64) -> String,
}

pub(super) const LIGHT_SPACE: &str = "Light-space ideal";
pub(super) const HARD: &str = "Hard truth";
pub(super) const SCREEN_SPACE: &str = "Screen-space ideal";
const TIME: &str = "Time";
const MEMORY: &str = "Memory";
const WORK: &str = "Work";

const RMSE: &str = "Root of the mean squared error of visibility, 0 to 1. Lower is better.";
const MAE: &str = "Mean absolute error of visibility, 0 to 1. Lower is better.";
const PSNR: &str =
    "Peak signal-to-noise ratio in decibels; none where the images are equal. Higher is better.";
const SSIM: &str = "Structural similarity, 11×11 Gaussian window, −1 to 1. Higher is better.";
const FLIP: &str =
    "Mean ꟻLIP: the difference a person sees when flipping between the images, 0 to 1. Lower is better.";
const LEAK: &str =
    "Mean visibility deep in shadow, 4 pixels or more from any light, 0 to 1. Lower is better.";
const OVER_DARKENING: &str =
    "Mean 1 − visibility deep in light, 4 pixels or more from any shadow, 0 to 1. Lower is better.";
const MATCH: &str =
    "Share of shadowable pixels with the same lit or shadowed answer, percent. Higher is better.";
const EDGES: &str = "The same within 2 pixels of a truth shadow edge, percent. Higher is better.";
const ACNE: &str = "Share of fully lit pixels that are answered shadowed, percent. Lower is better.";
const FRAME: &str = "Median time of a frame, shadow passes and lighting, milliseconds. Lower is better.";
const FRAME_RATIO: &str = "Frame time over that of the standard shadow map. Lower is better.";
const LOOKUP_RATIO: &str = "Lookup time over that of the standard shadow map. Lower is better.";
const KEPT: &str = "Textures and buffers that lookups need, layers and mips included. Lower is better.";
const TRANSIENT: &str = "Textures and buffers that only the shadow passes need. Lower is better.";
const PER_TEXEL: &str =
    "Bytes of textures that lookups need, for each texel of the map, without mip levels. Lower is better.";
const WITH_MIPS: &str = "The same with mip levels. Lower is better.";
const LOOKUPS: &str = "Texture lookups for each pixel that filters do not stretch; an interpolated one counts once. Lower is better.";
const PASSES: &str = "Passes between casting and lighting. Lower is better.";

pub(super) fn four_digits(value: f64) -> String {
    format!("{value:.4}")
}

fn percent(share: f64) -> String {
    format!("{:.2}", share * 100.0)
}

fn ratio(value: f64) -> String {
    format!("{value:.2}×")
}

impl Column {
    const fn new(
        group: &'static str,
        label: &'static str,
        meaning: &'static str,
        value: fn(&TechniqueResult) -> Option<f64>,
    ) -> Self {
        Self { group, label, meaning, better: Better::Lower, value, pixels: None, format: four_digits }
    }
    const fn higher(self) -> Self {
        Self { better: Better::Higher, ..self }
    }
    const fn over(self, pixels: fn(&TechniqueResult) -> u64) -> Self {
        Self { pixels: Some(pixels), ..self }
    }
    const fn shown(self, format: fn(f64) -> String) -> Self {
        Self { format, ..self }
    }
}

/// Every column, groups together.
pub(super) fn all() -> Vec<Column> {
    [light_space(), hard(), screen_space(), time(), memory(), work()].into_iter().flatten().collect()
}

fn light_space() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(LIGHT_SPACE, label, meaning, value);
    vec![
        column("RMSE", RMSE, |t| Some(t.scores.light_space.rmse)),
        column("MAE", MAE, |t| Some(t.scores.light_space.mae)),
        column("PSNR dB", PSNR, |t| t.scores.light_space.psnr).higher().shown(|v| format!("{v:.1}")),
        column("SSIM", SSIM, |t| Some(t.scores.light_space.ssim)).higher(),
        column("ꟻLIP", FLIP, |t| Some(t.scores.light_space.flip)),
        column("Leak", LEAK, |t| t.scores.light_space.leak).over(|t| t.scores.light_space.deep_shadow_pixels),
        column("Over-dark", OVER_DARKENING, |t| t.scores.light_space.over_darkening)
            .over(|t| t.scores.light_space.deep_lit_pixels),
    ]
}

fn hard() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(HARD, label, meaning, value);
    vec![
        column("Match %", MATCH, |t| Some(t.scores.hard.pixel_match)).higher().shown(percent),
        column("Edges %", EDGES, |t| t.scores.hard.pixel_match_near_edges).higher().shown(percent),
        column("RMSE", RMSE, |t| Some(t.scores.hard.rmse)),
        column("Acne %", ACNE, |t| t.scores.hard.acne).shown(percent),
        column("Leak", LEAK, |t| t.scores.hard.leak).over(|t| t.scores.hard.deep_shadow_pixels),
    ]
}

fn screen_space() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(SCREEN_SPACE, label, meaning, value);
    vec![
        column("RMSE", RMSE, |t| Some(t.scores.screen_space.rmse)),
        column("SSIM", SSIM, |t| Some(t.scores.screen_space.ssim)).higher(),
        column("ꟻLIP", FLIP, |t| Some(t.scores.screen_space.flip)),
    ]
}

fn time() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(TIME, label, meaning, value);
    vec![
        column("Frame ms", FRAME, |t| Some(t.time.frame.median_ms)).shown(|v| format!("{v:.3}")),
        column("× hard", FRAME_RATIO, |t| t.time.frame_ratio_to_hard).shown(ratio),
        column("Lookup × hard", LOOKUP_RATIO, |t| t.time.lookup_ratio_to_hard).shown(ratio),
    ]
}

fn memory() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(MEMORY, label, meaning, value);
    vec![
        column("Kept", KEPT, |t| Some(t.memory.kept_bytes as f64)).shown(text::bytes),
        column("Transient", TRANSIENT, |t| Some(t.memory.transient_bytes as f64)).shown(text::bytes),
    ]
}

fn work() -> Vec<Column> {
    let column = |label, meaning, value| Column::new(WORK, label, meaning, value);
    vec![
        column("B/texel", PER_TEXEL, |t| Some(t.work.as_ref()?.bytes_per_texel)).shown(text::significant),
        column("+ mips", WITH_MIPS, |t| Some(t.work.as_ref()?.bytes_per_texel_with_mips))
            .shown(text::significant),
        column("Lookups", LOOKUPS, |t| Some(t.work.as_ref()?.lookups.into())).shown(|n| n.to_string()),
        column("Passes", PASSES, |t| Some(t.work.as_ref()?.passes.len() as f64)).shown(|n| n.to_string()),
    ]
}
