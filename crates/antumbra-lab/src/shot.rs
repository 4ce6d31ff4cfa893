//! What is looked at: a scene, how it is seen and lit, and the maps that shadow it.

use crate::map_views::MapViews;
use antumbra::{ShadowMap, Technique, View, technique::Bias};
use antumbra_render::{GpuScene, views};
use antumbra_scene::{Camera, Geometry, Light};
use antumbra_truth::SharedTree;
use anyhow::{Context, Result};
use glam::Mat4;
use std::sync::Arc;

/// A scene, how it is seen and lit, and the maps that shadow it.
#[derive(Debug, Clone)]
pub struct Shot {
    /// Name of the scene.
    pub name: String,
    /// Its triangles.
    pub geometry: Arc<Geometry>,
    /// What tracers of these triangles share.
    pub tree: SharedTree,
    /// Where it is seen from.
    pub camera: Camera,
    /// What it is lit by.
    pub light: Light,
    /// Pixels across and down.
    pub resolution: [u32; 2],
    /// Texels along one side of each map.
    pub map_size: u32,
    /// Kernel width of the light-space ideal, texels.
    pub kernel: u32,
    /// Largest number of views of a sun, 1 to 8; spots have one.
    pub cascades: u32,
    /// Bias of every technique.
    pub bias: Bias,
}

/// A technique with its bias.
pub type Entry = (Box<dyn Technique>, Bias);

impl Shot {
    /// Techniques with this shot's bias.
    #[must_use]
    pub fn entries(&self, techniques: &[Box<dyn Technique>]) -> Vec<Entry> {
        techniques.iter().map(|technique| (technique.clone(), self.bias)).collect()
    }

    /// The scene on the GPU.
    ///
    /// # Errors
    /// As [`GpuScene::new`].
    pub fn upload(&self, gpu: &antumbra_render::Gpu) -> Result<GpuScene> {
        Ok(GpuScene::new(gpu, &self.geometry, &self.camera, &self.light, self.resolution)?)
    }

    /// The light's views for a camera's matrix, with the margin of the widest kernel; their depth leans or not.
    ///
    /// # Errors
    /// [`antumbra::LightError`], an empty scene.
    pub fn views(&self, camera: Mat4, maps: &[&ShadowMap], lean: bool) -> Result<Vec<View>> {
        let scene =
            self.geometry.bounds_around(self.camera.position).context("the scene has no triangles")?;
        Ok(views::fit(camera, scene, &self.light, self.cascades, maps, lean)?)
    }

    /// Largest number of views that the light can have: one per cascade, one of a spot.
    #[must_use]
    pub fn max_views(&self) -> u32 {
        match self.light {
            Light::Directional { .. } => self.cascades,
            Light::Spot { .. } => 1,
        }
    }

    /// Which of `views` shades what, for a filter of `kernel` texels.
    ///
    /// # Errors
    /// No views.
    pub fn map_views(&self, views: &[View], kernel: u32) -> Result<MapViews> {
        MapViews::new(views, self.map_size, kernel)
    }
}
