//! What shells offer when a word is completed: techniques, scenes and targets beside clap's own options.

use crate::arguments::Arguments;
use antumbra::technique;
use antumbra_reproduce::catalogue;
use antumbra_scene::procedural;
use clap::{
    Arg, Command, CommandFactory, Error,
    builder::{PossibleValue, TypedValueParser},
    error::ErrorKind,
};
use clap_complete::Shell;
use std::ffi::OsStr;

/// A text argument whose usual values shells offer, while every other text is taken as well.
#[derive(Debug, Clone)]
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

impl TypedValueParser for Suggested {
    type Value = String;

    fn parse_ref(&self, _: &Command, _: Option<&Arg>, value: &OsStr) -> Result<String, Error> {
        value.to_str().map(String::from).ok_or_else(|| {
            Error::raw(ErrorKind::InvalidUtf8, format!("'{}' is not Unicode text\n", value.to_string_lossy()))
        })
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.0)().into_iter().map(PossibleValue::new)))
    }
}

/// The script that teaches a shell to complete this program's arguments.
pub(crate) fn script(shell: Shell) -> String {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "antumbra", &mut script);
    let script = String::from_utf8_lossy(&script).into_owned();
    match shell {
        Shell::Zsh => with_files(&script),
        Shell::Fish => script + &fish_words(),
        _ => script,
    }
}

/// Commands whose words are scenes.
const SCENE_COMMANDS: &str = "compare render flicker bench bias kernels maps";

/// Words, as opposed to options, which fish's script leaves out.
fn fish_words() -> String {
    let line = |commands: &str, words: &Suggested| {
        let words = (words.0)().join(" ");
        format!("complete -c antumbra -n \"__fish_seen_subcommand_from {commands}\" -a \"{words}\"\n")
    };
    [(SCENE_COMMANDS, SCENES), ("curve techniques", TECHNIQUES), ("reproduce", TARGETS)]
        .iter()
        .map(|(commands, words)| line(commands, words))
        .collect()
}

/// Where zsh offers scenes it shall offer files too. Other shells do by themselves.
fn with_files(script: &str) -> String {
    let names = (SCENES.0)().join(" ");
    let both = format!("{{_alternative \"scenes:scene:({names})\" \"files:file:_files\"}}");
    script.replace(&format!(":({names})'"), &format!(":{both}'"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[test]
    fn shells_offer_techniques_scenes_and_targets() {
        for shell in [Shell::Bash, Shell::Zsh, Shell::Fish] {
            let script = script(shell);
            for name in ["evsm", "all-geometry", "truth", "fence", "csm/figure-9"] {
                assert!(script.contains(name), "{shell}: {name}");
            }
        }
        assert!(script(Shell::Zsh).contains("files:file:_files"));
    }

    #[test]
    fn other_words_are_taken_and_help_stays_short() {
        assert!(Arguments::try_parse_from(["antumbra", "compare", "x.glb", "-t", "esm.c=60"]).is_ok());
        let help = Arguments::try_parse_from(["antumbra", "compare", "--help"]).unwrap_err().to_string();
        assert!(!help.contains("possible values: hard"), "{help}");
    }
}
