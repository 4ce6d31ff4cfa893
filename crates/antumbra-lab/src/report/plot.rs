//! Error against cost as scatter plots, in SVG that needs no script.

use super::column::{HARD, LIGHT_SPACE, SCREEN_SPACE};
use super::table::family;
use super::text::{bytes, escape, milliseconds, significant};
use crate::axis::Axis;
use crate::metrics::Score;
use crate::results::{Results, TechniqueResult};

/// Size and margins of the view box, in its units; the plotting area is what the margins leave.
const SIZE: [f64; 2] = [480.0, 340.0];
const LEFT: f64 = 52.0;
const RIGHT: f64 = 14.0;
const TOP: f64 = 12.0;
const BOTTOM: f64 = 44.0;
/// Width of a letter of the labels and height of a line, generous.
const LETTER: [f64; 2] = [6.4, 12.0];

/// What is on the horizontal axis.
#[derive(Clone, Copy)]
struct Cost {
    label: &'static str,
    value: fn(&TechniqueResult) -> f64,
    /// Fastest and slowest where the cost varies.
    range: Option<fn(&TechniqueResult) -> [f64; 2]>,
    format: fn(f64) -> String,
    scale: f64,
}

/// What the error is against.
#[derive(Clone, Copy)]
struct Truth {
    key: &'static str,
    label: &'static str,
    score: fn(&TechniqueResult) -> &Score,
}

struct Point<'a> {
    technique: &'a TechniqueResult,
    cost: f64,
    error: f64,
    /// On the Pareto front: nothing is both cheaper and closer.
    leads: bool,
}

/// Two plots for each truth; the page shows one truth at a time.
pub(super) fn section(results: &Results) -> String {
    let truths = [
        Truth { key: "light_space", label: LIGHT_SPACE, score: |t| &t.scores.light_space },
        Truth { key: "hard", label: HARD, score: |t| &t.scores.hard },
        Truth { key: "screen_space", label: SCREEN_SPACE, score: |t| &t.scores.screen_space },
    ];
    let time = Cost {
        label: "frame time, ms",
        value: |t| t.time.frame.median_ms,
        range: Some(|t| [t.time.frame.min_ms, t.time.frame.max_ms]),
        format: milliseconds,
        scale: 1.0,
    };
    let memory = Cost {
        label: "kept memory, MiB",
        value: |t| t.memory.kept_bytes as f64,
        range: None,
        format: bytes,
        scale: 1.0 / 1_048_576.0,
    };
    let group = |truth: Truth| {
        let hidden = if truth.key == "light_space" { "" } else { " hidden" };
        format!(
            "<div class=\"plots\" data-truth=\"{}\"{hidden}>{}{}</div>\n",
            truth.key,
            figure(results, truth, time),
            figure(results, truth, memory)
        )
    };
    truths.map(group).concat()
}

fn figure(results: &Results, truth: Truth, cost: Cost) -> String {
    let points = points(results, truth, cost);
    let title = format!("RMSE to the {} against {}", truth.label.to_lowercase(), cost.label);
    let leaders: Vec<&str> = points.iter().filter(|p| p.leads).map(|p| p.technique.title.as_str()).collect();
    let described = format!("{title}. On the Pareto front: {}.", leaders.join(", "));
    format!(
        "<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">{}</svg><figcaption>{}</figcaption></figure>",
        SIZE[0],
        SIZE[1],
        escape(&described),
        drawing(&points, cost),
        escape(&title)
    )
}

fn points(results: &Results, truth: Truth, cost: Cost) -> Vec<Point<'_>> {
    let place = |t: &TechniqueResult| ((cost.value)(t) * cost.scale, (truth.score)(t).rmse);
    let dominated = |t: &TechniqueResult| {
        let (x, y) = place(t);
        let beats = |(a, b): (f64, f64)| a <= x && b <= y && (a < x || b < y);
        results.valid().any(|other| beats(place(other)))
    };
    let point = |technique| {
        let (cost, error) = place(technique);
        Point { technique, cost, error, leads: !dominated(technique) }
    };
    results.valid().map(point).collect()
}

