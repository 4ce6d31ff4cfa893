//! The library's rooms have an order: whoever stands in one needs to know those below it, and no other.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod modules;

use modules::{Graph, graph, names};

/// The modules of `crates/antumbra/src`, the lowest first. Each names those before it alone.
const ROOMS: [&str; 24] = [
    "error",
    "aabb",
    "parameter",
    "capabilities",
    "capacity",
    "camera",
    "light",
    "tile",
    "kernel",
    "table",
    "bias",
    "memory",
    "pipelines",
    "options",
    "describe",
    "filter",
    "precision",
    "bound",
    "technique",
    "shader",
    "pass",
    "cast",
    "map",
    "listing",
];

#[test]
fn no_arrow_points_up() {
    let graph = graph("antumbra");
    let missing: Vec<&String> = graph.keys().filter(|room| !ROOMS.contains(&room.as_str())).collect();
    assert!(missing.is_empty(), "which rooms are {missing:?} above?");
    assert!(ROOMS.iter().all(|room| graph.contains_key(*room)), "a room is gone: {:?}", graph.keys());
    assert_eq!(upward(&graph, &ROOMS), Vec::<String>::new());
}

#[test]
fn what_points_up_is_noticed() {
    let graph =
        |text: &str| Graph::from([("low".into(), names(text)), ("high".into(), names("use crate::low;"))]);
    let rooms = ["low", "high"];
    assert_eq!(upward(&graph("use std::fmt; // crate::high"), &rooms), Vec::<String>::new());
    let up = ["low names high: what both need lies below both"];
    assert_eq!(upward(&graph("use crate::high::Thing;"), &rooms), up);
    assert_eq!(upward(&graph("fn f() -> crate::high::Thing {}"), &rooms), up);
    // What the crate's root exports again is named by its room.
    assert_eq!(
        upward(&graph("use crate::{Thing};"), &rooms),
        ["low names Thing: what both need lies below both"]
    );
    assert_eq!(
        upward(&graph("use crate::low;"), &["high", "low"]),
        ["high names low: what both need lies below both"]
    );
}

/// Arrows that do not lead to a room before.
fn upward(graph: &Graph, rooms: &[&str]) -> Vec<String> {
    let place = |name: &str| rooms.iter().position(|room| *room == name);
    let mut found = Vec::new();
    for (room, named) in graph {
        let below = |name: &&String| place(name).is_some_and(|p| Some(p) < place(room));
        let others = named.iter().filter(|name| *name != room && !below(name));
        found.extend(others.map(|name| format!("{room} names {name}: what both need lies below both")));
    }
    found
}
