//! The report as a reader finds it: complete, self-contained, safe, and never half written.
#![allow(clippy::unwrap_used, reason = "helpers of tests fail like tests")]

mod fixture;

use antumbra_lab::classes::ClassShare;
use antumbra_lab::files::{self, FileError, write_atomically};
use antumbra_lab::report::{self, ReportError};
use antumbra_lab::results::{Family, LeftOut, Results, ResultsError};
use fixture::{Folder, images, results, technique, write};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

#[test]
fn report_is_complete_and_needs_no_network() {
    let folder = Folder::new("complete");
    let out = write(&results(), &folder.0.join("report")).unwrap();
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(!page.contains("http:") && !page.contains("https:"), "the page refers to the network");
    assert!(!page.contains("{{"), "a part of the template was not filled");
    for text in [
        "Exponential shadow map",
        "esm.c=80,kernel=5",
        "software rasteriser",
        r"&#39;it&#39;\&#39;&#39;s here.glb&#39;",
    ] {
        assert!(page.contains(text), "{text} is missing");
    }
    let read = Results::read(&out.join("results.json")).unwrap();
    assert_eq!(Results { files: vec![], ..read.clone() }, results());
    assert!(read.files.iter().all(|name| out.join(name).is_file()));
    assert_eq!(read.files.len(), 13);
    assert_eq!(folder.names(), ["report"]);
}

#[test]
fn words_follow_the_numbers() {
    let folder = Folder::new("words");
    let page = |results: &Results| {
        let out = write(results, &folder.0.join("report")).unwrap();
        fs::read_to_string(out.join("index.html")).unwrap()
    };
    let best = "which every filtered map approximates, is <strong>Exponential shadow map";
    assert!(page(&results()).contains(best));
    let mut other = results();
    other.techniques[1].scores.light_space.rmse = 0.9;
    assert!(!page(&other).contains(best));
    let take = "<p class=\"take\">For filtered shadows in this scene take <strong>";
    assert!(page(&results()).contains(take));
    let mut bright = results();
    bright.truth.no_shadow.pixel_match = 0.98;
    let bright = page(&bright);
    assert!(!bright.contains(take) && !bright.contains(best) && bright.contains("next to no shadow"));
    let nothing = Results { techniques: vec![], ..results() };
    assert!(page(&nothing).contains("No technique was compared."));
}

/// The smallest error of an invalid technique wins nothing.
#[test]
fn what_is_invalid_or_left_out_is_said_and_has_no_rank() {
    let folder = Folder::new("invalid");
    let mut some = results();
    some.techniques[1].invalid = Some("shadows are <missing>".into());
    some.run.notes = vec!["exact: holes are <coarse>".into()];
    some.run.warnings = vec!["the scene is <vast>".into()];
    some.left_out = vec![LeftOut { spec: "dpm.keeps=9".into(), reason: "too large".into() }];
    let out = write(&some, &folder.0.join("report")).unwrap();
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(page.contains("which every filtered map approximates, is <strong>Standard shadow map"));
    let table = page.split_once("table class=\"scores").unwrap().1.split_once("</table>").unwrap().0;
    for text in ["invalid: shadows are &lt;missing&gt;", "Left out", "dpm.keeps=9", "too large"] {
        assert!(table.contains(text), "{text} is missing in: {table}");
    }
    assert!(page.contains("exact: holes are &lt;coarse&gt;."));
    assert!(page.contains("<strong>Warning: the scene is &lt;vast&gt;.</strong>"));
    let row = table.split("</tr>").find(|row| row.contains("esm.c=80")).unwrap();
    assert_eq!(row.matches("<td").count(), 1, "{row}");
    let csv = some.csv();
    let (_, numbers) = csv.lines().last().unwrap().split_once(",basis").unwrap();
    assert_eq!(numbers.trim_start_matches(','), "shadows are <missing>");
    let read = Results::read(&out.join("results.json")).unwrap();
    assert_eq!((&read.left_out, &read.techniques[1].invalid), (&some.left_out, &some.techniques[1].invalid));
    assert_eq!((&read.run.notes, &read.run.warnings), (&some.run.notes, &some.run.warnings));
    assert_eq!(read.valid().count(), 1);
}

