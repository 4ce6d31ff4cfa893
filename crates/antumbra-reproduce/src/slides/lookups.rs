//! What lookups give and cost: bicubic, layered variance, summed-area tables.

use crate::{
    gallery,
    numbers::Measured,
    page::{Block, Cell, Page, Table, Unit},
    stored_image::difference,
    study::Timed,
    verdict::{Ran, Verdict, at_least, at_most, less, slides},
    workbench::Workbench,
};
use antumbra::technique::bicubic::reference::spline;
use antumbra_lab::chart::{Curve, Panel};
use antumbra_lab::truth::Truth;
use anyhow::Result;

const SHOWN: [(&str, &str); 4] = [
    ("hard", "standard map"),
    ("pcf.kernel=3,weights=box,taps=nearest", "PCF 3×3"),
    ("pcf.kernel=1", "one bilinear lookup"),
    ("bicubic", "bicubic, four bilinear lookups"),
];
/// Texels to each side of the edge.
const REACH: i16 = 3;

pub(super) fn bicubic(bench: &Workbench<'_>) -> Result<Page> {
    // Not the texels' borders, where nearest lookups could go either way.
    let positions: Vec<f32> = (-40 * REACH..40 * REACH).map(|i| (f32::from(i) + 0.5) / 40.0).collect();
    let mut curves = Vec::new();
    let mut largest = None;
    for (spec, name) in SHOWN {
        let answers = bench.edge(spec, 0.75, &positions)?;
        let points: Vec<[f64; 2]> =
            positions.iter().zip(&answers).map(|(x, v)| [f64::from(*x), f64::from(*v)]).collect();
        if spec == "bicubic" {
            largest = points.iter().map(|[x, v]| (v - convolution(*x)).abs()).reduce(f64::max);
        }
        curves.push(Curve { name: name.into(), points });
    }
    let exact = positions.iter().map(|x| [f64::from(*x), convolution(f64::from(*x))]).collect();
    curves.push(Curve { name: "exact convolution with the cubic B-spline".into(), points: exact });
    let reach = f64::from(REACH);
    let panel = Panel {
        curves,
        x: [-reach, reach],
        y: [-0.05, 1.05],
        x_label: "texels from the caster's edge".into(),
        y_label: "visibility, 0 in shadow, 1 lit".into(),
    };
    let mut page = Page::default();
    page.verdict(exactly(largest));
    page.blocks.push(Block::Plot(vec![panel], "A caster covers the texels on the left.".into()));
    Ok(page)
}

/// Texels on the right of 0 are lit: the sum of their B-splines at `x`.
fn convolution(x: f64) -> f64 {
    // The spline reaches two texels.
    (0..2 * i32::from(REACH) + 2).map(|texel| spline(x - f64::from(texel) - 0.5)).sum()
}

fn exactly(largest: Option<f64>) -> Verdict {
    Verdict::new(
        slides("PCF + bilinear lookups", "Exact bicubic convolution using 2x2 bilinear lookups"),
        "Four bilinear lookups give the exact bicubic convolution",
        Ran::new("the straight edge of a caster", ["bicubic"]),
        [at_most(
            "largest difference in visibility",
            largest,
            "a 256th, what filtering hardware resolves",
            1.0 / 256.0,
        )
        .ours("bilinear weights have 8 bits on cards")],
    )
}

const LAYERS: [(&str, &str); 4] = [
    ("vsm.kernel=5,sampling=trilinear", "VSM"),
    ("lvsm.kernel=5,intervals=2,sampling=trilinear", "2 intervals"),
    ("lvsm.kernel=5,sampling=trilinear", "4 intervals"),
    ("lvsm.kernel=5,intervals=8,sampling=trilinear", "8 intervals"),
];

