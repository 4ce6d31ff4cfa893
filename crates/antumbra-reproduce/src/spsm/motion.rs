//! Flicker along a path of camera and light.

use super::PUBLISHED;
use crate::{
    page::{Cell, Page, Table, Unit},
    verdict::{Ran, Verdict, at_most, ours, spsm},
    workbench::Workbench,
};
use antumbra_lab::{
    flicker::{Promise, ROW_FILE, STRIP_FILE},
    motion::Path,
};
use anyhow::Result;

const SPECS: [&str; 5] = ["hard", PUBLISHED, "spsm", "dpm", "exact"];
/// Scenes with their number of frames.
const SCENES: [(&str, u32); 3] = [("contact", 120), ("spheres", 120), ("tangle", 40)];
/// Flicker over that of a standard map that is called calm.
const HALF: f64 = 0.5;

pub(super) fn flicker(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "Flicker against the hard truth, mean per pixel and frame. In the picture: the same pixel in both frames. On \
         surfaces: the same point.",
        &["scene and technique", "in the picture", "over hard", "on surfaces", "over hard"],
    );
    for (scene, frames) in SCENES {
        let shot = bench.shot(scene, [480, 360]);
        let moving = bench.moving(shot, Path::Both, [frames; 2], bench.map(1024), &SPECS)?;
        let mut ratios = Vec::new();
        for spec in SPECS {
            let technique = moving.technique(spec)?;
            let [picture, surface] = [&technique.flicker, &technique.crawl].map(|m| m.get(&Promise::Hard));
            let cells = [picture, surface].map(|measured| {
                let over = measured.and_then(|m| m.ratio_to_hard);
                [Cell::ours(measured.map(|m| m.mean), Unit::Number), Cell::ours(over, Unit::Times)]
            });
            table.row(format!("{scene}, {frames} frames: {spec}"), cells.concat());
            ratios.push(picture.and_then(|m| m.ratio_to_hard));
        }
        (1..4).for_each(|i| page.verdict(calm(scene, SPECS[i], ratios[i])));
        let tiles = vec![moving.tile(STRIP_FILE, "six frames")?, moving.tile(ROW_FILE, "row over time")?];
        page.pictures(
            format!("The scene {scene}, and one row of its pixels over time, downwards."),
            1,
            tiles,
        );
    }
    page.blocks.insert(0, crate::page::Block::Table(table));
    Ok(page)
}

fn calm(scene: &str, spec: &str, ratio: Option<f64>) -> Verdict {
    let (whose, source) = match spec {
        "spsm" => ("SPSM with two layers", ours("two layers have to be as calm as the one that they extend")),
        "dpm" => ("deep primitive maps", ours("deep primitive maps have to be as calm as what they extend")),
        _ => (
            "SPSM",
            spsm(
                "§6.2",
                "Moving the light or varying the shadow map resolution at run time highlights the high temporal consistency of our method",
            ),
        ),
    };
    Verdict::new(
        source,
        format!("Flicker of {whose} is at most half of a standard map's (scene {scene})"),
        Ran::new(&format!("{scene}, 480×360, 1024²"), ["hard", spec]),
        [at_most("flicker over that of a standard map", ratio, "a half", HALF)
            .ours("the paper shows a video and no number; what is called calm flickers half as much")],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(calm("s", "dpm", Some(0.3)).outcome(), Holds);
        assert_eq!(calm("s", PUBLISHED, Some(0.6)).outcome(), Differs);
        assert_eq!(calm("s", "spsm", None).outcome(), Open);
    }
}
