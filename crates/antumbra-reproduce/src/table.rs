//! The table: every technique on every scene against ray-traced truth.

use crate::{
    page::{Block, Column, Entry, Matrix, Page, Unit},
    study::{Look, Study},
    target::{Source, Target},
    workbench::Workbench,
};
use antumbra::technique;
use antumbra_lab::truth::Truth;
use antumbra_lab::{metrics::Score, motion::Path, results::Refused, specs};
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
/// Frames of each technique that are timed; no verdict rests on them.
const ROUNDS: u32 = 3;

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

/// One column of the table.
struct Quantity {
    key: &'static str,
    group: &'static str,
    label: &'static str,
    meaning: &'static str,
    unit: Unit,
    /// Whether higher is better.
    higher: bool,
    value: fn(&Measured<'_>) -> Option<f64>,
}

const HARD: &str = "Hard truth";
const IDEAL: &str = "Light-space ideal";
const SMOOTH: &str = "Screen-space ideal";
const COST: &str = "Cost";
const TIME: &str = "time_ratio";
/// Errors that have a Pareto front against time.
const ERRORS: [&str; 3] = ["rmse_hard", "rmse_light_space", "rmse_screen_space"];

const QUANTITIES: &[Quantity] = &[
    Quantity {
        key: ERRORS[0],
        group: HARD,
        label: "RMSE",
        meaning: "Error to one shadow ray per pixel",
        unit: Unit::Number,
        higher: false,
        value: |m| Some(m.hard.rmse),
    },
    Quantity {
        key: "pixel_match",
        group: HARD,
        label: "Match",
        meaning: "Pixels with the same lit or shadowed answer",
        unit: Unit::Share,
        higher: true,
        value: |m| Some(m.hard.pixel_match),
    },
    Quantity {
        key: "acne",
        group: HARD,
        label: "Acne",
        meaning: "Fully lit pixels that are answered shadowed",
        unit: Unit::Share,
        higher: false,
        value: |m| m.hard.acne,
    },
    Quantity {
        key: ERRORS[1],
        group: IDEAL,
        label: "RMSE",
        meaning: "Error to depth from rays behind the same kernel",
        unit: Unit::Number,
        higher: false,
        value: |m| Some(m.light_space.rmse),
    },
    Quantity {
        key: "leak",
        group: IDEAL,
        label: "Leak",
        meaning: "Mean visibility deep in shadow",
        unit: Unit::Share,
        higher: false,
        value: |m| m.light_space.leak,
    },
    Quantity {
        key: "over_darkening",
        group: IDEAL,
        label: "Over-dark",
        meaning: "Mean 1 − visibility deep in light",
        unit: Unit::Share,
        higher: false,
        value: |m| m.light_space.over_darkening,
    },
    Quantity {
        key: ERRORS[2],
        group: SMOOTH,
        label: "RMSE",
        meaning: "Error to 16 rays per pixel",
        unit: Unit::Number,
        higher: false,
        value: |m| Some(m.screen_space.rmse),
    },
    Quantity {
        key: "flicker",
        group: "Motion",
        label: "Flicker",
        meaning: "Change of the error from frame to frame over that of the standard map, each against what it promises",
        unit: Unit::Times,
        higher: false,
        value: |m| m.flicker,
    },
    Quantity {
        key: TIME,
        group: COST,
        label: "Time",
        meaning: "Frame time over that of the standard map",
        unit: Unit::Times,
        higher: false,
        value: |m| Some(m.time),
    },
    Quantity {
        key: "bytes",
        group: COST,
        label: "Memory",
        meaning: "Textures and buffers that lookups need",
        unit: Unit::Bytes,
        higher: false,
        value: |m| Some(m.bytes as f64),
    },
];

fn run(bench: &Workbench<'_>) -> Result<Page> {
    let techniques = specs::techniques(&["all".into()], KERNEL)?;
    let specs: Vec<String> = techniques.iter().map(|t| technique::spec(t.as_ref())).collect();
    let family = |spec: &str| -> String {
        let found = specs.iter().position(|s| s == spec);
        found.map_or(String::new(), |i| techniques[i].about().family.name().into())
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
            on_front: Vec::new(),
        };
        rows.extend(study.looks.iter().zip(values).map(entry));
    }
    let mut rows = [means(&rows), rows].concat();
    mark_fronts(&mut rows);
    let column = |q: &Quantity| Column {
        key: q.key.into(),
        group: q.group.into(),
        label: q.label.into(),
        meaning: q.meaning.into(),
        unit: q.unit,
        higher: q.higher,
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

fn scene_values(bench: &Workbench<'_>, study: &Study) -> Result<Vec<Vec<Option<f64>>>> {
    let specs: Vec<&str> = study.looks.iter().map(|look| look.spec.as_str()).collect();
    let truths = bench.truths(study, &[Truth::Hard, Truth::LightSpace(KERNEL), Truth::ScreenSpace(4)])?;
    let frames: Vec<(u32, &str)> = specs.iter().map(|spec| (study.map, *spec)).collect();
    let times = bench.times(study.shot, &frames, if bench.quick { 1 } else { ROUNDS })?;
    let hard = specs.iter().position(|s| *s == "hard").context("the standard shadow map is missing")?;
    let small = bench.shot(study.shot.scene, SMALL);
    let moving = bench.moving(small, Path::Both, STEPS, bench.map(SMALL_MAP), &specs)?;
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
            time: time.over(&times[hard]).value,
            bytes: look.memory.kept_bytes,
        };
        all.push(QUANTITIES.iter().map(|q| (q.value)(&measured).filter(|v| v.is_finite())).collect());
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
    let index = |key: &str| QUANTITIES.iter().position(|q| q.key == key);
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
                row.on_front.push(key.into());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(scene: &str, technique: &str, time: f64, error: f64) -> Entry {
        let value = |q: &Quantity| match q.key {
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
            on_front: Vec::new(),
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
        assert_eq!(rows.map(|r| r.on_front.len()), [3, 3, 0, 3]);
    }

    #[test]
    fn means_are_over_the_scenes_that_have_a_value() {
        let mut rows = [row("a", "x", 1.0, 0.2), row("b", "x", 3.0, 0.4), row("b", "y", 1.0, 1.0)];
        rows[0].values[0] = None;
        let means = means(&rows);
        assert_eq!(means.len(), 2);
        assert_eq!((means[0].scene.as_str(), means[0].values[0]), ("mean", Some(0.4)));
        let time = QUANTITIES.iter().position(|q| q.key == TIME);
        assert_eq!(time.and_then(|t| means[0].values[t]), Some(2.0));
    }
}
