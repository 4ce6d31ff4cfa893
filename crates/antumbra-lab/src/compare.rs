//! The comparison: one scene, its ray-traced truths, every technique scored and timed.

use crate::{
    cascades,
    classes::{self, ClassShare},
    gpu::Gpu,
    lighting::{Lighting, Lookup, Pictures},
    metrics,
    plane::error_heat_map,
    report::file_stem,
    results::{Results, SCHEMA, Scores, TechniqueImages, TimeResult},
    setting::{Setting, Setup},
    stage::Stage,
    timing::{self, Entrant},
};
use antumbra::{Kernel, Technique, View, Weights, technique};
use anyhow::{Context, Result, bail};
use std::{
    collections::{BTreeMap, BTreeSet},
    time::Instant,
};

mod contestant;
pub(crate) mod facts;
mod truths;

pub use contestant::{Contestant, Entered, aim, contestants};
pub use facts::{adapter_facts, memory, work};
use truths::{Truth, Truths};

/// What to compare.
#[derive(Debug, Clone)]
pub struct Request {
    /// The scene, how it is seen and lit, and its maps.
    pub setting: Setting,
    /// The entrants, in order.
    pub techniques: Vec<Box<dyn Technique>>,
    /// Rays per pixel of the screen-space ideal, along one side.
    pub grid: u32,
    /// Frames that are timed, per technique.
    pub rounds: u32,
    /// The command line, for the report.
    pub command: Vec<String>,
}

/// Hears how far the work is; called from any thread.
pub trait Progress: Sync {
    /// A step begins.
    fn step(&self, name: &str);
    /// Share of the step that is done, 0 to 1.
    fn share(&self, share: f32);
}

/// A progress that nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Silent;

impl Progress for Silent {
    fn step(&self, _: &str) {}
    fn share(&self, _: f32) {}
}

/// Numbers and the pictures that they name.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Everything that was measured.
    pub results: Results,
    /// File name to file.
    pub images: BTreeMap<String, Vec<u8>>,
}

/// Reads technique specs: names with settings, or `all`, `all-comparison`, `all-basis`,
/// `all-geometry`. Every kernel that a spec does not set becomes `kernel` texels wide.
///
/// # Errors
/// [`antumbra::SettingError`], two equal specs.
pub fn techniques(specs: &[String], kernel: u32) -> Result<Vec<Box<dyn Technique>>> {
    let mut list: Vec<Box<dyn Technique>> = Vec::new();
    for spec in specs {
        let family = spec.strip_prefix("all-");
        let chosen: Vec<String> = match (spec.as_str(), family) {
            ("all", _) => technique::all().iter().map(|t| t.page().name.into()).collect(),
            (_, Some(family)) => {
                let in_family = technique::all().into_iter().filter(|t| t.page().family.name() == family);
                let names: Vec<String> = in_family.map(|t| t.page().name.into()).collect();
                if names.is_empty() {
                    let all = technique::all();
                    let known: BTreeSet<String> =
                        all.iter().map(|t| format!("all-{}", t.page().family.name())).collect();
                    let known: Vec<String> = known.into_iter().collect();
                    bail!("'{spec}' names no techniques; groups: all, {}", known.join(", "));
                }
                names
            }
            _ => vec![spec.clone()],
        };
        for spec in chosen {
            let mut technique = technique::parse(&spec)?;
            let has_kernel = technique.parameters().iter().any(|p| p.name == "kernel");
            if has_kernel && !spec.contains("kernel=") {
                technique::set(technique.as_mut(), "kernel", &kernel.to_string())
                    .with_context(|| format!("a kernel of {kernel} texels for every technique"))?;
            }
            list.push(technique);
        }
    }
    let mut seen = BTreeSet::new();
    for technique in &list {
        let spec = technique::spec(technique.as_ref());
        if !seen.insert(spec.clone()) {
            bail!("technique '{spec}' is listed twice");
        }
    }
    Ok(list)
}

/// The Gaussian of the light-space ideal, `width` texels wide: with the weights that techniques blur with.
///
/// # Errors
/// A width of 0.
pub fn ideal_kernel(width: u32) -> Result<antumbra_truth::Kernel> {
    let taps = Kernel::new(Weights::Gaussian, width, 0.0).taps;
    Ok(antumbra_truth::Kernel::new(taps.into_iter().map(f64::from).collect())?)
}

