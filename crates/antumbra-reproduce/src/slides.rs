//! The lecture slides on filtered hard shadows.

use crate::{
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::{busiest, difference},
    target::{Source, Target},
    verdict::{Fact, Ran, Verdict, less, slides},
    workbench::Workbench,
};
use antumbra_lab::image::GrayImage;
use antumbra_lab::truth::Truth;
use anyhow::Result;
use std::collections::BTreeSet;

mod blend;
mod lookups;
mod variance;

pub(crate) const SOURCE: Source = Source {
    key: "slides",
    name: "Lecture slides, Hard shadows: filtering",
    targets: &[
        Target {
            id: "slides/pcf-row",
            title: "Percentage-closer filtering of growing kernels",
            paper: "One scene with a standard shadow map, with 2×2, 3×3 and 4×4 percentage-closer filtering, and with \
                4×4 of bilinear lookups. Nearest-neighbour lookups leave quantisation; bilinear ones do not.",
            ours: "The scene spheres with a 512² map, so that texels show. Scored against rays: the ideal that a Gaussian \
               of the same width in light space would give.",
            seconds: [9, 2],
            run: pcf_row,
        },
        Target {
            id: "slides/depth",
            title: "Depth values are not blendable",
            paper: "Filtering 3.2 and 1.5 gives 2.8, which shadows a receiver at 3 that most of the texels light. Filtering \
                    depth is not equivalent to filtering the result of the shadow test (Annen et al. 2007, Eq. 5).",
            ours: "A box of 5×5 texels over depths that are then compared, and over comparisons; the edge of a caster, and the \
                   scene spheres with a 512² map.",
            seconds: [6, 2],
            run: blend::depth,
        },
        Target {
            id: "slides/vsm-row",
            title: "Variance estimates what PCF would answer",
            paper: "One scene with a standard map, PCF of 5×5, bilinear PCF of 5×5 and a VSM. Chebyshev's inequality becomes \
                    an equality for a single planar occluder and receiver.",
            ours: "The scene spheres with a 512² map and Gaussians of 5×5; receivers on a plane behind the edge of a plane.",
            seconds: [8, 2],
            run: variance::row,
        },
        Target {
            id: "slides/quality",
            title: "Speed and memory of ESM, CSM and VSM",
            paper: "365,000 faces, a 2048² map: 66 frames per second and 21 MB (ESM), 21 and 170 MB (CSM), 60 and 42 MB (VSM).",
            ours: "The scene fence with 365,000 triangles, 800×600 pixels, 2048², 5×5 Gauss, trilinear lookups.",
            seconds: [60, 8],
            run: variance::quality,
        },
        Target {
            id: "slides/sat-precision",
            title: "Summed-area tables of floats and of whole numbers",
            paper: "A table sums arbitrary rectangles from its four corners: differences of sums as large as the map.",
            ours: "Depth and its square on a tilted plane, 256² to 2048² texels, summed in 32-bit floats and in the whole numbers \
                   that the library uses; means of 3×3 texels against double precision.",
            seconds: [5, 2],
            run: blend::sums,
        },
        Target {
            id: "slides/bicubic",
            title: "Bicubic filtering with four bilinear lookups",
            paper: "For bigger kernels than 2×2, the exact bicubic convolution takes four bilinear lookups.",
            ours: "Visibility across the straight edge of a caster, position by position, beside the convolution of the \
                   texels' comparisons with the cubic B-spline, computed in double precision.",
            seconds: [2, 1],
            run: lookups::bicubic,
        },
        Target {
            id: "slides/vsm-layers",
            title: "Light bleeding and layered variance shadow maps",
            paper: "A VSM works in many situations, but light bleeds where the variance is large; several layered VSMs \
                    alleviate it.",
            ours: "The scene layers, a 1024² map, 5×5 Gauss: a VSM and layered ones of 2, 4 and 8 intervals of depth.",
            seconds: [6, 2],
            run: lookups::vsm_layers,
        },
        Target {
            id: "slides/sat",
            title: "Summed-area tables: rectangles at constant cost",
            paper: "Percentage-closer filtering grows with the square of the kernel; a summed-area table sums any rectangle \
                    in constant time.",
            ours: "Lookup times of VSM with a summed-area table for boxes of 3×3 to 63×63 texels, and of PCF for kernels of \
                   2×2 to 16×16; scene spheres, a 1024² map, 640×480 pixels.",
            seconds: [8, 3],
            run: lookups::sat,
        },
    ],
};

/// Spec, name, width.
const ROW: [(&str, &str, u32); 5] = [
    ("hard", "standard shadow map", 1),
    ("pcf.kernel=2,weights=box,taps=nearest", "PCF 2×2", 2),
    ("pcf.kernel=3,weights=box,taps=nearest", "PCF 3×3", 3),
    ("pcf.kernel=4,weights=box,taps=nearest", "PCF 4×4", 4),
    ("pcf.kernel=4,weights=box", "PCF 4×4, bilinear lookups", 4),
];

