//! Times of frames.

use super::{Workbench, parse};
use crate::study::{ShotKey, Timed};
use antumbra_lab::{prepared::Prepared, results::Refused, session::Session, timing::Upkeep};
use anyhow::{Result, bail};
use std::collections::BTreeMap;

/// The spec of a frame without shadows.
const NONE: &str = "none";

impl Workbench<'_> {
    /// Times `frames`, each a map's size and a spec, in turns, so that a round's ratios can be trusted. The spec
    /// `none` shades without shadows.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn times(&self, key: ShotKey, frames: &[(u32, &str)], rounds: u32) -> Result<Vec<Timed>> {
        let drawn: Vec<(u32, &str, bool)> = frames.iter().map(|(map, spec)| (*map, *spec, false)).collect();
        self.times_kept(key, &drawn, rounds)
    }

    /// The same where maps may be kept from frame to frame, as with lights and casters that do not move.
    ///
    /// # Errors
    /// As [`study`](Self::study).
    pub fn times_kept(&self, key: ShotKey, frames: &[(u32, &str, bool)], rounds: u32) -> Result<Vec<Timed>> {
        if rounds == 0 {
            bail!("times of no rounds");
        }
        self.cache.memo(&("race", key, frames, rounds), || {
            self.progress.step(&format!("prepare {} frames on {}", frames.len(), key.scene));
            let mut session = Session::without_techniques(&self.gpu, &self.shot_of(&key, 1)?)?;
            let order = prepare(&mut session, frames)?;
            let frame = |(place, frame): (&Option<usize>, &(u32, &str, bool))| {
                let upkeep = if frame.2 { Upkeep::Kept } else { Upkeep::Drawn };
                place.map(|i| (&session.prepared()[i], upkeep))
            };
            let prepared: Vec<Option<(&Prepared, Upkeep)>> = order.iter().zip(frames).map(frame).collect();
            self.progress.step(&format!("time {} frames on {}", frames.len(), key.scene));
            let samples = session.sample_frames(&prepared, rounds, self.progress)?;
            Ok(samples.into_iter().map(Timed::from).collect())
        })
    }
}

/// Prepares the techniques of all frames, those with maps of one size together, which share the light's
/// views. Returns for each frame which of the session's techniques it shows; `None` shades without shadows.
fn prepare(session: &mut Session<'_>, frames: &[(u32, &str, bool)]) -> Result<Vec<Option<usize>>> {
    let mut by_size: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (i, (map, ..)) in frames.iter().enumerate().filter(|(_, (_, spec, _))| *spec != NONE) {
        by_size.entry(*map).or_default().push(i);
    }
    let mut order = vec![None; frames.len()];
    for (map, members) in by_size {
        let first = session.prepared().len();
        let specs: Vec<&str> = members.iter().map(|i| frames[*i].1).collect();
        let entries = session.shot().entries(&parse(&specs)?);
        session.prepare(map, &entries)?;
        session.leave_out_invalid();
        if !session.left_out().is_empty() {
            return Err(Refused(session.left_out().to_vec()).into());
        }
        members.into_iter().zip(first..).for_each(|(frame, place)| order[frame] = Some(place));
    }
    Ok(order)
}
