//! Two numbers, how they have to compare, and where the limit comes from.

use super::number;
use crate::numbers::Measured;
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

/// Where a limit comes from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// A number of the document: where it stands.
    Document(String),
    /// The sentence says which of two things is larger, and gives no number.
    Sentence,
    /// Chosen here: the reason.
    Ours(String),
}

/// A limit that was another one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Change {
    /// What it was.
    pub before: String,
    /// Why it is not any more.
    pub reason: String,
}

/// Two numbers and how they have to compare.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Comparison {
    /// What the left number is.
    pub what: String,
    /// Its value; `None` where it could not be measured.
    pub value: Option<f64>,
    /// Between which two it lies surely; both the value itself if it comes out the same every time.
    pub range: Option<[f64; 2]>,
    /// How it has to compare.
    pub relation: Relation,
    /// What the right number is.
    pub than: String,
    /// Its value.
    pub limit: Option<f64>,
    /// Where the limit comes from.
    pub origin: Origin,
    /// What the limit was before, oldest first.
    pub changes: Vec<Change>,
}

/// A comparison that lacks the origin of its limit.
#[derive(Debug, Clone)]
#[must_use = "say where the limit comes from"]
pub struct Unfounded {
    what: String,
    value: Option<Measured>,
    relation: Relation,
    than: String,
    limit: Option<f64>,
}

fn compare(
    what: impl Into<String>,
    value: impl IntoMeasured,
    relation: Relation,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Unfounded {
    // Numbers that JSON cannot hold were not measured.
    let limit = limit.into().filter(|v| v.is_finite());
    Unfounded { what: what.into(), value: value.into_measured(), relation, than: than.into(), limit }
}

/// What can stand on the left: a number, one with a range, or none.
pub trait IntoMeasured {
    /// As a measurement; `None` if it is none.
    fn into_measured(self) -> Option<Measured>;
}

impl IntoMeasured for f64 {
    fn into_measured(self) -> Option<Measured> {
        Measured::exact(self).into_measured()
    }
}

impl IntoMeasured for Measured {
    fn into_measured(self) -> Option<Measured> {
        [self.value, self.low, self.high].iter().all(|v| v.is_finite()).then_some(self)
    }
}

impl<T: IntoMeasured> IntoMeasured for Option<T> {
    fn into_measured(self) -> Option<Measured> {
        self.and_then(IntoMeasured::into_measured)
    }
}

/// `value` has to be less than `limit`.
pub fn less(
    what: impl Into<String>,
    value: impl IntoMeasured,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Unfounded {
    compare(what, value, Relation::Less, than, limit)
}

/// `value` has to be at most `limit`.
pub fn at_most(
    what: impl Into<String>,
    value: impl IntoMeasured,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Unfounded {
    compare(what, value, Relation::AtMost, than, limit)
}

/// `value` has to be more than `limit`.
pub fn more(
    what: impl Into<String>,
    value: impl IntoMeasured,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Unfounded {
    compare(what, value, Relation::More, than, limit)
}

/// `value` has to be at least `limit`.
pub fn at_least(
    what: impl Into<String>,
    value: impl IntoMeasured,
    than: impl Into<String>,
    limit: impl Into<Option<f64>>,
) -> Unfounded {
    compare(what, value, Relation::AtLeast, than, limit)
}

impl Unfounded {
    /// The limit is a number of the document, which stands at `place`.
    pub fn document(self, place: impl Into<String>) -> Comparison {
        self.from(Origin::Document(place.into()))
    }

    /// The claim's sentence says that much, without a number.
    pub fn sentence(self) -> Comparison {
        self.from(Origin::Sentence)
    }

    /// The limit is chosen here for a reason.
    pub fn ours(self, reason: impl Into<String>) -> Comparison {
        self.from(Origin::Ours(reason.into()))
    }

    fn from(self, origin: Origin) -> Comparison {
        let Self { what, value, relation, than, limit } = self;
        Comparison {
            what,
            value: value.map(|m| m.value),
            range: value.map(|m| [m.low, m.high]),
            relation,
            than,
            limit,
            origin,
            changes: Vec::new(),
        }
    }
}

impl Comparison {
    /// The limit, or what is compared, was another one before.
    #[must_use]
    pub fn was(mut self, before: impl Into<String>, reason: impl Into<String>) -> Self {
        self.changes.push(Change { before: before.into(), reason: reason.into() });
        self
    }

    /// Whether it holds; `None` if a number is missing, or where the ends of the range disagree.
    #[must_use]
    pub fn holds(&self) -> Option<bool> {
        let ([low, high], limit) = (self.range?, self.limit?);
        let holds = |value: f64| match self.relation {
            Relation::Less => value < limit,
            Relation::AtMost => value <= limit,
            Relation::More => value > limit,
            Relation::AtLeast => value >= limit,
        };
        (holds(low) == holds(high)).then(|| holds(low))
    }

    /// Whether its value comes out the same every time.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.range.is_none_or(|[low, high]| low == high)
    }

    /// The reason in words, with the numbers.
    #[must_use]
    pub fn says(&self) -> String {
        let text = |v: Option<f64>| v.map_or("not measured".into(), number);
        let value = match self.range {
            Some([low, high]) if low < high => {
                format!("{}, surely within {} to {}", text(self.value), number(low), number(high))
            }
            _ => text(self.value),
        };
        let is = match (self.relation, self.holds()) {
            (_, None) if self.value.is_some() && self.limit.is_some() => "cannot be told from",
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
        format!("{} ({value}) {is} {} ({})", self.what, self.than, text(self.limit))
    }

    /// Where its limit comes from, and what it was.
    #[must_use]
    pub fn limit_says(&self) -> String {
        let origin = match &self.origin {
            Origin::Document(place) => format!("the document's, {place}"),
            Origin::Sentence => "the sentence says which is larger".into(),
            Origin::Ours(reason) => format!("ours, {reason}"),
        };
        let changes: String =
            self.changes.iter().map(|c| format!(" Before: {}; {}.", c.before, c.reason)).collect();
        format!("{}: {origin}.{changes}", self.than)
    }
}
