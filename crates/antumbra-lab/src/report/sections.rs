//! The prose-like parts of the page: facts, truth, adapter, choices, definitions.

use super::table::family;
use super::text::{bytes, count, escape, label, list, percent, seconds, significant};
use crate::results::{LensFacts, LightFacts, Results, TechniqueResult};

fn lens(lens: LensFacts) -> String {
    match lens {
        LensFacts::FovYDeg(degrees) => format!("vertical field of view {degrees:.1}°"),
        LensFacts::Height(height) => format!("orthographic, picture {height} high"),
    }
}

/// What coordinates are relative to, if that is not the file's origin.
fn relative(origin: [f64; 3]) -> String {
    let [x, y, z] = origin;
    if origin == [0.0; 3] {
        String::new()
    } else {
        format!(", relative to ({x}, {y}, {z}) in the file, as all coordinates here")
    }
}

fn vector([x, y, z]: [f32; 3]) -> String {
    let short = |v: f32| significant(f64::from(v)).trim_end_matches('0').trim_end_matches('.').to_owned();
    let short = |v: f32| {
        if v.abs() < 5e-4 {
            "0".to_owned()
        } else if v.abs() < 100.0 {
            short(v)
        } else {
            format!("{v:.0}")
        }
    };
    format!("({}, {}, {})", short(x), short(y), short(z)).replace('-', "−")
}

fn light(light: &LightFacts) -> String {
    match light {
        LightFacts::Directional { direction } => format!("directional light along {}", vector(*direction)),
        LightFacts::Spot { position, direction, outer_angle_deg } => format!(
            "spot light at {} along {}, half angle {outer_angle_deg:.1}°",
            vector(*position),
            vector(*direction)
        ),
    }
}

/// Pairs as a description list; values are HTML.
fn description(pairs: &[(&str, String)]) -> String {
    let items: String = pairs
        .iter()
        .map(|(term, value)| format!("<div><dt>{}</dt><dd>{value}</dd></div>", escape(term)))
        .collect();
    format!("<dl>{items}</dl>")
}

/// What was rendered, in one line.
pub(super) fn facts(results: &Results) -> String {
    let [w, h] = results.run.resolution;
    let views = results.run.views.len();
    let cascades = (views > 1).then(|| format!("{views} cascades"));
    let bias = Some(&results.run.bias).filter(|b| !b.is_empty() && *b != "auto").map(|b| format!("bias {b}"));
    let facts = [
        format!("{} techniques", results.techniques.len()),
        format!("{w} × {h} pixels"),
        format!("{0} × {0} texels a map", results.run.map_size),
        format!("{0} × {0} texel kernel", results.run.kernel_texels),
        format!("{} triangles", count(results.run.scene.triangles)),
        results.run.adapter.name.clone(),
    ];
    facts.iter().chain(&cascades).chain(&bias).map(|fact| format!("<li>{}</li>", escape(fact))).collect()
}

/// How the truth was made and whether raster and rays agree.
pub(super) fn truth(results: &Results) -> String {
    let truth = &results.truth;
    let explained: Vec<String> = truth
        .coverage_explained
        .iter()
        .map(|(why, pixels)| format!("{} {}", count(*pixels), escape(why)))
        .collect();
    let explained =
        if explained.is_empty() { String::new() } else { format!("; the rest: {}", list(&explained)) };
    let bounds = &results.run.scene.bounds;
    let camera = &results.run.scene.camera;
    description(&[
        ("Light", escape(&light(&results.run.scene.light))),
        (
            "Camera",
            format!(
                "at {} towards {}, up {}, {}",
                vector(camera.position),
                vector(camera.target),
                vector(camera.up),
                lens(camera.lens)
            ),
        ),
        (
            "Scene bounds",
            format!("{} to {}{}", vector(bounds.min), vector(bounds.max), relative(results.run.scene.origin)),
        ),
        (
            "Shadowable pixels",
            format!("{} see geometry that faces the light", count(truth.shadowable_pixels)),
        ),
        (
            "Raster and rays",
            format!(
                "see the same triangle in {} of the pixels{explained}",
                percent(truth.coverage_agreement)
            ),
        ),
        (
            "Time of the truth",
            format!(
                "tree {}, hard {}, light-space ideal {}, screen-space ideal {}",
                seconds(truth.seconds_build),
                seconds(truth.seconds_hard),
                seconds(truth.seconds_light_space),
                seconds(truth.seconds_screen_space)
            ),
        ),
        (
            "Whole comparison",
            format!(
                "{}{}",
                seconds(results.seconds_total),
                results
                    .peak_memory_bytes
                    .map_or_else(String::new, |peak| format!(", at most {} of memory", bytes(peak as f64)))
            ),
        ),
    ])
}

