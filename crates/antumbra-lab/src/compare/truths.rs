//! The truths of a comparison, and the parts of the picture that are scored on their own.

use super::{Progress, Request, ideal_kernel};
use crate::{
    gpu::Gpu,
    metrics,
    plane::Plane,
    regions::{Region, regions},
    results::{TruthFacts, TruthImages},
    stage::Stage,
};
use antumbra::View;
use antumbra_truth::{Coverage, CoverageTolerance, Hit, Visibility};
use anyhow::Result;
use glam::DVec3;
use std::{collections::BTreeMap, time::Instant};

/// Truths and masks.
#[derive(Debug)]
pub(super) struct Truths {
    pub(super) hard: Truth,
    pub(super) light_space: Truth,
    pub(super) screen_space: Truth,
    pub(super) regions: Vec<Region>,
    pub(super) facts: TruthFacts,
}

/// One truth as scores take it.
#[derive(Debug)]
pub(super) struct Truth {
    pub(super) plane: Plane,
    pub(super) shadowable: Vec<bool>,
}

impl Truth {
    fn new(visibility: Visibility) -> Result<Self> {
        let Visibility { width, height, values, shadowable } = visibility;
        Ok(Self { plane: Plane::new(width, height, values)?, shadowable })
    }
}

/// Traces everything; adds the truths' pictures to `images`.
pub(super) fn trace(
    gpu: &Gpu,
    request: &Request,
    stage: &Stage,
    views: &[View],
    progress: &dyn Progress,
    images: &mut BTreeMap<String, Vec<u8>>,
) -> Result<Truths> {
    let setting = &request.setting;
    let (light, geometry) = (&setting.light, &setting.geometry);
    let maps = setting.map_views(views, setting.kernel)?;
    let mut clock = Clock::start();
    progress.step("truth: build");
    let tracer = setting.tracer()?;
    let rays = setting.rays()?;
    let seconds_build = clock.lap();
    progress.step("truth: hard");
    let hard = tracer.hard(&rays, light);
    let seconds_hard = clock.lap();
    progress.step("truth: coverage");
    let hits = tracer.primary(&rays);
    let coverage =
        tracer.coverage(&rays, &hits, &stage.triangle_numbers(gpu, geometry)?, CoverageTolerance::default());
    // A twentieth of the depth range: wider than the ramp of a 16-term Fourier series.
    let near = |point: DVec3| 0.05 * f64::from(maps.view(point).depth_world);
    let regions = regions(&tracer, &hits, &hard.shadowable, light, &near);
    progress.step("truth: light-space ideal");
    clock.lap();
    let kernel = ideal_kernel(setting.kernel)?;
    let light_space = tracer.light_space_ideal(&rays, light, &kernel, &maps, &|s| progress.share(s));
    let seconds_light_space = clock.lap();
    progress.step("truth: screen-space ideal");
    let screen_space = tracer.supersampled(&rays, light, request.grid, &|s| progress.share(s));
    let seconds_screen_space = clock.lap();
    let [hard, light_space, screen_space] =
        [Truth::new(hard)?, Truth::new(light_space)?, Truth::new(screen_space)?];
    let mut save = |name: &str, truth: &Truth| -> Result<String> {
        let file = format!("truth-{name}.png");
        images.insert(file.clone(), truth.plane.to_gray_png()?);
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
        no_shadow: metrics::no_shadow_baseline(&hard.plane, &hard.shadowable)?.heard(),
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
