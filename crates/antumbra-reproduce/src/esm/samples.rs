//! Figure 7: how many samples PCF needs.

use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_least, esm as esm_says, more},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

const BUDGETS: [u32; 7] = [1, 4, 9, 16, 36, 64, 144];
const ESM: [(&str, &str); 2] = [
    ("esm.kernel=1,sampling=trilinear", "ESM, trilinear"),
    ("esm.kernel=5,sampling=trilinear", "ESM, 5×5 Gauss"),
];

pub(super) fn figure_7(bench: &Workbench<'_>) -> Result<Page> {
    let pcf = BUDGETS.map(|n| format!("footprint.budget={n}"));
    let specs: Vec<&str> = pcf.iter().map(String::as_str).chain(ESM.map(|e| e.0)).collect();
    let (shot, map) = (bench.shot("fence", [640, 480]).from(2.0), bench.map(2048));
    let study = bench.study(shot, map, &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(8)])?[0];
    let frames: Vec<(u32, &str)> = specs.iter().map(|s| (map, *s)).collect();
    let times = bench.times(shot, &frames, bench.rounds())?;
    let names: Vec<String> =
        BUDGETS.iter().map(|n| format!("PCF, {n} samples")).chain(ESM.map(|e| e.1.to_string())).collect();
    let mut table = Table::new(
        "Error to 64 rays per pixel, and frame time over that of trilinear ESM.",
        &["filter", "RMSE", "frame time"],
    );
    let esm = BUDGETS.len();
    let mut errors = Vec::new();
    let mut ratios = Vec::new();
    for ((name, spec), time) in names.iter().zip(&specs).zip(&times) {
        errors.push(bench.score(&study, spec, truth, None)?.rmse);
        let ratio = time.over(&times[esm]);
        let cells = [(errors[errors.len() - 1], Unit::Number), (ratio.value, Unit::Times)];
        ratios.push(ratio);
        table.row(name.as_str(), cells.map(|(v, unit)| Cell::ours(v, unit)).into());
    }
    let (pcf_errors, pcf_ratios) = (&errors[..esm], &ratios[..esm]);
    let plain = enough(pcf_errors, errors[esm]);
    let mut page = Page::default();
    page.verdict(many("trilinear ESM", plain.map(|i| BUDGETS[i]), 36));
    let blurred = enough(pcf_errors, errors[esm + 1]);
    page.verdict(many("ESM with a 5×5 Gauss", blurred.map(|i| BUDGETS[i]), 64));
    page.verdict(slower(pcf_ratios[plain.unwrap_or(esm - 1)]));
    if let Some(min) = pcf_errors.iter().copied().reduce(f64::min) {
        let settled = enough(pcf_errors, 1.02 * min).map_or(BUDGETS[esm - 1], |i| BUDGETS[i]);
        page.text(format!(
            "From {settled} samples on, more of them bring the error of PCF down by less than 2 %: a footprint of this \
             size holds no more texels."
        ));
    }
    let shown: Vec<usize> = [0, 3, 4, 5, esm, esm + 1].into();
    let mut pictures = Vec::new();
    for i in shown {
        pictures.push((names[i].as_str(), &study.look(specs[i])?.picture));
    }
    pictures.push(("64 rays per pixel", &truth.picture));
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = ["As in the figure, and what rays say.", "Enlarged: where one sample looks most wrong."];
    gallery::rows(&mut page, captions, 4, &pictures, window)?;
    page.table(table);
    Ok(page)
}

const SCENE: &str = "fence from twice its distance, 640×480, 2048², budgets of 1 to 144 samples";

/// The first whose error is not larger.
fn enough(errors: &[f64], limit: f64) -> Option<usize> {
    errors.iter().position(|e| *e <= limit)
}

/// Fewest samples that suffice, `None` if none of the tried numbers does.
fn many(esm: &str, needed: Option<u32>, paper: u32) -> Verdict {
    let (what, samples) = match needed {
        Some(n) => ("samples whose error is not larger than the ESM's", n),
        None => ("samples that do not suffice yet, the most that were tried", BUDGETS[BUDGETS.len() - 1]),
    };
    let quote = match paper {
        36 => "At least 36 samples are necessary for PCF to match regular trilinear ESMs",
        _ => {
            "64 samples are required to achieve similar quality to ESMs with an additional 5 × 5 Gauss filter"
        }
    };
    Verdict::new(
        esm_says("figure 7", quote),
        format!("PCF needs {paper} samples or more to match {esm}"),
        Ran::new(SCENE, ["footprint", ESM[0].0, ESM[1].0]),
        [at_least(what, f64::from(samples), "the paper's", f64::from(paper))
            .document("figure 7; §5 says at least 16 or up to 36 of trilinear ESM")],
    )
}

/// Frame time of the PCF that is as good (or the closest to it) over that of the ESM.
fn slower(ratio: Measured) -> Verdict {
    Verdict::new(
        esm_says(
            "§5",
            "PCF has to use at least 16 or up to 36 samples which reduces the framerate significantly",
        ),
        "At equal quality ESM is faster",
        Ran::new(SCENE, ["footprint", ESM[0].0]),
        [more("frame time of that PCF over that of the ESM", ratio, "1", 1.0).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(enough(&[0.3, 0.2, 0.1], 0.2), Some(1));
        assert_eq!(enough(&[0.3, 0.2, 0.1], 0.05), None);
        assert_eq!(many("ESM", Some(36), 36).outcome(), Holds);
        assert_eq!(many("ESM", Some(16), 36).outcome(), Differs);
        assert_eq!(many("ESM", None, 36).outcome(), Holds);
        assert_eq!(slower(Measured::exact(2.0)).outcome(), Holds);
        assert_eq!(slower(Measured::exact(0.9)).outcome(), Differs);
    }
}
