//! What can be reproduced.

use crate::{page::Page, workbench::Workbench};
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
    pub run: fn(&Workbench<'_>) -> Result<Page>,
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

impl Target {
    /// Name of its page.
    #[must_use]
    pub fn file(&self) -> String {
        format!("{}.html", self.id.replace('/', "-"))
    }
}
