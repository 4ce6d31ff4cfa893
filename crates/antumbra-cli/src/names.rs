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

/// Up to three known names that resemble a wrong one, or hold it, the most similar first.
pub(crate) fn similar<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Vec<&'a str> {
    let plain = |text: &str| text.trim_matches('*').to_lowercase();
    let wanted = plain(name);
    let mut rated: Vec<(f64, &str)> = known
        .map(|k| {
            let holds = !wanted.is_empty() && plain(k).contains(&wanted);
            let alike = strsim::normalized_damerau_levenshtein(&wanted, &plain(k));
            (if holds { alike.max(0.9) } else { alike }, k)
        })
        .filter(|(alike, _)| *alike > 0.5)
        .collect();
    rated.sort_by(|a, b| b.0.total_cmp(&a.0));
    rated.into_iter().take(3).map(|(_, k)| k).collect()
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

    #[test]
    fn similar_names_are_listed() {
        let known = ["SkyDome", "Ground", "house_01", "house_02", "house_03", "house_04"];
        let guess = |name| similar(name, known.into_iter());
        assert_eq!(guess("skydom"), ["SkyDome"]);
        assert_eq!(guess("house").len(), 3);
        assert!(guess("xyz").is_empty());
    }
}
