//! The page about flicker: a folder with one self-contained page, the data, and the pictures.

use super::{Outcome, Promise, Results, TechniqueFlicker, pictures};
use crate::{
    chart::{self, Curve, Panel},
    files,
    report::{STYLE, escape, text},
    results::LeftOut,
};
use anyhow::Result;
use base64::{Engine, engine::general_purpose::STANDARD};
use std::path::{Path, PathBuf};

const PAGE: &str = include_str!("page.html");
const OWN_STYLE: &str = include_str!("page.css");

/// Writes the folder, whole or not at all, and returns its path. An earlier report there is replaced,
/// any other folder that is not empty is refused.
///
/// # Errors
/// [`files::FileError`]; numbers that are not finite.
pub fn write(outcome: &Outcome, out_dir: &Path) -> Result<PathBuf> {
    let mut results = outcome.results.clone();
    results.files = outcome.images.keys().cloned().chain(["index.html".into()]).collect();
    let json = serde_json::to_string_pretty(&results)? + "\n";
    let page = html(outcome);
    files::write_folder(out_dir, |folder| {
        for (name, bytes) in &outcome.images {
            folder.write(name, bytes)?;
        }
        folder.write("flicker.json", json.as_bytes())?;
        folder.write("index.html", page.as_bytes())?;
        Ok(())
    })
}

fn html(outcome: &Outcome) -> String {
    let results = &outcome.results;
    let picture = |name: &str, alt: &str| picture(outcome, name, alt);
    let heat: String = results
        .techniques
        .iter()
        .zip(&results.heat_maps)
        .map(|(technique, file)| {
            let alt = format!("Where {} flickers", technique.title);
            let own = technique.flicker.get(&Promise::Hard).map_or(0.0, |m| m.mean);
            format!(
                "<figure>{}<figcaption>{} <b>{}</b><code>{}</code></figcaption></figure>",
                picture(file, &alt),
                escape(&technique.title),
                thousandths(own),
                escape(&technique.spec)
            )
        })
        .collect();
    let parts = [
        ("title", escape(&format!("{}: how shadows flicker", results.scene))),
        ("scene", escape(&results.scene)),
        ("style", format!("{STYLE}\n{OWN_STYLE}")),
        ("facts", facts(results)),
        ("answer", answer(results)),
        ("film", picture(pictures::FILM_FILE, "The truth and every technique in motion")),
        ("row", picture(pictures::ROW_FILE, "One row of pixels over time")),
        ("strip", picture(pictures::STRIP_FILE, "Frames of the path")),
        ("table", table(results)),
        ("plot", chart::svg(&[plot(results)])),
        ("heat", heat),
        ("ideal", thousandths(results.ideal_against_hard)),
        ("agreement", text::percent(results.agreement)),
        ("pixels", text::count(results.pixels.round() as u64)),
        ("stride", results.stride.to_string()),
        ("texel_changes", results.texel_changes.to_string()),
        ("motion", escape(&results.motion)),
        ("command", escape(&results.command.join(" "))),
        ("program", escape(&format!("{} {}", results.program.name, results.program.version))),
        ("adapter", escape(&format!("{}, {}", results.adapter.name, results.adapter.driver))),
        ("seconds", text::seconds(results.seconds_total)),
        ("tracing", text::seconds(results.seconds_tracing)),
        ("schema", escape(&results.schema)),
    ];
    text::fill(PAGE, &parts)
}

fn picture(outcome: &Outcome, name: &str, alt: &str) -> String {
    let Some(bytes) = outcome.images.get(name) else { return String::new() };
    format!("<img alt=\"{}\" src=\"data:image/png;base64,{}\">", escape(alt), STANDARD.encode(bytes))
}

fn facts(results: &Results) -> String {
    let [width, height] = results.resolution;
    let facts = [
        format!("{} frames", results.frames),
        results.motion.clone(),
        format!("{width} × {height} pixels"),
        format!("{0} × {0} texels a map", results.map_size),
        format!("{0} × {0} texel kernel", results.kernel_texels),
        format!("{} triangles", text::count(results.triangles)),
    ];
    let cascades = (results.cascades > 1).then(|| format!("{} cascades", results.cascades));
    let bias = Some(&results.bias).filter(|b| !b.is_empty() && *b != "auto").map(|b| format!("bias {b}"));
    facts.iter().chain(&cascades).chain(&bias).map(|fact| format!("<li>{}</li>", escape(fact))).collect()
}

/// Thousandths of a value, so that columns can be read: 12.3.
fn thousandths(value: f64) -> String {
    format!("{:.2}", 1e3 * value)
}

