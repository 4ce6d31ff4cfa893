//! What biases cost and give: acne against detached shadows.

use crate::{
    gpu::Gpu,
    image::GrayImage,
    map_views::MapViews,
    metrics::LIT_THRESHOLD,
    progress::Progress,
    results::LeftOut,
    session::Session,
    shot::{Entry, Shot},
    truth::{TracedShot, Truth, TruthImage},
};
use antumbra::{Technique, technique, technique::Bias};
use antumbra_scene::Light;
use antumbra_truth::{Hit, Ray};
use anyhow::{Context, Result};
use glam::DVec3;
use rayon::prelude::*;
use serde::Serialize;
use std::collections::{BTreeMap, btree_map};

mod standings;

pub use standings::{Place, Standing, Standings, standings};

/// Width of a bin of gaps between receiver and caster, texels.
const BIN_TEXELS: f64 = 0.5;
/// Gaps up to which shadows are looked at, texels.
const MAX_GAP_TEXELS: f64 = 16.0;
/// Pixels that a bin must hold to count.
const MIN_PIXELS: u32 = 8;
/// Visibility in the ideal up to which a pixel's shadow may be missed: deeper inside than edges move by
/// aliasing.
const SHADOWED: f32 = 0.25;
/// Tolerance within which an ideal counts as fully lit.
const ROUNDING: f32 = 1e-3;

/// Share of the fully lit pixels that may be answered shadowed with a fixed bias that [`Ranking`] lets
/// compete: beyond, it fails at what biases are for, however small its error.
pub const TOLERATED_ACNE: f64 = 0.01;

/// What to look at.
#[derive(Debug)]
pub struct Request<'a> {
    /// The scene, how it is seen and lit, and its maps; each technique has the ideal of its own kernel.
    pub shot: &'a Shot,
    /// The techniques.
    pub techniques: &'a [Box<dyn Technique>],
    /// The biases that each of them is given instead of the shot's.
    pub settings: &'a [Bias],
}

/// One technique with one bias.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Row {
    /// The technique with its settings.
    pub technique: String,
    /// The bias as text.
    pub bias: String,
    /// Share of the pixels that are fully lit in the ideal whose visibility is below ½.
    pub acne: f64,
    /// How much too early shadows end towards the casters that touch them, in texels of depth: the
    /// share of pixels answered lit, integrated over the gap between receiver and caster from 0 to 16
    /// texels. A constant bias of b texels gives b. Pixels are those whose visibility in the
    /// ideal is at most ¼; `None` where there are none.
    pub detached_texels: Option<f64>,
    /// Root mean square error against the light-space ideal of the technique's kernel.
    pub rmse: f64,
    /// Mean of 1 − visibility over pixels that are fully lit in the ideal.
    pub over_darkening: f64,
    /// Why these numbers are worth nothing, if so: triangles that the map had no memory for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub invalid: Option<String>,
}

/// What [`study`] found.
#[derive(Debug, Clone, PartialEq)]
pub struct Study {
    /// Techniques in their order, each with its biases in theirs.
    pub rows: Vec<Row>,
    /// Techniques that the device or the scene refuses, each once.
    pub left_out: Vec<LeftOut>,
}

/// [`Bias::Auto`] among the other biases of one technique.
#[derive(Debug, Clone, PartialEq)]
pub struct Ranking<'a> {
    /// Row of [`Bias::Auto`].
    pub auto: &'a Row,
    /// Rows of the other biases, in their order.
    pub others: Vec<&'a Row>,
    /// Row of the smallest error among the rows with at most [`TOLERATED_ACNE`], if there is one.
    pub best: Option<&'a Row>,
    /// Row of the smallest error, whatever its acne.
    pub best_of_all: &'a Row,
}

/// The rank of [`Bias::Auto`] for each technique, in the order of `rows`; techniques without it or
/// without another bias, and rows that are invalid, are left out.
#[must_use]
pub fn rank_biases(rows: &[Row]) -> Vec<Ranking<'_>> {
    let automatic = Bias::Auto.to_string();
    let valid = rows.iter().filter(|row| row.invalid.is_none());
    let (autos, others): (Vec<&Row>, Vec<&Row>) = valid.partition(|row| row.bias == automatic);
    let mut rankings = Vec::new();
    for auto in autos {
        let others: Vec<&Row> = others.iter().copied().filter(|o| o.technique == auto.technique).collect();
        let min = |max_acne: f64| {
            let able = others.iter().copied().filter(|row| row.acne <= max_acne);
            able.min_by(|a, b| a.rmse.total_cmp(&b.rmse))
        };
        if let Some(best_of_all) = min(1.0) {
            let best = min(TOLERATED_ACNE);
            rankings.push(Ranking { auto, best, best_of_all, others });
        }
    }
    rankings
}

