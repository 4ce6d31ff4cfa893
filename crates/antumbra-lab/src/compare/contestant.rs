//! Techniques made ready to be drawn on one stage.

use crate::{
    gpu::Gpu,
    lighting::{Lighting, Lookup},
    occupancy::Occupancy,
    plane::Plane,
    results::{LeftOut, Refused},
    stage::{Casters, Stage},
    timing::Entrant,
};
use antumbra::{Capacity, Options, Pipelines, ShadowMap, Size, Technique, View, technique, technique::Bias};
use anyhow::Result;

/// A technique with all that drawing it takes.
#[derive(Debug)]
pub struct Contestant {
    /// Its shadow map, prepared.
    pub shadows: ShadowMap,
    /// Its lookup pass.
    pub lookup: Lookup,
    /// How its casters are drawn.
    pub casters: Casters,
    /// The pass that asks for classes, if it has any.
    pub classes: Option<Lookup>,
    /// Its index among the entries that [`contestants`] was given.
    pub entry: usize,
    /// What its casters needed when [`draw_maps`](Self::draw_maps) last drew them, if it keeps triangles by id.
    pub occupancy: Option<Occupancy>,
    options: Options,
}

/// Techniques made ready, and those that could not be.
#[derive(Debug)]
pub struct Entered {
    /// In the order of the entries; at least one.
    pub contestants: Vec<Contestant>,
    /// What the device or the scene refuses, in the order of the entries.
    pub left_out: Vec<LeftOut>,
}

impl Contestant {
    /// Allocates everything, without a view yet.
    fn new(
        gpu: &Gpu,
        stage: &Stage,
        technique: &dyn Technique,
        options: &Options,
        entry: usize,
    ) -> Result<Self> {
        let shadows = ShadowMap::new(&gpu.device, technique, options.clone())?;
        let lookup = Lookup::new(gpu, stage, &shadows);
        let casters = Casters::new(gpu, stage, &shadows)?;
        let classes = Lookup::classes(gpu, stage, &shadows);
        gpu.check()?;
        Ok(Self { shadows, lookup, casters, classes, entry, occupancy: None, options: options.clone() })
    }

    /// Gives it the light's views.
    ///
    /// # Errors
    /// More than its map has room for.
    pub fn aim(&mut self, gpu: &Gpu, stage: &Stage, views: &[View]) -> Result<()> {
        self.shadows.prepare(&gpu.queue, views)?;
        self.casters.aim(gpu, stage, &self.shadows);
        Ok(())
    }

    /// Draws its maps for the views that it was last given. A map with too little memory for the triangles
    /// that share texels is allocated anew and drawn again; where the device refuses that, shadows are missing,
    /// which [`invalid`](Self::invalid) tells.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn draw_maps(&mut self, gpu: &Gpu, stage: &Stage) -> Result<()> {
        self.cast(gpu, stage)?;
        // Twice where triangles without an id were not counted in their texels.
        while let Some(needed) = self.occupancy.as_ref().and_then(Occupancy::needed) {
            // Later views may need a little more.
            let per_texel = needed.triangles_per_texel;
            let capacity = Capacity { triangles_per_texel: per_texel + per_texel / 4, ..needed };
            let options = self.options.clone().capacity(capacity);
            let Ok(mut larger) = Self::new(gpu, stage, self.shadows.technique(), &options, self.entry) else {
                break;
            };
            larger.aim(gpu, stage, self.shadows.views())?;
            larger.cast(gpu, stage)?;
            *self = larger;
        }
        Ok(())
    }

    fn cast(&mut self, gpu: &Gpu, stage: &Stage) -> Result<()> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, |pass| stage.draw_casters(&self.casters, pass))?;
        gpu.finish(encoder)?;
        self.occupancy = Occupancy::read(gpu, &self.shadows)?;
        Ok(())
    }

    /// Why what it shows is worth nothing, if so: triangles that its map had no memory for.
    #[must_use]
    pub fn invalid(&self) -> Option<String> {
        self.occupancy.as_ref().and_then(Occupancy::shortage)
    }

    /// Draws its maps and, on the surfaces that the stage already holds, its visibility.
    ///
    /// # Errors
    /// If its casters are not of the kind that its technique keeps.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        stage: &Stage,
        lighting: &Lighting,
    ) -> Result<()> {
        self.shadows.encode(encoder, |pass| stage.draw_casters(&self.casters, pass))?;
        lighting.encode_lookup(encoder, stage, &self.lookup, Some(&self.shadows), None);
        Ok(())
    }

    /// Class of every pixel, as [`shares`](crate::classes::shares) takes them, if the technique has
    /// any. Its maps and the stage's surfaces are drawn; overwrites the visibility buffer.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read_classes(&self, gpu: &Gpu, stage: &Stage, lighting: &Lighting) -> Result<Option<Plane>> {
        let Some(lookup) = &self.classes else { return Ok(None) };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        lighting.encode_lookup(&mut encoder, stage, lookup, Some(&self.shadows), None);
        gpu.finish(encoder)?;
        lighting.read_visibility(gpu).map(Some)
    }

    /// What a race takes.
    #[must_use]
    pub fn entrant(&self) -> Entrant<'_> {
        Entrant { shadows: Some((&self.shadows, &self.casters)), lookup: &self.lookup }
    }
}

/// A shadow map of `map_size` × `map_size` texels with room for `views` views for every technique and its bias,
/// sharing pipelines, without a view yet. Those that the device or the scene refuses are left out.
///
/// # Errors
/// [`Refused`] where none is left.
pub fn contestants(
    gpu: &Gpu,
    stage: &Stage,
    entries: &[(Box<dyn Technique>, Bias)],
    map_size: u32,
    views: u32,
) -> Result<Entered> {
    let pipelines = Pipelines::new(&gpu.device);
    let (mut contestants, mut left_out) = (Vec::with_capacity(entries.len()), Vec::new());
    for (entry, (technique, bias)) in entries.iter().enumerate() {
        let options = Options::from(Size::square(map_size)).views(views).pipelines(&pipelines).bias(*bias);
        let options = options.capacity(stage.capacity()).cutouts(stage.tells_cutouts());
        match Contestant::new(gpu, stage, technique.as_ref(), &options, entry) {
            Ok(contestant) => contestants.push(contestant),
            Err(reason) => left_out
                .push(LeftOut { spec: technique::spec(technique.as_ref()), reason: format!("{reason:#}") }),
        }
    }
    if contestants.is_empty() && !left_out.is_empty() {
        return Err(Refused(left_out).into());
    }
    Ok(Entered { contestants, left_out })
}

/// Gives all contestants the light's views.
///
/// # Errors
/// More views than the maps have room for.
pub fn aim(gpu: &Gpu, stage: &Stage, contestants: &mut [Contestant], views: &[View]) -> Result<()> {
    contestants.iter_mut().try_for_each(|contestant| contestant.aim(gpu, stage, views))
}
