//! The table: every technique on every scene against ray-traced truth.

use crate::{
    bench::Bench,
    page::{Block, Column, Entry, Matrix, Page, Unit},
    study::{Look, Study, Truth},
    target::{Source, Target},
};
use antumbra::technique;
use antumbra_lab::{
    compare,
    metrics::Score,
    motion::Path,
    results::{Refused, TimeResult},
};
use antumbra_scene::procedural;
use anyhow::{Context, Result};

pub(crate) const SOURCE: Source = Source {
    key: "table",
    name: "The table",
    targets: &[Target {
        id: "table",
        title: "Every technique on every scene",
        paper: "Nobody has published one table that scores percentage-closer filtering, variance, convolution, \
                exponential, moment and sub-pixel shadow maps against ray-traced truth on common scenes.",
        ours: "All techniques with their default settings and a kernel of 5 texels, maps of 1024², pictures of 512×384 \
               pixels, on all built-in scenes (a quick run: on the smallest). Flicker: six frames of 256×192 pixels \
               with maps of 512², the first of 120 in which the camera turns 8° while the light turns 5°.",
        seconds: [700, 100],
        run,
    }],
};

const KERNEL: u32 = 5;
/// Frames of the path on which flicker is measured, and how many of them are.
const STEPS: [u32; 2] = [120, 6];
/// Pixels of those frames, and texels of their maps.
const SMALL: [u32; 2] = [256, 192];
const SMALL_MAP: u32 = 512;
/// A quick run leaves larger scenes out.
const QUICK_TRIANGLES: usize = 5_000;

/// What was measured of one technique on one scene.
#[derive(Debug, Clone, Copy)]
struct Measured<'a> {
    hard: &'a Score,
    light_space: &'a Score,
    screen_space: &'a Score,
    /// Flicker over that of the standard map, each against its own truth.
    flicker: Option<f64>,
    /// Frame time over that of the standard map.
    time: f64,
    bytes: u64,
}