/// Renders every technique with every bias and compares with rays. A technique without a kernel is
/// compared with the ideal of a single bilinear tap.
///
/// # Errors
/// No technique that the device can do, a light or camera without a view, a lost device.
pub fn study(gpu: &Gpu, request: &Request<'_>, progress: &dyn Progress) -> Result<Study> {
    progress.step("upload");
    let with_biases = |technique| request.settings.iter().map(move |bias| (Box::clone(technique), *bias));
    let entries: Vec<Entry> = request.techniques.iter().flat_map(with_biases).collect();
    let session = Session::with_biases(gpu, request.shot, &entries)?;
    let mut left_out = session.left_out().to_vec();
    // Each bias is refused alike.
    left_out.dedup();
    let truths = Truths::trace(&session, request.techniques, progress)?;
    progress.step("render");
    let mut rows = Vec::with_capacity(session.prepared().len());
    for prepared in session.prepared() {
        let (technique, bias) = &entries[prepared.entry];
        let answer = session.draw_and_ask(prepared)?;
        let ideal = truths.ideals.get(&kernel(technique.as_ref())).context("an ideal for every kernel")?;
        let spec = technique::spec(technique.as_ref());
        let row =
            row(spec, bias.to_string(), &answer, ideal, &truths.gaps).context("no pixel faces the light")?;
        rows.push(Row { invalid: prepared.invalid(), ..row });
        progress.share(rows.len() as f32 / session.prepared().len() as f32);
    }
    Ok(Study { rows, left_out })
}

/// What is right, whatever the bias.
struct Truths {
    /// As [`gaps`] returns them.
    gaps: Vec<f64>,
    /// The light-space ideal by width of its kernel.
    ideals: BTreeMap<u32, TruthImage>,
}

impl Truths {
    fn trace(
        session: &Session<'_>,
        techniques: &[Box<dyn Technique>],
        progress: &dyn Progress,
    ) -> Result<Self> {
        let (shot, views) = (session.shot(), session.views());
        let traced = TracedShot::new(shot)?;
        progress.step("truth: gaps");
        let gaps = gaps(&traced, &shot.map_views(views, shot.kernel)?);
        let mut ideals = BTreeMap::new();
        for width in techniques.iter().map(|technique| kernel(technique.as_ref())) {
            if let btree_map::Entry::Vacant(place) = ideals.entry(width) {
                progress.step(&format!("truth: kernel of {width}"));
                place.insert(traced.trace(Truth::LightSpace(width), views, progress)?);
            }
        }
        Ok(Self { gaps, ideals })
    }
}

/// Width of a technique's kernel.
fn kernel(technique: &dyn Technique) -> u32 {
    let mut technique = technique.clone_box();
    let parameters = technique.parameters();
    parameters.iter().find(|p| p.name == "kernel").and_then(|p| p.value().parse().ok()).unwrap_or(1)
}

/// How far each receiver lies behind the first surface that its light meets, in texels; 0 where that is
/// the receiver itself.
fn gaps(traced: &TracedShot<'_>, maps: &MapViews) -> Vec<f64> {
    let TracedShot { shot, tracer, rays } = traced;
    let bounds = tracer.geometry().bounds();
    let far = bounds.map_or(0.0, |b| 4.0 * f64::from(b.radius()));
    let gap = |hit: &Hit| {
        if !hit.is_hit() {
            return 0.0;
        }
        let (origin, direction) = match shot.light {
            Light::Directional { direction } => {
                let direction = direction.as_dvec3().normalize();
                (hit.position - far * direction, direction)
            }
            Light::Spot { position, .. } => {
                let apex: DVec3 = position.as_dvec3();
                (apex, (hit.position - apex).normalize())
            }
        };
        let first = tracer.trace(&Ray { origin, direction });
        let behind = (hit.position - first.position).dot(direction).max(0.0);
        if first.is_hit() { behind / maps.texel(hit.position) } else { 0.0 }
    };
    tracer.primary(rays).par_iter().map(gap).collect()
}

