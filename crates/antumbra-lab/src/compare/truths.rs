//! The truths of a comparison, and the parts of the picture that are scored on their own.

use crate::{
    gpu::Gpu,
    metrics,
    progress::Progress,
    readback,
    regions::Region,
    results::{TruthFacts, TruthImages},
    session::Session,
    truth::{TracedShot, Truth, TruthImage},
};
use antumbra_truth::{Coverage, CoverageTolerance, Hit};
use anyhow::Result;
use std::{collections::BTreeMap, time::Instant};

/// Distance to a caster in contact, as a share of the depth range: wider than the ramp of a 16-term Fourier
/// series.
const NEAR: f64 = 0.05;

/// Truths and masks.
#[derive(Debug)]
pub(super) struct Truths {
    pub(super) hard: TruthImage,
    pub(super) light_space: TruthImage,
    pub(super) screen_space: TruthImage,
    pub(super) regions: Vec<Region>,
    pub(super) facts: TruthFacts,
}

/// Traces everything; adds the truths' pictures to `images`. `grid` is the number of rays per pixel of the
/// screen-space ideal, along one side.
pub(super) fn trace(
    gpu: &Gpu,
    session: &Session<'_>,
    grid: u32,
    progress: &dyn Progress,
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Truths> {
    let (shot, views) = (session.shot(), session.views());
    let mut clock = Clock::start();
    progress.step("truth: build");
    let traced = TracedShot::new(shot)?;
    let seconds_build = clock.lap();
    progress.step("truth: hard");
    let hard = traced.trace(Truth::Hard, views, progress)?;
    let seconds_hard = clock.lap();
    progress.step("truth: coverage");
    let hits = traced.tracer.primary(&traced.rays);
    let ids = readback::triangle_ids(gpu, session.scene(), &shot.geometry)?;
    let coverage = traced.tracer.coverage(&traced.rays, &hits, &ids, CoverageTolerance::default());
    let regions = traced.regions(&hits, &hard.shadowable, views, NEAR)?;
    progress.step("truth: light-space ideal");
    clock.lap();
    let light_space = traced.trace(Truth::LightSpace(shot.kernel), views, progress)?;
    let seconds_light_space = clock.lap();
    progress.step("truth: screen-space ideal");
    let screen_space = traced.trace(Truth::ScreenSpace(grid), views, progress)?;
    let seconds_screen_space = clock.lap();
    let mut save = |name: &str, truth: &TruthImage| -> Result<String> {
        let file = format!("truth-{name}.png");
        images.insert(file.clone(), truth.image.to_gray_png()?);
        Ok(file)
    };
    let facts = TruthFacts {
        seconds_build,
        seconds_hard,
        seconds_light_space,
        seconds_screen_space,
        coverage_agreement: coverage.agreement(),
        coverage_explained: coverage_explained(&coverage, &hits),
        shadowable_pixels: hard.shadowable.iter().filter(|s| **s).count() as u64,
        no_shadow: metrics::no_shadow_baseline(&hard.image, &hard.shadowable)?.reliable(),
        images: TruthImages {
            hard: save("hard", &hard)?,
            light_space: save("light-space", &light_space)?,
            screen_space: save("screen-space", &screen_space)?,
        },
    };
    Ok(Truths { hard, light_space, screen_space, regions, facts })
}

fn coverage_explained(coverage: &Coverage, hits: &[Hit]) -> BTreeMap<String, u64> {
    let background = hits.iter().filter(|h| !h.is_hit()).count();
    [
        ("on a shared edge", coverage.edge),
        ("at equal depth", coverage.depth_tie),
        ("at a cut-out's border", coverage.cutout),
        ("unexplained", coverage.unexplained),
        ("background pixels", background),
    ]
    .into_iter()
    .map(|(name, count)| (name.to_string(), count as u64))
    .collect()
}

/// Seconds between calls.
struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }
    fn lap(&mut self) -> f64 {
        let seconds = self.0.elapsed().as_secs_f64();
        self.0 = Instant::now();
        seconds
    }
}