/// A column: key, group, label, meaning, unit, whether higher is better, value.
type Quantity =
    (&'static str, &'static str, &'static str, &'static str, Unit, bool, fn(&Measured<'_>) -> Option<f64>);

const HARD: &str = "Hard truth";
const IDEAL: &str = "Light-space ideal";
const SMOOTH: &str = "Screen-space ideal";
const COST: &str = "Cost";
const TIME: &str = "time_ratio";
/// Errors that have a Pareto front against time.
const ERRORS: [&str; 3] = ["rmse_hard", "rmse_light_space", "rmse_screen_space"];

const QUANTITIES: &[Quantity] = &[
    (ERRORS[0], HARD, "RMSE", "Error to one shadow ray per pixel", Unit::Number, false, |m| {
        Some(m.hard.rmse)
    }),
    ("pixel_match", HARD, "Match", "Pixels with the same lit or shadowed answer", Unit::Share, true, |m| {
        Some(m.hard.pixel_match)
    }),
    ("acne", HARD, "Acne", "Fully lit pixels that are answered shadowed", Unit::Share, false, |m| {
        m.hard.acne
    }),
    (ERRORS[1], IDEAL, "RMSE", "Error to depth from rays behind the same kernel", Unit::Number, false, |m| {
        Some(m.light_space.rmse)
    }),
    ("leak", IDEAL, "Leak", "Mean visibility deep in shadow", Unit::Share, false, |m| m.light_space.leak),
    ("over_darkening", IDEAL, "Over-dark", "Mean 1 − visibility deep in light", Unit::Share, false, |m| {
        m.light_space.over_darkening
    }),
    (ERRORS[2], SMOOTH, "RMSE", "Error to 16 rays per pixel", Unit::Number, false, |m| {
        Some(m.screen_space.rmse)
    }),
    (
        "flicker",
        "Motion",
        "Flicker",
        "Change of the error from frame to frame over that of the standard map, each against what it promises",
        Unit::Times,
        false,
        |m| m.flicker,
    ),
    (TIME, COST, "Time", "Frame time over that of the standard map", Unit::Times, false, |m| Some(m.time)),
    ("bytes", COST, "Memory", "Textures and buffers that lookups need", Unit::Bytes, false, |m| {
        Some(m.bytes as f64)
    }),
];

fn run(bench: &Bench<'_>) -> Result<Page> {
    let techniques = compare::techniques(&["all".into()], KERNEL)?;
    let specs: Vec<String> = techniques.iter().map(|t| technique::spec(t.as_ref())).collect();
    let family = |spec: &str| -> String {
        let found = specs.iter().position(|s| s == spec);
        found.map_or(String::new(), |i| techniques[i].page().family.name().into())
    };
    let mut rows = Vec::new();
    let mut page = Page::default();
    let chosen = |p: &&procedural::Procedural| !bench.quick || p.triangles < QUICK_TRIANGLES;
    for scene in procedural::all().iter().filter(chosen) {
        let (shot, map) = (bench.shot(scene.name, [512, 384]), bench.map(1024));
        let specs: Vec<&str> = specs.iter().map(String::as_str).collect();
        let study = bench.possible(shot, map, &specs)?;
        for left_out in &study.left_out {
            page.text(format!("Left out on {}: {left_out}.", scene.name));
        }
        let values = scene_values(bench, &study)?;
        let entry = |(look, values): (&Look, Vec<Option<f64>>)| Entry {
            scene: scene.name.into(),
            technique: look.spec.clone(),
            title: look.title.clone(),
            family: family(&look.spec),
            values,
            leads: Vec::new(),
        };
        rows.extend(study.looks.iter().zip(values).map(entry));
    }
    let mut rows = [means(&rows), rows].concat();
    mark_fronts(&mut rows);
    let column = |q: &Quantity| Column {
        key: q.0.into(),
        group: q.1.into(),
        label: q.2.into(),
        meaning: q.3.into(),
        unit: q.4,
        higher: q.5,
    };
    let matrix = Matrix {
        caption: "Click a heading to sort. An error is underlined where it lies on the Pareto front of its scene: no \
                  other technique is both as fast and as close to that truth. The scene 'mean' averages all others."
            .into(),
        columns: QUANTITIES.iter().map(column).collect(),
        rows,
    };
    page.blocks.insert(0, Block::Matrix(matrix));
    Ok(page)
}

fn scene_values(bench: &Bench<'_>, study: &Study) -> Result<Vec<Vec<Option<f64>>>> {
    let specs: Vec<&str> = study.looks.iter().map(|look| look.spec.as_str()).collect();
    let truths = bench.truths(study, &[Truth::Hard, Truth::LightSpace(KERNEL), Truth::ScreenSpace(4)])?;
    let entrants: Vec<(u32, &str)> = specs.iter().map(|spec| (study.map, *spec)).collect();
    let times = bench.race(study.shot, &entrants, bench.rounds(3))?;
    let hard = specs.iter().position(|s| *s == "hard").context("the standard shadow map is missing")?;
    let small = bench.shot(study.shot.scene, SMALL);
    let moving = bench.moving(small, Path::Both, STEPS, bench.map(SMALL_MAP), &specs)?;
    let median = |time: &TimeResult| time.frame.median_ms;
    let mut all = Vec::new();
    for ((spec, look), time) in specs.iter().zip(&study.looks).zip(&times) {
        let mut scores = Vec::new();
        for truth in &truths {
            scores.push(bench.score(study, spec, truth, None)?);
        }
        let measured = Measured {
            hard: &scores[0],
            light_space: &scores[1],
            screen_space: &scores[2],
            flicker: possible(moving.technique(spec))?.and_then(|moved| moved.ratio_to_hard),
            time: median(time) / median(&times[hard]),
            bytes: look.memory.kept_bytes,
        };
        all.push(QUANTITIES.iter().map(|q| (q.6)(&measured).filter(|v| v.is_finite())).collect());
    }
    Ok(all)
}

/// Nothing where a technique was refused.
fn possible<T>(measured: Result<T>) -> Result<Option<T>> {
    match measured {
        Err(error) if error.is::<Refused>() => Ok(None),
        measured => measured.map(Some),
    }
}

/// A row for each technique with the means over its scenes.
fn means(rows: &[Entry]) -> Vec<Entry> {
    let mut means: Vec<Entry> = Vec::new();
    for row in rows {
        if means.iter().any(|m| m.technique == row.technique) {
            continue;
        }
        let mine = || rows.iter().filter(|r| r.technique == row.technique);
        let mean = |i: usize| {
            let values: Vec<f64> = mine().filter_map(|r| r.values[i]).collect();
            (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
        };
        let values = (0..row.values.len()).map(mean).collect();
        means.push(Entry { scene: "mean".into(), values, ..row.clone() });
    }
    means
}

/// Marks the errors that no other technique of the scene beats without being slower.
fn mark_fronts(rows: &mut [Entry]) {
    let index = |key: &str| QUANTITIES.iter().position(|q| q.0 == key);
    let Some(time) = index(TIME) else { return };
    for key in ERRORS {
        let Some(error) = index(key) else { continue };
        let point = |row: &Entry| row.values[time].zip(row.values[error]);
        let points: Vec<_> = rows.iter().map(|r| (r.scene.clone(), point(r))).collect();
        for (row, (scene, own)) in rows.iter_mut().zip(&points) {
            let Some((t, e)) = *own else { continue };
            let beaten = points.iter().any(|(other, p)| {
                let better = p.is_some_and(|(pt, pe)| pt <= t && pe <= e && (pt < t || pe < e));
                other == scene && better
            });
            if !beaten {
                row.leads.push(key.into());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(scene: &str, technique: &str, time: f64, error: f64) -> Entry {
        let value = |q: &Quantity| match q.0 {
            TIME => Some(time),
            key if ERRORS.contains(&key) => Some(error),
            _ => None,
        };
        Entry {
            scene: scene.into(),
            technique: technique.into(),
            title: technique.into(),
            family: "basis".into(),
            values: QUANTITIES.iter().map(value).collect(),
            leads: Vec::new(),
        }
    }

    #[test]
    fn a_front_is_what_nothing_beats_on_the_same_scene() {
        let mut rows = [
            row("a", "fast", 1.0, 0.3),
            row("a", "close", 3.0, 0.1),
            row("a", "neither", 3.0, 0.2),
            row("b", "neither", 5.0, 0.5),
        ];
        mark_fronts(&mut rows);
        assert_eq!(rows.map(|r| r.leads.len()), [3, 3, 0, 3]);
    }

    #[test]
    fn means_are_over_the_scenes_that_have_a_value() {
        let mut rows = [row("a", "x", 1.0, 0.2), row("b", "x", 3.0, 0.4), row("b", "y", 1.0, 1.0)];
        rows[0].values[0] = None;
        let means = means(&rows);
        assert_eq!(means.len(), 2);
        assert_eq!((means[0].scene.as_str(), means[0].values[0]), ("mean", Some(0.4)));
        let time = QUANTITIES.iter().position(|q| q.0 == TIME);
        assert_eq!(time.and_then(|t| means[0].values[t]), Some(2.0));
    }
}
