//! Modules of a crate do not lead in a circle: whoever reads one follows its names downwards, and arrives.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod modules;

use modules::{Graph, graph, names};
use std::collections::BTreeSet;

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

#[test]
fn modules_lead_in_no_circle() {
    for name in CRATES {
        let graph = graph(name);
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