#[test]
fn hostile_strings_stay_text() {
    let mut hostile = results();
    let attack = "</script><script>alert(1)</script>\"'&{{script}}";
    hostile.run.scene.name = attack.into();
    hostile.run.adapter.driver = attack.into();
    hostile.techniques[0].title = attack.into();
    hostile.techniques[0].spec = attack.into();
    hostile.techniques[0].explain = vec![attack.into()];
    hostile.techniques[0].settings.insert(attack.into(), attack.into());
    hostile.techniques[0].regions = BTreeMap::from([(attack.into(), hostile.techniques[0].scores.hard)]);
    hostile.techniques[0].memory.items[0].format = attack.into();
    hostile.techniques[0].classes = vec![ClassShare { name: attack.into(), colour: [1; 3], share: 0.5 }];
    hostile.techniques[0].time.passes[0].name = attack.into();
    hostile.truth.coverage_explained.insert(attack.into(), 3);
    hostile.run.command.push(attack.into());
    let folder = Folder::new("hostile");
    let out = write(&hostile, &folder.0.join("report")).unwrap();
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    assert!(!page.contains("alert(1)</script>"));
    assert_eq!(page.matches("<script").count(), 2, "the page's own scripts and no other");
}

#[test]
fn techniques_stand_with_their_family() {
    let mut mixed = results();
    mixed.techniques.push(technique("pcf", "Percentage-closer filtering", Family::Comparison, 0.7));
    let families: Vec<(Family, Vec<&str>)> = mixed
        .families()
        .into_iter()
        .map(|(family, members)| (family, members.into_iter().map(|t| t.name.as_str()).collect()))
        .collect();
    assert_eq!(families, [(Family::Comparison, vec!["hard", "pcf"]), (Family::Basis, vec!["esm"])]);
    let folder = Folder::new("families");
    let out = write(&mixed, &folder.0.join("report")).unwrap();
    let page = fs::read_to_string(out.join("index.html")).unwrap();
    let table = page.split_once("table class=\"scores").unwrap().1.split_once("</table>").unwrap().0;
    let place = |text: &str| table.find(text).unwrap();
    assert_eq!(table.matches("<tr class=\"family\">").count(), 2);
    assert!(place("<code>pcf</code>") < place(">Linear basis</th>"));
    assert!(place(">Linear basis</th>") < place("<code>esm."));
}

#[test]
fn older_results_are_read() {
    let folder = Folder::new("older");
    let out = write(&results(), &folder.0.join("report")).unwrap();
    let mut json: serde_json::Value =
        serde_json::from_slice(&fs::read(out.join("results.json")).unwrap()).unwrap();
    for added in ["work", "classes"] {
        json["techniques"][0].as_object_mut().unwrap().remove(added).unwrap();
    }
    json["techniques"][0]["images"].as_object_mut().unwrap().remove("classes").unwrap();
    let old = folder.0.join("old.json");
    fs::write(&old, json.to_string()).unwrap();
    let old = Results::read(&old).unwrap();
    assert_eq!((old.techniques[0].work.as_ref(), old.techniques[1].work.is_some()), (None, true));
    let rewritten = write(&old, &folder.0.join("report")).unwrap();
    assert!(fs::read_to_string(rewritten.join("results.csv")).unwrap().contains(",,,,\r\n"));
}

