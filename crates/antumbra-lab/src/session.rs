//! A shot on the GPU with techniques that are ready: draws, moves and times them.

use crate::{
    classes::Classes,
    gpu::{Gpu, Wait},
    image::{GrayImage, Rgba8Image},
    prepared::Prepared,
    progress::Progress,
    readback,
    results::{LeftOut, Refused, StartUp, TimeResult},
    shot::{Entry, Shot},
    timing::{self, TimedFrame, Upkeep},
};
use antumbra::{Options, Pipelines, ShadowMap, Size, Technique, View, technique};
use antumbra_render::{GpuScene, Lighting, Lookup, Pictures};
use antumbra_scene::{Camera, Light};
use anyhow::{Context, Result};
use std::cell::OnceCell;

/// A shot on the GPU with techniques that are ready to be drawn. The scene's surfaces are drawn whenever a
/// method returns.
#[derive(Debug)]
pub struct Session<'g> {
    gpu: &'g Gpu,
    shot: Shot,
    scene: GpuScene,
    lighting: Lighting,
    /// Made when the first picture is asked for.
    pictures: OnceCell<Pictures>,
    prepared: Vec<Prepared>,
    /// As the first techniques have them, without a lean.
    views: Vec<View>,
    left_out: Vec<LeftOut>,
}

/// Times of a session's techniques.
#[derive(Debug)]
pub struct Times {
    /// Shading without any shadow.
    pub unshadowed: TimeResult,
    /// One entry per technique, in their order; ratios are to `hard` if it is among them.
    pub techniques: Vec<TimeResult>,
}

impl<'g> Session<'g> {
    /// Uploads the scene and prepares techniques, all with the shot's bias.
    ///
    /// # Errors
    /// As [`without_techniques`](Self::without_techniques) and [`prepare`](Self::prepare).
    pub fn new(gpu: &'g Gpu, shot: &Shot, techniques: &[Box<dyn Technique>]) -> Result<Self> {
        Self::with_biases(gpu, shot, &shot.entries(techniques))
    }

