//! What every measurement starts from: a scene, how it is seen and lit, and the maps that shadow it.

use crate::{
    compare::{Contestant, Entered, aim, contestants},
    gpu::Gpu,
    lighting::Lighting,
    results::LeftOut,
    stage::Stage,
    views::{self, MapViews},
};
use antumbra::{ShadowMap, Technique, View, technique::Bias};
use antumbra_scene::{Camera, Geometry, Light};
use antumbra_truth::{CameraRays, Tracer};
use anyhow::{Context, Result};
use glam::Mat4;
use std::sync::Arc;

/// A scene, how it is seen and lit, and the maps that shadow it.
#[derive(Debug, Clone)]
pub struct Setting {
    /// Name of the scene.
    pub name: String,
    /// Its triangles.
    pub geometry: Arc<Geometry>,
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
    /// Most views of a sun, 1 to 8; spots have one.
    pub cascades: u32,
    /// Of every technique.
    pub bias: Bias,
}

/// A setting on the GPU, with techniques that are ready to be drawn.
#[derive(Debug)]
pub struct Setup {
    /// The scene.
    pub stage: Stage,
    /// Visibility and pictures.
    pub lighting: Lighting,
    /// The techniques, in the order they were given.
    pub contestants: Vec<Contestant>,
    /// What the device or the scene refuses.
    pub left_out: Vec<LeftOut>,
    /// The light's views, the same for all techniques: the margin is that of the widest kernel.
    pub views: Vec<View>,
}

impl Setting {
    /// Uploads the scene, makes a map for every technique, and gives all of them the light's views. Maps that
    /// keep triangles by id are drawn, so that they have memory for all of them.
    ///
    /// # Errors
    /// As [`Stage::new`] and [`contestants`](Self::contestants); a light or camera without a view.
    pub fn set_up(&self, gpu: &Gpu, techniques: &[Box<dyn Technique>]) -> Result<Setup> {
        self.set_up_biased(gpu, &self.entries(techniques))
    }

    /// The same with a bias of its own for every technique.
    ///
    /// # Errors
    /// As [`set_up`](Self::set_up).
    pub fn set_up_biased(&self, gpu: &Gpu, entries: &[(Box<dyn Technique>, Bias)]) -> Result<Setup> {
        let stage = self.stage(gpu)?;
        let lighting = Lighting::new(gpu, &stage);
        let (Entered { contestants, left_out }, views) = self.enter(gpu, &stage, entries)?;
        Ok(Setup { stage, lighting, contestants, left_out, views })
    }

    /// The same on a stage that holds the scene already: techniques, and the light's views.
    ///
    /// # Errors
    /// As [`set_up`](Self::set_up).
    pub fn enter(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        entries: &[(Box<dyn Technique>, Bias)],
    ) -> Result<(Entered, Vec<View>)> {
        let mut entered = self.contestants(gpu, stage, entries)?;
        let contestants = &mut entered.contestants;
        let maps: Vec<&ShadowMap> = contestants.iter().map(|c| &c.shadows).collect();
        let views = if maps.is_empty() { Vec::new() } else { self.views(stage.camera_matrix(), &maps)? };
        aim(gpu, stage, contestants, &views)?;
        for contestant in contestants {
            if contestant.shadows.technique().caster().keeps_ids() {
                contestant.draw_maps(gpu, stage)?;
            }
        }
        Ok((entered, views))
    }

    /// Techniques with this setting's bias.
    #[must_use]
    pub fn entries(&self, techniques: &[Box<dyn Technique>]) -> Vec<(Box<dyn Technique>, Bias)> {
        techniques.iter().map(|technique| (technique.clone(), self.bias)).collect()
    }

    /// The scene alone on the GPU.
    ///
    /// # Errors
    /// As [`Stage::new`].
    pub fn stage(&self, gpu: &Gpu) -> Result<Stage> {
        Stage::new(gpu, &self.geometry, &self.camera, &self.light, self.resolution)
    }

    /// Maps of this setting for techniques and their biases, without views yet. Those that the device or the
    /// scene refuses are left out.
    ///
    /// # Errors
    /// [`Refused`](crate::results::Refused) where none is left.
    pub fn contestants(
        &self,
        gpu: &Gpu,
        stage: &Stage,
        entries: &[(Box<dyn Technique>, Bias)],
    ) -> Result<Entered> {
        contestants(gpu, stage, entries, self.map_size, self.most_views())
    }

    /// The light's views for a camera's matrix, with the margin of the widest kernel.
    ///
    /// # Errors
    /// [`antumbra::LightError`], an empty scene.
    pub fn views(&self, camera: Mat4, maps: &[&ShadowMap]) -> Result<Vec<View>> {
        let scene =
            self.geometry.bounds_around(self.camera.position).context("the scene has no triangles")?;
        views::fit(camera, scene, &self.light, self.cascades, maps)
    }

    /// Views that the light can have: one per cascade, one of a spot.
    #[must_use]
    pub fn most_views(&self) -> u32 {
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

    /// The rays of the picture.
    ///
    /// # Errors
    /// A camera without a picture.
    pub fn rays(&self) -> Result<CameraRays> {
        Ok(CameraRays::new(&self.camera, self.resolution[0], self.resolution[1])?)
    }

    /// A tracer of the scene.
    ///
    /// # Errors
    /// Triangles that cannot be traced.
    pub fn tracer(&self) -> Result<Tracer<'_>> {
        Ok(Tracer::new(&self.geometry)?)
    }
}
