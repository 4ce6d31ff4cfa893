//! Which modules of a crate's root name which.

use std::{
    collections::{BTreeMap, BTreeSet},
    path::Path,
};

/// Modules of a crate's root, with those that each names.
pub(crate) type Graph = BTreeMap<String, BTreeSet<String>>;

/// The modules of a crate of the workspace.
pub(crate) fn graph(name: &str) -> Graph {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join(name).join("src");
    let mut graph = Graph::new();
    collect(&source, None, &mut graph);
    graph
}

/// Adds the files below a folder, which belong to a module of the root or are such modules.
fn collect(folder: &Path, module: Option<&str>, graph: &mut Graph) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let module = module.unwrap_or(stem);
        if path.is_dir() {
            collect(&path, Some(module), graph);
        } else if path.extension().is_some_and(|e| e == "rs")
            && stem != "tests"
            && !["lib", "main"].contains(&module)
        {
            let found = names(&std::fs::read_to_string(&path).unwrap());
            graph.entry(module.into()).or_default().extend(found.into_iter().filter(|name| name != module));
        }
    }
}

/// The modules of the root that a file names outside of its tests.
pub(crate) fn names(text: &str) -> BTreeSet<String> {
    let code = text.split("#[cfg(test)]").next().unwrap_or_default();
    let lines = code.lines().filter_map(|line| line.split("//").next());
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
