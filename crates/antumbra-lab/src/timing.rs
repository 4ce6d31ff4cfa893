//! Times of passes and frames.
//!
//! Passes are timed by the GPU's timestamps where it has them, which include neither recording nor
//! submission. Whole frames last from their first to their last timestamp; on software drivers, which
//! may stamp before work is done, and without timestamps by the wall clock from submission to completion.
//! Techniques take turns, round after round, so that a disturbance of the machine hits all of them.

use crate::{
    gpu::{Gpu, Wait},
    results::{PassTime, Spread, TimeMethod, TimeResult},
};
use antumbra::{Probe, ShadowMap};
use antumbra_render::{Casters, GpuScene, Lighting, Lookup};
use anyhow::Result;
use std::time::Instant;

/// Largest number of passes of one frame that are timed.
const MAX_PASSES: u32 = 1024;

/// Milliseconds per label.
type Passes = Vec<(&'static str, f64)>;

/// Timestamps around each pass of a frame.
#[derive(Debug)]
struct Stopwatch {
    /// `None` if the device has no timestamps.
    queries: Option<(wgpu::QuerySet, wgpu::Buffer, wgpu::Buffer)>,
    labels: Vec<&'static str>,
}

impl Stopwatch {
    fn new(gpu: &Gpu) -> Self {
        let timed = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
        let queries = timed.then(|| {
            let set = gpu.device.create_query_set(&wgpu::QuerySetDescriptor {
                label: Some("timestamps"),
                ty: wgpu::QueryType::Timestamp,
                count: 2 * MAX_PASSES,
            });
            let buffer = |usage| {
                gpu.device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some("timestamps"),
                    size: 16 * u64::from(MAX_PASSES),
                    usage,
                    mapped_at_creation: false,
                })
            };
            use wgpu::BufferUsages as Usage;
            (set, buffer(Usage::QUERY_RESOLVE | Usage::COPY_SRC), buffer(Usage::COPY_DST | Usage::MAP_READ))
        });
        Self { queries, labels: Vec::with_capacity(MAX_PASSES as usize) }
    }

    fn resolve(&self, encoder: &mut wgpu::CommandEncoder) {
        if let Some((set, resolved, staging)) = &self.queries {
            let count = 2 * self.labels.len() as u32;
            encoder.resolve_query_set(set, 0..count, resolved, 0);
            encoder.copy_buffer_to_buffer(resolved, 0, staging, 0, 8 * u64::from(count));
        }
    }

    /// Milliseconds from the first to the last timestamp, and per label in order of first appearance;
    /// `None` without timestamps.
    fn read(&self, gpu: &Gpu) -> Result<Option<(f64, Passes)>> {
        let Some((_, _, staging)) = &self.queries else { return Ok(None) };
        let bytes = gpu.map(staging)?;
        let stamps: Vec<u64> =
            bytes.chunks_exact(8).filter_map(|b| b.try_into().ok()).map(u64::from_ne_bytes).collect();
        let period = f64::from(gpu.queue.get_timestamp_period()) * 1e-6;
        let stamps = &stamps[..2 * self.labels.len()];
        let span = match (stamps.iter().min(), stamps.iter().max()) {
            (Some(first), Some(last)) => (last - first) as f64 * period,
            _ => 0.0,
        };
        let mut sums = Passes::new();
        for (i, (label, pair)) in self.labels.iter().zip(stamps.chunks_exact(2)).enumerate() {
            // Some software drivers stamp the end of a compute pass before it has run: the next pass
            // begins when it is done.
            let end = match stamps.get(2 * i + 2) {
                Some(next) if matches!(*label, "sum" | "scan") && i + 1 < self.labels.len() => *next,
                _ => pair[1],
            };
            let ms = end.saturating_sub(pair[0]) as f64 * period;
            match sums.iter_mut().find(|(name, _)| name == label) {
                Some((_, sum)) => *sum += ms,
                None => sums.push((label, ms)),
            }
        }
        Ok(Some((span, sums)))
    }
}

impl Probe for Stopwatch {
    fn pass(&mut self, label: &'static str, _: usize) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        let (set, ..) = self.queries.as_ref()?;
        let index = 2 * self.labels.len() as u32;
        if index + 2 > 2 * MAX_PASSES {
            return None;
        }
        self.labels.push(label);
        Some(wgpu::RenderPassTimestampWrites {
            query_set: set,
            beginning_of_pass_write_index: Some(index),
            end_of_pass_write_index: Some(index + 1),
        })
    }
}

/// What becomes of a map from frame to frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Upkeep {
    /// It is drawn and filtered anew in each.
    Drawn,
    /// It stays as the first frame drew it.
    Kept,
}

/// What a frame that is timed draws: `None` shades without any shadow.
#[derive(Debug, Clone, Copy)]
pub struct TimedFrame<'a> {
    /// The shadow map, prepared, and how its casters are drawn.
    pub shadows: Option<(&'a ShadowMap, &'a Casters)>,
    /// Its lookup pass.
    pub lookup: &'a Lookup,
    /// Whether the map stays as an earlier frame drew it, as with lights and casters that do not move.
    pub kept: bool,
}

