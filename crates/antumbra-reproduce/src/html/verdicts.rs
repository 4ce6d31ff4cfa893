//! Verdicts and facts, with all that they rest on.

use crate::{
    results::Judged,
    verdict::{Comparison, Fact, Ran},
};
use antumbra_lab::report::escape;

/// Verdicts with their sources, limits and settings.
pub(super) fn list(verdicts: &[Judged]) -> String {
    items(verdicts, basis)
}

/// Verdicts alone.
pub(super) fn lines(verdicts: &[Judged]) -> String {
    items(verdicts, |_| String::new())
}

fn items(verdicts: &[Judged], basis: fn(&Judged) -> String) -> String {
    let item = |v: &Judged| {
        format!(
            "<li class=\"{class}\"><b class=\"outcome\">{class}</b><span><strong>{claim}</strong>{ours} \
             <span class=\"quiet\">{reason}</span>{basis}</span></li>",
            class = v.outcome.name(),
            claim = escape(&v.claim),
            ours = if v.source.is_of_a_document() { "" } else { " <em>(our claim)</em>" },
            reason = escape(&v.reason),
            basis = basis(v),
        )
    };
    let items: String = verdicts.iter().map(item).collect();
    if items.is_empty() { items } else { format!("<ul class=\"verdict-list\">{items}</ul>") }
}

/// The source's words, the limits and where they come from, the spread, what ran.
fn basis(verdict: &Judged) -> String {
    let spread = if verdict.comparisons.iter().all(Comparison::is_exact) {
        "none: the numbers come out the same every time"
    } else {
        "ranges are those that hold the median of all frames in 95 of 100 cases; what they decide is open"
    };
    let limits: Vec<String> = verdict.comparisons.iter().map(Comparison::limit_says).collect();
    let rows = [
        ("Source", verdict.source.text()),
        ("Limit", limits.join(" ")),
        ("Spread", if limits.is_empty() { String::new() } else { spread.into() }),
        ("Ran", verdict.ran.as_ref().map_or("", Ran::text).into()),
    ];
    let row = |(name, text): (&str, String)| {
        if text.is_empty() {
            return text;
        }
        format!("<dt>{name}</dt><dd>{}</dd>", escape(&text))
    };
    format!("<dl class=\"basis\">{}</dl>", rows.map(row).concat())
}

/// Facts, under a heading that says that they are no verdicts.
pub(super) fn facts(facts: &[Fact]) -> String {
    let item = |f: &Fact| {
        format!(
            "<li><strong>{}</strong> {} <span class=\"quiet\">No measurement could end otherwise: {}.</span>\
             <dl class=\"basis\"><dt>Source</dt><dd>{}</dd></dl></li>",
            escape(&f.claim),
            escape(&f.found),
            escape(&f.because),
            escape(&f.source.text()),
        )
    };
    let items: String = facts.iter().map(item).collect();
    if items.is_empty() {
        return items;
    }
    format!(
        "<section class=\"facts\" aria-label=\"Facts\"><h3>Facts, not judged</h3><ul>{items}</ul></section>"
    )
}
