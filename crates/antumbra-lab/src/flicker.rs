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
//! jagged edge: wherever an edge passes, the truth changes at once and a filter over several frames.
//! That is measured too ([`Results::ideal_against_hard`]).
//!
//! # Which pixels?
//! Those that see geometry facing the light in both frames, where raster and rays see the same point to
//! half a pixel. At silhouettes they may not, and then the truth belongs to another surface. The ideals
//! take many rays, and are asked of every [`Request::stride`]-th pixel across and down only.

use crate::{
    compare::{self, Contestant, Entered, Progress, adapter_facts},
    gpu::Gpu,
    lighting::Lighting,
    motion::{Frame, Path},
    results::Program,
    setting::Setting,
    stage::Stage,
};
use antumbra::{ShadowMap, Technique, technique};
use anyhow::{Context, Result, bail};
use std::{
    collections::BTreeMap,
    time::{Duration, Instant},
};

mod page;
mod pictures;
mod results;
mod score;
mod truths;

pub use page::write;
pub use pictures::{FILM_FILE, ROW_FILE, STRIP_FILE};
pub use results::{Measured, Promise, Results, SCHEMA, TechniqueFlicker};
pub use score::{Tally, change_of_error};

use pictures::Pictures;
use score::Series;
use truths::{Moment, Right, Truths};

