//! The score table and the table of named regions.

use super::column::{self, Better, Column};
use super::text::{escape, percent, significant};
use crate::classes::ClassShare;
use crate::metrics::{MIN_DEEP_PIXELS, Score};
use crate::results::{Family, LeftOut, Results, TechniqueResult};
use std::collections::BTreeSet;

/// Name of a family for people and for CSS.
pub(super) fn family(family: Family) -> (&'static str, &'static str) {
    match family {
        Family::Comparison => ("Comparison", "comparison"),
        Family::Basis => ("Linear basis", "basis"),
        Family::Geometry => ("Geometry", "geometry"),
    }
}

/// The first cell of a technique's row.
pub(super) fn row_head(technique: &TechniqueResult) -> String {
    let (name, class) = family(technique.family);
    format!(
        "<th scope=\"row\" data-value=\"{title}\"><span class=\"mark {class}\" role=\"img\" aria-label=\"{name}\"></span>\
         <span class=\"name\">{title}</span><code>{spec}</code></th>",
        title = escape(&technique.title),
        spec = escape(&technique.spec),
    )
}

/// Techniques by columns, family by family.
pub(super) fn scores(results: &Results) -> String {
    let columns = column::all();
    let best: Vec<Option<f64>> = columns.iter().map(|column| best_of(results, column)).collect();
    let row = |t: &TechniqueResult| {
        let cells: String = match &t.invalid {
            Some(why) => across(&columns, &format!("invalid: {why}")),
            None => columns.iter().zip(&best).map(|(column, best)| cell(column, t, *best)).collect(),
        };
        format!("<tr>{}{cells}</tr>\n", row_head(t))
    };
    let bodies: String = results
        .families()
        .into_iter()
        .map(|(of, members)| {
            let rows: String = members.into_iter().map(row).collect();
            let (name, count) = (family(of).0, columns.len());
            format!(
                "<tbody><tr class=\"family\"><th scope=\"rowgroup\">{name}</th><td colspan=\"{count}\"></td></tr>\n{rows}</tbody>"
            )
        })
        .collect();
    format!(
        "<table class=\"scores sortable\"><caption class=\"unseen\">Scores, time and memory of every technique</caption>\n\
         <thead>{}</thead>\n{bodies}{}\n<tfoot>{}</tfoot></table>",
        head(&columns),
        left_out(results, &columns),
        baseline(&columns, &results.truth.no_shadow)
    )
}

/// A cell across all columns.
fn across(columns: &[Column], text: &str) -> String {
    format!("<td class=\"starts across\" colspan=\"{}\">{}</td>", columns.len(), escape(text))
}

/// Techniques that were refused, with the reasons; nothing if there are none.
fn left_out(results: &Results, columns: &[Column]) -> String {
    if results.left_out.is_empty() {
        return String::new();
    }
    let row = |left_out: &LeftOut| {
        let (spec, why) = (escape(&left_out.spec), across(columns, &left_out.reason));
        format!("<tr><th scope=\"row\" data-value=\"{spec}\"><code>{spec}</code></th>{why}</tr>\n")
    };
    let rows: String = results.left_out.iter().map(row).collect();
    format!(
        "<tbody><tr class=\"family\"><th scope=\"rowgroup\">Left out</th><td colspan=\"{}\"></td></tr>\n{rows}</tbody>",
        columns.len()
    )
}

fn head(columns: &[Column]) -> String {
    let mut groups: Vec<(&str, usize)> = Vec::new();
    for column in columns {
        match groups.last_mut() {
            Some((name, span)) if *name == column.group => *span += 1,
            _ => groups.push((column.group, 1)),
        }
    }
    let groups: String = groups
        .iter()
        .map(|(name, span)| {
            format!("<th scope=\"colgroup\" colspan=\"{span}\" class=\"starts\">{}</th>", escape(name))
        })
        .collect();
    let mut last = "";
    let labels: String = columns
        .iter()
        .map(|column| {
            let starts = if column.group == last { "" } else { " class=\"starts\"" };
            last = column.group;
            let first = if column.better == Better::Higher { "descending" } else { "ascending" };
            format!(
                "<th scope=\"col\"{starts}><button type=\"button\" data-first=\"{first}\" data-tip=\"{}\">{}</button></th>",
                escape(column.meaning),
                escape(column.label)
            )
        })
        .collect();
    format!(
        "<tr><th rowspan=\"2\" scope=\"col\"><button type=\"button\" data-first=\"ascending\" \
         data-tip=\"Title and specification\">Technique</button></th>{groups}</tr>\n<tr>{labels}</tr>"
    )
}

/// A best value is worth a mark only if another is worse.
fn best_of(results: &Results, column: &Column) -> Option<f64> {
    let values = || results.valid().filter_map(column.value);
    let (low, high) = (values().reduce(f64::min)?, values().reduce(f64::max)?);
    let best = if column.better == Better::Higher { high } else { low };
    (low < high).then_some(best)
}

