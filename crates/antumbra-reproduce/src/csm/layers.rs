//! Figure 9: leaking.

use crate::{
    bench::Bench,
    page::{Cell, Page, Table, Tile, Unit},
    raster::{busiest, difference},
    study::Truth,
    verdict::{Verdict, at_most, less},
};
use anyhow::Result;

const SPECS: [&str; 2] = ["vsm.kernel=7", "csm.kernel=7"];
const KERNEL: u32 = 7;
/// Share of the depth range: wider than the ramp of a CSM with 16 terms, 7 %.
const NEAR: f64 = 0.1;

pub(super) fn figure_9(bench: &Bench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "Leak: mean visibility where the ideal is 0. RMSE: to the light-space ideal of 7×7.",
        &["scene and technique", "leak behind layers", "leak anywhere", "RMSE"],
    );
    for (scene, resolution) in [("fence", [800, 600]), ("layers", [640, 480])] {
        let study = bench.study(bench.shot(scene, resolution), bench.map(2048), &SPECS)?;
        let ideal = &bench.truths(&study, &[Truth::LightSpace(KERNEL)])?[0];
        let regions = bench.regions(&study, NEAR)?;
        let layers = regions.get("layers").map(Vec::as_slice).unwrap_or_default();
        let mut behind = Vec::new();
        for spec in SPECS {
            let all = bench.score(&study, spec, ideal, None)?;
            let leak = bench.score(&study, spec, ideal, Some(("layers", layers)))?.leak;
            let cells = [(leak, Unit::Share), (all.leak, Unit::Share), (Some(all.rmse), Unit::Number)];
            table.row(format!("{scene}: {spec}"), cells.map(|(v, unit)| Cell::ours(v, unit)).into());
            behind.push(leak);
        }
        page.verdict(no_leaking(scene, behind[0], behind[1]));
        let [vsm, csm] = [study.look(SPECS[0])?, study.look(SPECS[1])?];
        // Where the VSM looks most wrong behind several layers.
        let mut wrong = difference(&vsm.picture, &ideal.picture);
        wrong.iter_mut().zip(layers).filter(|(_, l)| !**l).for_each(|(w, _)| *w = 0.0);
        let [w, h] = study.shot.resolution;
        let window = busiest(&wrong, [w, h], [w / 8, h / 8]);
        let mut whole = Vec::new();
        let mut close = Vec::new();
        for (name, picture) in [
            ("(a) VSM", &vsm.picture),
            ("(b) CSM, M = 16", &csm.picture),
            ("rays, filtered 7×7 in light space", &ideal.picture),
        ] {
            whole.push(Tile::new(name, &picture.framed(window))?);
            close.push(Tile::close_up(name, picture, window)?);
        }
        page.pictures(
            format!("The scene {scene}, as in the figure, with what rays say on the right."),
            3,
            whole,
        );
        page.pictures("Enlarged: where the VSM looks most wrong behind layers.", 3, close);
    }
    page.table(table);
    page.text(
        "Anywhere includes shadows close to what casts them, where the smooth step of a CSM has no room to fall: \
         there it is the CSM that is too bright (see figure 6).",
    );
    Ok(page)
}

/// What a CSM may leave: a few levels of its 8-bit coefficients.
const NOTHING: f64 = 0.01;

fn no_leaking(scene: &str, vsm: Option<f64>, csm: Option<f64>) -> Verdict {
    Verdict::new(
        format!("CSM does not leak behind layers where VSM does (scene {scene})"),
        [
            less("leak of the CSM behind layers", csm, "that of the VSM", vsm),
            at_most("leak of the CSM behind layers", csm, "1 %", NOTHING),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(no_leaking("s", Some(0.03), Some(0.002)).outcome(), Holds);
        assert_eq!(no_leaking("s", Some(0.001), Some(0.002)).outcome(), Differs);
        assert_eq!(no_leaking("s", Some(0.3), Some(0.1)).outcome(), Differs);
        assert_eq!(no_leaking("s", Some(0.03), None).outcome(), Open);
    }
}