fn pcf_row(bench: &Workbench<'_>) -> Result<Page> {
    let specs = ROW.map(|(spec, ..)| spec);
    let study = bench.study(bench.shot("spheres", [640, 480]), bench.map(512), &specs)?;
    let truths = bench.truths(&study, &[Truth::LightSpace(4), Truth::Hard, Truth::ScreenSpace(4)])?;
    let mut page = Page::default();
    let mut table = Table::new(
        "Levels are the different visibilities in the picture. The 4×4 ideal is what rays see through a Gaussian of \
         four texels; the anti-aliased truth is sharp, with 16 rays per pixel.",
        &["technique", "levels", "RMSE to the 4×4 ideal", "RMSE to the anti-aliased truth"],
    );
    let mut numbers = Vec::new();
    for (spec, name, _) in ROW {
        let levels = levels(&study.look(spec)?.visibility()?, &truths[0].truth.shadowable);
        let rmse = bench.score(&study, spec, &truths[0], None)?.rmse;
        let smooth = bench.score(&study, spec, &truths[2], None)?.rmse;
        let cells = [(levels as f64, Unit::Number), (rmse, Unit::Number), (smooth, Unit::Number)];
        table.row(name, cells.map(|(v, unit)| Cell::ours(v, unit)).into());
        numbers.push((levels, rmse));
    }
    page.fact(quantised([numbers[0].0, numbers[1].0, numbers[2].0, numbers[3].0, numbers[4].0]));
    page.verdict(smoother(numbers[0].1, numbers[3].1, numbers[4].1));
    // Where the standard map looks most wrong.
    let wrong = difference(&study.look("hard")?.picture, &truths[0].picture);
    let [w, h] = study.shot.resolution;
    let window = busiest(&wrong, [w, h], [w / 8, h / 8]);
    let mut tiles = vec![Tile::new("ray-traced scene", &truths[1].picture.framed(window))?];
    for (spec, name, _) in ROW {
        tiles.push(Tile::close_up(name, &study.look(spec)?.picture, window)?);
    }
    tiles.push(Tile::close_up("the 4×4 ideal", &truths[0].picture, window)?);
    page.pictures("The scene and, enlarged, the part that the standard map gets most wrong.", 4, tiles);
    page.table(table);
    Ok(page)
}

/// How many different visibilities there are, to a thousandth, in pixels that can be in shadow.
fn levels(plane: &GrayImage, shadowable: &[bool]) -> usize {
    let values = plane.values.iter().zip(shadowable).filter(|(_, s)| **s);
    values.map(|(v, _)| (1000.0 * v).round() as i32).collect::<BTreeSet<_>>().len()
}

fn quantised([hard, two, three, four, bilinear]: [usize; 5]) -> Fact {
    Fact {
        claim: "n×n nearest-neighbour lookups give at most n² + 1 levels of shadow; bilinear ones give more."
            .into(),
        source: slides("PCF + bilinear lookups", "Nearest neighbour lookups → quantization artifacts"),
        found: format!(
            "Levels without filtering {hard}, of 2×2 {two}, 3×3 {three}, 4×4 {four}, of bilinear 4×4 {bilinear}."
        ),
        because: "n² comparisons have n² + 1 sums, and weights that follow the position have no such bound"
            .into(),
    }
}

fn smoother(hard: f64, nearest: f64, bilinear: f64) -> Verdict {
    Verdict::new(
        slides("Percentage closer filtering", "Good quality needs big kernel size"),
        "A larger kernel comes closer to the filtered ideal, and bilinear lookups closer still",
        Ran::new("spheres, 640×480, 512²", [ROW[0].0, ROW[3].0, ROW[4].0]),
        [
            less("RMSE of 4×4", nearest, "that of the standard map", hard).sentence(),
            less("RMSE of bilinear 4×4", bilinear, "that of nearest 4×4", nearest).sentence(),
        ],
    )
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "tests fail by panicking")]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(smoother(0.3, 0.2, 0.1).outcome(), Holds);
        assert_eq!(smoother(0.3, 0.2, 0.25).outcome(), Differs);
        assert_eq!(smoother(0.3, 0.4, 0.1).outcome(), Differs);
    }

    #[test]
    fn levels_are_counted_where_shadow_can_be() {
        let plane = GrayImage::new(4, 1, vec![0.0, 1.0, 0.5, 0.5]).unwrap();
        assert_eq!(levels(&plane, &[true, true, true, false]), 3);
        assert_eq!(levels(&plane, &[true, false, false, false]), 1);
    }
}
