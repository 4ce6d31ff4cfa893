//! Figures 1 and 8: what ESM looks like beside CSM and VSM, and what it takes.

use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::{Look, Study, Traced},
    verdict::{Fact, Ran, Verdict, at_least, at_most, esm as esm_says, less},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// Spec, name.
const SPECS: [(&str, &str); 3] = [
    ("csm.kernel=5,sampling=trilinear", "CSM"),
    ("vsm.kernel=5,sampling=trilinear", "VSM"),
    ("esm.kernel=5,sampling=trilinear", "ESM"),
];
/// Frames per second and megabytes of CSM, VSM, ESM.
const PAPER: [(f64, f64); 3] = [(22.0, 170.0), (84.0, 42.0), (94.0, 21.0)];
const KERNEL: u32 = 5;
/// Share of the depth range within which a caster is in contact.
const NEAR: f64 = 0.05;

/// Errors of CSM, VSM and ESM.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Errors {
    all: f64,
    leak: Option<f64>,
    contact: Option<f64>,
}

fn errors(bench: &Workbench<'_>, study: &Study, ideal: &Traced) -> Result<[Errors; 3]> {
    let regions = bench.regions(study, NEAR)?;
    let contact = regions.get("contact").map(Vec::as_slice).unwrap_or_default();
    let away: Vec<bool> = contact.iter().map(|c| !c).collect();
    let of = |spec: &str| -> Result<Errors> {
        Ok(Errors {
            all: bench.score(study, spec, ideal, None)?.rmse,
            leak: bench.score(study, spec, ideal, Some(("away", &away)))?.leak,
            contact: Some(bench.score(study, spec, ideal, Some(("contact", contact)))?.rmse),
        })
    };
    Ok([of(SPECS[0].0)?, of(SPECS[1].0)?, of(SPECS[2].0)?])
}

fn error_table(errors: &[Errors; 3]) -> Table {
    let mut table = Table::new(
        "Leak: mean visibility in full shadow away from casters. Contact: RMSE where the caster is near.",
        &["technique", "RMSE to the ideal of 5×5", "leak", "RMSE at contact"],
    );
    for ((_, name), e) in SPECS.iter().zip(errors) {
        let cells = [
            Cell::ours(e.all, Unit::Number),
            Cell::ours(e.leak, Unit::Share),
            Cell::ours(e.contact, Unit::Number),
        ];
        table.row(*name, cells.into());
    }
    table
}

fn show(page: &mut Page, study: &Study, ideal: &Traced) -> Result<()> {
    let mut pictures = Vec::new();
    for (spec, name) in SPECS {
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("rays, filtered 5×5 in light space", &ideal.picture));
    let against = [("VSM", pictures[1].1), ("CSM", pictures[0].1)];
    for (i, (name, picture)) in against.into_iter().enumerate() {
        let window = gallery::window(&difference(picture, &ideal.picture), picture, 8);
        let closer = format!("Enlarged: where {name} looks most wrong.");
        let captions = ["As in the figure, with what rays say on the right.", closer.as_str()];
        if i == 0 {
            gallery::rows(page, captions, 4, &pictures, window)?;
        } else {
            gallery::close_ups(page, captions[1], 4, &pictures, window)?;
        }
    }
    Ok(())
}

/// Bytes of the filtered textures, mip levels included; the depth map is another matter.
fn filtered_bytes(look: &Look) -> f64 {
    look.memory.items.iter().filter(|i| i.mips > 1).map(|i| i.bytes as f64).sum()
}

pub(super) fn figure_1(bench: &Workbench<'_>) -> Result<Page> {
    let (shot, map) = (bench.shot("backyard", [800, 600]), bench.map(2048));
    let study = bench.study(shot, map, &SPECS.map(|s| s.0))?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(KERNEL)])?[0];
    let errors = errors(bench, &study, ideal)?;
    let times = bench.times(shot, &SPECS.map(|s| (map, s.0)), bench.rounds())?;
    let over = |i: usize| times[i].over(&times[2]);
    let mut table = Table::new(
        "Memory of the filtered maps with mip levels, and frame time over that of ESM.",
        &["technique", "memory", "frame time"],
    );
    let mut bytes = Vec::new();
    for (i, ((spec, name), (fps, megabytes))) in SPECS.iter().zip(PAPER).enumerate() {
        bytes.push(filtered_bytes(study.look(spec)?));
        let memory =
            Cell::ours(bytes[i], Unit::Bytes).paper((!bench.quick).then_some(megabytes * 1_048_576.0));
        table.row(*name, vec![memory, Cell::ours(over(i).value, Unit::Times).paper(PAPER[2].0 / fps)]);
    }
    let mut page = Page::default();
    page.fact(eight_times_less(bytes[0], bytes[2]));
    page.verdict(faster(over(0), over(1)));
    page.verdict(better_contact(FIGURE_1, errors[0].contact, errors[2].contact));
    show(&mut page, &study, ideal)?;
    page.table(table);
    page.table(error_table(&errors));
    Ok(page)
}

