//! Beyond the paper: from one triangle per texel to all.

use super::{PUBLISHED, quality::studied};
use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_least, more, ours, spsm},
    workbench::Workbench,
};
use anyhow::{Context, Result};

const SIX: &str = "dpm.keeps=6";
/// By number of triangles kept.
const ENTRIES: [(&str, &str); 6] = [
    ("hard", "standard map"),
    (PUBLISHED, "SPSM as published: one triangle"),
    ("spsm", "SPSM: one, and that of the centre"),
    ("dpm", "the first four by number"),
    (SIX, "the first six"),
    ("exact", "all"),
];
/// Those that are shown.
const SHOWN: [&str; 5] = ["hard", PUBLISHED, "spsm", "dpm", "exact"];
const SCENE: &str = "tangle";
const RESOLUTION: [u32; 2] = [1920, 1080];
const MAPS: [u32; 3] = [512, 1024, 2048];
const RAN: &str = "tangle, 1920×1080";
/// The map that only a standard map has.
const LARGE: u32 = 4096;
/// Pixel match of the paper's method at 2048².
const PAPER: f64 = 0.9963;
/// What an answer that may be called right matches.
const RIGHT: f64 = 0.999;

pub(super) fn beyond(bench: &Workbench<'_>) -> Result<Page> {
    let specs = ENTRIES.map(|entry| entry.0);
    let mut matches = vec![Vec::new(); ENTRIES.len()];
    let mut page = Page::default();
    let mut bytes = [0; ENTRIES.len()];
    for map in MAPS {
        let (study, truth) = studied(bench, SCENE, RESOLUTION, map, &specs)?;
        for (found, spec) in matches.iter_mut().zip(specs) {
            found.push(bench.score(&study, spec, &truth, None)?.pixel_match);
        }
        if map == MAPS[1] {
            let mut pictures = Vec::new();
            for (spec, name) in ENTRIES.iter().filter(|entry| SHOWN.contains(&entry.0)) {
                pictures.push((*name, &study.look(spec)?.picture));
            }
            pictures.push(("rays", &truth.picture));
            let window = gallery::window(&difference(pictures[1].1, &truth.picture), pictures[1].1, 12);
            let captions = ["Maps of 1024².", "Enlarged: where SPSM as published looks most wrong."];
            gallery::rows(&mut page, captions, 3, &pictures, window)?;
            for (bytes, look) in bytes.iter_mut().zip(&study.looks) {
                *bytes = look.memory.kept_bytes;
            }
        }
    }
    let (large, truth) = studied(bench, SCENE, RESOLUTION, LARGE, &["hard"])?;
    let large = bench.score(&large, "hard", &truth, None)?.pixel_match;
    let frames: Vec<(u32, &str)> = specs.iter().map(|spec| (bench.map(MAPS[1]), *spec)).collect();
    let times = bench.times(bench.shot(SCENE, RESOLUTION), &frames, bench.rounds())?;
    let mut table = Table::new(
        "Share of pixels that rays answer likewise; frame time over that of the standard map, and memory, with a 1024² map.",
        &["triangles kept", "512²", "1024²", "2048²", "4096²", "frame", "memory"],
    );
    for (i, (spec, name)) in ENTRIES.into_iter().enumerate() {
        let mut cells: Vec<Cell> = matches[i].iter().map(|m| Cell::ours(*m, Unit::Share)).collect();
        if spec == PUBLISHED {
            cells[2] = Cell::ours(matches[i][2], Unit::Share).paper(PAPER);
        }
        cells.push(Cell::ours((spec == "hard").then_some(large), Unit::Share));
        cells.push(Cell::ours(times[i].over(&times[0]).value, Unit::Times));
        cells.push(Cell::ours(bytes[i] as f64, Unit::Bytes));
        table.row(name, cells);
    }
    page.blocks.insert(0, crate::page::Block::Table(table));
    let at = |spec: &str, map: usize| {
        let entry = specs.iter().position(|s| *s == spec).with_context(|| format!("{spec} is missing"))?;
        anyhow::Ok(matches[entry][map])
    };
    page.verdict(published(at(PUBLISHED, 2)?));
    page.verdict(two_layers(at("spsm", 2)?));
    page.verdict(right(at("dpm", 2)?));
    page.verdict(smaller(at(SIX, 1)?, large));
    Ok(page)
}

fn published(found: f64) -> Verdict {
    Verdict::new(
        spsm(
            "§6.2",
            "The rendering quality achieved by the SPSM is close to ray-tracing solutions with a pixel match of ≈ 99.63%",
        ),
        "SPSM as published matches 99.63 % of the pixels with a 2048² map",
        Ran::new(&format!("{RAN}, 2048²"), [PUBLISHED]),
        [at_least("its pixel match", found, "the paper's", PAPER).document("§6.2")],
    )
}

fn two_layers(found: f64) -> Verdict {
    Verdict::new(
        ours(
            "the paper names shadow fusion as its limit, and several rasterisations as future work (§6.4, §7)",
        ),
        "With a second layer SPSM matches 99.9 % of the pixels at 2048²",
        Ran::new(&format!("{RAN}, 2048²"), ["spsm"]),
        [at_least("its pixel match", found, "99.9 %", RIGHT)
            .ours("one wrong pixel of a thousand is a quarter of what the paper has")],
    )
}

fn right(found: f64) -> Verdict {
    Verdict::new(
        ours("the paper keeps one triangle, since all of them would be intractable (§3.1)"),
        "Four numbers in the 16 bytes of a triangle, beside corners and centres, match 99.9 % of the pixels at 2048²",
        Ran::new(&format!("{RAN}, 2048²"), ["dpm"]),
        [at_least("their pixel match", found, "99.9 %", RIGHT)
            .ours("one wrong pixel of a thousand is a quarter of what the paper has")],
    )
}

fn smaller(six: f64, large: f64) -> Verdict {
    Verdict::new(
        ours("it tells what triangles are worth in texels"),
        "Six triangles per texel of a 1024² map match more pixels than a standard map of 4096²",
        Ran::new(&format!("{RAN}, 1024² and 4096²"), [SIX, "hard"]),
        [more("their pixel match", six, "that of the standard map", large)
            .ours("sixteen times the texels are more than six triangles take")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(published(0.997).outcome(), Holds);
        assert_eq!(published(0.995).outcome(), Differs);
        assert_eq!(two_layers(0.9991).outcome(), Holds);
        assert_eq!(two_layers(0.9989).outcome(), Differs);
        assert_eq!(right(0.9991).outcome(), Holds);
        assert_eq!(right(0.9989).outcome(), Differs);
        assert_eq!(smaller(0.998, 0.9976).outcome(), Holds);
        assert_eq!(smaller(0.9975, 0.9976).outcome(), Differs);
    }
}
