//! Figure 10: minification.

use crate::{
    page::{Cell, Page, Table, Unit},
    verdict::{Ran, Verdict, csm as csm_says, less},
    workbench::Workbench,
};
use antumbra_lab::{
    flicker::{FILM_FILE, Promise, ROW_FILE, STRIP_FILE},
    motion::Path,
};
use anyhow::Result;

/// Hardware's 2×2 comparison, the same width as the map's blur, that blur without and with mip-mapping.
const SPECS: [&str; 5] = [
    "hard",
    "pcf.kernel=2",
    "pcf.kernel=5",
    "csm.kernel=5,sampling=bilinear",
    "csm.kernel=5,sampling=trilinear",
];
const FRAMES: u32 = 48;

pub(super) fn figure_10(bench: &Workbench<'_>) -> Result<Page> {
    let shot = bench.shot("fence", [480, 360]);
    let moving = bench.moving(shot, Path::Recede, [FRAMES; 2], bench.map(1024), &SPECS)?;
    let mut page = Page::default();
    let mut table = Table::new(
        "Flicker: mean change of a pixel's error from frame to frame, the truth being the mean of 16 rays per pixel. \
         First and last third: near and far.",
        &["technique", "flicker", "near", "far", "over hard"],
    );
    let mut far = Vec::new();
    for spec in SPECS {
        let technique = moving.technique(spec)?;
        let measured = technique.flicker.get(&Promise::ScreenSpace);
        let third = |skip: usize| {
            let frames = &measured?.frames;
            let part = &frames[skip * frames.len() / 3..(skip + 1) * frames.len() / 3];
            (!part.is_empty()).then(|| part.iter().sum::<f64>() / part.len() as f64)
        };
        let mean = measured.map(|m| m.mean);
        let numbers = [mean, third(0), third(2)].map(|v| Cell::ours(v, Unit::Number));
        table.row(spec, [&numbers[..], &[Cell::ours(technique.ratio_to_hard, Unit::Times)]].concat());
        far.push(third(2));
    }
    page.verdict(removed(far[2], far[3], far[4]));
    page.table(table);
    page.pictures(
        "Visibility in the middle of the picture as the camera moves away to eight times its distance; the truth is one \
         ray per pixel.",
        1,
        vec![moving.tile(STRIP_FILE, "six frames")?, moving.tile(FILM_FILE, "all frames, moving")?],
    );
    page.pictures(
        "One row of pixels over time, downwards.",
        1,
        vec![moving.tile(ROW_FILE, "row over time")?],
    );
    Ok(page)
}

fn removed(pcf: Option<f64>, bilinear: Option<f64>, csm: Option<f64>) -> Verdict {
    let what = "flicker of the mip-mapped CSM far away";
    Verdict::new(
        csm_says(
            "figure 10",
            "regular tri-linear filtering with a 5x5 filter kernel significantly reduces screen space aliasing and \
             increases temporal coherence when moving the scene",
        ),
        "Mip-mapping a CSM of 5×5 removes aliasing in time that PCF has when the scene moves away",
        Ran::new("fence, 480×360, 1024², the last third of 48 frames", [SPECS[2], SPECS[3], SPECS[4]]),
        [
            less(what, csm, "that of PCF 5×5", pcf).sentence(),
            less(what, csm, "that of the CSM without mip-mapping", bilinear).sentence(),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(removed(Some(0.2), Some(0.15), Some(0.1)).outcome(), Holds);
        assert_eq!(removed(Some(0.2), Some(0.05), Some(0.1)).outcome(), Differs);
        assert_eq!(removed(Some(0.2), None, Some(0.1)).outcome(), Open);
    }
}
