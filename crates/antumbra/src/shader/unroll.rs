//! Loops written out.
//!
//! wgpu counts the rounds of every loop, so that none runs for ever, and then drivers keep what they
//! would have unrolled: indices stay unknown, and what depends on them alone is reckoned in every round.

use crate::error::DescriptionError;
use std::fmt::Write;

/// What ends the first line of a loop that is written out:
/// `for (var i = 0u; i < COUNT; i += 1u) { // unrolled`, where `COUNT` is a constant.
const MARK: &str = "{ // unrolled";

/// Writes the marked loops of a text out, the inner ones first. Each stays on the line on which it began,
/// and lines behind it keep their numbers. `count` knows the constants.
///
/// # Errors
/// [`DescriptionError::Loop`].
pub(super) fn unroll(text: &str, count: impl Fn(&str) -> Option<u32>) -> Result<String, DescriptionError> {
    let mut lines: Vec<String> = text.lines().map(str::to_string).collect();
    while let Some(start) = lines.iter().rposition(|line| line.ends_with(MARK)) {
        let head = lines[start].clone();
        let indent = &head[..head.len() - head.trim_start().len()];
        let end = (start..lines.len()).find(|i| lines[*i].strip_prefix(indent) == Some("}"));
        let rounds = header(&head).and_then(|(name, limit)| Some((name, count(limit)?)));
        let (Some(end), Some((name, rounds))) = (end, rounds) else {
            return Err(DescriptionError::Loop { line: head.trim().into() });
        };
        let body: Vec<&str> =
            lines[start + 1..end].iter().map(|l| l.split("//").next().unwrap_or_default().trim()).collect();
        let body = body.join(" ");
        let mut written = indent.to_string();
        for round in 0..rounds {
            let _ = write!(written, "{{ const {name} = {round}u; {body} }} ");
        }
        lines[start] = written;
        lines[start + 1..=end].iter_mut().for_each(String::clear);
    }
    Ok(lines.iter().flat_map(|line| [line.as_str(), "\n"]).collect())
}

/// Name and limit of a loop's variable.
fn header(line: &str) -> Option<(&str, &str)> {
    let (name, rest) = line.trim_start().strip_prefix("for (var ")?.split_once(" = 0u; ")?;
    let limit = rest.strip_prefix(name)?.strip_prefix(" < ")?;
    let (limit, step) = limit.split_once("; ")?;
    (step.strip_prefix(name)? == format!(" += 1u) {MARK}")).then_some((name, limit))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two(name: &str) -> Option<u32> {
        (name == "two").then_some(2)
    }

    #[test]
    fn loops_are_written_out_and_lines_stay() {
        let text = "a\n    for (var i = 0u; i < two; i += 1u) { // unrolled\n        f(i); // once\n        if x {\n            g();\n        }\n    }\nb\n";
        let body = "f(i); if x { g(); }";
        let expected =
            format!("a\n    {{ const i = 0u; {body} }} {{ const i = 1u; {body} }} \n\n\n\n\n\nb\n");
        assert_eq!(unroll(text, two).unwrap(), expected);
    }

    #[test]
    fn inner_loops_come_first() {
        let text = "for (var j = 0u; j < two; j += 1u) { // unrolled\n    for (var i = 0u; i < two; i += 1u) { // unrolled\n        f(i, j);\n    }\n}\n";
        let found = unroll(text, two).unwrap();
        assert_eq!(found.matches("f(i, j);").count(), 4);
        assert_eq!(found.lines().count(), 5);
    }

    #[test]
    fn other_loops_stay() {
        let text = "for (var i = 0u; i < two; i += 1u) {\n    f(i);\n}\n";
        assert_eq!(unroll(text, two).unwrap(), text);
    }

    #[test]
    fn a_loop_of_unknown_length_is_named() {
        for text in [
            "for (var i = 0u; i < many; i += 1u) { // unrolled\n    f(i);\n}\n",
            "for (var i = 0u; i < two; i += 1u) { // unrolled\n    f(i);\n",
        ] {
            let head = text.lines().next().unwrap();
            assert_eq!(unroll(text, two), Err(DescriptionError::Loop { line: head.into() }));
        }
    }
}
