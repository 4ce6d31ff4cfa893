//! What becomes of maps: jittered passes (section 3), stochastic sampling (section 1), maps that are kept
//! (section 5).

use super::strays;
use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_most, brabec, less},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// Map, spec, name.
const MAPS: [(u32, &str, &str); 7] = [
    (512, "hard", "standard map, 512²"),
    (1024, "hard", "standard map, 1024²"),
    (2048, "hard", "standard map, 2048²"),
    (512, "stratified.grid=2", "2×2 passes, in the middle"),
    (512, "stratified.grid=2,jitter=random", "2×2 passes, at random"),
    (512, "stratified.grid=4", "4×4 passes, in the middle"),
    (512, "stratified.grid=4,jitter=random", "4×4 passes, at random"),
];
const SCENE: &str = "brabec, 800×600";

pub(super) fn sampling(bench: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Strays: pixels on the other side of one half than 16 rays per pixel; RMSE to those.",
        &["map", "strays", "RMSE"],
    );
    let (mut found, mut pictures, mut truth) = (Vec::new(), Vec::new(), None);
    for (map, spec, name) in MAPS {
        let study = bench.study(bench.shot("brabec", [800, 600]), bench.map(map), &[spec])?;
        let rays = bench.truths(&study, &[Truth::ScreenSpace(4)])?.remove(0);
        let rmse = bench.score(&study, spec, &rays, None)?.rmse;
        let stray = strays(&study.look(spec)?.visibility()?, &rays.truth);
        table.row(name, vec![Cell::ours(stray, Unit::Share), Cell::ours(rmse, Unit::Number)]);
        found.push([stray, rmse]);
        pictures.push((name, study.look(spec)?.picture.clone()));
        truth = Some(rays.picture);
    }
    pictures.extend(truth.map(|rays| ("16 rays per pixel", rays)));
    let pictures: Vec<_> = pictures.iter().map(|(name, picture)| (*name, picture)).collect();
    let mut page = Page::default();
    page.verdict(twice_as_fine(found[3][0], found[1][0]));
    page.verdict(resolution_solves([found[0][1], found[1][1], found[2][1]]));
    page.verdict(stochastic([found[3][1], found[5][1]], [found[4][1], found[6][1]]));
    let window = gallery::window(&difference(pictures[0].1, pictures[7].1), pictures[0].1, 12);
    gallery::close_ups(&mut page, "Enlarged: where the 512² map is most wrong.", 4, &pictures, window)?;
    page.table(table);
    page.text(
        "Each pass draws one image plane, whose shift all of its texels share: at random places the samples of a \
         texel lie unevenly, but every texel has the same pattern.",
    );
    Ok(page)
}

/// Strays of 2×2 passes and of a map twice as large.
fn twice_as_fine(passes: f64, large: f64) -> Verdict {
    Verdict::new(
        brabec(
            "§3",
            "This stratified sampling scheme increases the effective resolution by a factor of two in each dimension",
        ),
        "2×2 passes of 512² outline shadows as a map of 1024² does",
        Ran::new(&format!("{SCENE}, 512² and 1024²"), [MAPS[3].1, MAPS[1].1]),
        [at_most("strays of 2×2 passes", passes, "1.1 times those of a 1024² map", 1.1 * large)
            .ours("as fine is within a tenth; a map of half the size strays about twice as much")],
    )
}

/// Errors of maps from small to large.
fn resolution_solves([small, middle, large]: [f64; 3]) -> Verdict {
    Verdict::new(
        brabec("§1", "The first can be solved by increasing the image resolution"),
        "Larger maps have smaller errors",
        Ran::new(&format!("{SCENE}, 512², 1024² and 2048²"), ["hard"]),
        [
            less("RMSE of 1024²", middle, "that of 512²", small).sentence(),
            less("RMSE of 2048²", large, "that of 1024²", middle).sentence(),
        ],
    )
}

