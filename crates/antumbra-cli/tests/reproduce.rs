//! The papers' experiments, made small: pages, numbers, going on after an interruption.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod common;

use antumbra_testing::Trials;
use common::Folder;
use serde_json::Value;
use std::{collections::BTreeSet, fs};

fn main() {
    let mut trials = Trials::default();
    trials.add("pages_and_numbers", |_| pages());
    trials.add_plain("list", list);
    trials.add_plain("refusals", refusals);
    trials.run();
}

const TARGETS: [&str; 2] = ["slides/pcf-row", "csm/figure-9"];

fn pages() {
    let folder = Folder::new();
    let run = |targets: &[&str]| -> Value {
        let json = [&["reproduce"], targets, &["--quick", "--json", "-o", "out"]].concat();
        serde_json::from_str(&folder.run(&json).good()).unwrap()
    };
    let first = run(&TARGETS[..1]);
    assert_eq!(first["schema"], "antumbra-reproduction/2");
    let cached = |folder: &Folder| fs::read_dir(folder.0.join("out/cache")).unwrap().count();
    let kept = cached(&folder);
    assert!(kept > 0);
    // As if interrupted: measurements are there, pages are not.
    fs::remove_file(folder.0.join("out/slides-pcf-row.html")).unwrap();
    let both = run(&TARGETS);
    let ids: BTreeSet<&str> =
        both["targets"].as_array().unwrap().iter().map(|t| t["id"].as_str().unwrap()).collect();
    assert_eq!(ids, BTreeSet::from(TARGETS));
    let target = |results: &Value, id: &str| -> Value {
        let mut found =
            results["targets"].as_array().unwrap().iter().find(|t| t["id"] == id).unwrap().clone();
        found["seconds"] = Value::Null;
        found
    };
    assert_eq!(target(&first, TARGETS[0]), target(&both, TARGETS[0]), "nothing is measured twice");
    let all = cached(&folder);
    assert!(all > kept);
    run(&TARGETS);
    assert_eq!(cached(&folder), all);
    let read = |name: &str| fs::read_to_string(folder.0.join("out").join(name)).unwrap();
    let index = read("index.html");
    for file in ["slides-pcf-row.html", "csm-figure-9.html"] {
        assert!(index.contains(file), "{file}");
        let page = read(file);
        assert!(page.contains("data:image/png;base64,") && page.ends_with("</html>\n"));
        assert!(!page.contains("src=\"http") && !page.contains("href=\"http"), "pages need no network");
    }
    let last = run(&TARGETS);
    assert_eq!(serde_json::from_str::<Value>(&read("results.json")).unwrap()["targets"], last["targets"]);
    let csv = read("results.csv");
    assert!(csv.starts_with("target,table,row,column,unit,ours,paper\r\n"));
    assert!(csv.lines().filter(|l| l.starts_with("csm/figure-9,")).count() >= 6, "{csv}");
    for verdict in both["targets"].as_array().unwrap().iter().flat_map(|t| t["verdicts"].as_array().unwrap())
    {
        assert!(["holds", "differs", "open"].contains(&verdict["outcome"].as_str().unwrap()), "{verdict}");
        assert!(!verdict["comparisons"].as_array().unwrap().is_empty());
    }
}

fn list() {
    let folder = Folder::new();
    let list = folder.run(&["reproduce", "--list"]).good();
    for word in ["csm/figure-9", "esm/table-3", "--quick", "all: about"] {
        assert!(list.contains(word), "{word}: {list}");
    }
    assert_eq!(folder.names().len(), 0);
}

fn refusals() {
    let folder = Folder::new();
    folder.run(&["reproduce", "csm/figure-99"]).refusal(&[
        "'csm/figure-99'",
        "--list",
        "did you mean csm/figure-9?",
    ]);
    let nothing = folder.run(&["reproduce"]);
    assert_eq!(nothing.code, Some(2), "{}", nothing.err);
    fs::create_dir(folder.0.join("mine")).unwrap();
    folder.write("mine/letter.txt", b"dear");
    folder.run(&["reproduce", "all", "-o", "mine"]).refusal(&["mine", "not empty", "another folder"]);
    folder.run(&["reproduce", "all", "-o", "mine/letter.txt"]).refusal(&["letter.txt is a file"]);
    assert_eq!(folder.names().len(), 2);
}
