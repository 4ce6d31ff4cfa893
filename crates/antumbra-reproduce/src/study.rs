//! What is asked and what is answered: shots, studies of them, truths.

use crate::{cache::packed, numbers::Measured, page::Tile, stored_image::StoredImage};
use antumbra::{View, technique};
use antumbra_lab::{
    classes::ClassShare,
    flicker::{self, TechniqueFlicker},
    image::GrayImage,
    results::{LeftOut, MemoryResult, Refused, Work},
    timing::Samples,
    truth::TruthImage,
};
use anyhow::{Context, Result};
use glam::{Mat4, Vec4};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// What a shot is kept by: a scene seen by its own camera in its own light.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ShotKey<S = &'static str> {
    /// Name of the procedural scene; its seed is the default one.
    pub scene: S,
    /// How far the camera is from its target, in the distances of the scene's own camera.
    pub distance: f32,
    /// Most views of a sun.
    pub cascades: u32,
    /// Pixels across and down.
    pub resolution: [u32; 2],
}

impl ShotKey {
    /// The same from farther away (or nearer), `distance` times the scene's own.
    #[must_use]
    pub fn from(self, distance: f32) -> Self {
        Self { distance, ..self }
    }

    /// The same with that many views of a sun.
    #[must_use]
    pub fn cascades(self, cascades: u32) -> Self {
        Self { cascades, ..self }
    }
}

/// What one technique shows.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Look {
    /// As it was asked for.
    pub spec: String,
    /// Name for people.
    pub title: String,
    /// The lit picture.
    pub picture: StoredImage,
    #[serde(with = "packed")]
    pub(crate) visibility: Vec<f32>,
    /// Visibility with the kinds of pixels that the technique tells apart in colour, if it does.
    pub tinted: Option<StoredImage>,
    /// The shares of those kinds.
    pub classes: Vec<ClassShare>,
    /// Each pixel's kind: 1 for the first, 0 for none, below 0 without geometry; empty where none are told apart.
    #[serde(with = "packed")]
    pub(crate) kinds: Vec<f32>,
    /// Its textures and buffers.
    pub memory: MemoryResult,
    /// Bytes per texel, lookups, passes.
    pub work: Work,
}

/// One shot with several techniques whose maps have one size and one view.
#[derive(Debug, Clone)]
pub struct Study {
    /// What was seen.
    pub shot: ShotKey,
    /// Texels along one side of the maps.
    pub map: u32,
    /// What each technique shows, in the order in which they were asked for.
    pub looks: Vec<Look>,
    /// Techniques that were asked for and are not among the looks: refused, or invalid.
    pub left_out: Vec<LeftOut>,
    pub(crate) views: Vec<ViewFacts>,
    pub(crate) key: String,
}

/// One of the light's views, as the cache keeps it.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub(crate) struct ViewFacts {
    clip_from_world: [f32; 16],
    depth_plane: [f32; 4],
    to_light: [f32; 4],
    texel_world: f32,
    linear_from_clip: [[f32; 4]; 2],
    depth_world: f32,
}

impl ViewFacts {
    pub(crate) fn of(view: &View) -> Self {
        Self {
            clip_from_world: view.clip_from_world.to_cols_array(),
            depth_plane: view.depth_plane.to_array(),
            to_light: view.to_light.to_array(),
            texel_world: view.texel_world,
            linear_from_clip: view.linear_from_clip.map(|row| row.to_array()),
            depth_world: view.depth_world,
        }
    }

    fn view(&self) -> View {
        View {
            clip_from_world: Mat4::from_cols_array(&self.clip_from_world),
            depth_plane: Vec4::from_array(self.depth_plane),
            to_light: Vec4::from_array(self.to_light),
            texel_world: self.texel_world,
            linear_from_clip: self.linear_from_clip.map(Vec4::from_array),
            depth_world: self.depth_world,
        }
    }
}

/// Times of one frame, milliseconds, a round each.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Timed {
    /// Whole frames.
    pub frames: Vec<f64>,
    /// Their lookup passes; none where passes cannot be timed.
    pub lookups: Vec<f64>,
}

impl From<Samples> for Timed {
    fn from(Samples { frame, passes }: Samples) -> Self {
        let lookups = passes.into_iter().find(|(name, _)| *name == "lookup").map(|(_, all)| all);
        Self { frames: frame, lookups: lookups.unwrap_or_default() }
    }
}

