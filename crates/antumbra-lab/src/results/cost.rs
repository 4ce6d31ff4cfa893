//! What a technique costs: time, memory, and what does not depend on the device.

use antumbra::MemoryItem;
use serde::{Deserialize, Serialize};

/// Cost in time, milliseconds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct TimeResult {
    /// Each pass in the order it runs.
    pub passes: Vec<PassTime>,
    /// The whole frame, shadow passes and lighting.
    pub frame: Spread,
    /// The clock of the frame.
    #[serde(default)]
    pub frame_method: TimeMethod,
    /// Frames that were measured.
    pub rounds: u32,
    /// Lookup time over that of the standard shadow map; `null` where it was not measured.
    pub lookup_ratio_to_hard: Option<f64>,
    /// Frame time over that of the standard shadow map; `null` where it was not measured.
    pub frame_ratio_to_hard: Option<f64>,
}

/// What a technique costs before its second frame: with shaders and pipelines of its own, none of which is
/// compiled yet.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct StartUp {
    /// To put its shaders together, allocate its maps and make all pipelines, milliseconds.
    pub set_up_ms: f64,
    /// To cast, filter and look up once, milliseconds; drivers compile then what they put off.
    pub first_frame_ms: f64,
}

/// Time of one pass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PassTime {
    /// E.g. "cast", "convert", "blur", "lookup".
    pub name: String,
    /// Median over the rounds, milliseconds.
    pub median_ms: f64,
    /// Fastest round, milliseconds.
    pub min_ms: f64,
    /// Slowest round, milliseconds.
    pub max_ms: f64,
    /// Median time to record it on the CPU, milliseconds.
    pub cpu_ms: Option<f64>,
    /// The clock.
    pub method: TimeMethod,
}

/// The clock of a measurement.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TimeMethod {
    /// Timestamps that the GPU writes before and after.
    Timestamps,
    /// Wall clock from submission to completion.
    #[default]
    Wall,
}

impl std::fmt::Display for TimeMethod {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Timestamps => "GPU timestamps",
            Self::Wall => "wall clock",
        })
    }
}

/// Median and extremes, milliseconds.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Spread {
    /// Median.
    pub median_ms: f64,
    /// Smallest.
    pub min_ms: f64,
    /// Largest.
    pub max_ms: f64,
}

/// Cost in memory, bytes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MemoryResult {
    /// Every texture and buffer.
    pub items: Vec<MemoryItem>,
    /// Sum over what lookups need.
    pub kept_bytes: u64,
    /// Sum over what only the passes need.
    pub transient_bytes: u64,
}

/// What a technique takes, whatever runs it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Work {
    /// Bytes of textures that lookups need, for each texel of the map, without mip levels.
    pub bytes_per_texel: f64,
    /// The same with mip levels.
    pub bytes_per_texel_with_mips: f64,
    /// Texture lookups for each pixel; an interpolated one counts once.
    pub lookups: u32,
    /// Passes between casting and lighting, in order.
    pub passes: Vec<String>,
}
