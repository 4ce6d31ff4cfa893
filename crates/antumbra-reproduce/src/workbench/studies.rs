//! Pictures of shots with several techniques, at rest and in motion, and of maps.

use super::{Workbench, parse};
use crate::{
    stored_image::StoredImage,
    study::{File, Look, Moving, ShotKey, Study, StudyFile, ViewFacts},
};
use antumbra::technique::Bias;
use antumbra_lab::{
    facts, flicker,
    maps::{self, Sheet},
    motion::Path,
    prepared::Prepared,
    results::Refused,
    session::Session,
    shot::Shot,
};
use anyhow::Result;

impl Workbench<'_> {
    /// Draws a shot with every technique of `specs`, maps being `map` texels wide.
    ///
    /// # Errors
    /// Unknown techniques or settings; [`Refused`] if the device or the scene refuses any of them.
    pub fn study(&self, shot: ShotKey, map: u32, specs: &[&str]) -> Result<Study> {
        self.study_biased(shot, map, specs, Bias::Auto)
    }

    /// The same with one bias for all techniques instead of each one's own.
    ///
    /// # Errors
    /// As [`study`](Self::study); a bias that is not finite.
    pub fn study_biased(&self, shot: ShotKey, map: u32, specs: &[&str], bias: Bias) -> Result<Study> {
        let study = self.drawn(shot, map, specs, bias)?;
        if study.left_out.is_empty() { Ok(study) } else { Err(Refused(study.left_out).into()) }
    }

    /// The same with each technique's own bias, without those of `specs` that cannot be drawn: what
    /// [`Study::left_out`] holds.
    ///
    /// # Errors
    /// Unknown techniques or settings; [`Refused`] where none is left.
    pub fn possible(&self, shot: ShotKey, map: u32, specs: &[&str]) -> Result<Study> {
        self.drawn(shot, map, specs, Bias::Auto)
    }

    fn drawn(&self, shot: ShotKey, map: u32, specs: &[&str], bias: Bias) -> Result<Study> {
        let key = ("study", shot, map, specs, bias.to_string());
        let StudyFile { looks, left_out, views } =
            self.cache.memo(&key, || self.draw(&shot, map, specs, bias))?;
        let key = serde_json::to_string(&key)?;
        Ok(Study { shot, map, looks, left_out, views, key })
    }

    fn draw(&self, key: &ShotKey, map: u32, specs: &[&str], bias: Bias) -> Result<StudyFile> {
        let shot = Shot { bias, ..self.shot_of(key, map)? };
        self.progress.step(&format!("prepare {} techniques on {}", specs.len(), key.scene));
        let mut session = Session::new(&self.gpu, &shot, &parse(specs)?)?;
        session.leave_out_invalid();
        let mut looks = Vec::new();
        for (i, prepared) in session.prepared().iter().enumerate() {
            let spec = specs[prepared.entry];
            self.progress.step(&format!("draw {spec} on {}", key.scene));
            self.progress.share(i as f32 / specs.len() as f32);
            looks.push(look(&session, prepared, spec)?);
        }
        let views = session.views().iter().map(ViewFacts::of).collect();
        Ok(StudyFile { looks, left_out: session.left_out().to_vec(), views })
    }

    /// Moves camera and light of a scene along a path of `frames`, traces the first `until` of them, and
    /// says how `specs` flicker. A quick run takes the whole path in 4 frames, a part of it in 3.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn moving(
        &self,
        shot: ShotKey,
        path: Path,
        [frames, until]: [u32; 2],
        map: u32,
        specs: &[&str],
    ) -> Result<Moving> {
        let [frames, until] = match (self.quick, until < frames) {
            (true, true) => [frames, 3],
            (true, false) => [4, 4],
            (false, _) => [frames, until],
        };
        self.cache.memo(&("moving", shot, path.name(), [frames, until], map, specs), || {
            let request = flicker::Request {
                shot: self.shot_of(&shot, map)?,
                path,
                frames,
                until,
                techniques: parse(specs)?,
                stride: 8,
                grid: 4,
                command: Vec::new(),
            };
            let flicker::Outcome { results, images } = flicker::measure(&self.gpu, &request, self.progress)?;
            Ok(Moving {
                results,
                images: images.into_iter().map(|(name, file)| (name, File(file))).collect(),
            })
        })
    }

    /// Depth and every channel of a technique's filtered maps, on one sheet.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn sheet(&self, shot: ShotKey, map: u32, spec: &str) -> Result<StoredImage> {
        self.cache.memo(&("sheet", shot, map, spec), || {
            self.progress.step(&format!("maps of {spec} on {}", shot.scene));
            let session = Session::new(&self.gpu, &self.shot_of(&shot, map)?, &parse(&[spec])?)?;
            let mut sheet = Sheet::default();
            maps::pictures(&self.gpu, &session, 0, &mut |picture| {
                sheet.add(&picture);
                Ok(())
            })?;
            Ok(sheet.image().into())
        })
    }
}

/// Draws one technique.
fn look(session: &Session<'_>, prepared: &Prepared, spec: &str) -> Result<Look> {
    let shadows = &prepared.shadows;
    let visibility = session.draw_and_ask(prepared)?;
    let picture = session.picture()?;
    let classes = session.classes(prepared, &visibility)?;
    let (tinted, classes, kinds) = classes
        .map_or((None, Vec::new(), Vec::new()), |c| (Some(c.picture.into()), c.shares, c.numbers.values));
    Ok(Look {
        spec: spec.into(),
        title: shadows.technique().about().title.into(),
        picture: picture.into(),
        visibility: visibility.values,
        tinted,
        classes,
        kinds,
        memory: facts::memory(&shadows.memory()),
        work: facts::work(shadows),
    })
}
