//! From answers and truths to numbers.

use super::{
    Measured, Promise, Request, TechniqueFlicker,
    truths::{FrameSample, FrameTruth, Truths},
};
use crate::{
    files,
    image::{Rgba8Image, diverging},
    prepared::Prepared,
};
use antumbra::technique;
use anyhow::Result;
use std::collections::BTreeMap;

/// A sum with the number of its terms.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Tally {
    /// Sum of |Δv − Δv_truth|.
    pub sum: f64,
    /// Pixels that counted.
    pub count: u64,
}

impl Tally {
    /// Mean per pixel, 0 without any.
    #[must_use]
    pub fn mean(self) -> f64 {
        if self.count == 0 { 0.0 } else { self.sum / self.count as f64 }
    }

    fn add(&mut self, other: Self) {
        self.sum += other.sum;
        self.count += other.count;
    }
}

/// |Δv − Δv_truth| of every pixel from `before` to `now`, each a technique's answers with the truth;
/// `None` where one of the truths is.
pub fn change_of_error<'a>(
    before: (&'a [f32], &'a [Option<f32>]),
    now: (&'a [f32], &'a [Option<f32>]),
) -> impl Iterator<Item = Option<f64>> + 'a {
    let errors = |(answers, truth): (&'a [f32], &'a [Option<f32>])| {
        answers.iter().zip(truth).map(|(v, t)| t.map(|t| f64::from(*v) - f64::from(t)))
    };
    errors(before).zip(errors(now)).map(|(before, now)| Some((now? - before?).abs()))
}

fn tally(changes: impl Iterator<Item = Option<f64>>) -> Tally {
    changes.flatten().fold(Tally::default(), |t, change| Tally { sum: t.sum + change, count: t.count + 1 })
}

/// One number per pair of frames, against each truth.
type Frames = BTreeMap<Promise, Vec<Tally>>;

/// What is known of one technique.
#[derive(Debug, Clone, Default)]
struct Single {
    flicker: Frames,
    crawl: Frames,
    /// Sum of each pixel's |Δv − Δv_truth| against the hard truth.
    heat: Vec<f64>,
}

/// What is known of all of them so far.
#[derive(Debug)]
pub(super) struct Series {
    resolution: [u32; 2],
    singles: Vec<Single>,
    ideal: Tally,
    /// Pairs of frames in which each pixel counted.
    seen: Vec<u32>,
    /// Pixels where raster and rays agree, of those that see anything.
    agree: Tally,
    pairs: u32,
}

const IN_PICTURE: [Promise; 3] = [Promise::Hard, Promise::LightSpace, Promise::ScreenSpace];
const ON_SURFACES: [Promise; 2] = [Promise::Hard, Promise::LightSpace];

impl Series {
    pub(super) fn new(techniques: usize, resolution: [u32; 2]) -> Self {
        let pixels = resolution[0] as usize * resolution[1] as usize;
        let single = Single { heat: vec![0.0; pixels], ..Single::default() };
        Self {
            resolution,
            singles: vec![single; techniques],
            ideal: Tally::default(),
            seen: vec![0; pixels],
            agree: Tally::default(),
            pairs: 0,
        }
    }

    /// A pair of frames; `points` and `answers` belong to the points of `was` under the light of `now`.
    pub(super) fn add(
        &mut self,
        truths: &Truths<'_>,
        was: &FrameSample,
        now: &FrameSample,
        points: &FrameTruth,
        answers: &[Vec<f32>],
    ) {
        self.pairs += 1;
        let both = was.truth.hard.iter().zip(&now.truth.hard).map(|(a, b)| a.is_some() && b.is_some());
        self.seen.iter_mut().zip(both).for_each(|(seen, both)| *seen += u32::from(both));
        let hits = now.truth.hits.iter().zip(&now.truth.agrees).filter(|(hit, _)| hit.is_hit());
        self.agree.add(tally(hits.map(|(_, agrees)| Some(f64::from(u8::from(*agrees))))));
        let sharp = |truth: &FrameTruth| -> Vec<Option<f32>> { truths.chosen(&truth.hard) };
        let ideal =
            |truth: &FrameTruth| -> Vec<f32> { truth.light_space.iter().map(|v| v.unwrap_or(0.0)).collect() };
        let (a, b) = (ideal(&was.truth), ideal(&now.truth));
        self.ideal.add(tally(change_of_error((&a, &sharp(&was.truth)), (&b, &sharp(&now.truth)))));
        for (i, single) in self.singles.iter_mut().enumerate() {
            let (old, new, point) = (&was.answers[i], &now.answers[i], &answers[i]);
            let changes = change_of_error((old, &was.truth.hard), (new, &now.truth.hard));
            for (heat, change) in single.heat.iter_mut().zip(changes) {
                *heat += change.unwrap_or(0.0);
            }
            for promise in IN_PICTURE {
                let pair = measured(truths, promise, (old, &was.truth), (new, &now.truth));
                single.flicker.entry(promise).or_default().push(pair);
            }
            for promise in ON_SURFACES {
                let pair = measured(truths, promise, (old, &was.truth), (point, points));
                single.crawl.entry(promise).or_default().push(pair);
            }
        }
    }

    /// Mean number of pixels that count in a pair of frames.
    pub(super) fn pixels(&self) -> f64 {
        self.seen.iter().map(|n| f64::from(*n)).sum::<f64>() / f64::from(self.pairs.max(1))
    }

