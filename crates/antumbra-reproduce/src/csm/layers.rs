//! Figure 9: leaking.

use crate::{
    gallery,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::{Look, Traced},
    verdict::{Ran, Verdict, csm as csm_says, less},
    workbench::Workbench,
};
use antumbra_lab::image::GrayImage;
use antumbra_lab::truth::Truth;
use anyhow::Result;

const SPECS: [&str; 2] = ["vsm.kernel=7,sampling=trilinear", "csm.kernel=7,sampling=trilinear"];
const KERNEL: u32 = 7;
/// Share of the depth range: the ramp of a CSM with 16 terms.
const NEAR: f64 = 0.07;
/// Pixels around one that may not be lit.
const DEEP: usize = 4;
/// A VSM leaks from this visibility on.
const LEAKS: f32 = 0.05;

pub(super) fn figure_9(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "Mean visibility where the ideal is 0, and RMSE to the ideal of 7×7.",
        &["scene and technique", "where the VSM leaks", "of all full shadow", "anywhere", "RMSE"],
    );
    for (scene, resolution) in [("fence", [800, 600]), ("layers", [640, 480])] {
        let study = bench.study(bench.shot(scene, resolution), bench.map(2048), &SPECS)?;
        let ideal = &bench.truths(&study, &[Truth::LightSpace(KERNEL)])?[0];
        let regions = bench.regions(&study, NEAR)?;
        let contact = regions.get("contact").map(Vec::as_slice).unwrap_or_default();
        let [vsm, csm] = [study.look(SPECS[0])?, study.look(SPECS[1])?];
        let visible = [vsm.visibility()?.values, csm.visibility()?.values];
        let shadow: Vec<bool> = ideal
            .truth
            .image
            .values
            .iter()
            .zip(&ideal.truth.shadowable)
            .map(|(v, s)| *s && *v == 0.0)
            .collect();
        let deep = deep(&ideal.truth.image, &ideal.truth.shadowable);
        let leaking: Vec<bool> = (0..shadow.len())
            .map(|i| deep[i] && shadow[i] && visible[0][i] > LEAKS && contact.get(i) == Some(&false))
            .collect();
        let share = mean(&leaking.iter().map(|l| f32::from(u8::from(*l))).collect::<Vec<_>>(), &shadow);
        let there = visible.each_ref().map(|v| mean(v, &leaking));
        for ((spec, visible), there) in SPECS.iter().zip(&visible).zip(there) {
            let rmse = bench.score(&study, spec, ideal, None)?.rmse;
            let cells = [
                (there, Unit::Share),
                (share, Unit::Share),
                (mean(visible, &shadow), Unit::Share),
                (Some(rmse), Unit::Number),
            ];
            table.row(format!("{scene}: {spec}"), cells.map(|(v, unit)| Cell::ours(v, unit)).into());
        }
        page.verdict(no_leaking(scene, there));
        // Where it leaks nowhere, in all full shadow.
        let shown = if leaking.contains(&true) { &leaking } else { &shadow };
        let window = gallery::window(&difference_in(vsm, ideal, shown), &vsm.picture, 8);
        let captions = [
            format!("The scene {scene}, as in the figure, with what rays say on the right."),
            "Enlarged: where the VSM is most wrong in full shadow.".into(),
        ];
        let pictures = [
            ("(a) VSM", &vsm.picture),
            ("(b) CSM, M = 16", &csm.picture),
            ("rays, filtered 7×7 in light space", &ideal.picture),
        ];
        gallery::rows(&mut page, [&captions[0], &captions[1]], 3, &pictures, window)?;
    }
    page.table(table);
    page.text(
        "Where the VSM leaks: its visibility is above 0.05 in full shadow whose caster is farther away than the ramp \
         of the CSM. Closer to casters the smooth step of the CSM has no room to fall, and there it is the CSM that \
         is too bright (see figure 6).",
    );
    Ok(page)
}

/// How much a picture differs from the ideal where a mask is set, 0 elsewhere.
fn difference_in(look: &Look, ideal: &Traced, mask: &[bool]) -> Vec<f64> {
    let mut wrong = difference(&look.picture, &ideal.picture);
    wrong.iter_mut().zip(mask).filter(|(_, shown)| !**shown).for_each(|(w, _)| *w = 0.0);
    wrong
}

/// Pixels with none nearby that can be lit and is: those that a filter of a pixel's footprint may not
/// brighten either.
fn deep(ideal: &GrayImage, shadowable: &[bool]) -> Vec<bool> {
    let [width, height] = [ideal.width, ideal.height].map(|n| n as usize);
    let lit: Vec<bool> = ideal.values.iter().zip(shadowable).map(|(v, s)| *s && *v > 0.0).collect();
    let around = |at: usize, size: usize| at.saturating_sub(DEEP)..(at + DEEP + 1).min(size);
    let is_deep = |i: usize| {
        let (x, y) = (i % width, i / width);
        around(y, height).all(|row| around(x, width).all(|column| !lit[row * width + column]))
    };
    (0..lit.len()).map(is_deep).collect()
}

/// Mean over the pixels of a mask; `None` if there is none.
fn mean(values: &[f32], mask: &[bool]) -> Option<f64> {
    let chosen = || values.iter().zip(mask).filter(|(_, m)| **m).map(|(v, _)| f64::from(*v));
    let count = chosen().count();
    (count > 0).then(|| chosen().sum::<f64>() / count as f64)
}

/// Mean visibility of the VSM and of the CSM where the VSM leaks.
fn no_leaking(scene: &str, [vsm, csm]: [Option<f64>; 2]) -> Verdict {
    Verdict::new(
        csm_says("§5", "Convolution Shadow Maps do not suffer from these artifacts and can deal with high depth complexity."),
        format!("CSM does not leak where VSM does (scene {scene})"),
        Ran::new(&format!("{scene}, 2048²"), SPECS),
        [less("visibility of the CSM there", csm, "a tenth of the VSM's", vsm.map(|v| 0.1 * v))
            .ours("the paper says none, which no sum of 16 waves is")
            .was(
                "less than the VSM's and at most 1 % behind layered casters",
                "the pixels were chosen anew as those where the VSM leaks and the ramp of the CSM does not reach",
            )],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(no_leaking("s", [Some(0.2), Some(0.002)]).outcome(), Holds);
        assert_eq!(no_leaking("s", [Some(0.2), Some(0.05)]).outcome(), Differs);
        assert_eq!(no_leaking("s", [None, None]).outcome(), Open);
        assert_eq!(mean(&[1.0, 0.5, 0.25], &[false, true, true]), Some(0.375));
        assert_eq!(mean(&[1.0], &[false]), None);
        let ideal = GrayImage::from_fn(20, 1, |x, _| f32::from(u8::from(x == 10)));
        let deep = deep(&ideal, &[true; 20]);
        assert_eq!([deep[5], deep[6], deep[14], deep[15]], [true, false, false, true]);
    }
}
