//! What is right in each frame, and at the points of the frame before.

use super::{Promise, Request};
use crate::{map_views::MapViews, motion::Frame, truth::ideal_kernel};
use antumbra_truth::{CameraRays, Hit, Tracer};
use anyhow::{Result, bail};
use glam::Vec3;

/// Visibility as it should be; `None` where a pixel is not shadowable or does not count.
#[derive(Debug, Clone)]
pub(super) struct FrameTruth {
    /// What each pixel sees.
    pub(super) hits: Vec<Hit>,
    /// Whether the rasteriser sees the same point.
    pub(super) agrees: Vec<bool>,
    /// One entry per pixel.
    pub(super) hard: Vec<Option<f32>>,
    /// One entry per chosen pixel.
    pub(super) light_space: Vec<Option<f32>>,
    /// One entry per chosen pixel.
    pub(super) screen_space: Vec<Option<f32>>,
}

/// One frame: what is right, and what each technique answered, pixel by pixel.
#[derive(Debug)]
pub(super) struct FrameSample {
    pub(super) truth: FrameTruth,
    pub(super) answers: Vec<Vec<f32>>,
}

/// Traces frames.
pub(super) struct Truths<'a> {
    tracer: &'a Tracer<'a>,
    resolution: [u32; 2],
    kernel: antumbra_truth::Kernel,
    grid: u32,
    /// Numbers of the pixels that are asked for the ideals.
    chosen: Vec<usize>,
}

impl<'a> Truths<'a> {
    pub(super) fn new(tracer: &'a Tracer<'a>, request: &Request) -> Result<Self> {
        let [width, height] = request.shot.resolution;
        if !(1..=width.min(height)).contains(&request.stride) {
            bail!(
                "a stride of {} pixels: allowed are 1 to {}, the shorter side of the picture",
                request.stride,
                width.min(height)
            );
        }
        let step = request.stride as usize;
        let first = request.stride / 2;
        let rows = (first..height).step_by(step);
        let chosen = rows.flat_map(|y| (first..width).step_by(step).map(move |x| (y * width + x) as usize));
        Ok(Self {
            tracer,
            resolution: request.shot.resolution,
            kernel: ideal_kernel(request.shot.kernel)?,
            grid: request.grid,
            chosen: chosen.collect(),
        })
    }

    /// The entries of chosen pixels.
    pub(super) fn chosen<T: Copy>(&self, entries: &[T]) -> Vec<T> {
        self.chosen.iter().map(|&pixel| entries[pixel]).collect()
    }

    /// What is right in a frame; `drawn` is where the rasteriser's surfaces are, relative to the eye.
    pub(super) fn of_frame(
        &self,
        frame: &Frame,
        maps: &MapViews,
        drawn: &[Option<Vec3>],
    ) -> Result<FrameTruth> {
        let [width, height] = self.resolution;
        let rays = CameraRays::new(&frame.camera, width, height)?;
        let hits = self.tracer.primary(&rays);
        let eye = frame.camera.position.as_dvec3();
        let pixel = |distance| frame.camera.projection.pixel_size(distance, height);
        let same = |(hit, drawn): (&Hit, &Option<Vec3>)| match drawn {
            Some(drawn) if hit.is_hit() => {
                let arm = hit.position - eye;
                arm.distance(drawn.as_dvec3()) < 0.5 * pixel(arm.length())
            }
            _ => false,
        };
        let agrees = hits.iter().zip(drawn).map(same).collect();
        let screen_space = self.tracer.supersampled_at(&rays, &self.chosen, &frame.light, self.grid);
        Ok(self.under(frame, maps, hits, agrees, screen_space))
    }

    /// What is right at the points of another frame under this frame's light. There is no screen there.
    pub(super) fn at_points(&self, points: &FrameTruth, frame: &Frame, maps: &MapViews) -> FrameTruth {
        self.under(frame, maps, points.hits.clone(), points.agrees.clone(), points.screen_space.clone())
    }

    fn under(
        &self,
        frame: &Frame,
        maps: &MapViews,
        hits: Vec<Hit>,
        agrees: Vec<bool>,
        mut screen_space: Vec<Option<f32>>,
    ) -> FrameTruth {
        let drop = |values: &mut [Option<f32>], agrees: &[bool]| {
            values
                .iter_mut()
                .zip(agrees)
                .filter(|(_, agrees)| !**agrees)
                .for_each(|(value, _)| *value = None);
        };
        let mut hard = self.tracer.hard_at(&hits, &frame.light);
        drop(&mut hard, &agrees);
        let mut light_space =
            self.tracer.light_space_ideal_at(&self.chosen(&hits), &frame.light, &self.kernel, maps);
        let chosen = self.chosen(&agrees);
        drop(&mut light_space, &chosen);
        // A pixel whose centre is not shadowable may have a shadowable corner: what is asked is the centre.
        for (value, centre) in screen_space.iter_mut().zip(self.chosen(&hard)) {
            *value = value.filter(|_| centre.is_some());
        }
        FrameTruth { hits, agrees, hard, light_space, screen_space }
    }
}

impl FrameTruth {
    /// One of the truths.
    pub(super) fn of(&self, promise: Promise) -> &[Option<f32>] {
        match promise {
            Promise::Hard => &self.hard,
            Promise::LightSpace => &self.light_space,
            Promise::ScreenSpace => &self.screen_space,
        }
    }
}
