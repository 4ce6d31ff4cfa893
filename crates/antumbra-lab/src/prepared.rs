//! A technique made ready to be drawn on one scene.

use crate::{
    gpu::{Gpu, Wait},
    occupancy::Occupancy,
    results::StartUp,
    timing::TimedFrame,
};
use antumbra::{Capacity, Options, Pipelines, ShadowMap, Technique, View};
use antumbra_render::{Casters, GpuScene, Lighting, Lookup};
use anyhow::Result;
use std::time::Instant;

/// A technique with all that drawing it takes.
#[derive(Debug)]
pub struct Prepared {
    /// Its shadow map, prepared.
    pub shadows: ShadowMap,
    /// Its lookup pass.
    pub lookup: Lookup,
    /// How its casters are drawn.
    pub casters: Casters,
    /// The pass that asks for classes, if it has any.
    pub classes: Option<Lookup>,
    /// Its index among the entries that it was prepared with.
    pub entry: usize,
    /// What its casters needed when [`draw_maps`](Self::draw_maps) last drew them, if it keeps triangles by
    /// id.
    pub occupancy: Option<Occupancy>,
    options: Options,
}

impl Prepared {
    /// Allocates everything, without a view yet.
    pub(crate) fn new(
        gpu: &Gpu,
        scene: &GpuScene,
        technique: &dyn Technique,
        options: &Options,
        entry: usize,
    ) -> Result<Self> {
        let shadows = ShadowMap::new(&gpu.device, technique, options.clone())?;
        let lookup = Lookup::new(gpu, scene, &shadows);
        let casters = Casters::new(gpu, scene, &shadows)?;
        let classes = Lookup::classes(gpu, scene, &shadows);
        gpu.check()?;
        Ok(Self { shadows, lookup, casters, classes, entry, occupancy: None, options: options.clone() })
    }

    /// Gives it the light's views.
    ///
    /// # Errors
    /// More than its map has room for.
    pub fn set_views(&mut self, gpu: &Gpu, scene: &GpuScene, views: &[View]) -> Result<()> {
        self.shadows.prepare(&gpu.queue, views)?;
        self.casters.set_views(gpu, scene, &self.shadows);
        Ok(())
    }

    /// Draws its maps for the views that it was last given. A map with too little memory for the triangles
    /// that share texels is allocated anew and drawn again; where the device refuses that, shadows are
    /// missing, which [`invalid`](Self::invalid) tells.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn draw_maps(&mut self, gpu: &Gpu, scene: &GpuScene) -> Result<()> {
        self.cast(gpu, scene)?;
        // Twice where triangles without an id were not counted in their texels.
        while let Some(needed) = self.occupancy.as_ref().and_then(Occupancy::needed) {
            // Later views may need a little more.
            let per_texel = needed.triangles_per_texel;
            let capacity = Capacity { triangles_per_texel: per_texel + per_texel / 4, ..needed };
            let options = self.options.clone().capacity(capacity);
            let Ok(mut larger) = Self::new(gpu, scene, self.shadows.technique(), &options, self.entry) else {
                break;
            };
            larger.set_views(gpu, scene, self.shadows.views())?;
            larger.cast(gpu, scene)?;
            *self = larger;
        }
        Ok(())
    }

    fn cast(&mut self, gpu: &Gpu, scene: &GpuScene) -> Result<()> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, |pass| scene.draw_casters(&self.casters, pass))?;
        gpu.finish(encoder)?;
        self.occupancy = Occupancy::read(gpu, &self.shadows)?;
        Ok(())
    }

    /// Why what it shows is worth nothing, if so: triangles that its map had no memory for.
    #[must_use]
    pub fn invalid(&self) -> Option<String> {
        self.occupancy.as_ref().and_then(Occupancy::shortage)
    }

    /// Draws its maps and, on the surfaces that the scene already holds, its visibility.
    ///
    /// # Errors
    /// If its casters are not of the kind that its technique keeps.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &GpuScene,
        lighting: &Lighting,
    ) -> Result<()> {
        self.shadows.encode(encoder, |pass| scene.draw_casters(&self.casters, pass))?;
        lighting.encode_lookup(encoder, scene, &self.lookup, Some(&self.shadows), None);
        Ok(())
    }

    /// What it costs another map of the same kind, which shares nothing with this one, to draw its first frame.
    pub(crate) fn start_up(&self, gpu: &Gpu, scene: &GpuScene, lighting: &Lighting) -> Result<StartUp> {
        let options = self.options.clone().pipelines(&Pipelines::new(&gpu.device));
        let start = Instant::now();
        let mut other = Self::new(gpu, scene, self.shadows.technique(), &options, self.entry)?;
        other.set_views(gpu, scene, self.shadows.views())?;
        gpu.run(|_| Ok(()))?;
        let set_up_ms = start.elapsed().as_secs_f64() * 1e3;
        let start = Instant::now();
        gpu.run(|encoder| other.encode(encoder, scene, lighting))?;
        Ok(StartUp { set_up_ms, first_frame_ms: start.elapsed().as_secs_f64() * 1e3 })
    }

    /// A frame to be timed.
    #[must_use]
    pub fn frame(&self) -> TimedFrame<'_> {
        TimedFrame { shadows: Some((&self.shadows, &self.casters)), lookup: &self.lookup, kept: false }
    }
}
