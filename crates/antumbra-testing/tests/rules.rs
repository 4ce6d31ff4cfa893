//! Rules of CONTRIBUTING.md that can be asked: files and functions are short, every program of tests is run,
//! the renderer never waits.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use std::path::{Path, PathBuf};

/// Largest number of lines of a file, tests included.
const MAX_FILE_LINES: usize = 400;
/// Largest number of lines of a function, from its signature to its closing brace.
const MAX_FUNCTION_LINES: usize = 60;

#[test]
fn files_and_functions_are_short() {
    let files: Vec<PathBuf> = rust_files(&crates_folder());
    assert!(files.len() > 200, "{files:?}");
    let read = |path: &PathBuf| long(&path.display().to_string(), &std::fs::read_to_string(path).unwrap());
    let long: Vec<String> = files.iter().flat_map(read).collect();
    assert!(long.is_empty(), "{}", long.join("\n"));
}

#[test]
fn what_is_too_long_is_noticed() {
    let body = "        let x = 1;\n";
    let function = |lines: usize| {
        format!("    pub(crate) fn f(\n        a: u32,\n    ) {{\n{}    }}\n", body.repeat(lines))
    };
    assert!(long("a.rs", &format!("impl A {{\n{}}}\n", function(MAX_FUNCTION_LINES - 4))).is_empty());
    let found = long("a.rs", &format!("impl A {{\n{}}}\n", function(MAX_FUNCTION_LINES - 3)));
    assert_eq!(found, ["a.rs:2: function f has 61 lines, allowed are 60: take a step out of it"]);
    assert!(long("b.rs", &"// x\n".repeat(MAX_FILE_LINES)).is_empty());
    assert_eq!(long("b.rs", &"// x\n".repeat(MAX_FILE_LINES + 1)).len(), 1);
    // Declarations and functions on one line end where they begin.
    let short = format!("trait T {{\n    fn a();\n    fn b() {{}}\n{}}}\n", "    // x\n".repeat(70));
    assert!(long("c.rs", &short).is_empty());
}

/// A program that is not named in its manifest runs under the usual harness, which finds no test in it.
#[test]
fn programs_of_tests_are_named() {
    let mut count = 0;
    for path in rust_files(&crates_folder()) {
        let Some((package, name)) = path.to_str().unwrap().split_once("/tests/") else { continue };
        let text = std::fs::read_to_string(&path).unwrap();
        if !text.contains("\nfn main() {") {
            continue;
        }
        let name = name.trim_end_matches(".rs").trim_end_matches("/main");
        let manifest = std::fs::read_to_string(Path::new(package).join("Cargo.toml")).unwrap();
        let entry = format!("[[test]]\nname = \"{name}\"\nharness = false\n");
        assert!(manifest.contains(&entry), "{package}/Cargo.toml lacks\n{entry}");
        count += 1;
    }
    assert!(count > 20, "{count}");
}

/// What draws runs in browsers too, where nothing may wait.
#[test]
fn the_renderer_never_waits() {
    let waits = |package: &str| {
        let files = rust_files(&crates_folder().join(package).join("src"));
        let text: String = files.iter().map(|path| std::fs::read_to_string(path).unwrap()).collect();
        [".poll(", "block_on", "map_async"].into_iter().filter(|call| text.contains(call)).count()
    };
    assert_eq!((waits("antumbra-render"), waits("antumbra-lab")), (0, 3));
}

fn crates_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().into()
}

/// All `.rs` files below a folder.
fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let of = |path: PathBuf| if path.is_dir() { rust_files(&path) } else { vec![path] };
    entries.flat_map(of).filter(|path| path.extension().is_some_and(|e| e == "rs")).collect()
}

/// What in a file that rustfmt has laid out is too long.
fn long(path: &str, text: &str) -> Vec<String> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    if lines.len() > MAX_FILE_LINES {
        found.push(format!("{path}: {} lines, allowed are {MAX_FILE_LINES}: split it", lines.len()));
    }
    for (start, line) in lines.iter().enumerate() {
        let Some(name) = function_name(line) else { continue };
        let indent = line.len() - line.trim_start().len();
        let at_indent = |l: &str, c: char| l.strip_prefix(&line[..indent]).is_some_and(|l| l.starts_with(c));
        let ends = |l: &str| at_indent(l, '}') || (at_indent(l, ')') && l.ends_with(';'));
        let length = match lines[start..].iter().skip(1).position(|l| ends(l)) {
            Some(after) if !line.ends_with([';', '}']) => after + 2,
            _ => 1,
        };
        if length > MAX_FUNCTION_LINES {
            found.push(format!(
                "{path}:{}: function {name} has {length} lines, allowed are {MAX_FUNCTION_LINES}: take a step out of it",
                start + 1
            ));
        }
    }
    found
}

/// The name of the function that a line begins to define.
fn function_name(line: &str) -> Option<&str> {
    let (before, rest) = line.split_once("fn ")?;
    let modifiers = ["pub", "pub(crate)", "pub(super)", "const", "async"];
    let name = &rest[..rest.find(['(', '<'])?];
    before.split_whitespace().all(|word| modifiers.contains(&word)).then_some(name)
}
