//! Names of what the library adds to a user's module: all of them begin with one word.
//!
//! Files name things after themselves (`raster_linear`), and the user's module may do so too. So receivers' text has its
//! module-scope names changed when it is written out, and the user may give another word for a second map.

use super::ShaderText;
use crate::error::NameError;
use std::collections::BTreeMap;

/// The word that names begin with unless the user gives another.
pub(super) const PREFIX: &str = "shadow";
/// What the user's shader defines.
const HOOK: &str = "shadow_covers";

impl ShaderText {
    /// The same text with another word in front of every name: `named("lamp")` has `lamp_visibility`, `lamp_class`, and
    /// asks for `lamp_covers` and nothing that begins with `shadow`. So several maps, also of one technique, stand in one
    /// module.
    ///
    /// # Errors
    /// [`NameError`] unless `name` is a lower-case letter followed by lower-case letters, digits and single underscores.
    pub fn named(&self, name: &str) -> Result<Self, NameError> {
        let begins = name.starts_with(|c: char| c.is_ascii_lowercase());
        let good = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if !begins || !name.chars().all(good) || name.contains("__") || name.ends_with('_') {
            return Err(NameError { name: name.into() });
        }
        Ok(Self { prefix: Some(name.into()), ..self.clone() })
    }

    /// A text that calls what files define by the names that they have there; for tests.
    #[doc(hidden)]
    #[must_use]
    pub fn renamed(&self, text: &str) -> String {
        replaced(text, &self.names())
    }

    /// Names in files, and in the user's module.
    fn names(&self) -> BTreeMap<String, String> {
        let Some(prefix) = &self.prefix else { return BTreeMap::new() };
        let all: String = self.pieces.iter().map(|(_, text)| text.as_str()).collect();
        let mut names: BTreeMap<String, String> =
            globals(&all).map(|name| (name.to_string(), renamed(name, prefix))).collect();
        names.insert(HOOK.into(), renamed(HOOK, prefix));
        names
    }
}

/// A name with that word in front, as functions or, if it begins with a capital, types have it.
fn renamed(name: &str, prefix: &str) -> String {
    let is_type = name.starts_with(|c: char| c.is_ascii_uppercase());
    let own = name.strip_prefix(if is_type { "Shadow" } else { PREFIX }).unwrap_or(name);
    if is_type {
        let words = prefix.split('_').flat_map(|word| {
            let (first, rest) = word.split_at(word.len().min(1));
            [first.to_ascii_uppercase(), rest.to_string()]
        });
        return words.chain([own.to_string()]).collect();
    }
    match own.trim_start_matches('_') {
        "" => format!("{prefix}_uniforms"),
        own => format!("{prefix}_{own}"),
    }
}

/// Names that a text declares at module scope.
pub(super) fn globals(text: &str) -> impl Iterator<Item = &str> {
    let (mut depth, mut declares, mut in_template) = (0, false, false);
    tokens(text).filter_map(move |token| {
        match token {
            "{" => depth += 1,
            "}" => depth -= 1,
            "fn" | "struct" | "const" | "alias" | "var" if depth == 0 => declares = true,
            // The address space of a variable stands between.
            "<" if declares => in_template = true,
            ">" if declares => in_template = false,
            name if declares && !in_template && is_name(name) => {
                declares = false;
                return Some(name);
            }
            _ => {}
        }
        None
    })
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// The text with names replaced, comments included, members of structs not.
fn replaced(text: &str, names: &BTreeMap<String, String>) -> String {
    let mut result = String::with_capacity(text.len() + text.len() / 4);
    let (mut before, mut struct_begins, mut in_struct) = ("", false, false);
    let mut rest = text;
    for part in split(text) {
        rest = &rest[part.len()..];
        let is_member = before == "." || in_struct && rest.trim_start().starts_with(':');
        let kept = if is_member { None } else { names.get(part) };
        result += kept.map_or(part, String::as_str);
        match part {
            "struct" => struct_begins = true,
            "{" => in_struct = std::mem::take(&mut struct_begins),
            "}" => in_struct = false,
            _ => {}
        }
        if !part.trim().is_empty() {
            before = part;
        }
    }
    result
}

/// Names, numbers and single other characters, without comments and blanks.
fn tokens(text: &str) -> impl Iterator<Item = &str> {
    let code = text.split('\n').flat_map(|line| split(line.split("//").next().unwrap_or_default()));
    code.filter(|part| !part.trim().is_empty())
}

/// The text in parts: words of letters, digits and underscores, and single other characters.
fn split(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let in_word = |c: char| c.is_alphanumeric() || c == '_';
        let length =
            if in_word(first) { rest.find(|c| !in_word(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        let (part, after) = rest.split_at(length);
        rest = after;
        Some(part)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "//! needs shadow\n\
        struct ShadowView { a: f32, taps_sum: f32 }\nstruct Tap { at: vec2f }\n\
        @group(1) @binding(0) var<uniform> shadow: ShadowView;\nconst taps_width: u32 = 3u;\n\
        fn taps_sum(width: f32) -> f32 { var taps = 1e-3; let x = shadow.a + shadow.taps_sum; return taps_lit(x) + taps; }\n\
        fn shadow_visibility() -> bool { return shadow_covers(1u); } // taps_sum\n";

    fn text(prefix: Option<&str>) -> ShaderText {
        ShaderText {
            pieces: vec![("a.wgsl".into(), TEXT.into())],
            prefix: prefix.map(String::from),
            ..ShaderText::default()
        }
    }

    #[test]
    fn every_name_of_the_module_begins_with_the_word() {
        let names: Vec<&str> = globals(TEXT).collect();
        assert_eq!(names, ["ShadowView", "Tap", "shadow", "taps_width", "taps_sum", "shadow_visibility"]);
        let lamp = text(None).named("desk_lamp").unwrap().text();
        for name in [
            "DeskLampView",
            "DeskLampTap",
            "desk_lamp_uniforms.a",
            "desk_lamp_taps_sum(",
            "desk_lamp_covers(",
        ] {
            assert!(lamp.contains(name), "{name}: {lamp}");
        }
        assert!(lamp.contains("var taps = 1e-3") && lamp.contains("(width: f32)"), "{lamp}");
        assert_eq!(text(None).text(), TEXT);
        let usual = text(Some(PREFIX));
        assert!(
            usual.text().contains("fn shadow_visibility()") && usual.text().contains("fn shadow_taps_sum(")
        );
        assert_eq!(usual.renamed("taps_sum(1.0)"), "shadow_taps_sum(1.0)");
        assert_eq!(usual.text().matches('\n').count(), TEXT.matches('\n').count());
    }

    #[test]
    fn what_is_no_name_is_refused() {
        for name in ["", "Lamp", "1lamp", "desk lamp", "_lamp", "a__b", "lamp_", "lämp"] {
            let error = text(None).named(name).unwrap_err().to_string();
            assert!(error.contains(&format!("'{name}'")), "{error}");
        }
        text(None).named("l2_a").unwrap();
    }
}
