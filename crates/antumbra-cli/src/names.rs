//! Guesses what a wrong name was meant to be.

/// The known name that resembles a wrong one most, if any does.
pub(crate) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    known
        .map(|k| {
            // The second also knows swapped letters in short names.
            let likeness = strsim::jaro_winkler(name, k).max(strsim::normalized_damerau_levenshtein(name, k));
            (likeness, k)
        })
        .filter(|(likeness, _)| *likeness > 0.6)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, k)| k)
}