pub(super) fn figure_8(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("fence", [800, 600]), bench.map(2048), &SPECS.map(|s| s.0))?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(KERNEL)])?[0];
    let errors = errors(bench, &study, ideal)?;
    let mut page = Page::default();
    page.verdict(less_leaking(errors[1].leak, errors[2].leak));
    page.verdict(better_contact(FIGURE_8, errors[0].contact, errors[2].contact));
    page.verdict(as_good_as_csm(errors[0].all, errors[2].all));
    show(&mut page, &study, ideal)?;
    page.table(error_table(&errors));
    Ok(page)
}

fn eight_times_less(csm: f64, esm: f64) -> Fact {
    Fact {
        claim: "ESM takes 8× less memory than CSM with 16 terms.".into(),
        source: esm_says("figure 1", "ESMs require 8× less memory than CSMs"),
        found: format!("The filtered maps of CSM take {:.2} times the bytes of ESM's.", csm / esm),
        because: "32 coefficients of 8 bits are 8 floats of 32, and mip levels add the same share to both"
            .into(),
    }
}

const FIGURE_1: &str = "backyard, 800×600, 2048²";
const FIGURE_8: &str = "fence, 800×600, 2048²";

/// Frame times over ESM's.
fn faster(csm: Measured, vsm: Measured) -> Verdict {
    Verdict::new(
        esm_says("figure 1", "CSMs (22 FPS, 170 MB), VSMs (84 FPS, 42 MB), and ESMs (94 FPS, 21 MB)"),
        "ESM is faster than CSM and not slower than VSM",
        Ran::new(FIGURE_1, SPECS.map(|s| s.0)),
        [
            at_least("frame time of CSM over that of ESM", csm, "1.5", 1.5).ours(
                "the paper's 4.3 is of a card; what is called faster here takes two thirds of the time",
            ),
            at_least("frame time of VSM over that of ESM", vsm, "1, within 5 %", 0.95)
                .ours("not slower, less what the caches of a machine may turn"),
        ],
    )
}

fn less_leaking(vsm: Option<f64>, esm: Option<f64>) -> Verdict {
    Verdict::new(
        esm_says(
            "figure 8",
            "At the same time they don't suffer from light leaking as much as VSMs (top closeups).",
        ),
        "ESM leaks less than VSM",
        Ran::new(FIGURE_8, [SPECS[1].0, SPECS[2].0]),
        [less("leak of ESM away from casters", esm, "that of VSM", vsm).sentence()],
    )
}

fn better_contact(scene: &str, csm: Option<f64>, esm: Option<f64>) -> Verdict {
    Verdict::new(
        esm_says("§5", "The closeups show that ESMs perform better at contact shadows than CSMs"),
        "Contact shadows of ESM are better than those of CSM",
        Ran::new(scene, [SPECS[0].0, SPECS[2].0]),
        [less("RMSE of ESM at contact", esm, "that of CSM", csm).sentence()],
    )
}

fn as_good_as_csm(csm: f64, esm: f64) -> Verdict {
    Verdict::new(
        esm_says("§5", "the filtering quality between ESMs and CSMs is virtually not distinguishable"),
        "ESM filters as well as CSM",
        Ran::new(FIGURE_8, [SPECS[0].0, SPECS[2].0]),
        [at_most("RMSE of ESM to the filtered ideal", esm, "that of CSM", csm).sentence()],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        let faster = |csm, vsm| faster(Measured::exact(csm), Measured::exact(vsm)).outcome();
        assert_eq!([faster(3.0, 1.1), faster(1.2, 1.1), faster(3.0, 0.8)], [Holds, Differs, Differs]);
        assert_eq!(less_leaking(Some(0.2), Some(0.1)).outcome(), Holds);
        assert_eq!(less_leaking(Some(0.1), Some(0.2)).outcome(), Differs);
        assert_eq!(better_contact("s", Some(0.2), Some(0.1)).outcome(), Holds);
        assert_eq!(better_contact("s", Some(0.1), Some(0.2)).outcome(), Differs);
        assert_eq!(as_good_as_csm(0.2, 0.1).outcome(), Holds);
        assert_eq!(as_good_as_csm(0.1, 0.2).outcome(), Differs);
    }
}
