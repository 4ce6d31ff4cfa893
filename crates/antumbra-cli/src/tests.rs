//! The command lines that documents show are command lines that this program takes.

use crate::arguments::Arguments;
use antumbra::technique;
use clap::Parser;
use std::path::Path;

/// What follows `antumbra` in every line of a document, or of the Makefile, that runs it.
fn commands(document: &str) -> Vec<Vec<String>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(document);
    let text = std::fs::read_to_string(path).unwrap().replace("\\\n", " ");
    let runs = text.lines().filter(|line| line.contains("run --release"));
    let arguments = |line: &str| Some(line.split(" #").next()?.split_once(" -- ")?.1.to_string());
    let words = |line: String| line.split_whitespace().map(String::from).collect();
    runs.filter_map(arguments).map(words).collect()
}

#[test]
fn documents_show_commands_that_are_taken() {
    let names: Vec<&str> = technique::all().iter().map(|technique| technique.about().name).collect();
    let mut seen = 0;
    for document in ["README.md", "CONTRIBUTING.md", "docs/bias.md", "docs/performance.md", "Makefile"] {
        for words in commands(document) {
            seen += 1;
            let program = ["antumbra".to_string()];
            let parsed = Arguments::try_parse_from(program.iter().chain(&words));
            assert!(parsed.is_ok(), "{document}: {}: {}", words.join(" "), parsed.unwrap_err());
            let is_spec = |word: &&String| match word.split_once('.') {
                None => names.contains(&word.as_str()),
                Some((name, settings)) => names.contains(&name) && settings.contains('='),
            };
            for spec in words.iter().filter(is_spec) {
                technique::parse(spec).unwrap();
            }
        }
    }
    assert!(seen > 12, "{seen} are not all command lines that documents show");
    assert!(Arguments::try_parse_from(["antumbra", "compare", "--no-such-option"]).is_err());
}
