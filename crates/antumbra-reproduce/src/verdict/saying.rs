//! Where a claim comes from, what ran to judge it, and what cannot be judged.

use antumbra::technique;
use serde::{Deserialize, Serialize};

/// A document whose claims are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Document {
    /// Brabec and Seidel 2001.
    Brabec,
    /// Annen et al. 2007.
    Csm,
    /// Annen et al. 2008.
    Esm,
    /// Lecocq et al. 2014.
    Spsm,
    /// The lecture slides.
    Slides,
}

/// Whose claim a claim is. There is none without a source.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Saying {
    /// A document's.
    Document {
        /// Which one.
        document: Document,
        /// Section, figure, table or slide.
        place: String,
        /// Its sentence.
        quote: String,
    },
    /// Of no document.
    Ours {
        /// Why it is judged all the same.
        reason: String,
    },
}

/// A claim of [`Document::Brabec`].
pub fn brabec(place: &str, quote: &str) -> Saying {
    says(Document::Brabec, place, quote)
}

/// A claim of [`Document::Csm`].
pub fn csm(place: &str, quote: &str) -> Saying {
    says(Document::Csm, place, quote)
}

/// A claim of [`Document::Esm`].
pub fn esm(place: &str, quote: &str) -> Saying {
    says(Document::Esm, place, quote)
}

/// A claim of [`Document::Spsm`].
pub fn spsm(place: &str, quote: &str) -> Saying {
    says(Document::Spsm, place, quote)
}

/// A claim of [`Document::Slides`].
pub fn slides(place: &str, quote: &str) -> Saying {
    says(Document::Slides, place, quote)
}

/// A claim that no document makes.
pub fn ours(reason: &str) -> Saying {
    Saying::Ours { reason: reason.into() }
}

fn says(document: Document, place: &str, quote: &str) -> Saying {
    Saying::Document { document, place: place.into(), quote: quote.into() }
}

impl Document {
    /// Authors and year.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Brabec => "Brabec and Seidel 2001",
            Self::Csm => "Annen et al. 2007",
            Self::Esm => "Annen et al. 2008",
            Self::Spsm => "Lecocq et al. 2014",
            Self::Slides => "the slides",
        }
    }
}

impl Saying {
    /// In one line.
    #[must_use]
    pub fn text(&self) -> String {
        match self {
            Self::Document { document, place, quote } => format!("“{quote}” ({}, {place})", document.name()),
            Self::Ours { reason } => format!("No document says this; {reason}"),
        }
    }

    /// Whether a document makes the claim.
    #[must_use]
    pub fn is_of_a_document(&self) -> bool {
        matches!(self, Self::Document { .. })
    }
}

/// What ran: a scene with its sizes, and techniques with all their settings.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Ran(String);

impl Ran {
    /// Techniques, by their specs, on a scene.
    pub fn new<S: AsRef<str>>(scene: &str, specs: impl IntoIterator<Item = S>) -> Self {
        let all: Vec<String> = specs.into_iter().map(|spec| settings(spec.as_ref())).collect();
        Self(format!("{scene}: {}", all.join("; ")))
    }

    /// What is no technique on a scene, such as a sum in double precision.
    pub fn other(what: impl Into<String>) -> Self {
        Self(what.into())
    }

    /// In one line.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.0
    }
}

/// A technique's name and all its settings, those that the spec leaves out too.
fn settings(spec: &str) -> String {
    let Ok(mut technique) = technique::parse(spec) else { return spec.into() };
    let name = technique.about().name;
    let all: Vec<String> =
        technique.parameters().iter().map(|p| format!("{}={}", p.name, p.value())).collect();
    if all.is_empty() { name.into() } else { format!("{name} ({})", all.join(", ")) }
}

/// What a source says and cannot come out otherwise here: it is shown, and not counted among verdicts.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Fact {
    /// What is so.
    pub claim: String,
    /// Who says it.
    pub source: Saying,
    /// What was found, with its numbers.
    pub found: String,
    /// Why no measurement could have ended otherwise.
    pub because: String,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_ran_tells_settings_that_the_spec_leaves_out() {
        let ran = Ran::new("fence, 640×480", ["vsm.kernel=7", "nothing.like=this"]);
        assert!(ran.text().starts_with("fence, 640×480: vsm (") && ran.text().contains("kernel=7"));
        assert!(ran.text().contains("sampling=") && ran.text().ends_with("; nothing.like=this"));
    }

    #[test]
    fn sources_name_document_and_place() {
        let text = csm("§5", "CSMs are slower").text();
        assert_eq!(text, "“CSMs are slower” (Annen et al. 2007, §5)");
        assert!(!ours("of interest").is_of_a_document());
    }
}
