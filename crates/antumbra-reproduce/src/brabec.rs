//! Brabec and Seidel 2001, Hardware-accelerated rendering of antialiased shadows with shadow maps.

use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    study::Timed,
    target::{Source, Target},
    verdict::{Ran, Verdict, at_most, brabec, less, more},
    workbench::Workbench,
};
use antumbra_lab::image::GrayImage;
use antumbra_lab::truth::Truth;
use anyhow::Result;

mod depths;

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
                   visibility.",
            seconds: [15, 4],
            run: depths::grey_levels,
        },
        Target {
            id: "brabec/depth",
            title: "Depths of few bits",
            paper: "Section 6: encoding depth in 8 bits of a colour loses precision; 12 bits per channel are a solution.",
            ours: "The scene brabec, 800×600 pixels, a 512² map, fast PCF 2×2 of linear depths in 8, 12, 16 bits and \
                   floats, with and without a bias that knows their steps, and a standard map of projected depths. The paper's depth is a linear ramp whose ends it does \
                   not tell; ours runs from the lamp to the farthest receiver.",
            seconds: [10, 4],
            run: depths::few_bits,
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
    let Filters { mut page, errors, steps, times } = filters(bench, 1.0, 512, &FIGURE_7)?;
    page.verdict(close_to_pcf(errors[1], errors[2], errors[0]));
    page.verdict(faster_than_pcf(times[2].over(&times[1])));
    page.verdict(least_blocky([steps[0], steps[2], steps[3]]));
    page.text(
        "The wider footprint smooths away blocks and sharp edges alike: its error to the sharp truth grows.",
    );
    Ok(page)
}

fn figure_8(bench: &Workbench<'_>) -> Result<Page> {
    let pair = [("hard", "(a) without filtering", 15.0), ("packed.grid=2", "(b) fast PCF 2×2", 10.0)];
    let Filters { mut page, steps, .. } = filters(bench, 0.5, 1024, &pair)?;
    page.verdict(smooth(steps[0], steps[1]));
    Ok(page)
}

/// How ways to filter compare.
struct Filters {
    page: Page,
    /// RMSE to the truth.
    errors: Vec<f64>,
    /// What [`blockiness`] says.
    steps: Vec<f64>,
    times: Vec<Timed>,
}

/// Root of the mean square of what visibility changes by from a pixel to the next, right and below,
/// where both can be in shadow. An edge that is spread over n pixels counts 1/√n of a sharp one.
fn blockiness(visibility: &GrayImage, shadowable: &[bool]) -> f64 {
    let (width, values) = (visibility.width as usize, &visibility.values);
    let (mut sum, mut count) = (0.0, 0_u64);
    for i in 0..values.len() {
        let right = ((i + 1) % width != 0).then_some(i + 1);
        let below = (i + width < values.len()).then_some(i + width);
        for k in right.into_iter().chain(below) {
            if shadowable[i] && shadowable[k] {
                sum += f64::from(values[k] - values[i]).powi(2);
                count += 1;
            }
        }
    }
    (sum / count.max(1) as f64).sqrt()
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
        "RMSE to the truth; blockiness, the RMS change of visibility from pixel to pixel; frame time over that \
         without filtering (the paper's from frames per second).",
        &["technique", "RMSE", "blockiness", "frame time"],
    );
    let (mut errors, mut steps, mut pictures) = (Vec::new(), Vec::new(), Vec::new());
    for ((spec, name, fps), time) in row.iter().zip(&times) {
        let rmse = bench.score(&study, spec, truth, None)?.rmse;
        let blocky = blockiness(&study.look(spec)?.visibility()?, &truth.truth.shadowable);
        let ratio = time.over(&times[0]).value;
        let own = [rmse, blocky].map(|v| Cell::ours(v, Unit::Number));
        let time = Cell::ours(ratio, Unit::Times).paper(row[0].2 / fps);
        table.row(*name, own.into_iter().chain([time]).collect());
        errors.push(rmse);
        steps.push(blocky);
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
    Ok(Filters { page, errors, steps, times })
}

const SCENE: &str = "brabec, 800×600, 512²";

fn close_to_pcf(pcf: f64, fast: f64, none: f64) -> Verdict {
    Verdict::new(
        brabec("§5", "resulting in an image quality comparable to the normal PCF method"),
        "Fast PCF 2×2 is close to PCF 2×2 in quality",
        Ran::new(SCENE, [FIGURE_7[0].0, FIGURE_7[1].0, FIGURE_7[2].0]),
        [
            at_most("RMSE of fast PCF", fast, "that of PCF and a quarter", 1.25 * pcf).ours(
                "comparable is less than twice as far off as going without any filter would leave room for",
            ),
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

/// Blockiness without filtering, of fast PCF 2×2 and 4×4.
fn least_blocky([none, two, four]: [f64; 3]) -> Verdict {
    Verdict::new(
        brabec("§5", "Having about 20 different levels of shadowing, blockiness is reduced to a minimum."),
        "Fast PCF 4×4 has the least blockiness",
        Ran::new(SCENE, [FIGURE_7[0].0, FIGURE_7[2].0, FIGURE_7[3].0]),
        [
            less("blockiness of fast PCF 2×2", two, "that without filtering", none).sentence(),
            less("blockiness of fast PCF 4×4", four, "that of 2×2", two).sentence(),
        ],
    )
}

fn smooth(none: f64, fast: f64) -> Verdict {
    Verdict::new(
        brabec(
            "§5",
            "Using fast PCF with a filter size of 2 × 2, shadow boundaries appear well smoothed (right).",
        ),
        "At 1024² too, fast PCF smooths blocky boundaries",
        Ran::new("brabec from half the distance, 800×600, 1024²", [FIGURE_7[0].0, FIGURE_7[2].0]),
        [more("blockiness without filtering", none, "1.1 times that of fast PCF 2×2", 1.1 * fast)
            .ours("a tenth is more than pixels change by otherwise")],
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
    }

    #[test]
    fn blockiness_falls_with_the_width_of_an_edge() {
        let edge = |ramp: f32| GrayImage::from_fn(8, 2, |x, _| ((x as f32 - 2.0) / ramp).clamp(0.0, 1.0));
        let all = [true; 16];
        let [sharp, wide] = [1.0, 4.0].map(|ramp| blockiness(&edge(ramp), &all));
        assert!((sharp / wide - 2.0).abs() < 1e-6, "{sharp} {wide}");
        assert_eq!(blockiness(&GrayImage::filled(8, 2, 1.0), &all), 0.0);
        assert_eq!(blockiness(&edge(1.0), &[false; 16]), 0.0);
    }
}