/// What to measure.
#[derive(Debug, Clone)]
pub struct Request {
    /// The scene, camera and light of the first frame, the maps.
    pub setting: Setting,
    /// How camera and light move.
    pub path: Path,
    /// Number of frames of the whole path.
    pub frames: u32,
    /// Frames that are measured, from the first; 2 or more. Few steps of a long path are as small as all.
    pub until: u32,
    /// The entrants, in order.
    pub techniques: Vec<Box<dyn Technique>>,
    /// Pixels from one that is asked for the ideals to the next, across and down.
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
    let setting = &request.setting;
    let mut frames = request.path.frames(&setting.camera, &setting.light, request.frames)?;
    if !(2..=request.frames).contains(&request.until) {
        bail!("{} measured frames: allowed are 2 to the {} of the path", request.until, request.frames);
    }
    frames.truncate(request.until as usize);
    if request.techniques.is_empty() {
        bail!("no technique to measure");
    }
    progress.step("upload");
    let mut stage = setting.stage(gpu)?;
    let lighting = Lighting::new(gpu, &stage);
    let entries = setting.entries(&request.techniques);
    let Entered { mut contestants, left_out } = setting.contestants(gpu, &stage, &entries)?;
    let mut invalid: Vec<Option<String>> = vec![None; contestants.len()];
    let tracer = setting.tracer()?;
    let truths = Truths::new(&tracer, request)?;
    let mut series = Series::new(contestants.len(), setting.resolution);
    let mut pictures: Option<Pictures> = None;
    let mut before: Option<(Frame, Moment)> = None;
    let mut texels: Vec<Vec<f32>> = Vec::new();
    let mut tracing = Duration::ZERO;
    progress.step(&format!("frames of the path: {}", frames.len()));
    for (number, frame) in frames.iter().enumerate() {
        let at = || format!("frame {number} of the path");
        let maps: Vec<&ShadowMap> = contestants.iter().map(|c| &c.shadows).collect();
        let moved = Setting { camera: frame.camera, light: frame.light, ..setting.clone() };
        let camera = stage.camera_matrix_of(&moved.geometry, &moved.camera, &moved.light);
        let views = moved.views(camera, &maps).with_context(at)?;
        let planes = moved.map_views(&views, setting.kernel)?;
        compare::aim(gpu, &stage, &mut contestants, &views)?;
        texels.push(views.iter().map(|view| view.texel_world).collect());
        for (contestant, invalid) in contestants.iter_mut().zip(&mut invalid) {
            let drawn = contestant.draw_maps(gpu, &stage);
            drawn.with_context(|| technique::spec(contestant.shadows.technique()))?;
            *invalid = invalid.take().or_else(|| contestant.invalid());
        }
        let camera_rests = before.as_ref().is_some_and(|(f, _)| f.camera == frame.camera);
        // The points of the last frame under this frame's light: its surfaces are still there.
        let on_points = match &before {
            Some(_) if !camera_rests => Some(answers(gpu, &stage, &lighting, &contestants)?),
            _ => None,
        };
        stage.look(gpu, &setting.geometry, &frame.camera, &frame.light);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        stage.encode_surfaces(&mut encoder, None);
        gpu.finish(encoder)?;
        let seen = answers(gpu, &stage, &lighting, &contestants)?;
        let drawn = stage.surfaces().read_positions(gpu)?;
        let clock = Instant::now();
        let right = truths.right(frame, &planes, &drawn).with_context(at)?;
        tracing += clock.elapsed();
        let now = Moment { right, answers: seen };
        let pictures =
            pictures.get_or_insert_with(|| Pictures::new(request, &now, truths.size(), &contestants));
        pictures.add(&now);
        if let Some((last, was)) = &before {
            let points: Right = match on_points {
                None => now.right.clone(),
                Some(_) if last.light == frame.light => was.right.clone(),
                Some(_) => {
                    let clock = Instant::now();
                    let right = truths.right_at(&was.right, frame, &planes);
                    tracing += clock.elapsed();
                    right
                }
            };
            let answers = on_points.as_ref().unwrap_or(&now.answers);
            series.add(&truths, was, &now, &points, answers);
        }
        before = Some((*frame, now));
        progress.share((number + 1) as f32 / frames.len() as f32);
    }
    progress.step("pictures");
    let Some(pictures) = pictures else { bail!("no frame was drawn") };
    let mut images = BTreeMap::new();
    let (mut techniques, heat_maps) = series.results(request, &contestants, &mut images)?;
    for (technique, invalid) in techniques.iter_mut().zip(invalid) {
        technique.invalid = invalid;
    }
    pictures.files(&mut images)?;
    let results = Results {
        schema: SCHEMA.into(),
        program: Program { name: "antumbra".into(), version: env!("CARGO_PKG_VERSION").into() },
        command: request.command.clone(),
        scene: setting.name.clone(),
        triangles: setting.geometry.triangle_count() as u64,
        path: request.path.name().into(),
        motion: request.path.description().into(),
        frames: request.until,
        resolution: setting.resolution,
        map_size: setting.map_size,
        kernel_texels: setting.kernel,
        cascades: setting.most_views(),
        bias: setting.bias.to_string(),
        stride: request.stride,
        adapter: adapter_facts(gpu),
        pixels: series.pixels(),
        agreement: series.agreement(),
        ideal_against_hard: series.ideal_against_hard(),
        texel_changes: texel_changes(&texels),
        techniques,
        left_out,
        heat_maps,
        seconds_tracing: tracing.as_secs_f64(),
        seconds_total: start.elapsed().as_secs_f64(),
        files: Vec::new(),
    };
    if results.pixels == 0.0 {
        bail!("no pixel sees geometry that faces the light in two frames: nothing can flicker");
    }
    Ok(Outcome { results, images })
}

/// How often a view's texels had another size than in the frame before; another number of views counts once.
fn texel_changes(texels: &[Vec<f32>]) -> u32 {
    let changes = |pair: &[Vec<f32>]| match pair {
        [was, now] if was.len() == now.len() => was.iter().zip(now).filter(|(a, b)| a != b).count(),
        _ => 1,
    };
    texels.windows(2).map(changes).sum::<usize>() as u32
}

/// What each map answers for the surfaces that are drawn.
fn answers(
    gpu: &Gpu,
    stage: &Stage,
    lighting: &Lighting,
    contestants: &[Contestant],
) -> Result<Vec<Vec<f32>>> {
    let ask = |contestant: &Contestant| {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let shadows = Some(&contestant.shadows);
        lighting.encode_lookup(&mut encoder, stage, &contestant.lookup, shadows, None);
        gpu.finish(encoder)?;
        Ok(lighting.read_visibility(gpu)?.values)
    };
    contestants.iter().map(ask).collect()
}
