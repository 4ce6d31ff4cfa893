//! The answer in words, computed from the numbers.

use super::text::{self, escape, list, milliseconds, percent, significant};
use crate::results::{Results, TechniqueResult};

/// The valid technique with the smallest cost; the first of equals.
pub(super) fn best(results: &Results, cost: impl Fn(&TechniqueResult) -> f64) -> Option<&TechniqueResult> {
    results.valid().min_by(|a, b| cost(a).total_cmp(&cost(b)))
}

fn name(technique: &TechniqueResult) -> String {
    format!("<strong>{}</strong> <code>{}</code>", escape(&technique.title), escape(&technique.spec))
}

fn frame(technique: &TechniqueResult) -> String {
    milliseconds(technique.time.frame.median_ms)
}

/// Share of the best error within which an error is as good.
const AS_GOOD: f64 = 1.1;

/// The technique to take for filtered shadows: the quickest of those whose error is as good as the smallest.
fn recommended(results: &Results) -> Option<&TechniqueResult> {
    let error = |t: &TechniqueResult| t.scores.light_space.rmse;
    let min = error(best(results, error)?);
    let as_good = results.valid().filter(|t| error(t) <= AS_GOOD * min);
    as_good.min_by(|a, b| a.time.frame.median_ms.total_cmp(&b.time.frame.median_ms))
}

/// The first line: what to take and why, or why nothing can be said.
fn recommendation(results: &Results) -> Option<String> {
    if results.truth.shows_no_shadow() {
        return Some(format!(
            "<p class=\"take\">This view shows next to no shadow: drawing none at all matches {} of the pixels that \
             could be in shadow, so no technique is named. Choose another with <code>--camera</code> and \
             <code>--light</code>.</p>",
            percent(results.truth.no_shadow.pixel_match)
        ));
    }
    let take = recommended(results)?;
    let ratio = take.time.frame_ratio_to_hard;
    let ratio =
        ratio.map_or_else(String::new, |r| format!(", {} × the frame of <code>hard</code>", significant(r)));
    let leak = take.scores.light_space.leak.filter(|leak| *leak >= 0.01);
    let leak = leak.map_or_else(String::new, |l| format!(" Mind that it leaks {} of the light.", percent(l)));
    Some(format!(
        "<p class=\"take\">For filtered shadows in this scene take {}: of the techniques whose error is within a \
         tenth of the smallest it is the quickest (RMSE {}, {} a frame{ratio}, {} of memory).{leak}</p>",
        name(take),
        significant(take.scores.light_space.rmse),
        frame(take),
        text::bytes(take.memory.kept_bytes as f64)
    ))
}

/// Who is best by error, by error and time, by time; and what the no-shadow baseline scores.
pub(super) fn paragraph(results: &Results) -> String {
    let light_space = |t: &TechniqueResult| t.scores.light_space.rmse;
    let product = |t: &TechniqueResult| light_space(t) * t.time.frame.median_ms;
    let mut sentences = Vec::new();
    if results.truth.shows_no_shadow() {
        sentences.push("Numbers below rank little but noise.".into());
    } else if let (Some(closest), Some(trade)) = (best(results, light_space), best(results, product)) {
        sentences.push(format!(
            "Closest to the light-space ideal, which every filtered map approximates, is {}: RMSE {} at {} a frame.",
            name(closest),
            significant(light_space(closest)),
            frame(closest)
        ));
        sentences.push(if std::ptr::eq(closest, trade) {
            "It is also the best trade, with the smallest error × frame time.".into()
        } else {
            format!(
                "The best trade, with the smallest error × frame time, is {}: RMSE {} at {}.",
                name(trade),
                significant(light_space(trade)),
                frame(trade)
            )
        });
        sentences.extend(other_truths(results));
        sentences.extend(fastest(results));
    } else {
        sentences.push("No technique was compared.".into());
    }
    sentences.push(baseline(results));
    let device = results.run.adapter.device_type.to_lowercase();
    if device.contains("cpu") || device.contains("software") {
        sentences.push(
            "Times are those of a software rasteriser: they rank work on this processor, not on a graphics card."
                .into(),
        );
    }
    format!(
        "{}<p>{}</p>{}",
        recommendation(results).unwrap_or_default(),
        sentences.join(" "),
        missing(results)
    )
}

/// Warnings and notes of the run; techniques whose numbers are worth nothing or do not exist, and why.
fn missing(results: &Results) -> String {
    let invalid = results.techniques.iter().filter_map(|t| Some((&t.spec, "invalid", t.invalid.as_ref()?)));
    let left_out = results.left_out.iter().map(|l| (&l.spec, "left out", &l.reason));
    let line = |(spec, what, why): (&String, &str, &String)| {
        format!("<p class=\"quiet\"><code>{}</code> {what}: {}.</p>", escape(spec), escape(why))
    };
    let note = |text: &String| format!("<p class=\"quiet\">{}.</p>", escape(text));
    let warning = |text: &String| format!("<p><strong>Warning: {}.</strong></p>", escape(text));
    let warnings = results.run.warnings.iter().map(warning);
    warnings.chain(results.run.notes.iter().map(note)).chain(invalid.chain(left_out).map(line)).collect()
}

fn other_truths(results: &Results) -> Option<String> {
    let hard = best(results, |t| -t.scores.hard.pixel_match)?;
    let smooth = best(results, |t| t.scores.screen_space.rmse)?;
    Some(format!(
        "Against the hard truth {} answers most pixels right ({}); against the anti-aliased screen-space \
         ideal {} has the smallest error (RMSE {}).",
        name(hard),
        percent(hard.scores.hard.pixel_match),
        name(smooth),
        significant(smooth.scores.screen_space.rmse)
    ))
}

/// The fastest frame, and whose measured range it cannot be told from.
fn fastest(results: &Results) -> Option<String> {
    let fastest = best(results, |t| t.time.frame.median_ms)?;
    let overlaps =
        |t: &&TechniqueResult| !std::ptr::eq(*t, fastest) && t.time.frame.min_ms <= fastest.time.frame.max_ms;
    let label = |t: &TechniqueResult| escape(&text::label(results, t));
    let rivals: Vec<String> = results.valid().filter(overlaps).map(label).collect();
    let caution = match rivals.len() {
        0 => String::new(),
        1..=3 => format!(", though its range overlaps that of {}", list(&rivals)),
        n => format!(", though its range overlaps those of {n} others"),
    };
    Some(format!("The shortest frame is that of {} ({}{caution}).", name(fastest), frame(fastest)))
}

fn baseline(results: &Results) -> String {
    let none = &results.truth.no_shadow;
    let beaten = |t: &&TechniqueResult| t.scores.hard.rmse >= none.rmse;
    let label = |t: &TechniqueResult| escape(&text::label(results, t));
    let losers: Vec<String> = results.valid().filter(beaten).map(label).collect();
    let verdict = match losers.len() {
        0 if results.valid().next().is_none() => String::new(),
        0 => " Every technique has a smaller error than that.".into(),
        1 => format!(" {} is no better than that.", losers[0]),
        _ => format!(" {} are no better than that.", list(&losers)),
    };
    format!(
        "For scale: drawing no shadow at all already matches {} of the shadowable pixels of the hard truth (RMSE {}).{verdict}",
        percent(none.pixel_match),
        significant(none.rmse)
    )
}
