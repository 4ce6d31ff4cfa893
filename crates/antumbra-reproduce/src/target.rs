//! What can be reproduced.

use crate::{bench::Bench, page::Page};
use anyhow::Result;

/// A table, a figure or the claims of a paper.
#[derive(Debug, Clone, Copy)]
pub struct Target {
    /// Source and what of it, such as `csm/figure-9`.
    pub id: &'static str,
    /// What it is about, in a few words.
    pub title: &'static str,
    /// What the paper did.
    pub paper: &'static str,
    /// What we run instead.
    pub ours: &'static str,
    /// Seconds that it takes on two busy cores without a graphics card, among all others, with which it
    /// shares measurements: in full, and in a quick run.
    pub seconds: [u32; 2],
    /// Measures and judges.
    pub run: fn(&Bench<'_>) -> Result<Page>,
}

/// A paper, or what else has targets.
#[derive(Debug, Clone, Copy)]
pub struct Source {
    /// First part of the targets' names.
    pub key: &'static str,
    /// Author, year and title.
    pub name: &'static str,
    /// Its targets, in the paper's order.
    pub targets: &'static [Target],
}

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

impl Target {
    /// Name of its page.
    #[must_use]
    pub fn file(&self) -> String {
        format!("{}.html", self.id.replace('/', "-"))
    }

    /// The paper that it is from.
    #[must_use]
    pub fn source(&self) -> Option<&'static Source> {
        SOURCES.iter().find(|s| s.targets.iter().any(|t| t.id == self.id))
    }
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
