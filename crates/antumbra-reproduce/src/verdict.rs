//! What becomes of a paper's claim when it is measured.
//!
//! A verdict is nothing but a claim and comparisons of measured numbers: it holds if all of them do,
//! and its reason is written from the same numbers. There is no other way to make one.

use serde::{Deserialize, Serialize};

/// Which way a comparison goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Relation {
    /// The left number is smaller.
    Less,
    /// The left number is not larger.
    AtMost,
    /// The left number is larger.
    More,
    /// The left number is not smaller.
    AtLeast,
}

/// Two numbers and how they have to compare.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// What the left number is.
    pub what: String,
    /// Its value; `None` where it could not be measured.
    pub value: Option<f64>,
    /// How it has to compare.
    pub relation: Relation,
    /// What the right number is.
    pub than: String,
    /// Its value.
    pub limit: Option<f64>,
}

/// A claim and what decides it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// What the paper says.
    pub claim: String,
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
    /// Something was not measured.
    Open,
}

fn compare(
    what: impl Into<String>,
    value: impl Into<Option<f64>>,
    relation: Relation,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Comparison {
    // Numbers that JSON cannot hold were not measured.
    let finite = |v: Option<f64>| v.filter(|v| v.is_finite());
    Comparison {
        what: what.into(),
        value: finite(value.into()),
        relation,
        than: than.into(),
        limit: finite(limit.into()),
    }
}

/// `value` has to be less than `limit`.
pub fn less(
    what: impl Into<String>,
    value: impl Into<Option<f64>>,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Comparison {
    compare(what, value, Relation::Less, than, limit)
}

/// `value` has to be at most `limit`.
pub fn at_most(
    what: impl Into<String>,
    value: impl Into<Option<f64>>,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Comparison {
    compare(what, value, Relation::AtMost, than, limit)
}

/// `value` has to be more than `limit`.
pub fn more(
    what: impl Into<String>,
    value: impl Into<Option<f64>>,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Comparison {
    compare(what, value, Relation::More, than, limit)
}

/// `value` has to be at least `limit`.
pub fn at_least(
    what: impl Into<String>,
    value: impl Into<Option<f64>>,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Comparison {
    compare(what, value, Relation::AtLeast, than, limit)
}

impl Comparison {
    /// Whether it holds; `None` if a number is missing.
    #[must_use]
    pub fn holds(&self) -> Option<bool> {
        let (value, limit) = (self.value?, self.limit?);
        Some(match self.relation {
            Relation::Less => value < limit,
            Relation::AtMost => value <= limit,
            Relation::More => value > limit,
            Relation::AtLeast => value >= limit,
        })
    }

    /// The reason in words, with the numbers.
    #[must_use]
    pub fn says(&self) -> String {
        let number = |v: Option<f64>| v.map_or("not measured".into(), number);
        let is = match (self.relation, self.holds()) {
            (_, None) => "to be compared with",
            (Relation::Less, Some(true)) => "is less than",
            (Relation::Less, Some(false)) => "is not less than",
            (Relation::AtMost, Some(true)) => "is at most",
            (Relation::AtMost, Some(false)) => "is more than",
            (Relation::More, Some(true)) => "is more than",
            (Relation::More, Some(false)) => "is not more than",
            (Relation::AtLeast, Some(true)) => "is at least",
            (Relation::AtLeast, Some(false)) => "is less than",
        };
        format!("{} ({}) {is} {} ({})", self.what, number(self.value), self.than, number(self.limit))
    }
}

impl Verdict {
    /// A claim that holds if all comparisons do.
    #[must_use]
    pub fn new(claim: impl Into<String>, comparisons: impl Into<Vec<Comparison>>) -> Self {
        Self { claim: claim.into(), comparisons: comparisons.into(), missing: None }
    }

    /// A claim that cannot be judged, and why.
    #[must_use]
    pub fn open(claim: impl Into<String>, missing: impl Into<String>) -> Self {
        Self { claim: claim.into(), comparisons: Vec::new(), missing: Some(missing.into()) }
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

/// Whether the cells of a table come in the paper's order: a rank correlation of `least` or more.
pub(crate) fn same_order(ours: &[f64], paper: &[f64], min: f64) -> Verdict {
    let correlation = crate::numbers::rank_correlation(ours, paper);
    Verdict::new(
        "The cells of the table come in the paper's order",
        [at_least("rank correlation of our ratios with the paper's", correlation, min.to_string(), min)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_verdict_holds_only_if_every_comparison_does() {
        let good = less("a", 1.0, "b", 2.0);
        let bad = at_least("c", 3.0, "d", 4.0);
        let unknown = more("e", None, "f", 1.0);
        let outcome = |c: &[&Comparison]| {
            let all: Vec<Comparison> = c.iter().map(|c| (*c).clone()).collect();
            Verdict::new("claim", all).outcome()
        };
        assert_eq!(outcome(&[&good]), Outcome::Holds);
        assert_eq!(outcome(&[&good, &bad]), Outcome::Differs);
        assert_eq!(outcome(&[&good, &unknown]), Outcome::Open);
        assert_eq!(outcome(&[&unknown, &bad]), Outcome::Differs);
        assert_eq!(outcome(&[]), Outcome::Open);
        assert_eq!(Verdict::open("claim", "nothing").outcome(), Outcome::Open);
    }

    #[test]
    fn relations_are_what_they_say() {
        for (value, limit, answers) in [
            (1.0, 2.0, [true, true, false, false]),
            (2.0, 2.0, [false, true, false, true]),
            (3.0, 2.0, [false, false, true, true]),
        ] {
            let made = [less, at_most, more, at_least].map(|f| f("v", Some(value), "l", Some(limit)));
            assert_eq!(made.map(|c| c.holds() == Some(true)), answers, "{value} {limit}");
        }
        assert_eq!(less("v", f64::NAN, "l", 1.0).holds(), None);
    }

    #[test]
    fn the_reason_names_what_decided() {
        let verdict = Verdict::new("c", [less("x", 1.0, "y", 2.0), more("z", 0.125, "w", 0.25)]);
        assert_eq!(verdict.reason(), "z (0.125) is not more than w (0.25)");
        let verdict = Verdict::new("c", [less("x", 1.0, "y", 2.0)]);
        assert_eq!(verdict.reason(), "x (1) is less than y (2)");
    }

    #[test]
    fn numbers_read_well() {
        let all = [0.0, 12_345.6, 0.123_46, 99.63, 2.0, -0.5, 1e-9].map(number);
        assert_eq!(all, ["0", "12346", "0.1235", "99.63", "2", "-0.5", "1.00e-9"]);
    }
}