impl Timed {
    /// A frame.
    #[must_use]
    pub fn ms(&self) -> f64 {
        Measured::median(&self.frames).value
    }

    /// How many frames of another it takes as long as, round by round.
    #[must_use]
    pub fn over(&self, other: &Self) -> Measured {
        Measured::ratio(&self.frames, &other.frames)
    }
}

/// A truth as it was traced.
#[derive(Debug, Clone)]
pub struct Traced {
    /// Visibility, and the pixels that see geometry facing the light.
    pub truth: TruthImage,
    /// The scene shaded with it.
    pub picture: StoredImage,
    pub(crate) key: String,
}

impl Traced {
    pub(crate) fn new(file: TracedFile, [width, height]: [u32; 2], key: String) -> Result<Self> {
        let image = GrayImage::new(width, height, file.values)?;
        let shadowable = file.shadowable.into_iter().map(|s| s != 0).collect();
        Ok(Self { truth: TruthImage { image, shadowable }, picture: file.picture, key })
    }
}

/// A scene in motion.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Moving {
    /// How every technique flickers.
    pub results: flicker::Results,
    pub(crate) images: BTreeMap<String, File>,
}

/// The bytes of a file.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct File(#[serde(with = "packed")] pub(crate) Vec<u8>);

impl Moving {
    /// What a technique flickers, by the spec it was asked for.
    ///
    /// # Errors
    /// A spec that was not asked for; [`Refused`] where it was left out or is invalid.
    pub fn technique(&self, spec: &str) -> Result<&TechniqueFlicker> {
        let full = technique::spec(technique::parse(spec)?.as_ref());
        if let Some(left_out) = self.results.left_out.iter().find(|left_out| left_out.spec == full) {
            return Err(Refused(vec![left_out.clone()]).into());
        }
        let found = self.results.techniques.iter().find(|technique| technique.spec == full);
        let found = found.with_context(|| format!("{spec} was not moved"))?;
        match &found.invalid {
            None => Ok(found),
            Some(why) => Err(Refused(vec![LeftOut { spec: full, reason: why.clone() }]).into()),
        }
    }

    /// One of the pictures that [`flicker::measure`] drew.
    ///
    /// # Errors
    /// A name that it does not use; no PNG.
    pub fn tile(&self, name: &str, caption: impl Into<String>) -> Result<Tile> {
        let File(png) = self.images.get(name).with_context(|| format!("no picture is called {name}"))?;
        let number =
            |at: usize| png.get(at..at + 4).and_then(|b| Some(u32::from_be_bytes(b.try_into().ok()?)));
        // Where every PNG says its size.
        let size = number(16).zip(number(20)).with_context(|| format!("{name} is no PNG"))?;
        Ok(Tile { caption: caption.into(), png: png.clone(), size: size.into(), close_up: true })
    }
}

/// What the cache keeps of a truth.
#[derive(Serialize, Deserialize)]
pub(crate) struct TracedFile {
    #[serde(with = "packed")]
    pub(crate) values: Vec<f32>,
    #[serde(with = "packed")]
    pub(crate) shadowable: Vec<u8>,
    pub(crate) picture: StoredImage,
}

/// What the cache keeps of a study.
#[derive(Serialize, Deserialize)]
pub(crate) struct StudyFile {
    pub(crate) looks: Vec<Look>,
    pub(crate) left_out: Vec<LeftOut>,
    pub(crate) views: Vec<ViewFacts>,
}

impl Look {
    /// Visibility in each pixel.
    ///
    /// # Errors
    /// Never for a look that a [`Workbench`](crate::workbench::Workbench) made.
    pub fn visibility(&self) -> Result<GrayImage> {
        let [width, height] = self.picture.size;
        Ok(GrayImage::new(width, height, self.visibility.clone())?)
    }

    /// The share of a kind of pixels, 0..1, if the technique has it.
    #[must_use]
    pub fn share(&self, class: &str) -> Option<f64> {
        self.classes.iter().find(|c| c.name == class).map(|c| c.share)
    }
}

impl Study {
    /// The light's views, the same for all techniques.
    #[must_use]
    pub fn views(&self) -> Vec<View> {
        self.views.iter().map(ViewFacts::view).collect()
    }

    /// The look of a technique, by the spec it was asked for.
    ///
    /// # Errors
    /// A spec that is not in the study.
    pub fn look(&self, spec: &str) -> Result<&Look> {
        self.looks.iter().find(|l| l.spec == spec).with_context(|| format!("{spec} is not in the study"))
    }
}
