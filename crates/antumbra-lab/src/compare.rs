//! The comparison: one scene, its ray-traced truths, every technique scored and timed.

use crate::{
    cascades,
    classes::ClassShare,
    facts, files,
    gpu::Gpu,
    image::error_heat_map,
    metrics::Score,
    prepared::Prepared,
    progress::Progress,
    results::{Results, SCHEMA, Scores, TechniqueImages, TechniqueResult, TimeResult},
    session::Session,
    shot::Shot,
    truth::TruthImage,
};
use antumbra::{Technique, technique};
use anyhow::{Context, Result};
use std::{collections::BTreeMap, time::Instant};

mod truths;

use truths::Truths;

/// What to compare.
#[derive(Debug, Clone)]
pub struct Request {
    /// The scene, how it is seen and lit, and its maps.
    pub shot: Shot,
    /// The techniques, in order.
    pub techniques: Vec<Box<dyn Technique>>,
    /// Rays per pixel of the screen-space ideal, along one side.
    pub grid: u32,
    /// Frames that are timed, per technique.
    pub rounds: u32,
    /// The command line, for the report.
    pub command: Vec<String>,
}

/// Numbers and the pictures that they name.
#[derive(Debug, Clone)]
pub struct Comparison {
    /// Everything that was measured.
    pub results: Results,
    /// File name to file.
    pub images: BTreeMap<String, Vec<u8>>,
}

/// Renders, traces, scores and times.
///
/// # Errors
/// No technique that the device can do, a light or camera without a view, a lost device.
pub fn compare(gpu: &Gpu, request: &Request, progress: &dyn Progress) -> Result<Comparison> {
    let start = Instant::now();
    progress.step("upload");
    let session = Session::new(gpu, &request.shot, &request.techniques)?;
    let mut images = BTreeMap::new();
    let truths = truths::trace(gpu, &session, request.grid, progress, &mut images)?;
    let cascades = draw_cascades(gpu, &session, &truths, &mut images)?;
    let mut rendered = Vec::new();
    for (i, prepared) in session.prepared().iter().enumerate() {
        progress.step(&format!("render {}", technique::spec(prepared.shadows.technique())));
        rendered.push(render(&session, prepared, &truths, &mut images)?);
        progress.share((i + 1) as f32 / session.prepared().len() as f32);
    }
    progress.step("time");
    let times = session.time(request.rounds, progress)?.techniques;
    let measured = session.prepared().iter().zip(rendered).zip(times);
    let techniques = measured.map(|((prepared, rendered), time)| entry(prepared, rendered, time)).collect();
    let mut run = facts::run(gpu, &session, request.command.clone())?;
    run.warnings.extend(facts::coverage_warning(&truths.facts, run.resolution));
    let results = Results {
        schema: SCHEMA.into(),
        run,
        cascades,
        truth: truths.facts,
        techniques,
        left_out: session.left_out().to_vec(),
        peak_memory_bytes: facts::peak_memory(),
        seconds_total: start.elapsed().as_secs_f64(),
        files: Vec::new(),
    };
    Ok(Comparison { results, images })
}

/// The picture of the hard truth in the colours of the cascades, if there are several; returns its name.
fn draw_cascades(
    gpu: &Gpu,
    session: &Session<'_>,
    truths: &Truths,
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Option<String>> {
    let (shot, views) = (session.shot(), session.views());
    if views.len() < 2 {
        return Ok(None);
    }
    let picture = session.picture_of(&truths.hard.image)?;
    let maps = shot.map_views(views, shot.kernel)?;
    let pixels = cascades::pixels(gpu, session.scene(), &shot.camera, &maps)?;
    let file = String::from("cascades.png");
    images.insert(file.clone(), cascades::tint(&picture, &pixels)?.to_png()?);
    Ok(Some(file))
}

/// What a technique's picture is worth.
struct Rendered {
    scores: Scores,
    classes: Vec<ClassShare>,
    regions: BTreeMap<String, Score>,
    images: TechniqueImages,
}

/// Draws one technique and scores it.
fn render(
    session: &Session<'_>,
    prepared: &Prepared,
    truths: &Truths,
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Rendered> {
    let technique = prepared.shadows.technique();
    let answer = session.draw_and_ask(prepared)?;
    let picture = session.picture()?;
    let spec = technique::spec(technique);
    let score = |truth: &TruthImage, among: Option<&[bool]>| -> Result<Score> {
        Ok(truth.score(&answer, among).with_context(|| spec.clone())?.reliable())
    };
    let scores = Scores {
        hard: score(&truths.hard, None)?,
        light_space: score(&truths.light_space, None)?,
        screen_space: score(&truths.screen_space, None)?,
    };
    let mut regions = BTreeMap::new();
    for region in truths.regions.iter().filter(|r| r.pixels.contains(&true)) {
        regions.insert(region.name.to_string(), score(&truths.light_space, Some(&region.pixels))?);
    }
    let stem = files::stem(&spec);
    let mut save = |kind: &str, bytes: Vec<u8>| {
        let file = format!("{stem}-{kind}");
        images.insert(file.clone(), bytes);
        file
    };
    let error = |truth: &TruthImage| -> Result<Vec<u8>> {
        Ok(error_heat_map(&answer, &truth.image, &truth.shadowable)?.to_png()?)
    };
    let classes = session.classes(prepared, &answer)?;
    let tinted = classes.as_ref().map(|classes| classes.picture.to_png()).transpose()?;
    let images = TechniqueImages {
        classes: tinted.map(|bytes| save("classes.png", bytes)),
        picture: save("picture.png", picture.to_png()?),
        visibility: save("visibility.png", answer.to_gray_png()?),
        error_hard: save("error-hard.png", error(&truths.hard)?),
        error_light_space: save("error-light-space.png", error(&truths.light_space)?),
    };
    Ok(Rendered { scores, classes: classes.map(|c| c.shares).unwrap_or_default(), regions, images })
}

/// One entry of the results.
fn entry(prepared: &Prepared, rendered: Rendered, time: TimeResult) -> TechniqueResult {
    let shadows = &prepared.shadows;
    let about = shadows.technique().about();
    let mut technique = shadows.technique().clone_box();
    let settings = technique.parameters().iter().map(|p| (p.name.to_string(), value(&p.value()))).collect();
    let Rendered { scores, classes, regions, images } = rendered;
    TechniqueResult {
        name: about.name.into(),
        spec: technique::spec(shadows.technique()),
        title: about.title.into(),
        family: about.family,
        paper: about.paper.into(),
        settings,
        scores,
        regions,
        classes,
        time,
        memory: facts::memory(&shadows.memory()),
        work: Some(facts::work(shadows)),
        invalid: prepared.invalid(),
        explain: explain(prepared),
        images,
    }
}

/// What the library says of itself, and how much its lists held.
fn explain(prepared: &Prepared) -> Vec<String> {
    let occupancy = prepared.occupancy.as_ref();
    let held = occupancy.and_then(|occupancy| occupancy.lists.as_ref()).map(|lists| {
        let (mean, longest) = (lists.mean(), lists.longest);
        format!("lists held {} triangles, {mean:.2} per texel, at most {longest}", lists.entries)
    });
    prepared.shadows.explain().into_iter().chain(held).collect()
}

/// A number where the text is one.
fn value(text: &str) -> serde_json::Value {
    serde_json::from_str(text).unwrap_or_else(|_| text.into())
}