fn row(technique: String, bias: String, answer: &GrayImage, ideal: &TruthImage, gaps: &[f64]) -> Option<Row> {
    let mean = |sum: f64, count: u32| (count > 0).then(|| sum / f64::from(count));
    let (mut lit, mut acne, mut dark, mut all, mut squares) = (0, 0, 0.0, 0, 0.0);
    let mut bins = [(0, 0); (MAX_GAP_TEXELS / BIN_TEXELS) as usize];
    for (((v, ideal), shadowable), gap) in
        answer.values.iter().zip(&ideal.image.values).zip(&ideal.shadowable).zip(gaps)
    {
        if !shadowable {
            continue;
        }
        all += 1;
        squares += f64::from(v - ideal).powi(2);
        if *ideal >= 1.0 - ROUNDING {
            lit += 1;
            acne += u32::from(*v < LIT_THRESHOLD);
            dark += f64::from(1.0 - v);
        }
        if let Some(bin) = bins.get_mut((gap / BIN_TEXELS) as usize)
            && *ideal <= SHADOWED
        {
            bin.0 += u32::from(*v >= LIT_THRESHOLD);
            bin.1 += 1;
        }
    }
    Some(Row {
        technique,
        bias,
        acne: mean(acne.into(), lit).unwrap_or(0.0),
        detached_texels: detached(&bins),
        rmse: mean(squares, all)?.sqrt(),
        over_darkening: mean(dark, lit).unwrap_or(0.0),
        invalid: None,
    })
}

/// Integral of the share of lit pixels (lit, all) over the gap. Bins with too few pixels take the share
/// of their neighbour.
fn detached(bins: &[(u32, u32)]) -> Option<f64> {
    let share = |(lit, all): &(u32, u32)| (*all >= MIN_PIXELS).then(|| f64::from(*lit) / f64::from(*all));
    let mut last = bins.iter().find_map(share)?;
    Some(
        bins.iter()
            .map(|bin| {
                last = share(bin).unwrap_or(last);
                last * BIN_TEXELS
            })
            .sum(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_constant_bias_detaches_shadows_by_itself() {
        for bias in [0.0, 1.0, 3.0] {
            let lit = |bin: usize| (bin as f64 + 0.5) * BIN_TEXELS < bias;
            let bins: Vec<_> = (0..32).map(|bin| (if lit(bin) { 100 } else { 0 }, 100)).collect();
            assert!((detached(&bins).unwrap() - bias).abs() < 1e-9);
            // One bin that hardly anything is known of changes nothing.
            let mut sparse = bins;
            sparse[20] = (1, 1);
            assert!((detached(&sparse).unwrap() - bias).abs() < 1e-9);
        }
        assert_eq!(detached(&[(0, 3)]), None);
    }

    #[test]
    fn a_fixed_bias_competes_if_it_does_its_work() {
        let row = |technique: &str, bias: &str, acne, rmse| Row {
            technique: technique.into(),
            bias: bias.into(),
            acne,
            detached_texels: None,
            rmse,
            over_darkening: 0.0,
            invalid: None,
        };
        let rows = [
            row("hard", "none", 0.3, 0.1),
            row("hard", "auto", 0.0, 0.15),
            row("hard", "slope_texels=1", TOLERATED_ACNE, 0.2),
            row("hard", "slope_texels=2", 0.0, 0.3),
            row("pcf", "auto", 0.0, 0.1),
            row("pcf", "none", 0.5, 0.05),
            row("esm", "auto", 0.0, 0.1),
            row("vsm", "none", 0.0, 0.1),
        ];
        let [hard, pcf] = rank_biases(&rows).try_into().unwrap();
        assert_eq!((hard.auto, hard.best, hard.best_of_all), (&rows[1], Some(&rows[2]), &rows[0]));
        assert_eq!(hard.others, [&rows[0], &rows[2], &rows[3]]);
        assert_eq!((pcf.auto, pcf.best, pcf.best_of_all), (&rows[4], None, &rows[5]));
    }
}