#[test]
fn csv_has_one_row_per_technique_and_quotes_commas() {
    let csv = results().csv();
    let lines: Vec<&str> = csv.lines().collect();
    assert_eq!(lines.len(), 3);
    let columns = lines[0].split(',').count();
    assert_eq!(lines[1].split(',').count(), columns);
    assert!(lines[2].starts_with("\"esm.c=80,kernel=5\",esm,Exponential shadow map,basis,"));
    assert_eq!(lines[2].split(',').count(), columns + 1, "one comma is quoted");
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    let folder = Folder::new("finite");
    let mut broken = results();
    broken.techniques[0].scores.hard.rmse = f64::NAN;
    let error = write(&broken, &folder.0.join("report")).unwrap_err();
    assert!(matches!(error, ReportError::Results(ResultsError::NotFinite(_))), "{error}");
    assert!(folder.names().is_empty());
}

#[test]
fn missing_images_and_bad_names_are_refused_before_writing() {
    let folder = Folder::new("names");
    let mut some = images(&results());
    some.remove("hard-picture.png");
    let error = report::write(&results(), &some, &folder.0.join("report")).unwrap_err();
    assert!(matches!(&error, ReportError::MissingImage(name) if name == "hard-picture.png"), "{error}");
    for name in ["../escape.png", "a/b.png", "", ".hidden", "Index.html"] {
        let mut images = images(&results());
        images.insert(name.into(), vec![]);
        let error = report::write(&results(), &images, &folder.0.join("report")).unwrap_err();
        assert!(matches!(error, ReportError::Name(_)), "{name}: {error}");
    }
    assert!(folder.names().is_empty());
    assert_eq!(files::stem("esm.c=80,kernel=5"), "esm.c-80-kernel-5");
}

#[test]
fn an_earlier_report_is_replaced() {
    let folder = Folder::new("replace");
    let out = folder.0.join("report");
    let mut images = images(&results());
    images.insert("esm.exr".into(), vec![1]);
    report::write(&results(), &images, &out).unwrap();
    assert!(out.join("esm.exr").is_file());
    write(&results(), &out).unwrap();
    assert!(!out.join("esm.exr").exists(), "a file of the earlier report stayed");
    assert_eq!(folder.names(), ["report"]);
}

#[test]
fn folders_of_others_are_refused_and_left_alone() {
    let folder = Folder::new("foreign");
    let refused = |out: &Path| match write(&results(), out).unwrap_err() {
        ReportError::File(FileError::NotOurs { why, .. }) => why,
        other => panic!("{other}"),
    };
    let foreign = folder.0.join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("results.json"), "{\"schema\":\"theirs/1\"}").unwrap();
    assert!(refused(&foreign).contains("no results.json or maps.json or flicker.json of this program"));
    let added = folder.0.join("added");
    write(&results(), &added).unwrap();
    fs::write(added.join("notes.txt"), "mine").unwrap();
    assert!(refused(&added).contains("notes.txt"));
    assert_eq!(fs::read_to_string(added.join("notes.txt")).unwrap(), "mine");
    let file = folder.0.join("file");
    fs::write(&file, "mine").unwrap();
    assert!(refused(&file).contains("is a file"));
    let empty = folder.0.join("empty");
    fs::create_dir(&empty).unwrap();
    write(&results(), &empty).unwrap();
    assert_eq!(folder.names().len(), 4);
}

#[test]
fn errors_name_the_file_and_the_reason_and_leave_nothing() {
    let folder = Folder::new("errors");
    fs::create_dir(folder.0.join("taken")).unwrap();
    let error = write_atomically(&folder.0.join("taken"), b"x").unwrap_err();
    assert!(error.to_string().contains("taken"), "{error}");
    assert_eq!(folder.names(), ["taken"]);
    let error = Results::read(&folder.0.join("nowhere.json")).unwrap_err();
    assert!(error.to_string().ends_with("nowhere.json: no such file or folder"), "{error}");
    fs::write(folder.0.join("old.json"), "{\"schema\":\"antumbra-results/0\"}").unwrap();
    let error = Results::read(&folder.0.join("old.json")).unwrap_err();
    assert!(matches!(error, ResultsError::Schema { .. }), "{error}");
}
