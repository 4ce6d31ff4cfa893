//! Text that goes into a page: escaping, names, numbers, templates.

use crate::results::{Results, TechniqueResult};

/// Safe as HTML text and in a quoted attribute.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\'' => safe.push_str("&#39;"),
            _ => safe.push(c),
        }
    }
    safe
}

/// The template with each `{{key}}` replaced, in one pass, so that what is put in is never read as
/// a template again.
pub(crate) fn fill(template: &str, parts: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        page.push_str(before);
        let (key, after) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(parts.iter().find(|(name, _)| *name == key).map_or("", |(_, value)| value));
        rest = after;
    }
    page + rest
}

/// A technique's title, with its specification where another has the same title; says so if it is invalid.
pub(super) fn label(results: &Results, technique: &TechniqueResult) -> String {
    let same = results.techniques.iter().filter(|t| t.title == technique.title).count();
    let name =
        if same > 1 { format!("{} ({})", technique.title, technique.spec) } else { technique.title.clone() };
    if technique.invalid.is_some() { name + ", invalid" } else { name }
}

/// A share as a percentage: "98.42 %".
#[must_use]
pub fn percent(share: f64) -> String {
    format!("{:.2}\u{202f}%", share * 100.0)
}

/// A size: "512 B", "20.0 MiB".
#[must_use]
pub fn bytes(bytes: f64) -> String {
    let units = ["B", "KiB", "MiB", "GiB", "TiB"];
    let power = (1..units.len()).take_while(|&p| bytes >= 1024_f64.powi(p as i32)).count();
    let value = bytes / 1024_f64.powi(power as i32);
    let digits = usize::from(power > 0 && value < 100.0);
    format!("{value:.digits$}\u{202f}{}", units[power])
}

/// A time: "0.412 ms", "153 ms".
#[must_use]
pub fn milliseconds(ms: f64) -> String {
    format!("{}\u{202f}ms", significant(ms))
}

/// A time: "12.3 s".
pub(crate) fn seconds(s: f64) -> String {
    if s < 0.1 { milliseconds(s * 1e3) } else { format!("{}\u{202f}s", significant(s)) }
}

/// Three significant digits, without an exponent: "0.0412", "4.12", "412".
#[must_use]
pub fn significant(value: f64) -> String {
    if value == 0.0 || !value.is_finite() {
        return format!("{value}");
    }
    let magnitude = value.abs().log10().floor() as i32;
    format!("{value:.0$}", (2 - magnitude).clamp(0, 9) as usize)
}

/// A count with thin spaces between thousands: "1 234 567".
#[must_use]
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let groups: Vec<&str> =
        (0..digits.len()).rev().step_by(3).map(|last| &digits[last.saturating_sub(2)..=last]).collect();
    groups.into_iter().rev().collect::<Vec<_>>().join("\u{202f}")
}

/// "a", "a and b", "a, b and c".
pub(super) fn list(items: &[String]) -> String {
    match items {
        [] => String::new(),
        [one] => one.clone(),
        [rest @ .., last] => format!("{} and {last}", rest.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_text_has_no_markup() {
        assert_eq!(escape("<b a=\"x\">'&"), "&lt;b a=&quot;x&quot;&gt;&#39;&amp;");
    }

    #[test]
    fn filling_is_one_pass() {
        let parts = [("a", "{{b}}".to_owned()), ("b", "never".to_owned())];
        assert_eq!(fill("<{{a}}|{{c}}>", &parts), "<{{b}}|>");
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(bytes(512.0), "512\u{202f}B");
        assert_eq!(bytes(20.0 * 1024.0 * 1024.0), "20.0\u{202f}MiB");
        assert_eq!(count(1_234_567), "1\u{202f}234\u{202f}567");
        assert_eq!(count(12), "12");
        assert_eq!(significant(0.041_23), "0.0412");
        assert_eq!(significant(412.3), "412");
        assert_eq!(significant(1.0), "1.00");
        assert_eq!(list(&["a".into(), "b".into(), "c".into()]), "a, b and c");
    }
}
