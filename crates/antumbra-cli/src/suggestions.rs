//! Words that are usual for an argument: techniques, scenes and targets.

use antumbra::technique;
use antumbra_reproduce::catalogue;
use antumbra_scene::procedural;
use clap::{
    Arg, Command, Error,
    builder::{PossibleValue, TypedValueParser},
    error::ErrorKind,
};
use std::ffi::OsStr;

/// A text argument whose usual values shells offer, while every other text is taken as well.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Suggested(fn() -> Vec<&'static str>);

/// Names of techniques and of groups of them.
pub(crate) const TECHNIQUES: Suggested = Suggested(|| {
    let names = technique::all().into_iter().map(|technique| technique.about().name);
    names.chain(["all", "all-comparison", "all-basis", "all-geometry"]).collect()
});
/// Names of techniques, and `truth`.
pub(crate) const TECHNIQUE_OR_TRUTH: Suggested = Suggested(|| {
    let names = technique::all().into_iter().map(|technique| technique.about().name);
    names.chain(["truth"]).collect()
});
/// Names of built-in scenes.
pub(crate) const SCENES: Suggested = Suggested(|| procedural::all().iter().map(|scene| scene.name).collect());
/// What can be reproduced.
pub(crate) const TARGETS: Suggested = Suggested(|| {
    let sources =
        catalogue::SOURCES.iter().map(|source| source.targets).filter_map(|targets| targets.first());
    let sources = sources.filter_map(|target| target.id.split('/').next());
    catalogue::all().map(|target| target.id).chain(sources).chain(["all"]).collect()
});

impl Suggested {
    /// The usual values.
    pub(crate) fn words(self) -> Vec<&'static str> {
        (self.0)()
    }
}

impl TypedValueParser for Suggested {
    type Value = String;

    fn parse_ref(&self, _: &Command, _: Option<&Arg>, value: &OsStr) -> Result<String, Error> {
        value.to_str().map(String::from).ok_or_else(|| {
            Error::raw(ErrorKind::InvalidUtf8, format!("'{}' is not Unicode text\n", value.to_string_lossy()))
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new(self.words().into_iter().map(PossibleValue::new)))
    }
}
