//! What the documents name must be there: files, links, make's targets, versions.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use std::{
    fs,
    path::{Path, PathBuf},
};

const DOCUMENTS: [&str; 6] = [
    "README.md",
    "ARCHITECTURE.md",
    "CONTRIBUTING.md",
    "docs/bias.md",
    "docs/performance.md",
    "docs/sampling.md",
];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap()
}

/// Files and folders of the project, from its root, with a slash in front and one behind folders.
fn listing() -> Vec<String> {
    fn walk(folder: &Path, root: &Path, found: &mut Vec<String>) {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = entry.path();
            let name = entry.file_name().into_string().unwrap();
            if name.starts_with(".git") || name == "target" || name == "node_modules" {
                continue;
            }
            let end = if path.is_dir() { "/" } else { "" };
            found.push(format!("/{}{end}", path.strip_prefix(root).unwrap().display()));
            if path.is_dir() {
                walk(&path, root, found);
            }
        }
    }
    let (root, mut found) = (root(), Vec::new());
    walk(&root, &root, &mut found);
    found
}

/// What stands between single backticks, code blocks left out.
fn quoted(text: &str) -> Vec<&str> {
    let prose = text.split("```").step_by(2);
    prose.flat_map(|part| part.split('`').skip(1).step_by(2)).collect()
}

/// Whether a quotation is the name of a file or a folder of the project. The placeholder x stands for a
/// technique that is yet to be written; the program writes the files of a report.
fn is_path(quotation: &str) -> bool {
    const ENDS: [&str; 10] = [".rs", ".wgsl", ".in", ".md", ".toml", ".json", ".sh", ".html", ".js", "/"];
    let placeholder = quotation.split('/').any(|part| part == "x" || part.starts_with("x."));
    let written = ["results.json", "index.html"].contains(&quotation);
    let folder = quotation.starts_with("crates/") || quotation.starts_with("docs/");
    (folder || ENDS.iter().any(|end| quotation.ends_with(end)))
        && !placeholder
        && !written
        && !quotation.contains([' ', '<', '*'])
}

#[test]
fn files_are_where_documents_say() {
    let listing = listing();
    let there = |path: &str| {
        let ends = [format!("/{path}"), format!("/{path}/")];
        listing.iter().any(|found| ends.iter().any(|end| found.ends_with(end)))
    };
    let mut seen = 0;
    for document in DOCUMENTS {
        let text = read(document);
        for path in quoted(&text).into_iter().filter(|quotation| is_path(quotation)) {
            seen += 1;
            assert!(there(path), "{document} names `{path}`, which is not there");
        }
    }
    assert!(seen > 20, "{seen} paths are not all that the documents name");
    assert!(!there("tests/no_such_file.rs"));
}

#[test]
fn links_lead_somewhere() {
    for document in DOCUMENTS {
        let text = read(document);
        let folder = root().join(document).parent().unwrap().to_path_buf();
        for link in text.split("](").skip(1).filter_map(|rest| rest.split_once(')')) {
            let target = link.0.split('#').next().unwrap();
            let there = target.is_empty() || target.starts_with("https://") || folder.join(target).exists();
            assert!(there, "{document} links to {target}, which is not there");
        }
    }
}

#[test]
fn make_has_the_targets_that_documents_name() {
    let makefile = read("Makefile");
    let mut seen = 0;
    for document in DOCUMENTS {
        let text = read(document);
        let shell = text.lines().filter(|line| line.starts_with("make "));
        let prose = quoted(&text).into_iter().filter(|quotation| quotation.starts_with("make "));
        for command in shell.chain(prose) {
            seen += 1;
            let target = command.split_whitespace().nth(1).unwrap();
            let there = makefile.lines().any(|line| line.starts_with(&format!("{target}:")));
            assert!(there, "{document} says `{command}`, and the Makefile has no {target}");
        }
    }
    assert!(seen > 3, "{seen} commands are not all that the documents name");
}

/// `cargo run` at the root, which documents say, means the program `antumbra`, whatever other programs there are.
#[test]
fn one_program_is_run() {
    assert!(read("Cargo.toml").contains("\ndefault-members = [\"crates/antumbra-cli\"]\n"));
    let manifest = read("crates/antumbra-cli/Cargo.toml");
    assert_eq!(manifest.matches("[[bin]]").count(), 1);
    assert!(manifest.contains("name = \"antumbra\""));
}

/// The first row of the table of versions is that of the manifest, in the README and in the crate's
/// documentation.
#[test]
fn versions_are_those_of_the_manifest() {
    let in_manifest = |path: &str, key: &str| {
        let manifest = read(path);
        let line = manifest.lines().find(|line| line.starts_with(&format!("{key} = "))).unwrap();
        line.split('"').nth(1).unwrap().to_string()
    };
    let value = |key| in_manifest("Cargo.toml", key);
    let short = |version: String| version.splitn(3, '.').take(2).collect::<Vec<_>>().join(".");
    let antumbra = short(value("version"));
    let rust = in_manifest("crates/antumbra/Cargo.toml", "rust-version");
    let [wgpu, glam] = ["wgpu", "glam"].map(value);
    let row = format!("| {antumbra} | {wgpu} | {glam} | {rust} |");
    for document in ["README.md", "crates/antumbra/src/lib.rs"] {
        let text = read(document);
        let mut lines = text.lines().map(|line| line.trim_start_matches("//! "));
        lines.find(|line| *line == "| antumbra | wgpu | glam | Rust |").unwrap();
        assert_eq!(lines.nth(1).unwrap(), row, "{document}");
    }
    let readme = read("README.md");
    for line in [format!("antumbra = \"{antumbra}\""), format!("wgpu = \"{wgpu}\"")] {
        assert!(readme.contains(&line), "the README does not say {line}");
    }
}

/// What a registry shows of a crate.
#[test]
fn published_crates_say_what_they_are() {
    let mut published = 0;
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let path = entry.unwrap().path().join("Cargo.toml");
        let manifest = fs::read_to_string(&path).unwrap();
        if manifest.contains("publish = false") {
            continue;
        }
        published += 1;
        let keys = ["description", "license", "readme", "documentation", "keywords", "categories"];
        for key in keys.into_iter().chain(["rust-version"]) {
            let given =
                |line: &str| line.starts_with(&format!("{key} ")) || line.starts_with(&format!("{key}."));
            assert!(manifest.lines().any(given), "{} has no {key}", path.display());
        }
    }
    assert!(published > 4, "{published} are not all crates");
}
