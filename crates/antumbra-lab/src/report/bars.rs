//! Time per pass and memory per texture: bars for the eye, tables for the numbers.

use super::table::row_head;
use super::text::{bytes, count, escape, milliseconds, significant};
use crate::results::{Lifetime, PassTime, Results, TechniqueResult};

/// Colours of the style sheet for passes; a ninth pass is drawn like the first.
const PASS_COLORS: usize = 8;

/// Stacked bars of the passes' medians, and their table.
pub(super) fn time(results: &Results) -> String {
    let mut names: Vec<&str> = Vec::new();
    for pass in results.valid().flat_map(|t| &t.time.passes) {
        if !names.contains(&pass.name.as_str()) {
            names.push(&pass.name);
        }
    }
    let color = |name: &str| names.iter().position(|n| *n == name).unwrap_or(0) % PASS_COLORS;
    let key: String = names
        .iter()
        .map(|name| format!("<li><span class=\"swatch pass{}\"></span>{}</li>", color(name), escape(name)))
        .collect();
    let extent = |t: &TechniqueResult| {
        t.time.passes.iter().map(|p| p.median_ms).sum::<f64>().max(t.time.frame.median_ms)
    };
    let longest = results.valid().map(extent).fold(0.0, f64::max);
    let bars: String = results
        .valid()
        .map(|t| {
            let segments: String =
                t.time.passes.iter().map(|pass| segment(pass, longest, color(&pass.name))).collect();
            let frame = &t.time.frame;
            format!(
                "<li><span class=\"label\"><span class=\"name\">{}</span><code>{}</code></span>\
                 <span class=\"bar\">{segments}<span class=\"frame\" style=\"left:{:.3}%\" data-tip=\"{tip}\"></span></span>\
                 <span class=\"total\" data-tip=\"{tip}\">{}</span></li>\n",
                escape(&t.title),
                escape(&t.spec),
                share(frame.median_ms, longest),
                milliseconds(frame.median_ms),
                tip = escape(&format!(
                    "Frame: median {}, {} to {}, {} rounds, {}",
                    milliseconds(frame.median_ms),
                    significant(frame.min_ms),
                    milliseconds(frame.max_ms),
                    t.time.rounds,
                    t.time.frame_method
                )),
            )
        })
        .collect();
    format!(
        "<ul class=\"key\">{key}<li><span class=\"swatch frame-key\"></span>whole frame</li></ul>\
         <ul class=\"bars\">{bars}</ul>{}",
        pass_table(results)
    )
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole * 100.0 } else { 0.0 }
}

fn segment(pass: &PassTime, longest: f64, color: usize) -> String {
    let tip = format!(
        "{}: {} ({} to {}), {}",
        pass.name,
        milliseconds(pass.median_ms),
        significant(pass.min_ms),
        milliseconds(pass.max_ms),
        pass.method
    );
    let width = share(pass.median_ms, longest);
    format!("<span class=\"pass{color}\" style=\"width:{width:.3}%\" data-tip=\"{}\"></span>", escape(&tip))
}

fn pass_table(results: &Results) -> String {
    let row = |pass: &PassTime| {
        format!(
            "<tr><td>{}</td><td>{:.4}</td><td>{:.4}</td><td>{:.4}</td><td>{}</td><td>{}</td></tr>",
            escape(&pass.name),
            pass.median_ms,
            pass.min_ms,
            pass.max_ms,
            pass.cpu_ms.map_or("–".into(), |ms| format!("{ms:.4}")),
            pass.method
        )
    };
    let groups: String = results
        .valid()
        .map(|t| {
            let head = row_head(t).replacen("scope=\"row\"", "scope=\"rowgroup\" colspan=\"6\"", 1);
            let rows: String = t.time.passes.iter().map(row).collect();
            format!("<tbody><tr>{head}</tr>{rows}</tbody>")
        })
        .collect();
    format!(
        "<details><summary>All passes as a table</summary><div class=\"scroll\" tabindex=\"0\" role=\"region\" \
         aria-label=\"Passes\"><table class=\"plain\"><thead><tr><th scope=\"col\">Pass</th><th scope=\"col\">Median ms</th>\
         <th scope=\"col\">Fastest ms</th><th scope=\"col\">Slowest ms</th><th scope=\"col\">Recording on CPU ms</th>\
         <th scope=\"col\">Clock</th></tr></thead>{groups}</table></div></details>"
    )
}

/// Kept and transient bytes as bars; every texture in a table that opens.
pub(super) fn memory(results: &Results) -> String {
    let total = |t: &TechniqueResult| (t.memory.kept_bytes + t.memory.transient_bytes) as f64;
    let largest = results.valid().map(total).fold(0.0, f64::max);
    let items: String = results.valid().map(|t| memory_item(t, largest)).collect();
    format!(
        "<ul class=\"key\"><li><span class=\"swatch kept\"></span>kept: lookups need it</li>\
         <li><span class=\"swatch transient\"></span>transient: only the passes need it</li></ul>{items}"
    )
}

fn memory_item(technique: &TechniqueResult, largest: f64) -> String {
    let memory = &technique.memory;
    let (kept, transient) = (memory.kept_bytes as f64, memory.transient_bytes as f64);
    let rows: String = memory
        .items
        .iter()
        .map(|item| {
            let lifetime = match item.lifetime {
                Lifetime::Kept => "kept",
                Lifetime::Transient => "transient",
                Lifetime::Borrowed => "borrowed",
            };
            format!(
                "<tr><th scope=\"row\">{}</th><td><code>{}</code></td><td>{} × {}</td><td>{}</td><td>{}</td>\
                 <td>{}</td><td>{lifetime}</td></tr>",
                escape(&item.name),
                escape(&item.format),
                item.width,
                item.height,
                item.layers,
                item.mips,
                count(item.bytes),
            )
        })
        .collect();
    format!(
        "<details class=\"memory\"><summary><span class=\"label\"><span class=\"name\">{}</span><code>{}</code></span>\
         <span class=\"bar\"><span class=\"kept\" style=\"width:{:.3}%\"></span>\
         <span class=\"transient\" style=\"width:{:.3}%\"></span></span>\
         <span class=\"total\">{} + {}</span></summary>\
         <div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"Memory of {}\"><table class=\"plain\"><thead><tr><th scope=\"col\">Item</th>\
         <th scope=\"col\">Format</th><th scope=\"col\">Texels</th><th scope=\"col\">Layers</th><th scope=\"col\">Mips</th>\
         <th scope=\"col\">Bytes</th><th scope=\"col\">Lifetime</th></tr></thead><tbody>{rows}</tbody></table></div></details>\n",
        escape(&technique.title),
        escape(&technique.spec),
        share(kept, largest),
        share(transient, largest),
        bytes(kept),
        bytes(transient),
        escape(&technique.title),
    )
}
