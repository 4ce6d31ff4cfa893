//! What shells offer when a word is completed: techniques, scenes and targets beside clap's own options.

use crate::{
    arguments::Arguments,
    suggestions::{SCENES, Suggested, TARGETS, TECHNIQUES},
};
use clap::CommandFactory;
use clap_complete::Shell;

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
    let line = |commands: &str, words: Suggested| {
        let words = words.words().join(" ");
        format!("complete -c antumbra -n \"__fish_seen_subcommand_from {commands}\" -a \"{words}\"\n")
    };
    [(SCENE_COMMANDS, SCENES), ("curve techniques", TECHNIQUES), ("reproduce", TARGETS)]
        .iter()
        .map(|(commands, words)| line(commands, *words))
        .collect()
}

/// Where zsh offers scenes it shall offer files too. Other shells do by themselves.
fn with_files(script: &str) -> String {
    let names = SCENES.words().join(" ");
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