fn answer(results: &Results) -> String {
    let measured = |technique: &&TechniqueFlicker| technique.name != "hard" && technique.rank().is_some();
    let ratio = |technique: &TechniqueFlicker| technique.rank().unwrap_or(f64::INFINITY);
    let order = |a: &&TechniqueFlicker, b: &&TechniqueFlicker| ratio(a).total_cmp(&ratio(b));
    let all = || results.techniques.iter().filter(measured);
    let (Some(best), Some(worst)) = (all().min_by(order), all().max_by(order)) else {
        return "<p>Hard shadow mapping was not among the techniques, so there is no ratio to it.</p>".into();
    };
    let said = |technique: &TechniqueFlicker| {
        format!(
            "<b>{}</b> <code>{}</code> flickers {} times as much as hard shadow mapping",
            escape(&technique.title),
            escape(&technique.spec),
            text::significant(ratio(technique))
        )
    };
    if best.spec == worst.spec {
        return format!("<p>{}.</p>", said(best));
    }
    format!("<p>{}, the least of all; {}, the most.</p>", said(best), said(worst))
}

fn table(results: &Results) -> String {
    let columns = [
        ("flicker", Promise::Hard),
        ("flicker", Promise::LightSpace),
        ("flicker", Promise::ScreenSpace),
        ("crawl", Promise::Hard),
        ("crawl", Promise::LightSpace),
    ];
    let mut html = String::from(
        "<table class=\"scores\"><thead><tr><th rowspan=\"2\">Technique</th><th rowspan=\"2\">Ratio to hard<br>by its own truth</th>\
         <th colspan=\"3\" scope=\"colgroup\" class=\"starts\">In the picture, against the</th>\
         <th colspan=\"2\" scope=\"colgroup\" class=\"starts\">On surfaces, against the</th></tr><tr>",
    );
    for (i, (_, promise)) in columns.iter().enumerate() {
        let starts = if i % 3 == 0 { " class=\"starts\"" } else { "" };
        html += &format!("<th{starts}>{}</th>", promise.title());
    }
    html += "</tr></thead><tbody>";
    for technique in &results.techniques {
        let ratio = technique.rank().map_or("–".into(), |ratio| format!("{ratio:.3}"));
        html += &format!(
            "<tr><th scope=\"row\"><span class=\"mark {}\"></span><span class=\"name\">{}</span><code>{}</code></th><td><b>{ratio}</b></td>",
            technique.family.name(),
            escape(&technique.title),
            escape(&technique.spec),
        );
        if let Some(why) = &technique.invalid {
            html += &format!("<td class=\"starts across\" colspan=\"5\">invalid: {}</td></tr>", escape(why));
            continue;
        }
        for (i, (where_, promise)) in columns.iter().enumerate() {
            let kept = if *where_ == "flicker" { &technique.flicker } else { &technique.crawl };
            let cell = kept.get(promise).map_or("–".into(), |measured| {
                let ratio = measured.ratio_to_hard.map_or(String::new(), |r| format!(" <i>{r:.2}</i>"));
                format!("{}{ratio}", thousandths(measured.mean))
            });
            let own = i < 3 && *promise == technique.promise;
            let starts = if i % 3 == 0 { " starts" } else { "" };
            html += &format!("<td class=\"{}{starts}\">{cell}</td>", if own { "own" } else { "" });
        }
        html += "</tr>";
    }
    for LeftOut { spec, reason } in &results.left_out {
        html += &format!(
            "<tr><th scope=\"row\"><code>{}</code></th><td>–</td><td class=\"starts across\" colspan=\"5\">left out: {}</td></tr>",
            escape(spec),
            escape(reason)
        );
    }
    html + "</tbody></table>"
}

/// Flicker of every pair of frames, each technique against its own truth.
fn plot(results: &Results) -> Panel {
    let valid = results.techniques.iter().filter(|technique| technique.invalid.is_none());
    let curves: Vec<Curve> = valid
        .filter_map(|technique| {
            let frames = &technique.flicker.get(&technique.promise)?.frames;
            let points = frames.iter().enumerate().map(|(i, v)| [(i + 1) as f64, 1e3 * v]).collect();
            Some(Curve { name: format!("{} ({})", technique.spec, technique.promise.title()), points })
        })
        .collect();
    let top = curves.iter().flat_map(|curve| &curve.points).map(|point| point[1]).fold(0.0, f64::max);
    Panel {
        curves,
        x: [1.0, f64::from(results.frames.max(3) - 1)],
        y: [0.0, if top > 0.0 { 1.05 * top } else { 1.0 }],
        x_label: "frame".into(),
        y_label: "flicker in the picture, thousandths, each against its own truth".into(),
    }
}
