//! Guesses what a wrong name was meant to be.

/// The known name that resembles a wrong one most, if any does.
pub(crate) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    known
        // Wrong letters, with swapped ones as one, decide; of equals the one that begins alike. Two of three
        // letters have to be right, or the name is an abbreviation.
        .map(|k| (strsim::normalized_damerau_levenshtein(name, k), strsim::jaro_winkler(name, k), k))
        .filter(|(letters, _, k)| *letters > 0.6 || (!name.is_empty() && k.starts_with(name)))
        .max_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)))
        .map(|(.., k)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_strangers_are_not() {
        let known = ["hard", "pcf", "vsm", "csm", "esm", "evsm", "msm", "lvsm", "kernel", "fence"];
        let guess = |name| nearest(name, known.into_iter());
        for (slip, meant) in
            [("vms", "vsm"), ("k", "kernel"), ("fense", "fence"), ("pfc", "pcf"), ("evms", "evsm")]
        {
            assert_eq!(guess(slip), Some(meant));
        }
        for stranger in ["zzz", "", "shadow", "model", "house", "performance", "map"] {
            assert_eq!(guess(stranger), None, "{stranger}");
        }
    }
}
