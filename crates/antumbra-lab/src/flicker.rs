//! Flicker: how far a technique's shadows change from frame to frame by themselves.
//!
//! Of two neighbouring frames, flicker is the mean |Δv − Δv_truth| over pixels: v is a technique's
//! visibility, v_truth what is right, and a change that the truth makes too does not count. Two
//! questions are asked of it.
//!
//! - **In the picture**: the same pixel in both frames, whatever it sees. This is what a screen shows.
//!   The error of a technique is a pattern on the ground; when the camera moves it passes under the
//!   pixels, so that a blunder flickers even if it stands still.
//! - **On surfaces** ("crawl"): the same point in both frames. The points that one frame sees are asked
//!   of the next frame's map and of rays to the next frame's light. Under a resting sun the truth does
//!   not change, so this is what the map's own motion does, and stays 0 for a map that rests as well.
//!
//! # Which truth?
//! Each technique is judged by what it promises ([`Promise`]), and hard shadow mapping, to which all are
//! related, by its own. Against the hard truth a perfect penumbra would flicker about as badly as a
//! jagged edge: where an edge passes a pixel, the truth changes from one frame to the next, a filter over several.
//! That is measured too ([`Results::ideal_against_hard`]).
//!
//! # Which pixels?
//! Those that see geometry facing the light in both frames, where raster and rays see the same point to
//! half a pixel. At silhouettes they may not, and then the truth belongs to another surface. The ideals
//! take many rays, and are asked of every [`Request::stride`]-th pixel across and down only.

use crate::{
    facts,
    gpu::Gpu,
    motion::{Frame, Path},
    progress::Progress,
    shot::Shot,
};
use antumbra::Technique;
use antumbra_truth::Tracer;
use anyhow::{Context, Result, bail};
use std::{collections::BTreeMap, time::Instant};

mod page;
mod pictures;
mod recording;
mod results;
mod score;
mod truths;

pub use page::write;
pub use pictures::{FILM_FILE, ROW_FILE, STRIP_FILE};
pub use results::{Measured, Promise, Results, SCHEMA, TechniqueFlicker};
pub use score::{Tally, change_of_error};

use recording::Recording;
use truths::Truths;

/// What to measure.
#[derive(Debug, Clone)]
pub struct Request {
    /// The scene, camera and light of the first frame, the maps.
    pub shot: Shot,
    /// How camera and light move.
    pub path: Path,
    /// Number of frames of the whole path.
    pub frames: u32,
    /// Frames that are measured, from the first; 2 or more. Few steps of a long path are as small as all.
    pub until: u32,
    /// The techniques, in order.
    pub techniques: Vec<Box<dyn Technique>>,
    /// Distance in pixels, across and down, between pixels for which the ideals are computed.
    pub stride: u32,
    /// Rays per pixel of the screen-space ideal, along one side.
    pub grid: u32,
    /// The command line, for the page.
    pub command: Vec<String>,
}

/// Numbers and the pictures that they name.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// Everything that was measured.
    pub results: Results,
    /// File name to file.
    pub images: BTreeMap<String, Vec<u8>>,
}

/// Renders and traces every frame.
///
/// # Errors
/// Numbers out of range, no technique that the device can do, a camera that sees nothing, a lost device.
pub fn measure(gpu: &Gpu, request: &Request, progress: &dyn Progress) -> Result<Outcome> {
    let start = Instant::now();
    let frames = frames(request)?;
    progress.step("upload");
    let tracer = Tracer::sharing(&request.shot.geometry, &request.shot.tree)?;
    let mut recording = Recording::new(gpu, request, Truths::new(&tracer, request)?)?;
    progress.step(&format!("frames of the path: {}", frames.len()));
    for (number, frame) in frames.iter().enumerate() {
        recording.add(frame).with_context(|| format!("frame {number} of the path"))?;
        progress.share((number + 1) as f32 / frames.len() as f32);
    }
    progress.step("pictures");
    outcome(gpu, request, &recording, start)
}

/// The frames that are measured.
fn frames(request: &Request) -> Result<Vec<Frame>> {
    let Request { shot, frames: count, until, .. } = request;
    let mut frames = request.path.frames(&shot.camera, &shot.light, *count)?;
    if !(2..=*count).contains(until) {
        bail!("{until} measured frames: allowed are 2 to the {count} of the path");
    }
    frames.truncate(*until as usize);
    if request.techniques.is_empty() {
        bail!("no technique to measure");
    }
    Ok(frames)
}

/// Numbers and pictures of all frames.
fn outcome(gpu: &Gpu, request: &Request, recording: &Recording<'_>, start: Instant) -> Result<Outcome> {
    let Recording { session, series, invalid, .. } = recording;
    let shot = &request.shot;
    let mut images = BTreeMap::new();
    let (mut techniques, heat_maps) = series.results(request, session.prepared(), &mut images)?;
    for (technique, invalid) in techniques.iter_mut().zip(invalid) {
        technique.invalid.clone_from(invalid);
    }
    recording.pictures.as_ref().context("no frame was drawn")?.files(&mut images)?;
    let results = Results {
        schema: SCHEMA.into(),
        program: facts::program(),
        command: request.command.clone(),
        scene: shot.name.clone(),
        triangles: shot.geometry.triangle_count() as u64,
        path: request.path.name().into(),
        motion: request.path.description().into(),
        frames: request.until,
        resolution: shot.resolution,
        map_size: shot.map_size,
        kernel_texels: shot.kernel,
        cascades: shot.max_views(),
        bias: shot.bias.to_string(),
        stride: request.stride,
        adapter: facts::adapter(gpu),
        pixels: series.pixels(),
        agreement: series.agreement(),
        ideal_against_hard: series.ideal_against_hard(),
        texel_changes: recording.texel_changes(),
        techniques,
        left_out: session.left_out().to_vec(),
        heat_maps,
        seconds_tracing: recording.tracing.as_secs_f64(),
        seconds_total: start.elapsed().as_secs_f64(),
        files: Vec::new(),
    };
    if results.pixels == 0.0 {
        bail!("no pixel sees geometry that faces the light in two frames: nothing can flicker");
    }
    Ok(Outcome { results, images })
}
