//! Figure 9: leaking.

use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::{Look, Traced},
    verdict::{Ran, Verdict, at_least, at_most, csm as csm_says, less},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

const SPECS: [&str; 2] = ["vsm.kernel=7,sampling=trilinear", "csm.kernel=7,sampling=trilinear"];
const KERNEL: u32 = 7;
/// Share of the depth range that casters and receiver are apart.
const NEAR: f64 = 0.05;

pub(super) fn figure_9(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "Layered: share of the pixels in full shadow that have several casters, apart. Mean visibility where the ideal is 0, \
         and RMSE to the ideal of 7×7.",
        &["scene and technique", "layered", "there", "in full shadow", "away from contact", "RMSE"],
    );
    for (scene, resolution) in [("fence in low sun", [800, 600]), ("layers", [640, 480])] {
        let study = bench.study(bench.shot(scene, resolution), bench.map(2048), &SPECS)?;
        let ideal = &bench.truths(&study, &[Truth::LightSpace(KERNEL)])?[0];
        let regions = bench.regions(&study, NEAR)?;
        let region = |name| regions.get(name).map(Vec::as_slice).unwrap_or_default();
        let [vsm, csm] = [study.look(SPECS[0])?, study.look(SPECS[1])?];
        let visible = [vsm.visibility()?.values, csm.visibility()?.values];
        let values = ideal.truth.image.values.iter().zip(&ideal.truth.shadowable);
        let shadow: Vec<bool> = values.map(|(v, s)| *s && *v == 0.0).collect();
        let both = |mask: &[bool], other: bool| -> Vec<bool> {
            shadow.iter().zip(mask).map(|(s, m)| *s && *m == other).collect()
        };
        let (layered, away) = (both(region("layers"), true), both(region("contact"), false));
        let share = mean(&layered.iter().map(|l| f32::from(u8::from(*l))).collect::<Vec<_>>(), &shadow);
        let there = visible.each_ref().map(|v| mean(v, &layered));
        for ((spec, visible), there) in SPECS.iter().zip(&visible).zip(there) {
            let rmse = bench.score(&study, spec, ideal, None)?.rmse;
            let cells = [
                (share, Unit::Share),
                (there, Unit::Share),
                (mean(visible, &shadow), Unit::Share),
                (mean(visible, &away), Unit::Share),
                (Some(rmse), Unit::Number),
            ];
            table.row(format!("{scene}: {spec}"), cells.map(|(v, unit)| Cell::ours(v, unit)).into());
        }
        page.verdict(no_leaking(scene, share, there));
        let window = gallery::window(&difference_in(vsm, ideal, &layered), &vsm.picture, 8);
        let captions = [
            format!("The scene {scene}, as in the figure, with what rays say on the right."),
            "Enlarged: where the VSM is most wrong behind several casters.".into(),
        ];
        let pictures = [
            ("(a) VSM", &vsm.picture),
            ("(b) CSM, M = 16", &csm.picture),
            ("rays, filtered 7×7 in light space", &ideal.picture),
        ];
        gallery::rows(&mut page, [&captions[0], &captions[1]], 3, &pictures, window)?;
    }
    page.table(table);
    Ok(page)
}

/// How much a picture differs from the ideal where a mask is set, 0 elsewhere.
fn difference_in(look: &Look, ideal: &Traced, mask: &[bool]) -> Vec<f64> {
    let mut wrong = difference(&look.picture, &ideal.picture);
    wrong.iter_mut().zip(mask).filter(|(_, shown)| !**shown).for_each(|(w, _)| *w = 0.0);
    wrong
}

/// Mean over the pixels of a mask; `None` if there is none.
fn mean(values: &[f32], mask: &[bool]) -> Option<f64> {
    let chosen = || values.iter().zip(mask).filter(|(_, m)| **m).map(|(v, _)| f64::from(*v));
    let count = chosen().count();
    (count > 0).then(|| chosen().sum::<f64>() / count as f64)
}

/// Share of the shadow that is layered; mean visibility of the VSM and of the CSM there.
fn no_leaking(scene: &str, share: Option<f64>, [vsm, csm]: [Option<f64>; 2]) -> Verdict {
    Verdict::new(
        csm_says(
            "§5",
            "Convolution Shadow Maps do not suffer from these artifacts and can deal with high depth complexity.",
        ),
        format!("CSM does not leak behind several casters, where VSM does (scene {scene})"),
        Ran::new(&format!("{scene}, 2048²"), SPECS),
        [
            at_least("share of the shadow behind several casters", share, "5 %", 0.05)
                .ours("fewer pixels would not be what the figure is about"),
            less("visibility of the CSM there", csm, "that of the VSM", vsm).sentence(),
            at_most("visibility of the CSM there", csm, "1 %", 0.01)
                .ours("fewer than three levels of an 8-bit picture do not show")
                .was(
                    "a tenth of the VSM's where the VSM leaks and the ramp of the CSM does not reach",
                    "those pixels were chosen by how the two fail",
                ),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(no_leaking("s", Some(0.1), [Some(0.2), Some(0.002)]).outcome(), Holds);
        assert_eq!(no_leaking("s", Some(0.1), [Some(0.2), Some(0.05)]).outcome(), Differs);
        assert_eq!(no_leaking("s", Some(0.1), [Some(0.001), Some(0.002)]).outcome(), Differs);
        assert_eq!(no_leaking("s", Some(0.01), [Some(0.2), Some(0.002)]).outcome(), Differs);
        assert_eq!(no_leaking("s", None, [None, None]).outcome(), Open);
        assert_eq!(mean(&[1.0, 0.5, 0.25], &[false, true, true]), Some(0.375));
        assert_eq!(mean(&[1.0], &[false]), None);
    }
}
