//! Numbers of many things, sorted by a click.

use super::write;
use crate::page::{Column, Entry, Matrix};
use antumbra_lab::report::escape;
use std::collections::BTreeSet;

/// The table with its choices of rows.
pub(super) fn table(matrix: &Matrix) -> String {
    let rows: String = matrix.rows.iter().map(|row| entry(row, &matrix.columns)).collect();
    format!(
        "<p>{}</p><p class=\"choose\" data-table=\"matrix\">{}{}</p>\
         <div class=\"scroll wide\" tabindex=\"0\" role=\"region\" aria-label=\"Numbers\"><table id=\"matrix\" class=\"scores sortable\">\
         <thead>{}</thead><tbody>{rows}</tbody></table></div>\n",
        escape(&matrix.caption),
        choice("scene", "Scene", matrix.rows.iter().map(|r| r.scene.as_str())),
        choice("technique", "Technique", matrix.rows.iter().map(|r| r.technique.as_str())),
        head(&matrix.columns)
    )
}

fn choice<'a>(name: &str, label: &str, values: impl Iterator<Item = &'a str>) -> String {
    let values: BTreeSet<&str> = values.collect();
    let options: String =
        values.iter().map(|v| format!("<option value=\"{0}\">{0}</option>", escape(v))).collect();
    format!(
        "<label class=\"filter\">{label} <select name=\"{name}\"><option value=\"\">all</option>{options}</select></label>"
    )
}

fn head(columns: &[Column]) -> String {
    let mut groups: Vec<(&str, usize)> = Vec::new();
    for column in columns {
        match groups.last_mut() {
            Some((name, span)) if *name == column.group => *span += 1,
            _ => groups.push((&column.group, 1)),
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
            last = &column.group;
            let first = if column.higher { "descending" } else { "ascending" };
            format!(
                "<th scope=\"col\"{starts} title=\"{}\"><button type=\"button\" data-first=\"{first}\">{}</button></th>",
                escape(&column.meaning),
                escape(&column.label)
            )
        })
        .collect();
    let name = |label: &str| {
        format!(
            "<th rowspan=\"2\" scope=\"col\"><button type=\"button\" data-first=\"ascending\">{label}</button></th>"
        )
    };
    format!("<tr>{}{}{groups}</tr>\n<tr>{labels}</tr>", name("Technique"), name("Scene"))
}

fn entry(row: &Entry, columns: &[Column]) -> String {
    let mut last = "";
    let cells: String = columns
        .iter()
        .zip(&row.values)
        .map(|(column, value)| {
            let mut classes = Vec::new();
            if column.group != last {
                classes.push("starts");
            }
            last = &column.group;
            if row.on_front.contains(&column.key) {
                classes.push("leads");
            }
            let class =
                if classes.is_empty() { String::new() } else { format!(" class=\"{}\"", classes.join(" ")) };
            match value {
                Some(v) => format!("<td{class} data-value=\"{v}\">{}</td>", write(*v, column.unit)),
                None => format!("<td{class}><span class=\"none\">–</span></td>"),
            }
        })
        .collect();
    format!(
        "<tr data-scene=\"{scene}\" data-technique=\"{spec}\"><th scope=\"row\" data-value=\"{title} {spec}\">\
         <span class=\"mark {family}\"></span>{title}<code>{spec}</code></th><td data-value=\"{scene}\">{scene}</td>{cells}</tr>\n",
        scene = escape(&row.scene),
        spec = escape(&row.technique),
        title = escape(&row.title),
        family = escape(&row.family),
    )
}