/// All times of one frame, milliseconds, a round each.
#[derive(Debug, Default)]
pub struct Samples {
    /// The whole frame.
    pub frame: Vec<f64>,
    /// Its passes, by label; none where the device has no timestamps.
    pub passes: Vec<(&'static str, Vec<f64>)>,
}

/// Times whole frames (cast, filter, surfaces, lookup) of all `frames` in turns. The first round
/// warms up and does not count. `progress` is told shares in (0,1].
///
/// # Errors
/// If the device is lost.
pub fn time_interleaved(
    gpu: &Gpu,
    scene: &GpuScene,
    lighting: &Lighting,
    frames: &[TimedFrame<'_>],
    rounds: u32,
    progress: &dyn Fn(f32),
) -> Result<Vec<TimeResult>> {
    let samples = sample_interleaved(gpu, scene, lighting, frames, rounds, progress)?;
    Ok(samples.iter().map(|s| s.result(rounds, frame_method(gpu))).collect())
}

/// The same, with every time that was taken: what was timed in one round may be set against one another.
///
/// # Errors
/// If the device is lost.
pub fn sample_interleaved(
    gpu: &Gpu,
    scene: &GpuScene,
    lighting: &Lighting,
    frames: &[TimedFrame<'_>],
    rounds: u32,
    progress: &dyn Fn(f32),
) -> Result<Vec<Samples>> {
    let mut stopwatch = Stopwatch::new(gpu);
    let mut samples: Vec<Samples> = frames.iter().map(|_| Samples::default()).collect();
    for round in 0..=rounds {
        for (timed, samples) in frames.iter().zip(&mut samples) {
            // What is kept is drawn once.
            let timed = TimedFrame { kept: timed.kept && round > 0, ..*timed };
            let (frame, passes) = frame(gpu, scene, lighting, timed, &mut stopwatch)?;
            if round > 0 {
                samples.frame.push(frame);
                for (name, ms) in passes {
                    match samples.passes.iter_mut().find(|(n, _)| *n == name) {
                        Some((_, all)) => all.push(ms),
                        None => samples.passes.push((name, vec![ms])),
                    }
                }
            }
        }
        progress((round + 1) as f32 / (rounds + 1) as f32);
    }
    Ok(samples)
}

/// Whether the timestamps of a device say how long a frame takes.
fn frame_method(gpu: &Gpu) -> TimeMethod {
    let timed = gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
    if timed && gpu.info.device_type != wgpu::DeviceType::Cpu {
        TimeMethod::Timestamps
    } else {
        TimeMethod::Wall
    }
}

/// One frame: milliseconds of all of it, and per pass.
fn frame(
    gpu: &Gpu,
    scene: &GpuScene,
    lighting: &Lighting,
    timed: TimedFrame<'_>,
    stopwatch: &mut Stopwatch,
) -> Result<(f64, Passes)> {
    stopwatch.labels.clear();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    if let Some((shadows, casters)) = timed.shadows.filter(|_| !timed.kept) {
        shadows.encode_probed(&mut encoder, stopwatch, |pass| scene.draw_casters(casters, pass))?;
    }
    scene.encode_surfaces(&mut encoder, stopwatch.pass("surfaces", 0));
    let timestamps = stopwatch.pass("lookup", 0);
    let shadows = timed.shadows.map(|(shadows, _)| shadows);
    lighting.encode_lookup(&mut encoder, scene, timed.lookup, shadows, timestamps);
    stopwatch.resolve(&mut encoder);
    let start = Instant::now();
    gpu.finish(encoder)?;
    let wall = start.elapsed().as_secs_f64() * 1e3;
    Ok(match stopwatch.read(gpu)? {
        Some((span, passes)) if frame_method(gpu) == TimeMethod::Timestamps => (span, passes),
        Some((_, passes)) => (wall, passes),
        None => (wall, Passes::new()),
    })
}

impl Samples {
    fn result(&self, rounds: u32, frame_method: TimeMethod) -> TimeResult {
        let pass = |(name, ms): &(&'static str, Vec<f64>)| {
            let Spread { median_ms, min_ms, max_ms } = spread(ms);
            let method = TimeMethod::Timestamps;
            PassTime { name: (*name).into(), median_ms, min_ms, max_ms, cpu_ms: None, method }
        };
        TimeResult {
            passes: self.passes.iter().map(pass).collect(),
            frame: spread(&self.frame),
            frame_method,
            rounds,
            lookup_ratio_to_hard: None,
            frame_ratio_to_hard: None,
        }
    }
}

/// Median and extremes; zeros of nothing.
fn spread(samples: &[f64]) -> Spread {
    let mut sorted = samples.to_vec();
    sorted.sort_by(f64::total_cmp);
    let at = |i: usize| sorted.get(i).copied().unwrap_or(0.0);
    Spread { median_ms: at(sorted.len() / 2), min_ms: at(0), max_ms: at(sorted.len().saturating_sub(1)) }
}

/// Fills in the ratios of `times` to the times of the standard shadow map, which is number `hard` among
/// them; `unshadowed` is what shading takes without any.
pub fn relate(times: &mut [TimeResult], unshadowed: &TimeResult, hard: Option<usize>) {
    let Some(hard) = hard.and_then(|i| times.get(i)).cloned() else { return };
    let own = |time: &TimeResult| Some(pass_ms(time, "lookup")? - pass_ms(unshadowed, "lookup")?);
    for time in times {
        time.frame_ratio_to_hard =
            Some(time.frame.median_ms / hard.frame.median_ms).filter(|r| r.is_finite());
        // A lookup that takes no longer than none at all is below what the clock can tell.
        let pair = own(time).zip(own(&hard)).filter(|(_, h)| *h > 0.0);
        time.lookup_ratio_to_hard = pair.map(|(t, h)| t.max(0.0) / h).filter(|r| r.is_finite());
    }
}

/// Median of a pass, if it was timed.
#[must_use]
pub fn pass_ms(time: &TimeResult, name: &str) -> Option<f64> {
    time.passes.iter().find(|p| p.name == name).map(|p| p.median_ms)
}
