//! What becomes of a paper's claim when it is measured.
//!
//! A verdict is nothing but a claim with its source, what ran, and comparisons of measured numbers with
//! limits whose origin is told: it holds if all of them do, and its reason is written from the same
//! numbers. There is no other way to make one. What cannot come out otherwise is a [`Fact`].

use serde::{Deserialize, Serialize};

mod comparison;
mod saying;

pub use comparison::{
    Change, Comparison, IntoMeasured, Origin, Relation, Unfounded, at_least, at_most, less, more,
};
pub use saying::{Document, Fact, Ran, Saying, brabec, csm, esm, ours, slides, spsm};

/// A claim and what decides it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// What is claimed, in our words and of our scenes.
    pub claim: String,
    /// Whose claim it is.
    pub source: Saying,
    /// What ran to judge it; `None` where nothing did.
    pub ran: Option<Ran>,
    /// All of these have to hold.
    pub comparisons: Vec<Comparison>,
    /// Why there is nothing to compare, such as a technique that this program lacks.
    pub missing: Option<String>,
}

/// How a verdict ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Every comparison holds.
    Holds,
    /// At least one does not.
    Differs,
    /// Something was not measured, or the spread of what was measured decides.
    Open,
}

impl Verdict {
    /// A claim that holds if all comparisons do.
    #[must_use]
    pub fn new(
        source: Saying,
        claim: impl Into<String>,
        ran: Ran,
        comparisons: impl Into<Vec<Comparison>>,
    ) -> Self {
        let comparisons = comparisons.into();
        Self { claim: claim.into(), source, ran: Some(ran), comparisons, missing: None }
    }

    /// A claim that cannot be judged, and why.
    #[must_use]
    pub fn open(source: Saying, claim: impl Into<String>, missing: impl Into<String>) -> Self {
        let missing = Some(missing.into());
        Self { claim: claim.into(), source, ran: None, comparisons: Vec::new(), missing }
    }

    /// How it ends.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        if self.missing.is_some() || self.comparisons.is_empty() {
            return Outcome::Open;
        }
        let answers = || self.comparisons.iter().map(Comparison::holds);
        match () {
            () if answers().any(|a| a == Some(false)) => Outcome::Differs,
            () if answers().any(|a| a.is_none()) => Outcome::Open,
            () => Outcome::Holds,
        }
    }

    /// The reason in words: all comparisons if it holds, else those that do not.
    #[must_use]
    pub fn reason(&self) -> String {
        if let Some(missing) = &self.missing {
            return missing.clone();
        }
        let outcome = self.outcome();
        let tells = |c: &&Comparison| match outcome {
            Outcome::Holds => true,
            Outcome::Differs => c.holds() == Some(false),
            Outcome::Open => c.holds().is_none(),
        };
        let parts: Vec<String> = self.comparisons.iter().filter(tells).map(Comparison::says).collect();
        parts.join("; ")
    }
}

impl Outcome {
    /// One word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Holds => "holds",
            Self::Differs => "differs",
            Self::Open => "open",
        }
    }
}

/// Three or four significant digits, without trailing zeros.
#[must_use]
pub fn number(value: f64) -> String {
    let magnitude = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !(-6..9).contains(&magnitude) {
        return format!("{value:.2e}");
    }
    let text = format!("{value:.0$}", (3 - magnitude).clamp(0, 9) as usize);
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

/// Whether the cells of a table come in the paper's order: a rank correlation of `min` or more.
pub(crate) fn same_order(source: Saying, ran: Ran, ours: &[f64], paper: &[f64], min: f64) -> Verdict {
    let correlation = crate::numbers::rank_correlation(ours, paper);
    let enough =
        at_least("rank correlation of our ratios with the paper's", correlation, min.to_string(), min);
    Verdict::new(
        source,
        "The cells of the table come in the paper's order",
        ran,
        [enough.ours("a rank correlation of this size leaves few pairs of cells in another order")],
    )
}

#[cfg(test)]
mod tests;
