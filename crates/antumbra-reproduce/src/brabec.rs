//! Brabec and Seidel 2001, Hardware-accelerated rendering of antialiased shadows with shadow maps.

use crate::{
    gallery,
    numbers::{Measured, smallest},
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::Timed,
    target::{Source, Target},
    verdict::{Ran, Verdict, at_most, brabec, less, more},
    workbench::Workbench,
};
use antumbra_lab::image::GrayImage;
use antumbra_lab::truth::{Truth, TruthImage};
use anyhow::Result;

mod depths;
mod maps;

pub(crate) const SOURCE: Source = Source {
    key: "brabec",
    name: "Brabec and Seidel 2001, Hardware-accelerated rendering of antialiased shadows",
    targets: &[
        Target {
            id: "brabec/figure-7",
            title: "Four ways to filter a shadow map of 512²",
            paper: "7,000 polygons, 800×600 pixels, a 512² map: without filtering (25 to 30 fps), PCF 2×2 of four jittered \
                    passes (10 fps), fast PCF 2×2 of packed neighbours (15 to 20 fps), fast PCF 4×4 (5 fps). Fast PCF is \
                    comparable to PCF in quality; with 4×4 blockiness is reduced to a minimum.",
            ours: "The scene brabec (7,000 triangles, a spot light) at the same sizes. stratified is the PCF of jittered \
                   passes, packed the fast one. The truth is sharp, with 16 rays per pixel.",
            seconds: [20, 4],
            run: figure_7,
        },
        Target {
            id: "brabec/figure-8",
            title: "A larger map still wants filtering",
            paper: "A 1024² map without filtering is still blocky (15 fps); with fast PCF 2×2 boundaries are smooth (10 fps).",
            ours: "The scene brabec from half the distance, with a 1024² map.",
            seconds: [15, 4],
            run: figure_8,
        },
        Target {
            id: "brabec/levels",
            title: "Levels of grey",
            paper: "Sections 3 and 4: a 2×2 footprint has five levels of shadowing; fast PCF 4×4 adds four phases of five \
                    levels, which makes 20.",
            ours: "The scene brabec, 800×600 pixels, a 512² map. Levels are the different bytes in the picture of \
                   visibility, and all that any pattern of shadow in 4×4 texels can give.",
            seconds: [15, 4],
            run: depths::grey_levels,
        },
        Target {
            id: "brabec/depth",
            title: "Depths of few bits",
            paper: "Section 6: encoding depth in 8 bits of a colour loses precision; 12 bits per channel are a solution.",
            ours: "The scene brabec, 800×600 pixels, a 512² map, fast PCF 2×2 of linear depths in 8, 12, 16 bits and \
                   floats, with a bias that does not know their steps. The paper's depth is a linear ramp whose ends it \
                   does not tell; ours runs from the lamp to the farthest receiver. A bias that knows the steps and a \
                   standard map of projected depths, which the paper has not, are shown beside.",
            seconds: [15, 5],
            run: depths::few_bits,
        },
        Target {
            id: "brabec/sampling",
            title: "Finer maps by jittered passes, and stochastic sampling",
            paper: "Four jittered passes double the effective resolution each way (section 3). Sampling artifacts of a map \
                    are solved by more resolution and by stochastic sampling instead of regular grid points (section 1).",
            ours: "The scene brabec, 800×600 pixels: stratified maps of 512² with 2×2 to 4×4 passes, each pass in the middle of \
                   its cell or at a place of its own there, and standard maps of 512² to 2048².",
            seconds: [20, 6],
            run: maps::sampling,
        },
        Target {
            id: "brabec/static",
            title: "A light that stands still",
            paper: "With stationary lighting the map is computed beforehand, which makes PCF with filters larger than 2×2 \
                    affordable (section 5).",
            ours: "The scene brabec, 800×600 pixels, a 512² map: frames whose map is drawn anew, and frames whose map is kept.",
            seconds: [15, 5],
            run: maps::kept,
        },
    ],
};

/// Spec, name, frames per second.
const FIGURE_7: [(&str, &str, f64); 4] = [
    ("hard", "(a) without filtering", 27.5),
    ("stratified.grid=2", "(b) PCF 2×2", 10.0),
    ("packed.grid=2", "(c) fast PCF 2×2", 17.5),
    ("packed.grid=4", "(d) fast PCF 4×4", 5.0),
];

