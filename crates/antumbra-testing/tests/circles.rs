//! Modules of a crate do not lead in a circle: whoever reads one follows its names downwards, and arrives.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// Crates whose modules have an order.
const CRATES: [&str; 7] = [
    "antumbra-cli",
    "antumbra-lab",
    "antumbra-render",
    "antumbra-reproduce",
    "antumbra-scene",
    "antumbra-testing",
    "antumbra-truth",
];

/// Modules of a crate's root, with those that each names.
type Graph = BTreeMap<String, BTreeSet<String>>;

#[test]
fn modules_lead_in_no_circle() {
    for name in CRATES {
        let source = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(name).join("src");
        let mut graph = Graph::new();
        collect(&source, None, &mut graph);
        assert!(graph.len() > 3, "{name}: {graph:?}");
        assert_eq!(circle(&graph), None, "{name}");
    }
}

#[test]
fn a_circle_is_found() {
    let named = "use crate::{\n    a::{B, crate_c},\n    c,\n};\nfn f() { crate::d::e() }\n// crate::f\n";
    assert_eq!(names(named), ["a", "c", "d"].map(String::from).into());
    let of = |pairs: &[(&str, &str)]| {
        let mut graph = Graph::new();
        for (from, to) in pairs {
            graph.entry((*from).into()).or_default().insert((*to).into());
            graph.entry((*to).into()).or_default();
        }
        circle(&graph)
    };
    assert_eq!(of(&[("a", "b"), ("b", "c"), ("a", "c")]), None);
    let found = of(&[("a", "b"), ("b", "c"), ("c", "b")]).unwrap();
    assert_eq!(found, ["b", "c"].map(String::from).into());
}

/// Adds the files below a folder, which belong to a module of the root or are such modules.
fn collect(folder: &Path, module: Option<&str>, graph: &mut Graph) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let module = module.unwrap_or(stem);
        if path.is_dir() {
            collect(&path, Some(module), graph);
        } else if path.extension().is_some_and(|e| e == "rs") && !["lib", "main"].contains(&module) {
            let found = names(&std::fs::read_to_string(&path).unwrap());
            graph.entry(module.into()).or_default().extend(found.into_iter().filter(|name| name != module));
        }
    }
}

/// The modules of the root that a file names outside of its tests.
fn names(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter(|line| !line.trim_start().starts_with("//"));
    let code: String = lines.flat_map(|line| [line, "\n"]).collect();
    code.split("crate::").skip(1).flat_map(heads).filter(|name| !name.is_empty()).collect()
}

/// What stands first in each branch of a path, behind `crate::`.
fn heads(path: &str) -> Vec<String> {
    let Some(tree) = path.strip_prefix('{') else { return vec![head(path)] };
    let (mut depth, mut start, mut found) = (0, 0, Vec::new());
    for (i, c) in tree.char_indices() {
        match c {
            '{' => depth += 1,
            '}' | ',' if depth == 0 => {
                found.push(head(tree[start..i].trim()));
                start = i + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    found
}

fn head(path: &str) -> String {
    path.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
}

/// Modules that are left when modules that name none of the rest, or that none of the rest names, are taken
/// away again and again: those in circles, and between them.
fn circle(graph: &Graph) -> Option<BTreeSet<String>> {
    let mut left: BTreeSet<String> = graph.keys().cloned().collect();
    loop {
        let names_left = |name: &String| graph[name].iter().any(|other| left.contains(other));
        let is_named = |name: &String| left.iter().any(|other| graph[other].contains(name));
        let next: BTreeSet<String> =
            left.iter().filter(|name| names_left(name) && is_named(name)).cloned().collect();
        if next == left {
            return (!left.is_empty()).then_some(left);
        }
        left = next;
    }
}