    /// The same with a bias of its own for every technique.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn with_biases(gpu: &'g Gpu, shot: &Shot, entries: &[Entry]) -> Result<Self> {
        let mut session = Self::without_techniques(gpu, shot)?;
        session.prepare(shot.map_size, entries)?;
        Ok(session)
    }

    /// Uploads the scene alone.
    ///
    /// # Errors
    /// As [`GpuScene::new`]; a lost device.
    pub fn without_techniques(gpu: &'g Gpu, shot: &Shot) -> Result<Self> {
        Self::on(gpu, shot, shot.upload(gpu)?)
    }

    /// The same on a scene that is uploaded already.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn on(gpu: &'g Gpu, shot: &Shot, scene: GpuScene) -> Result<Self> {
        let session = Self {
            gpu,
            shot: shot.clone(),
            lighting: Lighting::new(gpu, &scene),
            scene,
            pictures: OnceCell::new(),
            prepared: Vec::new(),
            views: Vec::new(),
            left_out: Vec::new(),
        };
        session.draw_surfaces()?;
        Ok(session)
    }

    /// Adds techniques with maps of `map_size` texels, which share the light's views: the margin is that of
    /// the widest kernel. Maps that keep triangles by id are drawn, so that they have memory for all of them.
    /// Techniques that the device or the scene refuses are left out.
    ///
    /// # Errors
    /// [`Refused`] where none is left; a light or camera without a view; a lost device.
    pub fn prepare(&mut self, map_size: u32, entries: &[Entry]) -> Result<()> {
        let first = self.prepared.len();
        let pipelines = Pipelines::new(&self.gpu.device);
        let mut left_out = Vec::new();
        for (entry, (technique, bias)) in entries.iter().enumerate() {
            let options = Options::from(Size::square(map_size)).views(self.shot.max_views()).bias(*bias);
            let options = options.capacity(self.scene.capacity()).cutouts(self.scene.tells_cutouts());
            let options = options.pipelines(&pipelines);
            match Prepared::new(self.gpu, &self.scene, technique.as_ref(), &options, entry) {
                Ok(prepared) => self.prepared.push(prepared),
                Err(reason) => left_out.push(LeftOut {
                    spec: technique::spec(technique.as_ref()),
                    reason: format!("{reason:#}"),
                }),
            }
        }
        if self.prepared.len() == first && !left_out.is_empty() {
            return Err(Refused(left_out).into());
        }
        self.left_out.extend(left_out);
        let views = self.set_views(first)?;
        if first == 0 {
            self.views = views;
        }
        let ids = |prepared: &&mut Prepared| prepared.shadows.description().storage.keeps_ids();
        for prepared in self.prepared[first..].iter_mut().filter(ids) {
            prepared.draw_maps(self.gpu, &self.scene)?;
        }
        Ok(())
    }

    /// Gives the light's views for the shot's camera to the maps from `first` on, and returns those that do not lean.
    fn set_views(&mut self, first: usize) -> Result<Vec<View>> {
        let Shot { geometry, camera, light, .. } = &self.shot;
        let matrix = self.scene.camera_matrix_of(geometry, camera, light);
        let maps: Vec<&ShadowMap> = self.prepared[first..].iter().map(|p| &p.shadows).collect();
        if maps.is_empty() {
            return Ok(Vec::new());
        }
        let fit = |lean| self.shot.views(matrix, &maps, lean);
        let (level, leaning) = (fit(false)?, fit(true)?);
        for prepared in &mut self.prepared[first..] {
            let views = if prepared.shadows.leans() { &leaning } else { &level };
            prepared.set_views(self.gpu, &self.scene, views)?;
        }
        Ok(level)
    }

    /// Moves the maps to another camera and light, and draws them. Surfaces stay where they are until
    /// [`look`](Self::look).
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    pub fn draw_maps(&mut self, camera: &Camera, light: &Light) -> Result<()> {
        (self.shot.camera, self.shot.light) = (*camera, *light);
        self.views = self.set_views(0)?;
        for prepared in &mut self.prepared {
            let drawn = prepared.draw_maps(self.gpu, &self.scene);
            drawn.with_context(|| technique::spec(prepared.shadows.technique()))?;
        }
        Ok(())
    }

    /// Draws the surfaces that the camera of the last [`draw_maps`](Self::draw_maps) sees.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn look(&mut self) -> Result<()> {
        let Shot { geometry, camera, light, .. } = &self.shot;
        self.scene.look(self.gpu, geometry, camera, light);
        self.pictures = OnceCell::new();
        self.draw_surfaces()
    }

    fn draw_surfaces(&self) -> Result<()> {
        self.gpu.run(|encoder| {
            self.scene.encode_surfaces(encoder, None);
            Ok(())
        })
    }

    /// What is looked at.
    #[must_use]
    pub fn shot(&self) -> &Shot {
        &self.shot
    }

    /// The scene on the GPU.
    #[must_use]
    pub fn scene(&self) -> &GpuScene {
        &self.scene
    }

    /// The techniques, in the order in which they were given.
    #[must_use]
    pub fn prepared(&self) -> &[Prepared] {
        &self.prepared
    }

    /// Techniques that the device or the scene refuses.
    #[must_use]
    pub fn left_out(&self) -> &[LeftOut] {
        &self.left_out
    }

    /// What makes results less than they could be: one sentence each.
    #[must_use]
    pub fn notes(&self) -> Vec<String> {
        let Some(reason) = self.scene.coarse_cutouts() else { return Vec::new() };
        let shadows = self.prepared.iter().map(|prepared| &prepared.shadows);
        let asking = shadows.filter(|shadows| shadows.description().storage.keeps_ids());
        let specs: Vec<String> = asking.map(|shadows| technique::spec(shadows.technique())).collect();
        if specs.is_empty() {
            return Vec::new();
        }
        let specs = specs.join(", ");
        vec![format!("{specs}: holes of cut-outs are as coarse as the texels of maps, since {reason}")]
    }

    /// Leaves out techniques whose maps had no memory for all triangles.
    pub fn leave_out_invalid(&mut self) {
        let (invalid, valid) = self.prepared.drain(..).partition(|p| p.invalid().is_some());
        self.prepared = valid;
        let invalid: Vec<Prepared> = invalid;
        self.left_out.extend(invalid.iter().filter_map(|p| {
            Some(LeftOut { spec: technique::spec(p.shadows.technique()), reason: p.invalid()? })
        }));
    }

    /// The light's views, the same for all techniques that were prepared together, but for those whose depth leans;
    /// none without a technique.
    #[must_use]
    pub fn views(&self) -> &[View] {
        &self.views
    }

    /// Visibility of every pixel as a technique answers: draws its maps and asks them.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn draw_and_ask(&self, prepared: &Prepared) -> Result<GrayImage> {
        self.gpu.run(|encoder| prepared.encode(encoder, &self.scene, &self.lighting))?;
        readback::visibility(self.gpu, &self.lighting)
    }

    /// Visibility of every pixel as a technique answers whose maps are drawn.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn ask(&self, prepared: &Prepared) -> Result<GrayImage> {
        self.asked(&prepared.lookup, prepared)
    }

    /// What a technique tells apart whose maps are drawn and that answers `visibility`, if it has classes.
    /// The visibility that [`picture`](Self::picture) takes is lost.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn classes(&self, prepared: &Prepared, visibility: &GrayImage) -> Result<Option<Classes>> {
        let Some(lookup) = &prepared.classes else { return Ok(None) };
        let numbers = self.asked(lookup, prepared)?;
        Ok(Some(Classes::new(visibility, &numbers, prepared.shadows.description().classes)?))
    }

    fn asked(&self, lookup: &Lookup, prepared: &Prepared) -> Result<GrayImage> {
        self.gpu.run(|encoder| {
            self.lighting.encode_lookup(encoder, &self.scene, lookup, Some(&prepared.shadows), None);
            Ok(())
        })?;
        readback::visibility(self.gpu, &self.lighting)
    }

    /// The picture that the visibility makes which was drawn last.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn picture(&self) -> Result<Rgba8Image> {
        let pictures = match self.pictures.get() {
            Some(pictures) => pictures,
            None => {
                let made = Pictures::new(self.gpu, &self.scene, &self.lighting)?;
                self.draw_surfaces()?;
                self.pictures.get_or_init(|| made)
            }
        };
        self.gpu.run(|encoder| {
            pictures.encode(encoder);
            Ok(())
        })?;
        readback::picture(self.gpu, pictures)
    }

    /// The picture that a given visibility makes.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn picture_of(&self, visibility: &GrayImage) -> Result<Rgba8Image> {
        self.lighting.write_visibility(self.gpu, &visibility.values);
        self.picture()
    }

    /// What it costs to set up a technique anew and draw its first frame.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    pub fn start_up(&self, prepared: &Prepared) -> Result<StartUp> {
        prepared.start_up(self.gpu, &self.scene, &self.lighting)
    }

    /// Times whole frames of all techniques in turns, `rounds` each, and of shading without any shadow.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn time(&self, rounds: u32, progress: &dyn Progress) -> Result<Times> {
        let frames: Vec<_> = std::iter::once(None).chain(self.prepared.iter().map(Some)).collect();
        let mut techniques = self.time_frames(&frames, rounds, progress)?;
        let unshadowed = techniques.remove(0);
        let hard = self.prepared.iter().position(|p| p.shadows.technique().about().name == "hard");
        timing::relate(&mut techniques, &unshadowed, hard);
        Ok(Times { unshadowed, techniques })
    }

    /// Times of the given frames, `None` being one without any shadow; ratios are left out.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn time_frames(
        &self,
        frames: &[Option<&Prepared>],
        rounds: u32,
        progress: &dyn Progress,
    ) -> Result<Vec<TimeResult>> {
        let unshadowed = Lookup::unshadowed(self.gpu, &self.scene);
        let unshadowed = TimedFrame { shadows: None, lookup: &unshadowed, kept: false };
        let frames: Vec<TimedFrame<'_>> =
            frames.iter().map(|frame| frame.map_or(unshadowed, Prepared::frame)).collect();
        let share = |share| progress.share(share);
        timing::time_interleaved(self.gpu, &self.scene, &self.lighting, &frames, rounds, &share)
    }

    /// The same, with every time that was taken, of frames whose maps may be kept.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn sample_frames<'s>(
        &'s self,
        frames: &[Option<(&'s Prepared, Upkeep)>],
        rounds: u32,
        progress: &dyn Progress,
    ) -> Result<Vec<timing::Samples>> {
        let unshadowed = Lookup::unshadowed(self.gpu, &self.scene);
        let none = TimedFrame { shadows: None, lookup: &unshadowed, kept: false };
        let frame = |frame: &Option<(&'s Prepared, Upkeep)>| {
            let Some((prepared, upkeep)) = *frame else { return none };
            TimedFrame { kept: upkeep == Upkeep::Kept, ..prepared.frame() }
        };
        let frames: Vec<TimedFrame<'_>> = frames.iter().map(frame).collect();
        let share = |share| progress.share(share);
        timing::sample_interleaved(self.gpu, &self.scene, &self.lighting, &frames, rounds, &share)
    }
}