pub(super) fn vsm_layers(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("layers", [640, 480]), bench.map(1024), &LAYERS.map(|l| l.0))?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
    let mut table = Table::new(
        "Leak: mean visibility deep in shadow. Memory with mip levels.",
        &["technique", "leak", "RMSE to the ideal of 5×5", "memory"],
    );
    let (mut leaks, mut pictures) = (Vec::new(), Vec::new());
    for (spec, name) in LAYERS {
        let score = bench.score(&study, spec, ideal, None)?;
        let look = study.look(spec)?;
        let bytes = look.memory.kept_bytes as f64;
        let cells = [(score.leak, Unit::Share), (Some(score.rmse), Unit::Number), (Some(bytes), Unit::Bytes)];
        table.row(name, cells.map(|(v, unit)| Cell::ours(v, unit)).into());
        leaks.push(score.leak);
        pictures.push((name, &look.picture));
    }
    pictures.push(("rays, filtered 5×5 in light space", &ideal.picture));
    let mut page = Page::default();
    page.verdict(alleviated(leaks[0], leaks[2], leaks[3]));
    let window = gallery::window(&difference(pictures[0].1, &ideal.picture), pictures[0].1, 4);
    let captions = ["The scene.", "Enlarged: where the VSM looks most wrong."];
    gallery::rows(&mut page, captions, 5, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn alleviated(vsm: Option<f64>, four: Option<f64>, eight: Option<f64>) -> Verdict {
    Verdict::new(
        slides("Variance shadow maps", "“Layer” several VSM to alleviate these problems"),
        "Layers alleviate the light bleeding of VSM",
        Ran::new("layers, 640×480, 1024²", LAYERS.map(|l| l.0)),
        [
            less("leak with 4 intervals", four, "that of the VSM", vsm).sentence(),
            less("leak with 8 intervals", eight, "half of that of the VSM", vsm.map(|v| 0.5 * v))
                .ours("what is alleviated by eight layers is less than half of what it was"),
        ],
    )
}

const BOXES: [u32; 4] = [3, 7, 15, 63];
const KERNELS: [u32; 4] = [2, 4, 8, 16];

pub(super) fn sat(bench: &Workbench<'_>) -> Result<Page> {
    let summed = BOXES.map(|k| format!("vsm.sampling=summed,kernel={k}"));
    let pcf = KERNELS.map(|k| format!("pcf.kernel={k},weights=box,taps=nearest"));
    let map = bench.map(1024);
    let frames: Vec<(u32, &str)> = std::iter::once("none")
        .chain(summed.iter().chain(&pcf).map(String::as_str))
        .map(|s| (map, s))
        .collect();
    let times = bench.times(bench.shot("spheres", [640, 480]), &frames, bench.rounds())?;
    let (none, times) = times.split_at(1);
    let own: Vec<Vec<f64>> = times.iter().map(|t| beyond(t, &none[0])).collect();
    let (table_times, pcf_times) = own.split_at(BOXES.len());
    let mut table = Table::new(
        "Time of the lookup pass, less that of a pass without any lookup.",
        &["technique", "time", "over the smallest kernel"],
    );
    for (specs, times) in [(&summed, table_times), (&pcf, pcf_times)] {
        for (spec, time) in specs.iter().zip(times) {
            let ratio = Measured::ratio(time, &times[0]).value;
            let ms = Measured::median(time).value;
            table
                .row(spec.as_str(), vec![Cell::ours(ms, Unit::Milliseconds), Cell::ours(ratio, Unit::Times)]);
        }
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(constant(table_times));
    page.verdict(quadratic(pcf_times));
    Ok(page)
}

/// What each lookup took longer than shading without any in the same round; whole frames where passes
/// cannot be timed.
fn beyond(time: &Timed, none: &Timed) -> Vec<f64> {
    let of = |t: &Timed| if t.lookups.is_empty() { t.frames.clone() } else { t.lookups.clone() };
    of(time).iter().zip(of(none)).map(|(all, less)| all - less).collect()
}

/// From the smallest to the largest.
fn growth(times: &[Vec<f64>]) -> Option<Measured> {
    times.first().zip(times.last()).map(|(first, last)| Measured::ratio(last, first))
}

const SAT: &str = "spheres, 640×480, 1024²";

/// Times for boxes of 3×3 to 63×63, by rounds.
fn constant(times: &[Vec<f64>]) -> Verdict {
    let growth = growth(times);
    Verdict::new(
        slides("Efficient filtering with summed-area tables", "Summing arbitrary rectangles is O(1)!"),
        "With a summed-area table the cost of a lookup does not depend on the rectangle",
        Ran::new(&format!("{SAT}, boxes of 3 to 63"), ["vsm.sampling=summed"]),
        [at_most(
            "lookup of 63×63 over that of 3×3, 441 times the area",
            growth,
            "1.25, what caches lose",
            1.25,
        )
        .ours("constant work on loads that lie farther apart")],
    )
}

/// Times for kernels of 2×2 to 16×16, by rounds.
fn quadratic(times: &[Vec<f64>]) -> Verdict {
    let growth = growth(times);
    Verdict::new(
        slides("Percentage closer filtering", "Big kernel size is slow (quadratic growth)"),
        "PCF grows with the area of its kernel",
        Ran::new(&format!("{SAT}, kernels of 2 to 16"), ["pcf.weights=box,taps=nearest"]),
        [at_least("lookup of 16×16 over that of 2×2, 64 times the area", growth, "16", 16.0)
            .ours("a quarter of 64, for what a lookup costs whatever its kernel")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(exactly(Some(1e-6)).outcome(), Holds);
        assert_eq!(exactly(Some(0.01)).outcome(), Differs);
        assert_eq!(alleviated(Some(0.2), Some(0.1), Some(0.05)).outcome(), Holds);
        assert_eq!(alleviated(Some(0.2), Some(0.3), Some(0.05)).outcome(), Differs);
        assert_eq!(alleviated(Some(0.2), Some(0.1), Some(0.15)).outcome(), Differs);
        let same = |times: [f64; 3]| times.map(|ms| vec![ms; 9]);
        assert_eq!(constant(&same([1.0, 1.0, 1.1])).outcome(), Holds);
        assert_eq!(constant(&same([1.0, 1.5, 2.0])).outcome(), Differs);
        assert_eq!(quadratic(&same([1.0, 4.0, 60.0])).outcome(), Holds);
        assert_eq!(quadratic(&same([1.0, 1.0, 2.0])).outcome(), Differs);
        let round = |ms: [f64; 2]| Timed { frames: vec![9.0; 2], lookups: ms.into() };
        assert_eq!(beyond(&round([3.0, 4.0]), &round([1.0, 1.0])), [2.0, 3.0]);
    }

    #[test]
    fn the_convolution_of_an_edge_is_smooth_and_symmetric() {
        assert!((convolution(0.0) - 0.5).abs() < 1e-12);
        assert!(convolution(-2.6).abs() < 1e-12 && (convolution(2.6) - 1.0).abs() < 1e-12);
        assert!((convolution(0.7) + convolution(-0.7) - 1.0).abs() < 1e-12);
    }
}