fn figure_7(bench: &Workbench<'_>) -> Result<Page> {
    let Filters { mut page, errors, strays, times } = filters(bench, 1.0, 512, &FIGURE_7)?;
    page.verdict(close_to_pcf(errors[1], errors[2], errors[0]));
    page.verdict(faster_than_pcf(times[2].over(&times[1])));
    page.verdict(least_blocky([strays[0], strays[2], strays[3]]));
    page.verdict(slowest([0, 1, 2].map(|i| times[3].over(&times[i]))));
    page.text(
        "The wider footprint smooths away blocks and sharp edges alike: its error to the sharp truth grows. Where its \
         visibility passes one half is another matter: that line follows the texels or the true edge.",
    );
    Ok(page)
}

fn figure_8(bench: &Workbench<'_>) -> Result<Page> {
    let pair = [("hard", "(a) without filtering", 15.0), ("packed.grid=2", "(b) fast PCF 2×2", 10.0)];
    let Filters { mut page, strays, .. } = filters(bench, 0.5, 1024, &pair)?;
    page.verdict(smooth(strays[0], strays[1]));
    Ok(page)
}

/// How ways to filter compare.
struct Filters {
    page: Page,
    /// RMSE to the truth.
    errors: Vec<f64>,
    /// What [`strays`] says.
    strays: Vec<f64>,
    times: Vec<Timed>,
}

/// Share of the pixels that can be in shadow which are on the other side of one half than the truth. The
/// line of one half bounds a shadow however wide it is blurred: no blur moves it by itself.
fn strays(visibility: &GrayImage, truth: &TruthImage) -> f64 {
    let pairs = || visibility.values.iter().zip(&truth.image.values).zip(&truth.shadowable);
    let all = pairs().filter(|(_, s)| **s).count();
    let stray = pairs().filter(|((v, t), s)| **s && (**v > 0.5) != (**t > 0.5)).count();
    stray as f64 / all.max(1) as f64
}