/// Renders, traces, scores and times.
///
/// # Errors
/// No technique that the device can do, a light or camera without a view, a lost device.
pub fn compare(gpu: &Gpu, request: &Request, progress: &dyn Progress) -> Result<Comparison> {
    let start = Instant::now();
    progress.step("upload");
    let setting = &request.setting;
    let Setup { stage, lighting, contestants, left_out, views } = setting.set_up(gpu, &request.techniques)?;
    let mut images = BTreeMap::new();
    let truths = truths::trace(gpu, request, &stage, &views, progress, &mut images)?;
    let pictures = Pictures::new(gpu, &stage, &lighting)?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    stage.encode_surfaces(&mut encoder, None);
    gpu.finish(encoder)?;
    lighting.write_visibility(gpu, &truths.hard.plane);
    let cascades = draw_cascades(gpu, setting, (&stage, &pictures, &views), &mut images)?;
    let mut rendered = Vec::new();
    for (i, contestant) in contestants.iter().enumerate() {
        progress.step(&format!("render {}", technique::spec(contestant.shadows.technique())));
        rendered.push(render(gpu, &stage, (&lighting, &pictures), contestant, &truths, &mut images)?);
        progress.share((i + 1) as f32 / contestants.len() as f32);
    }
    progress.step("time");
    let times = time(gpu, request, &stage, &lighting, &contestants, progress)?;
    let techniques = contestants
        .iter()
        .zip(rendered)
        .zip(times)
        .map(|((contestant, rendered), time)| facts::technique(contestant, rendered, time))
        .collect();
    let results = Results {
        schema: SCHEMA.into(),
        run: facts::run(gpu, setting, &views, request.command.clone())?,
        cascades,
        truth: truths.facts,
        techniques,
        left_out,
        peak_memory_bytes: facts::peak_memory(),
        seconds_total: start.elapsed().as_secs_f64(),
        files: Vec::new(),
    };
    Ok(Comparison { results, images })
}

/// What the visibility buffer makes of the picture, in the colours of the cascades, if there are several;
/// returns its name.
fn draw_cascades(
    gpu: &Gpu,
    setting: &Setting,
    (stage, pictures, views): (&Stage, &Pictures, &[View]),
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Option<String>> {
    if views.len() < 2 {
        return Ok(None);
    }
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    pictures.encode(&mut encoder);
    gpu.finish(encoder)?;
    let maps = setting.map_views(views, setting.kernel)?;
    let pixels = cascades::pixels(gpu, stage, &setting.camera, &maps)?;
    let file = String::from("cascades.png");
    images.insert(file.clone(), cascades::tint(&pictures.read(gpu)?, &pixels)?.to_png()?);
    Ok(Some(file))
}

/// What a technique's picture is worth.
struct Rendered {
    scores: Scores,
    classes: Vec<ClassShare>,
    regions: BTreeMap<String, metrics::Score>,
    images: TechniqueImages,
}

/// Draws one technique on the surfaces that the stage already holds, and scores it.
fn render(
    gpu: &Gpu,
    stage: &Stage,
    (lighting, pictures): (&Lighting, &Pictures),
    contestant: &Contestant,
    truths: &Truths,
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Rendered> {
    let shadows = &contestant.shadows;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    contestant.encode(&mut encoder, stage, lighting)?;
    pictures.encode(&mut encoder);
    gpu.finish(encoder)?;
    let test = lighting.read_visibility(gpu)?;
    let picture = pictures.read(gpu)?;
    let spec = technique::spec(shadows.technique());
    let score = |truth: &Truth, mask: &[bool]| -> Result<_> {
        Ok(metrics::score(&test, &truth.plane, mask).with_context(|| spec.clone())?.heard())
    };
    let scores = Scores {
        hard: score(&truths.hard, &truths.hard.shadowable)?,
        light_space: score(&truths.light_space, &truths.light_space.shadowable)?,
        screen_space: score(&truths.screen_space, &truths.screen_space.shadowable)?,
    };
    let mut regions = BTreeMap::new();
    for region in truths.regions.iter().filter(|r| r.pixels.contains(&true)) {
        regions.insert(region.name.to_string(), score(&truths.light_space, &region.pixels)?);
    }
    let stem = file_stem(&spec);
    let mut save = |kind: &str, bytes: Vec<u8>| {
        let file = format!("{stem}-{kind}");
        images.insert(file.clone(), bytes);
        file
    };
    let error = |truth: &Truth| -> Result<Vec<u8>> {
        Ok(error_heat_map(&test, &truth.plane, &truth.shadowable)?.to_png()?)
    };
    let numbers = contestant.read_classes(gpu, stage, lighting)?;
    let known = shadows.technique().classes();
    let tinted = match &numbers {
        Some(numbers) => Some(classes::picture(&test, numbers, known)?.to_png()?),
        None => None,
    };
    let images = TechniqueImages {
        classes: tinted.map(|bytes| save("classes.png", bytes)),
        picture: save("picture.png", picture.to_png()?),
        visibility: save("visibility.png", test.to_gray_png()?),
        error_hard: save("error-hard.png", error(&truths.hard)?),
        error_light_space: save("error-light-space.png", error(&truths.light_space)?),
    };
    let classes = numbers.map(|numbers| classes::shares(&numbers, known)).unwrap_or_default();
    Ok(Rendered { scores, classes, regions, images })
}

/// Times all contestants and, for reference, shading without shadows and the standard shadow map
/// if that is not among them.
fn time(
    gpu: &Gpu,
    request: &Request,
    stage: &Stage,
    lighting: &Lighting,
    contestants: &[Contestant],
    progress: &dyn Progress,
) -> Result<Vec<TimeResult>> {
    let unshadowed = Lookup::unshadowed(gpu, stage);
    let mut entrants = vec![Entrant { shadows: None, lookup: &unshadowed }];
    entrants.extend(contestants.iter().map(Contestant::entrant));
    let mut times = timing::race(gpu, stage, lighting, &entrants, request.rounds, &|s| progress.share(s))?;
    let unshadowed = times.remove(0);
    let hard = contestants.iter().position(|c| c.shadows.technique().page().name == "hard");
    timing::relate(&mut times, &unshadowed, hard);
    Ok(times)
}