fn drawing(points: &[Point<'_>], cost: Cost) -> String {
    let ranges = points.iter().flat_map(|p| match cost.range {
        Some(range) => range(p.technique).map(|v| v * cost.scale).to_vec(),
        None => vec![p.cost],
    });
    let x = Axis::new(ranges.collect(), [LEFT, SIZE[0] - RIGHT]);
    let y = Axis::new(points.iter().map(|p| p.error).collect(), [SIZE[1] - BOTTOM, TOP]);
    let mut svg = grid(&x, &y, cost);
    svg.push_str(&front(points, &x, &y));
    let places: Vec<[f64; 2]> = points.iter().map(|p| [x.place(p.cost), y.place(p.error)]).collect();
    for (point, &[px, py]) in points.iter().zip(&places) {
        if let Some(range) = cost.range {
            let [from, to] = range(point.technique).map(|v| x.place(v * cost.scale));
            svg.push_str(&format!("<path class=\"spread\" d=\"M{from:.1} {py:.1}H{to:.1}\"/>"));
        }
        svg.push_str(&mark(point, px, py, cost));
    }
    svg + &labels(points, &places)
}

fn grid(x: &Axis, y: &Axis, cost: Cost) -> String {
    let mut svg = String::new();
    let (right, bottom) = (SIZE[0] - RIGHT, SIZE[1] - BOTTOM);
    for (at, text) in x.ticks() {
        svg.push_str(&format!(
            "<path class=\"grid\" d=\"M{at:.1} {TOP}V{bottom}\"/><text class=\"tick\" x=\"{at:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{text}</text>",
            bottom + 16.0
        ));
    }
    for (at, text) in y.ticks() {
        svg.push_str(&format!(
            "<path class=\"grid\" d=\"M{LEFT} {at:.1}H{right}\"/><text class=\"tick\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{text}</text>",
            LEFT - 7.0,
            at + 4.0
        ));
    }
    let log = |axis: &Axis| if axis.is_log() { " (log)" } else { "" };
    let middle = (TOP + bottom) / 2.0;
    svg + &format!(
        "<path class=\"axis\" d=\"M{LEFT} {TOP}V{bottom}H{right}\"/>\
         <text class=\"title\" x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"middle\">{}{}</text>\
         <text class=\"title\" transform=\"translate(12 {middle:.1}) rotate(-90)\" text-anchor=\"middle\">RMSE{}</text>",
        (LEFT + right) / 2.0,
        SIZE[1] - 8.0,
        cost.label,
        log(x),
        log(y)
    )
}

/// The staircase below which nothing was found.
fn front(points: &[Point<'_>], x: &Axis, y: &Axis) -> String {
    let mut leaders: Vec<&Point<'_>> = points.iter().filter(|p| p.leads).collect();
    leaders.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    let Some(first) = leaders.first() else {
        return String::new();
    };
    let mut path = format!("M{:.1} {TOP}", x.place(first.cost));
    for leader in leaders {
        path.push_str(&format!("H{:.1}V{:.1}", x.place(leader.cost), y.place(leader.error)));
    }
    format!("<path class=\"front\" d=\"{path}H{}\"/>", SIZE[0] - RIGHT)
}

/// A circle, square or triangle by family, filled on the front.
fn mark(point: &Point<'_>, x: f64, y: f64, cost: Cost) -> String {
    let (_, class) = family(point.technique.family);
    let shape = match class {
        "comparison" => format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"5\"/>"),
        "basis" => format!("<rect x=\"{:.1}\" y=\"{:.1}\" width=\"9\" height=\"9\"/>", x - 4.5, y - 4.5),
        _ => format!("<path d=\"M{x:.1} {:.1}l5.6 9.6h-11.2z\"/>", y - 6.0),
    };
    let tip = format!(
        "{} — {}: RMSE {}, {}",
        point.technique.title,
        point.technique.spec,
        significant(point.error),
        (cost.format)(point.cost / cost.scale)
    );
    let leads = if point.leads { " leads" } else { "" };
    format!(
        "<g class=\"point {class}{leads}\" tabindex=\"0\" role=\"img\" aria-label=\"{0}\" data-tip=\"{0}\">{shape}</g>",
        escape(&tip)
    )
}

/// Names beside their points, each at the first of eight places where it covers no point and no
/// earlier name; the point's tip still tells a name that finds no place.
fn labels(points: &[Point<'_>], places: &[[f64; 2]]) -> String {
    let mut taken: Vec<[f64; 4]> =
        places.iter().map(|&[x, y]| [x - 6.0, y - 6.0, x + 6.0, y + 6.0]).collect();
    let overlap = |a: &[f64; 4], b: &[f64; 4]| a[0] < b[2] && b[0] < a[2] && a[1] < b[3] && b[1] < a[3];
    let mut svg = String::new();
    for (point, &[x, y]) in points.iter().zip(places) {
        let name = unique_name(points, point.technique);
        let (w, h) = (name.chars().count() as f64 * LETTER[0], LETTER[1]);
        let offsets = [
            [9.0, -h / 2.0],
            [-9.0 - w, -h / 2.0],
            [-w / 2.0, -9.0 - h],
            [-w / 2.0, 8.0],
            [7.0, -7.0 - h],
            [7.0, 6.0],
            [-7.0 - w, -7.0 - h],
            [-7.0 - w, 6.0],
        ];
        let boxes = offsets.map(|[dx, dy]| [x + dx, y + dy, x + dx + w, y + dy + h]);
        let fits = |b: &&[f64; 4]| {
            let inside = b[0] > LEFT && b[2] < SIZE[0] && b[1] > 0.0 && b[3] < SIZE[1] - BOTTOM;
            inside && !taken.iter().any(|other| overlap(b, other))
        };
        if let Some(&place) = boxes.iter().find(fits) {
            let [left, _, _, bottom] = place;
            svg.push_str(&format!(
                "<text class=\"label\" x=\"{left:.1}\" y=\"{:.1}\">{}</text>",
                bottom - 2.5,
                escape(name)
            ));
            taken.push(place);
        }
    }
    svg
}

/// The short name, or the whole specification where several techniques share the name.
fn unique_name<'a>(points: &[Point<'_>], technique: &'a TechniqueResult) -> &'a str {
    let same = points.iter().filter(|p| p.technique.name == technique.name).count();
    if same > 1 { &technique.spec } else { &technique.name }
}