/// Pictures, a table and its numbers.
fn filters(bench: &Workbench<'_>, distance: f32, map: u32, row: &[(&str, &str, f64)]) -> Result<Filters> {
    let specs: Vec<&str> = row.iter().map(|r| r.0).collect();
    let (shot, map) = (bench.shot("brabec", [800, 600]).from(distance), bench.map(map));
    let study = bench.study(shot, map, &specs)?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let frames: Vec<(u32, &str)> = specs.iter().map(|s| (map, *s)).collect();
    let times = bench.times(shot, &frames, bench.rounds())?;
    let mut table = Table::new(
        "RMSE to the truth; strays, the pixels on the other side of one half than the truth; frame time over that \
         without filtering (the paper's from frames per second).",
        &["technique", "RMSE", "strays", "frame time"],
    );
    let (mut errors, mut outside, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for ((spec, name, fps), time) in row.iter().zip(&times) {
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        let stray = strays(&study.look(spec)?.visibility()?, &truth.truth);
        let ratio = time.over(&times[0]).value;
        let own = [Cell::ours(rmse, Unit::Number), Cell::ours(stray, Unit::Share)];
        let time = Cell::ours(ratio, Unit::Times).paper(row[0].2 / fps);
        table.row(*name, own.into_iter().chain([time]).collect());
        errors.push(rmse);
        outside.push(stray);
        pictures.push((*name, &study.look(spec)?.picture));
    }
    pictures.push(("16 rays per pixel", &truth.picture));
    let mut page = Page::default();
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = [
        "As in the figure, with what rays say on the right.",
        "Enlarged: where no filtering looks most wrong.",
    ];
    gallery::rows(&mut page, captions, pictures.len(), &pictures, window)?;
    page.table(table);
    Ok(Filters { page, errors, strays: outside, times })
}

const SCENE: &str = "brabec, 800×600, 512²";

fn close_to_pcf(pcf: f64, fast: f64, none: f64) -> Verdict {
    Verdict::new(
        brabec("§5", "resulting in an image quality comparable to the normal PCF method"),
        "Fast PCF 2×2 is close to PCF 2×2 in quality",
        Ran::new(SCENE, [FIGURE_7[0].0, FIGURE_7[1].0, FIGURE_7[2].0]),
        [
            at_most("RMSE of fast PCF", fast, "that of PCF and a quarter", 1.25 * pcf)
                .ours("comparable errs by no more than a quarter more"),
            less("RMSE of fast PCF", fast, "that without filtering", none)
                .ours("what does not improve on no filter is comparable to none"),
        ],
    )
}

fn faster_than_pcf(ratio: Measured) -> Verdict {
    Verdict::new(
        brabec(
            "§5",
            "With fast percentage closer filtering enabled (Section 4), we can achieve nearly real-time frame rates of about 15 – 20 fps.",
        ),
        "Fast PCF 2×2 is faster than PCF 2×2",
        Ran::new(SCENE, [FIGURE_7[1].0, FIGURE_7[2].0]),
        [less("its frame time over that of PCF", ratio, "1", 1.0)
            .document("§5: 15 to 20 frames per second, and 10 for PCF")],
    )
}

const NOT_BY_BLUR: &str = "any blur lowers that, whatever it does to blocks";
const BEFORE: &str = "the RMS change of visibility from pixel to pixel";

/// Strays without filtering, of fast PCF 2×2 and 4×4.
fn least_blocky([none, two, four]: [f64; 3]) -> Verdict {
    Verdict::new(
        brabec("§5", "Having about 20 different levels of shadowing, blockiness is reduced to a minimum."),
        "Fast PCF 4×4 has the least blockiness: its outline follows the true one most closely",
        Ran::new(SCENE, [FIGURE_7[0].0, FIGURE_7[2].0, FIGURE_7[3].0]),
        [
            less("strays of fast PCF 2×2", two, "those without filtering", none).sentence(),
            less("strays of fast PCF 4×4", four, "those of 2×2", two).sentence().was(BEFORE, NOT_BY_BLUR),
        ],
    )
}

/// Frame times of fast PCF 4×4 over those without filtering, of PCF 2×2 and of fast PCF 2×2.
fn slowest(ratios: [Measured; 3]) -> Verdict {
    Verdict::new(
        brabec("§5", "Due to this, a frame rate of only 5 fps can be achieved."),
        "Fast PCF 4×4 is the slowest of the four",
        Ran::new(SCENE, FIGURE_7.map(|f| f.0)),
        [more("its least frame time over that of another", smallest(ratios), "1", 1.0)
            .document("§5: 25 to 30, 10 and 15 to 20 frames per second for the others")],
    )
}

fn smooth(none: f64, fast: f64) -> Verdict {
    Verdict::new(
        brabec(
            "§5",
            "Using fast PCF with a filter size of 2 × 2, shadow boundaries appear well smoothed (right).",
        ),
        "At 1024² too, the outline of fast PCF follows the true one more closely",
        Ran::new("brabec from half the distance, 800×600, 1024²", [FIGURE_7[0].0, FIGURE_7[2].0]),
        [less("strays of fast PCF 2×2", fast, "those without filtering", none)
            .sentence()
            .was(format!("{BEFORE}, more than 1.1 times that of fast PCF"), NOT_BY_BLUR)],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(close_to_pcf(0.1, 0.12, 0.2).outcome(), Holds);
        assert_eq!(close_to_pcf(0.1, 0.13, 0.2).outcome(), Differs);
        assert_eq!(close_to_pcf(0.1, 0.12, 0.11).outcome(), Differs);
        assert_eq!(faster_than_pcf(Measured::exact(0.75)).outcome(), Holds);
        assert_eq!(faster_than_pcf(Measured::exact(1.5)).outcome(), Differs);
        assert_eq!(least_blocky([0.3, 0.2, 0.1]).outcome(), Holds);
        assert_eq!(least_blocky([0.3, 0.1, 0.2]).outcome(), Differs);
        assert_eq!(smooth(0.2, 0.1).outcome(), Holds);
        assert_eq!(smooth(0.1, 0.1).outcome(), Differs);
        assert_eq!(slowest([2.0, 1.1, 1.2].map(Measured::exact)).outcome(), Holds);
        assert_eq!(slowest([2.0, 0.9, 1.2].map(Measured::exact)).outcome(), Differs);
    }

    #[test]
    fn an_outline_strays_by_its_place_and_not_by_its_blur() {
        let edge = |at: f32, width: f32| {
            GrayImage::from_fn(20, 2, |x, _| ((x as f32 + 0.5 - at) / width + 0.5).clamp(0.0, 1.0))
        };
        let truth = TruthImage { image: edge(10.0, 0.01), shadowable: vec![true; 40] };
        assert_eq!(strays(&edge(10.0, 8.0), &truth), 0.0);
        assert_eq!(strays(&edge(13.0, 1.0), &truth), 0.15);
        let nowhere = TruthImage { shadowable: vec![false; 40], ..truth };
        assert_eq!(strays(&edge(13.0, 1.0), &nowhere), 0.0);
    }
}