/// The adapter as it names itself.
pub(super) fn adapter(results: &Results) -> String {
    let adapter = &results.run.adapter;
    let features = if adapter.features.is_empty() {
        "none beyond the WebGPU minimum".to_owned()
    } else {
        adapter.features.iter().map(|f| format!("<code>{}</code>", escape(f))).collect::<Vec<_>>().join(" ")
    };
    description(&[
        ("Adapter", escape(&adapter.name)),
        ("Driver", escape(&adapter.driver)),
        ("Interface", escape(&adapter.backend)),
        ("Kind", escape(&adapter.device_type)),
        ("Features in use", features),
    ])
}

/// Settings of each technique and what the library chose for it.
pub(super) fn explain(results: &Results) -> String {
    let one = |t: &TechniqueResult| {
        let settings: String = t
            .settings
            .iter()
            .map(|(key, value)| {
                let value = value.as_str().map_or_else(|| value.to_string(), str::to_owned);
                format!("<li><code>{} = {}</code></li>", escape(key), escape(&value))
            })
            .collect();
        let choices: String = t.explain.iter().map(|line| format!("<li>{}</li>", escape(line))).collect();
        let choices = if choices.is_empty() { String::new() } else { format!("<ul>{choices}</ul>") };
        format!(
            "<article><h3>{}</h3><p class=\"quiet\">{} family · {}</p><ul class=\"settings\">{settings}</ul>{choices}</article>\n",
            escape(&label(results, t)),
            family(t.family).0,
            escape(&t.paper)
        )
    };
    results.techniques.iter().map(one).collect()
}

/// The command line as a POSIX shell reads it.
pub(super) fn command(arguments: &[String]) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./=,:+@%".contains(c);
    let quote = |argument: &String| {
        if !argument.is_empty() && argument.chars().all(plain) {
            argument.clone()
        } else {
            format!("'{}'", argument.replace('\'', r"'\''"))
        }
    };
    arguments.iter().map(quote).collect::<Vec<_>>().join(" ")
}

/// How each number is defined, and by whom.
pub(super) fn definitions() -> String {
    let html = |pairs: &[(&str, &str)]| {
        description(&pairs.iter().map(|(term, text)| (*term, (*text).to_owned())).collect::<Vec<_>>())
    };
    html(&[
        (
            "Visibility v",
            "Linear, 1 lit and 0 shadowed. No tone mapping, no textures. Every number is over <em>shadowable</em> pixels: those that see geometry facing the light. The others are dark whatever the map says and would flatter every technique.",
        ),
        (
            "Hard truth",
            "One primary ray through each pixel's centre and one shadow ray from the point it meets (Lecocq et al. 2014, §6.2).",
        ),
        (
            "Light-space ideal",
            "Σ w(q) f(d, z(p − q)): the answer of a map with infinitely many texels, depth from rays, under the same kernel in light space (Annen et al. 2007, Eq. 4). It separates the error of an approximation from the wish to blur.",
        ),
        ("Screen-space ideal", "The mean of many hard answers over each pixel: the truth for anti-aliasing."),
        (
            "Match",
            "Share of pixels with the same answer, lit from v ≥ ½ (Lecocq et al. 2014, §6.2). It rewards acne and flatters everything, so <em>Edges</em> repeats it over pixels within 2 pixels, between centres, of one with the other answer.",
        ),
        ("RMSE, MAE", "√ mean (v − t)² and mean |v − t|, with t the truth."),
        ("PSNR", "−20 log₁₀ RMSE in decibels, the largest signal being 1. Equal images have none."),
        (
            "SSIM",
            "Structural similarity (Wang et al. 2004): 11 × 11 Gaussian window, σ = 1.5, K₁ = 0.01, K₂ = 0.03; pixels that are not shadowable have weight 0 in the window.",
        ),
        (
            "ꟻLIP",
            "LDR-ꟻLIP (Andersson et al. 2020) at 67 pixels per degree, of v as the light of a white surface; pixels that are not shadowable are white in both images.",
        ),
        (
            "Leak",
            "Mean v over pixels that are fully shadowed in truth and at least 4 pixels from any that is not. Over fewer than 400 such pixels one small spot would decide: then – and their number.",
        ),
        (
            "Over-darkening",
            "Mean 1 − v over pixels that are fully lit in truth and at least 4 pixels from any that is not; of fewer than 400 their number alone.",
        ),
        ("Acne", "Share of pixels that are fully lit in truth and answered shadowed."),
        (
            "Error maps",
            "v − t: blue where too dark, red where too bright, white where right. Lightness falls with |v − t| to the power 0.7.",
        ),
        (
            "Time",
            "Medians over the rounds with the fastest and slowest round, in milliseconds; the clock is named with each pass.",
        ),
        ("Memory", "Every texture and buffer allocated, layers and mips included."),
        (
            "Work",
            "What does not depend on the device's speed: bytes for each texel of the map that lookups need, lookups for each pixel, passes between casting and lighting. Trilinear interpolation counts as one lookup, an anisotropic one is not stretched.",
        ),
    ])
}
