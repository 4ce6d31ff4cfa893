//! Techniques made ready to be drawn on one stage.

use super::view;
use crate::{
    gpu::Gpu,
    lighting::{Lighting, Lookup},
    plane::Plane,
    stage::{Casters, Stage},
    timing::Entrant,
};
use antumbra::{Options, Pipelines, ShadowMap, Size, Technique, View, technique, technique::Bias};
use antumbra_scene::{Geometry, Light};
use anyhow::{Context, Result};

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
}

impl Contestant {
    /// Draws its maps and, on the surfaces that the stage already holds, its visibility.
    pub fn encode(&self, encoder: &mut wgpu::CommandEncoder, stage: &Stage, lighting: &Lighting) {
        self.shadows.encode(encoder, |view, pass| stage.draw_casters(&self.casters, view, pass));
        lighting.encode_lookup(encoder, stage, &self.lookup, Some(&self.shadows), None);
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

/// [`enter_biased`] with [`Bias::Auto`] for all.
///
/// # Errors
/// As [`enter_biased`].
pub fn enter(
    gpu: &Gpu,
    stage: &mut Stage,
    geometry: &Geometry,
    light: &Light,
    techniques: &[Box<dyn Technique>],
    map_size: u32,
) -> Result<(Vec<Contestant>, View)> {
    let entries: Vec<_> = techniques.iter().map(|t| (t.clone(), Bias::Auto)).collect();
    enter_biased(gpu, stage, geometry, light, &entries, map_size)
}

/// [`contestants`] with the light's only view.
///
/// # Errors
/// Settings that the device cannot do (naming the technique), a light or camera without a view.
pub fn enter_biased(
    gpu: &Gpu,
    stage: &mut Stage,
    geometry: &Geometry,
    light: &Light,
    entries: &[(Box<dyn Technique>, Bias)],
    map_size: u32,
) -> Result<(Vec<Contestant>, View)> {
    let mut contestants = contestants(gpu, stage, entries, map_size)?;
    let maps: Vec<&ShadowMap> = contestants.iter().map(|c| &c.shadows).collect();
    let view = view(stage, geometry, light, &maps)?;
    aim(gpu, stage, &mut contestants, &view)?;
    Ok((contestants, view))
}

/// A shadow map of `map_size` × `map_size` texels for every technique and its bias, sharing pipelines,
/// without a view yet.
///
/// # Errors
/// Settings that the device cannot do, naming the technique.
pub fn contestants(
    gpu: &Gpu,
    stage: &Stage,
    entries: &[(Box<dyn Technique>, Bias)],
    map_size: u32,
) -> Result<Vec<Contestant>> {
    let pipelines = Pipelines::new(&gpu.device);
    let mut contestants = Vec::with_capacity(entries.len());
    for (technique, bias) in entries {
        let options = Options::from(Size::square(map_size)).pipelines(&pipelines).bias(*bias);
        let shadows = ShadowMap::new(&gpu.device, technique.as_ref(), options)
            .with_context(|| technique::spec(technique.as_ref()))?;
        let lookup = Lookup::new(gpu, stage, &shadows);
        let casters =
            Casters::new(gpu, stage, &shadows).with_context(|| technique::spec(technique.as_ref()))?;
        let classes = Lookup::classes(gpu, stage, &shadows);
        gpu.check().with_context(|| technique::spec(technique.as_ref()))?;
        contestants.push(Contestant { shadows, lookup, casters, classes });
    }
    Ok(contestants)
}

/// Gives all contestants a view, and the stage the views that they draw casters for.
///
/// # Errors
/// Never for one view: every map has room for that.
pub fn aim(gpu: &Gpu, stage: &mut Stage, contestants: &mut [Contestant], view: &View) -> Result<()> {
    let mut caster_views = Vec::new();
    for contestant in contestants {
        contestant.shadows.prepare(&gpu.queue, &[*view])?;
        for view in contestant.shadows.caster_views() {
            if !caster_views.contains(view) {
                caster_views.push(*view);
            }
        }
    }
    stage.set_views(gpu, &caster_views);
    Ok(())
}
