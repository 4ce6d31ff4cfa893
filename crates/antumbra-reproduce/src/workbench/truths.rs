//! What studies' pictures ought to be, and how far off they are.

use super::Workbench;
use crate::{
    cache::packed,
    study::{Study, Traced, TracedFile},
};
use antumbra_lab::{
    metrics::Score,
    regions::Region,
    session::Session,
    shot::Shot,
    truth::{TracedShot, Truth},
};
use anyhow::{Context, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// The pixels of a region, as the cache keeps them.
#[derive(Serialize, Deserialize)]
struct Mask(#[serde(with = "packed")] Vec<u8>);

impl Workbench<'_> {
    /// Traces what a study's pictures ought to be. The scene's tree of triangles is built once for all
    /// that are not known yet.
    ///
    /// # Errors
    /// A lost device.
    pub fn truths(&self, study: &Study, truths: &[Truth]) -> Result<Vec<Traced>> {
        let shot = self.shot_of(&study.shot, study.map)?;
        let mut rays = None;
        truths.iter().map(|truth| self.truth(study, &shot, &mut rays, *truth)).collect()
    }

    fn truth<'s>(
        &self,
        study: &Study,
        shot: &'s Shot,
        rays: &mut Option<TracedShot<'s>>,
        truth: Truth,
    ) -> Result<Traced> {
        let views = matches!(truth, Truth::LightSpace(_)).then_some((study.map, &study.views));
        let key = ("truth", study.shot, truth, views);
        let file = self.cache.memo(&key, || {
            self.progress.step(&format!("trace rays: {}, {}", study.shot.scene, name(truth)));
            let rays = match rays {
                Some(rays) => rays,
                none => none.insert(TracedShot::new(shot)?),
            };
            let found = rays.trace(truth, &study.views(), self.progress)?;
            let picture = Session::without_techniques(&self.gpu, shot)?.picture_of(&found.image)?;
            Ok(TracedFile {
                picture: picture.into(),
                values: found.image.values,
                shadowable: found.shadowable.into_iter().map(u8::from).collect(),
            })
        })?;
        Traced::new(file, shot.resolution, serde_json::to_string(&key)?)
    }

    /// Scores a technique of a study against one of its truths, over the pixels that can be in shadow
    /// or, where `among` names a mask, over those pixels of the mask that can.
    ///
    /// # Errors
    /// A spec that is not in the study; a mask without any such pixel.
    pub fn score(
        &self,
        study: &Study,
        spec: &str,
        truth: &Traced,
        among: Option<(&str, &[bool])>,
    ) -> Result<Score> {
        let key = ("score", &study.key, spec, &truth.key, among.map(|(name, _)| name));
        self.cache.memo(&key, || {
            let score = truth.truth.score(&study.look(spec)?.visibility()?, among.map(|(_, mask)| mask));
            score.with_context(|| format!("{spec} on {}", study.shot.scene))
        })
    }

    /// Pixels of a study where techniques are known to differ, by name: see
    /// [`regions`](antumbra_lab::regions::regions); `near` is a share of the depth range.
    ///
    /// # Errors
    /// A scene that cannot be traced.
    pub fn regions(&self, study: &Study, near: f64) -> Result<BTreeMap<String, Vec<bool>>> {
        let key = ("regions", study.shot, study.map, &study.views, near);
        let masks: BTreeMap<String, Mask> = self.cache.memo(&key, || {
            let shot = self.shot_of(&study.shot, study.map)?;
            self.progress.step(&format!("trace rays: {}, regions", study.shot.scene));
            let (rays, views) = (TracedShot::new(&shot)?, study.views());
            let shadowable = rays.trace(Truth::Hard, &views, self.progress)?.shadowable;
            let hits = rays.tracer.primary(&rays.rays);
            let mask = |r: Region| (r.name.into(), Mask(r.pixels.into_iter().map(u8::from).collect()));
            Ok(rays.regions(&hits, &shadowable, &views, near)?.into_iter().map(mask).collect())
        })?;
        Ok(masks.into_iter().map(|(name, m)| (name, m.0.into_iter().map(|v| v != 0).collect())).collect())
    }
}

fn name(truth: Truth) -> String {
    match truth {
        Truth::Hard => "hard truth".into(),
        Truth::LightSpace(kernel) => format!("light-space ideal of {kernel}×{kernel}"),
        Truth::ScreenSpace(grid) => format!("screen-space ideal of {grid}×{grid}"),
    }
}
