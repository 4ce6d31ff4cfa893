//! What the slider and the grid of heat maps show.

use super::table::family;
use super::text::{escape, label};
use super::{ReportError, column};
use crate::image::diverging;
use crate::results::{Family, Results, TechniqueResult};
use base64::{Engine, engine::general_purpose::STANDARD};
use std::collections::{BTreeMap, BTreeSet};

/// A side of the slider.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    Left,
    Right,
}

/// One thing to look at.
struct View<'a> {
    label: String,
    file: &'a str,
    /// The two visibility images that an error map is the difference of.
    difference: Option<[&'a str; 2]>,
}

fn truths(results: &Results) -> Vec<View<'_>> {
    let images = &results.truth.images;
    let view = |label: &str, file| View { label: label.into(), file, difference: None };
    let cascades = results.cascades.as_ref().map(|file| view("Cascades in colour", file));
    [
        view(column::LIGHT_SPACE, &images.light_space),
        view(column::HARD, &images.hard),
        view(column::SCREEN_SPACE, &images.screen_space),
    ]
    .into_iter()
    .chain(cascades)
    .collect()
}

fn views<'a>(results: &'a Results, technique: &'a TechniqueResult) -> Vec<View<'a>> {
    let (images, truth) = (&technique.images, &results.truth.images);
    let view = |what: &str, file: &'a str| View {
        label: format!("{} · {what}", label(results, technique)),
        file,
        difference: None,
    };
    let error = |what: &str, file: &'a str, truth: &'a str| View {
        difference: Some([&images.visibility, truth]),
        ..view(what, file)
    };
    let classes = images.classes.as_ref().map(|file| view("classes", file));
    [
        view("picture", &images.picture),
        view("visibility", &images.visibility),
        error("error to light-space ideal", &images.error_light_space, &truth.light_space),
        error("error to hard truth", &images.error_hard, &truth.hard),
    ]
    .into_iter()
    .chain(classes)
    .collect()
}

/// Every image that the page shows, once: a JSON object from file name to base64, safe in a script
/// element since names and base64 hold no '<'.
pub(super) fn images(results: &Results, images: &BTreeMap<String, Vec<u8>>) -> Result<String, ReportError> {
    let techniques = results.techniques.iter().flat_map(|t| views(results, t));
    let names: BTreeSet<&str> = truths(results).into_iter().chain(techniques).map(|view| view.file).collect();
    let entry = |name: &str| match images.get(name) {
        Some(bytes) => Ok(format!("\"{name}\":\"{}\"", STANDARD.encode(bytes))),
        None => Err(ReportError::MissingImage(name.to_owned())),
    };
    let entries = names.into_iter().map(entry).collect::<Result<Vec<_>, _>>()?;
    Ok(format!("{{{}}}", entries.join(",\n")))
}

/// The choices of one side. At first the left shows the first technique's picture and the right the
/// best one's; with a single technique the left shows the light-space ideal.
pub(super) fn options(results: &Results, side: Side, best: Option<&TechniqueResult>) -> String {
    let first = results.techniques.first();
    let left = match (first, best) {
        (Some(first), Some(best)) if !std::ptr::eq(first, best) => &first.images.picture,
        _ => &results.truth.images.light_space,
    };
    let right = match (best, left == &results.truth.images.light_space) {
        (Some(best), true) => &best.images.visibility,
        (Some(best), false) => &best.images.picture,
        (None, _) => &results.truth.images.hard,
    };
    let chosen = if side == Side::Left { left } else { right };
    let group = |label: &str, views: &[View<'_>]| {
        let options: String = views.iter().map(|view| option(view, chosen)).collect();
        format!("<optgroup label=\"{}\">{options}</optgroup>\n", escape(label))
    };
    let techniques = results.techniques.iter().map(|t| group(&t.spec, &views(results, t)));
    std::iter::once(group("Ray-traced truth", &truths(results))).chain(techniques).collect()
}

fn option(view: &View<'_>, chosen: &str) -> String {
    let selected = if view.file == chosen { " selected" } else { "" };
    let difference = view.difference.map_or_else(String::new, |[test, truth]| {
        format!(" data-test=\"{}\" data-truth=\"{}\"", escape(test), escape(truth))
    });
    format!("<option value=\"{}\"{difference}{selected}>{}</option>", escape(view.file), escape(&view.label))
}

/// All signed-error maps, family by family.
pub(super) fn heat_maps(results: &Results) -> String {
    let group = |(of, members): (Family, Vec<&TechniqueResult>)| {
        let members: String = members.into_iter().map(|t| heat_map(results, t)).collect();
        let (name, class) = family(of);
        let head = format!("<h3><span class=\"mark {class}\" aria-hidden=\"true\"></span>{name}</h3>");
        format!("{head}<div class=\"maps\">{members}</div>\n")
    };
    results.families().into_iter().map(group).collect()
}

fn heat_map(results: &Results, technique: &TechniqueResult) -> String {
    let [w, h] = results.run.resolution;
    let figures = |truth: &str, file: &str, numbers: String| {
        format!(
            "<button type=\"button\" class=\"map\" data-against=\"{truth}\" data-image=\"{file}\" data-visibility=\"{visibility}\">\
             <img alt=\"Signed error of {title}\" data-file=\"{file}\" width=\"{w}\" height=\"{h}\">\
             <span class=\"numbers\">{numbers}</span></button>",
            file = escape(file),
            visibility = escape(&technique.images.visibility),
            title = escape(&label(results, technique)),
        )
    };
    let number = |metric: &str, value: Option<f64>| {
        format!("<span>{metric} <b>{}</b></span>", value.map_or("–".into(), column::four_digits))
    };
    let (soft, hard) = (&technique.scores.light_space, &technique.scores.hard);
    let soft =
        number("RMSE", Some(soft.rmse)) + &number("ꟻLIP", Some(soft.flip)) + &number("leak", soft.leak);
    let percent = format!("<span>match <b>{}</b></span>", super::text::percent(hard.pixel_match));
    let hard = percent + &number("RMSE", Some(hard.rmse)) + &number("leak", hard.leak);
    format!(
        "<figure>{}{}<figcaption><span class=\"name\">{}</span><code>{}</code></figcaption></figure>\n",
        figures("light_space", &technique.images.error_light_space, soft),
        figures("hard", &technique.images.error_hard, hard),
        escape(&technique.title),
        escape(&technique.spec),
    )
}

/// The colours of the error maps, −1 to 1.
pub(super) fn legend() -> String {
    let stop = |i: i32| {
        let [r, g, b] = diverging(i as f32 / 10.0);
        format!("rgb({r},{g},{b})")
    };
    let stops: Vec<String> = (-10..=10).map(stop).collect();
    format!(
        "<div class=\"legend\"><span>too dark −1</span>\
         <span class=\"ramp\" role=\"img\" aria-label=\"from blue at −1 through white at 0 to red at 1\" \
         style=\"background:linear-gradient(90deg,{})\"></span><span>+1 too bright</span>\
         <span class=\"grey\"><span class=\"swatch\"></span>cannot be in shadow</span></div>",
        stops.join(",")
    )
}