/// Errors of 2×2 and 4×4 passes.
fn stochastic(middles: [f64; 2], random: [f64; 2]) -> Verdict {
    let less_at = |what: &str, i: usize| {
        let what = format!("RMSE of {what} passes at random");
        less(what, random[i], "that of passes in the middle", middles[i]).sentence()
    };
    Verdict::new(
        brabec("§1", "by using stochastic sampling instead of sampling at regular grid points"),
        "Passes at random places of their cells have smaller errors than passes in the middle",
        Ran::new(&format!("{SCENE}, 512²"), [MAPS[3].1, MAPS[4].1, MAPS[5].1, MAPS[6].1]),
        [less_at("2×2", 0), less_at("4×4", 1)],
    )
}

/// Spec, name, whether the map is kept.
const FRAMES: [(&str, &str, bool); 8] = [
    ("hard", "without filtering", false),
    ("hard", "without filtering, map kept", true),
    ("stratified.grid=2", "PCF 2×2", false),
    ("stratified.grid=2", "PCF 2×2, map kept", true),
    ("stratified.grid=4", "PCF 4×4", false),
    ("stratified.grid=4", "PCF 4×4, map kept", true),
    ("packed.grid=4", "fast PCF 4×4", false),
    ("packed.grid=4", "fast PCF 4×4, map kept", true),
];

pub(super) fn kept(bench: &Workbench<'_>) -> Result<Page> {
    let map = bench.map(512);
    let frames = FRAMES.map(|(spec, _, kept)| (map, spec, kept));
    let times = bench.times_kept(bench.shot("brabec", [800, 600]), &frames, bench.rounds())?;
    let mut table = Table::new("Frame times.", &["frame", "time", "over that without filtering"]);
    for ((_, name, _), time) in FRAMES.iter().zip(&times) {
        let ratio = time.over(&times[0]).value;
        table.row(*name, vec![Cell::ours(time.ms(), Unit::Milliseconds), Cell::ours(ratio, Unit::Times)]);
    }
    let mut page = Page::default();
    page.table(table);
    page.verdict(affordable(times[5].over(&times[2]), times[5].over(&times[4])));
    Ok(page)
}

/// Frame time of PCF 4×4 with its map kept over that of PCF 2×2 and of 4×4 with maps drawn anew.
fn affordable(two: Measured, four: Measured) -> Verdict {
    Verdict::new(
        brabec(
            "§5",
            "If we restrict ourselves to stationary lighting, the shadow map generation becomes a precomputing step \
             which makes PCF with filter sizes larger than 2 × 2 affordable.",
        ),
        "PCF 4×4 of a map that is kept takes no longer than PCF 2×2 of one that is drawn anew",
        Ran::new(&format!("{SCENE}, 512²"), ["stratified.grid=2", "stratified.grid=4"]),
        [
            at_most("its frame time over that of PCF 2×2", two, "1", 1.0)
                .ours("the paper calls 2×2 interactive: what takes no longer is affordable"),
            less("its frame time over that with the map drawn anew", four, "1", 1.0).sentence(),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(twice_as_fine(0.0105, 0.01).outcome(), Holds);
        assert_eq!(twice_as_fine(0.02, 0.01).outcome(), Differs);
        assert_eq!(resolution_solves([0.3, 0.2, 0.1]).outcome(), Holds);
        assert_eq!(resolution_solves([0.3, 0.2, 0.2]).outcome(), Differs);
        assert_eq!(stochastic([0.2, 0.2], [0.1, 0.1]).outcome(), Holds);
        assert_eq!(stochastic([0.2, 0.2], [0.1, 0.3]).outcome(), Differs);
        let exact = Measured::exact;
        assert_eq!(affordable(exact(0.9), exact(0.5)).outcome(), Holds);
        assert_eq!(affordable(exact(1.1), exact(0.5)).outcome(), Differs);
        let unsure = Measured { value: 0.99, low: 0.9, high: 1.1 };
        assert_eq!(affordable(unsure, exact(0.5)).outcome(), Open);
    }
}
