//! What is right: a shot under rays.

use crate::{
    image::{GrayImage, ImageError},
    metrics::{self, Score, ScoreError},
    progress::Progress,
    regions::{self, Region},
    shot::Shot,
};
use antumbra::{Kernel, View, Weights};
use antumbra_truth::{CameraRays, Hit, Tracer, Visibility};
use anyhow::Result;
use glam::DVec3;
use serde::Serialize;

/// What is right, by which question.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Truth {
    /// One shadow ray per pixel.
    Hard,
    /// Ray-traced depth behind a Gaussian of so many texels of the shot's maps.
    LightSpace(u32),
    /// So many rays per pixel along each side.
    ScreenSpace(u32),
}

/// A truth as scores take it.
#[derive(Debug, Clone)]
pub struct TruthImage {
    /// Visibility, 1 lit.
    pub image: GrayImage,
    /// Pixels that see geometry facing the light.
    pub shadowable: Vec<bool>,
}

impl TruthImage {
    fn new(visibility: Visibility) -> Result<Self, ImageError> {
        let Visibility { width, height, values, shadowable } = visibility;
        Ok(Self { image: GrayImage::new(width, height, values)?, shadowable })
    }

    /// Scores an answer over the pixels that can be in shadow or, where `among` is a mask, over those pixels
    /// of the mask that can.
    ///
    /// # Errors
    /// As [`metrics::score`].
    pub fn score(&self, answer: &GrayImage, among: Option<&[bool]>) -> Result<Score, ScoreError> {
        let both = |(a, b): (&bool, &bool)| *a && *b;
        match among {
            None => metrics::score(answer, &self.image, &self.shadowable),
            Some(among) => {
                let mask: Vec<bool> = self.shadowable.iter().zip(among).map(both).collect();
                metrics::score(answer, &self.image, &mask)
            }
        }
    }
}

/// A shot with a tracer of its scene and the rays of its picture.
#[derive(Debug)]
pub struct TracedShot<'s> {
    /// What is looked at.
    pub shot: &'s Shot,
    /// Finds what rays hit.
    pub tracer: Tracer<'s>,
    /// The rays of the picture.
    pub rays: CameraRays,
}

impl<'s> TracedShot<'s> {
    /// Builds the tree of the scene's triangles.
    ///
    /// # Errors
    /// Triangles that cannot be traced, a camera without a picture.
    pub fn new(shot: &'s Shot) -> Result<Self> {
        let [width, height] = shot.resolution;
        let tracer = Tracer::sharing(&shot.geometry, &shot.tree)?;
        Ok(Self { shot, tracer, rays: CameraRays::new(&shot.camera, width, height)? })
    }

    /// Traces one of the truths; `views` are those of the light, for the light-space ideal.
    ///
    /// # Errors
    /// No views where they are needed, a kernel without a width.
    pub fn trace(&self, truth: Truth, views: &[View], progress: &dyn Progress) -> Result<TruthImage> {
        let Self { shot, tracer, rays } = self;
        let report = |share| progress.share(share);
        let visibility = match truth {
            Truth::Hard => tracer.hard(rays, &shot.light),
            Truth::LightSpace(width) => {
                let (kernel, maps) = (ideal_kernel(width)?, shot.map_views(views, width)?);
                tracer.light_space_ideal(rays, &shot.light, &kernel, &maps, &report)
            }
            Truth::ScreenSpace(grid) => tracer.supersampled(rays, &shot.light, grid, &report),
        };
        Ok(TruthImage::new(visibility)?)
    }

    /// Parts of the picture where techniques are known to differ: see [`regions::regions`]. `near` is a share
    /// of the depth range.
    ///
    /// # Errors
    /// No views.
    pub fn regions(
        &self,
        hits: &[Hit],
        shadowable: &[bool],
        views: &[View],
        near: f64,
    ) -> Result<Vec<Region>> {
        let maps = self.shot.map_views(views, self.shot.kernel)?;
        let near = |point: DVec3| near * f64::from(maps.view(point).depth_world);
        Ok(regions::regions(&self.tracer, hits, shadowable, &self.shot.light, &near))
    }
}

/// The Gaussian of the light-space ideal, `width` texels wide: with the weights that techniques blur with.
///
/// # Errors
/// A width of 0.
pub fn ideal_kernel(width: u32) -> Result<antumbra_truth::Kernel> {
    let taps = Kernel::new(Weights::Gaussian, width, 0.0).taps;
    Ok(antumbra_truth::Kernel::new(taps.into_iter().map(f64::from).collect())?)
}
