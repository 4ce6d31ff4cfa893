//! The list of all sources and their targets.

use crate::target::{Source, Target};

/// Everything that can be reproduced.
pub const SOURCES: &[Source] = &[
    crate::table::SOURCE,
    crate::brabec::SOURCE,
    crate::slides::SOURCE,
    crate::csm::SOURCE,
    crate::esm::SOURCE,
    crate::spsm::SOURCE,
];

/// Every target.
pub fn all() -> impl Iterator<Item = &'static Target> {
    SOURCES.iter().flat_map(|source| source.targets)
}

/// The source of a target, if it is one of them.
#[must_use]
pub fn source_of(target: &Target) -> Option<&'static Source> {
    SOURCES.iter().find(|source| source.targets.iter().any(|t| t.id == target.id))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn targets_have_names_of_their_own_under_their_sources() {
        let ids: BTreeSet<&str> = all().map(|t| t.id).collect();
        assert_eq!(ids.len(), all().count());
        for source in SOURCES {
            for target in source.targets {
                let (key, rest) = target.id.split_once('/').unwrap_or((target.id, "x"));
                assert!(key == source.key && !rest.is_empty(), "{}", target.id);
                let plain = target
                    .id
                    .chars()
                    .all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || "/-".contains(c));
                assert!(
                    plain && target.seconds[0] >= target.seconds[1] && target.seconds[1] > 0,
                    "{}",
                    target.id
                );
                for text in [target.title, target.paper, target.ours] {
                    assert!(text.len() > 8, "{}: {text}", target.id);
                }
            }
        }
    }
}