fn cell(column: &Column, technique: &TechniqueResult, best: Option<f64>) -> String {
    let starts = if starts_group(column) { " starts" } else { "" };
    let Some(value) = (column.value)(technique) else {
        return match column.pixels {
            Some(pixels) => format!("<td class=\"none{starts}\">{}</td>", too_few(pixels(technique))),
            None => format!("<td class=\"none{starts}\"><span aria-label=\"none\">–</span></td>"),
        };
    };
    let shown = (column.format)(value);
    // What is printed alike is equally good.
    let is_best = best.is_some_and(|best| (column.format)(best) == shown);
    if is_best {
        format!("<td class=\"best{starts}\" data-value=\"{value}\"><strong>{shown}</strong></td>")
    } else {
        format!("<td class=\"{}\" data-value=\"{value}\">{shown}</td>", starts.trim())
    }
}

/// Number of pixels, in place of a mean over too few.
fn too_few(pixels: u64) -> String {
    format!(
        "<span title=\"only {pixels} pixels; told from {MIN_DEEP_PIXELS} on\">– <small>({pixels})</small></span>"
    )
}

fn starts_group(column: &Column) -> bool {
    let columns = column::all();
    let first = columns.iter().find(|other| other.group == column.group);
    first.is_some_and(|first| first.label == column.label)
}

/// What drawing no shadow scores, in the columns of the hard truth.
fn baseline(columns: &[Column], score: &Score) -> String {
    let cells: String = columns
        .iter()
        .map(|column| {
            let value = match (column.group, column.label) {
                (column::HARD, "Match %") => Some(score.pixel_match),
                (column::HARD, "Edges %") => score.pixel_match_near_edges,
                (column::HARD, "RMSE") => Some(score.rmse),
                (column::HARD, "Acne %") => score.acne,
                (column::HARD, "Leak") => score.leak,
                _ => None,
            };
            let starts = if starts_group(column) { " class=\"starts\"" } else { "" };
            let shown = match (column.group, column.label, value) {
                (column::HARD, "Leak", None) => too_few(score.deep_shadow_pixels),
                _ => value.map_or_else(String::new, column.format),
            };
            format!("<td{starts}>{shown}</td>")
        })
        .collect();
    format!(
        "<tr><th scope=\"row\"><span class=\"name\">No shadow drawn</span><code>all pixels lit</code></th>{cells}</tr>"
    )
}

/// Named parts of the picture, against the light-space ideal; nothing if there are none.
pub(super) fn regions(results: &Results) -> String {
    let names: BTreeSet<&String> = results.valid().flat_map(|t| t.regions.keys()).collect();
    if names.is_empty() {
        return String::new();
    }
    let heads: String = names
        .iter()
        .map(|name| format!("<th scope=\"colgroup\" colspan=\"3\" class=\"starts\">{}</th>", escape(name)))
        .collect();
    let labels =
        "<th scope=\"col\" class=\"starts\">RMSE</th><th scope=\"col\">Leak</th><th scope=\"col\">Edges</th>"
            .repeat(names.len());
    let rows: String = results
        .valid()
        .map(|t| {
            let cells: String = names.iter().map(|name| region_cells(t.regions.get(*name))).collect();
            format!("<tr>{}{cells}</tr>\n", row_head(t))
        })
        .collect();
    format!(
        "<h3>Parts of the picture</h3><p>Against the light-space ideal, over shadowed pixels only. <b>contact</b>: \
         the blocker is within a twentieth of the light's depth range. <b>layers</b>: two blockers or more lie \
         between the surface and the light, as far apart as that.</p>\
         <div class=\"scroll regions\" tabindex=\"0\" role=\"region\" aria-label=\"Parts of the picture\"><table>\
         <thead><tr><th rowspan=\"2\" scope=\"col\">Technique</th>{heads}</tr><tr>{labels}</tr></thead>\
         <tbody>{rows}</tbody></table></div>"
    )
}

fn region_cells(score: Option<&Score>) -> String {
    let shown = |value: Option<f64>, format: fn(f64) -> String| value.map_or("–".into(), format);
    format!(
        "<td class=\"starts\">{}</td><td>{}</td><td>{}</td>",
        shown(score.map(|s| s.rmse), column::four_digits),
        score.map_or("–".into(), |s| s.leak.map_or_else(|| too_few(s.deep_shadow_pixels), significant)),
        shown(score.and_then(|s| s.pixel_match_near_edges), percent),
    )
}

/// Kinds of pixels that techniques tell apart; nothing if none does.
pub(super) fn classes(results: &Results) -> String {
    let row = |t: &TechniqueResult| {
        let one = |(i, class): (usize, &ClassShare)| {
            let head = if i == 0 { row_head(t) } else { "<td></td>".into() };
            let [r, g, b] = class.colour;
            format!(
                "<tr>{head}<td><span class=\"swatch\" style=\"background:rgb({r},{g},{b})\"></span> {}</td><td>{}</td></tr>\n",
                escape(&class.name),
                super::text::percent(class.share)
            )
        };
        t.classes.iter().enumerate().map(one).collect::<String>()
    };
    let rows: String = results.valid().map(row).collect();
    if rows.is_empty() {
        return String::new();
    }
    format!(
        "<h3>Kinds of pixels</h3><p>What some techniques tell apart while they look up, as shares of the pixels that \
         see geometry. Their pictures are among those of the slider.</p>\
         <div class=\"scroll regions\" tabindex=\"0\" role=\"region\" aria-label=\"Kinds of pixels\"><table>\
         <thead><tr><th scope=\"col\">Technique</th><th scope=\"col\">Kind</th><th scope=\"col\">Share</th></tr></thead>\
         <tbody>{rows}</tbody></table></div>"
    )
}