    /// Share of pixels where raster and rays see the same point, of those that see any.
    pub(super) fn agreement(&self) -> f64 {
        self.agree.mean()
    }

    /// Flicker of the light-space ideal against the hard truth.
    pub(super) fn ideal_against_hard(&self) -> f64 {
        self.ideal.mean()
    }

    /// Results of all techniques, and the names of their heat maps, which go to `images`.
    pub(super) fn results(
        &self,
        request: &Request,
        prepared: &[Prepared],
        images: &mut BTreeMap<String, Vec<u8>>,
    ) -> Result<(Vec<TechniqueFlicker>, Vec<String>)> {
        let abouts = || prepared.iter().map(|c| c.shadows.technique().about());
        let hard = abouts().position(|about| about.name == "hard").map(|i| &self.singles[i]);
        let mut files = Vec::new();
        let mut techniques = Vec::new();
        for (single, prepared) in self.singles.iter().zip(prepared) {
            let technique = prepared.shadows.technique();
            let (about, spec) = (technique.about(), technique::spec(technique));
            let promise = Promise::of(technique, request.path);
            let own = mean(&single.flicker, promise);
            let base = hard.map(|hard| {
                let name = Promise::of_hard(request.path);
                mean(&hard.flicker, name)
            });
            let file = format!("{}-heat.png", files::stem(&spec));
            images.insert(file.clone(), self.heat_map(single)?);
            files.push(file);
            techniques.push(TechniqueFlicker {
                name: about.name.into(),
                spec,
                title: about.title.into(),
                family: about.family,
                promise,
                ratio_to_hard: ratio(own, base),
                flicker: frames(&single.flicker, hard.map(|h| &h.flicker)),
                crawl: frames(&single.crawl, hard.map(|h| &h.crawl)),
                invalid: None,
            });
        }
        Ok((techniques, files))
    }

    /// White where nothing flickers, deepest red where a pixel is wrong by another quarter in each frame.
    fn heat_map(&self, single: &Single) -> Result<Vec<u8>> {
        let colour = |(sum, seen): (&f64, &u32)| {
            let [r, g, b] =
                if *seen == 0 { [128; 3] } else { diverging((4.0 * sum / f64::from(*seen)) as f32) };
            [r, g, b, 255]
        };
        let rgba = single.heat.iter().zip(&self.seen).flat_map(colour).collect();
        Ok(Rgba8Image::new(self.resolution[0], self.resolution[1], rgba)?.to_png()?)
    }
}

fn measured(
    truths: &Truths<'_>,
    promise: Promise,
    was: (&[f32], &FrameTruth),
    now: (&[f32], &FrameTruth),
) -> Tally {
    if promise == Promise::Hard {
        return tally(change_of_error((was.0, &was.1.hard), (now.0, &now.1.hard)));
    }
    let (a, b) = (truths.chosen(was.0), truths.chosen(now.0));
    tally(change_of_error((&a, was.1.of(promise)), (&b, now.1.of(promise))))
}

fn mean(frames: &Frames, promise: Promise) -> f64 {
    let mut all = Tally::default();
    frames.get(&promise).into_iter().flatten().for_each(|pair| all.add(*pair));
    all.mean()
}

fn ratio(own: f64, base: Option<f64>) -> Option<f64> {
    base.map(|base| own / base).filter(|ratio| ratio.is_finite())
}

fn frames(own: &Frames, hard: Option<&Frames>) -> BTreeMap<Promise, Measured> {
    let one = |(&promise, pairs): (&Promise, &Vec<Tally>)| {
        let value = mean(own, promise);
        let ratio_to_hard = ratio(value, hard.map(|hard| mean(hard, promise)));
        let frames = pairs.iter().map(|pair| pair.mean()).collect();
        (promise, Measured { mean: value, ratio_to_hard, frames })
    };
    own.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn flicker(v: [&[f32]; 2], t: [&[Option<f32>]; 2]) -> f64 {
        tally(change_of_error((v[0], t[0]), (v[1], t[1]))).mean()
    }

    #[test]
    fn the_truth_does_not_flicker_however_it_changes() {
        let truths: [[Option<f32>; 3]; 2] =
            [[Some(0.0), Some(1.0), None], [Some(1.0), Some(0.25), Some(1.0)]];
        let answers = truths.map(|truth| truth.map(|v| v.unwrap_or(0.4)));
        assert_eq!(flicker([&answers[0], &answers[1]], [&truths[0], &truths[1]]), 0.0);
        // One that does not follow, or runs ahead.
        assert_eq!(flicker([&answers[0], &answers[0]], [&truths[0], &truths[1]]), 0.875);
        // A constant error is none.
        let dark = answers.map(|answer| answer.map(|v| v - 0.5));
        assert_eq!(flicker([&dark[0], &dark[1]], [&truths[0], &truths[1]]), 0.0);
    }

    #[test]
    fn pixels_without_a_truth_do_not_count() {
        let lit = [Some(1.0), None, Some(1.0)];
        let other = [Some(1.0), Some(1.0), None];
        let pair = tally(change_of_error((&[1.0, 0.0, 0.0], &lit), (&[0.5, 1.0, 1.0], &other)));
        assert_eq!(pair, Tally { sum: 0.5, count: 1 });
        assert_eq!(Tally::default().mean(), 0.0);
    }
}
