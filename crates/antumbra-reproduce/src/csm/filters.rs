//! Figures 1, 7 and 8: what filters do to aliasing.

use crate::{
    gallery,
    page::{Cell, Page, Table, Tile, Unit},
    stored_image::difference,
    verdict::{Ran, Verdict, at_most, csm as csm_says, less},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// How much farther than the scene's own the camera is.
const FAR: f32 = 4.0;
const FIGURE_1: [(&str, &str); 4] = [
    ("pcf.kernel=1", "PCF"),
    ("csm.kernel=1,sampling=bilinear", "CSM, no mips"),
    ("csm.kernel=1,sampling=trilinear", "CSM, mip-mapped"),
    ("csm.kernel=7,sampling=trilinear", "CSM, mip-mapped, 7×7"),
];

pub(super) fn figure_1(bench: &Workbench<'_>) -> Result<Page> {
    let shot = bench.shot("fence", [640, 480]).from(FAR);
    let study = bench.study(shot, bench.map(2048), &FIGURE_1.map(|f| f.0))?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(8)])?[0];
    let mut table = Table::new("RMSE to the truth of 64 rays per pixel.", &["filter", "RMSE", "MAE"]);
    let mut errors = Vec::new();
    let mut pictures = Vec::new();
    for (spec, name) in FIGURE_1 {
        let score = bench.score(&study, spec, truth, None)?;
        table.row(name, [score.rmse, score.mae].map(|v| Cell::ours(v, Unit::Number)).into());
        errors.push(score.rmse);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("64 rays per pixel", &truth.picture));
    let mut page = Page::default();
    page.verdict(minification(errors[0], errors[1], errors[2]));
    let window = gallery::window(&difference(pictures[0].1, pictures[2].1), pictures[0].1, 8);
    let captions = ["The whole picture.", "Enlarged: where mip-mapping changes most."];
    gallery::rows(&mut page, captions, 5, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn minification(pcf: f64, bilinear: f64, mipmapped: f64) -> Verdict {
    Verdict::new(
        csm_says(
            "figure 1",
            "CSM enable tri-linear filtering of shadows and thereby achieve effective screen-space anti-aliasing.",
        ),
        "Mip-mapping removes minification aliasing",
        Ran::new("fence from four times its distance, 640×480, 2048²", FIGURE_1.map(|f| f.0)),
        [
            less("RMSE of the mip-mapped CSM", mipmapped, "that of PCF", pcf).sentence(),
            less("RMSE of the mip-mapped CSM", mipmapped, "that of the CSM without mips", bilinear)
                .sentence(),
        ],
    )
}

const FIGURE_7: [(&str, &str); 6] = [
    ("pcf.kernel=1", "(a) PCF"),
    ("csm.kernel=1,sampling=bilinear", "(b) CSM, bilinear"),
    ("csm.kernel=1,sampling=anisotropic", "(c) CSM, trilinear"),
    ("csm.kernel=3,sampling=anisotropic", "(d) 3×3"),
    ("csm.kernel=5,sampling=anisotropic", "(e) 5×5"),
    ("csm.kernel=7,sampling=anisotropic", "(f) 7×7"),
];

pub(super) fn figure_7(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("trees", [800, 600]), bench.map(2048), &FIGURE_7.map(|f| f.0))?;
    let truth = &bench.truths(&study, &[Truth::ScreenSpace(4)])?[0];
    let mut table = Table::new("Against 16 rays per pixel.", &["filter", "RMSE", "SSIM"]);
    let mut errors = Vec::new();
    let mut pictures = Vec::new();
    for (spec, name) in FIGURE_7 {
        let score = bench.score(&study, spec, truth, None)?;
        table.row(name, [score.rmse, score.ssim].map(|v| Cell::ours(v, Unit::Number)).into());
        errors.push(score.rmse);
        pictures.push((name, &study.look(spec)?.picture));
    }
    let mut page = Page::default();
    page.verdict(recovered(errors[0], errors[1], errors[2]));
    let window = gallery::window(&difference(pictures[0].1, &truth.picture), pictures[0].1, 8);
    let captions = ["As in the figure.", "Enlarged: where PCF looks most wrong."];
    gallery::rows(&mut page, captions, 3, &pictures, window)?;
    let tiles = vec![
        Tile::new("16 rays per pixel", &truth.picture.framed(window))?,
        Tile::close_up("16 rays per pixel", &truth.picture, window)?,
    ];
    page.pictures("What rays say.", 3, tiles);
    page.table(table);
    Ok(page)
}

fn recovered(pcf: f64, bilinear: f64, trilinear: f64) -> Verdict {
    Verdict::new(
        csm_says(
            "§5",
            "Trilinear filtering using CSMs fully recovers the shape of the branch close to the tree root.",
        ),
        "Trilinear lookups recover thin shadows that PCF and bilinear lookups break up",
        Ran::new("trees, 800×600, 2048²", [FIGURE_7[0].0, FIGURE_7[1].0, FIGURE_7[2].0]),
        [
            less("RMSE of the trilinear CSM", trilinear, "that of PCF", pcf).sentence(),
            less("RMSE of the trilinear CSM", trilinear, "that of the bilinear CSM", bilinear).sentence(),
        ],
    )
}

const SIZES: [u32; 4] = [128, 256, 512, 1024];
const KERNELS: [u32; 2] = [3, 7];

pub(super) fn figure_8(bench: &Workbench<'_>) -> Result<Page> {
    let mut page = Page::default();
    let mut table = Table::new(
        "RMSE to what rays see through the kernel, over the pixels that are partly lit there.",
        &["technique", "128²", "256²", "512²", "1024²"],
    );
    let mut tiles = Vec::new();
    let mut errors = Vec::new();
    for kernel in KERNELS {
        let spec = format!("csm.kernel={kernel},sampling=trilinear");
        let mut rows = [Vec::new(), Vec::new()];
        for size in SIZES {
            let study =
                bench.study(bench.shot("spheres", [400, 300]), bench.map(size), &["hard", spec.as_str()])?;
            let ideal = &bench.truths(&study, &[Truth::LightSpace(kernel)])?[0];
            let edges: Vec<bool> =
                ideal.truth.image.values.iter().map(|v| (0.02..0.98).contains(v)).collect();
            for (row, spec) in rows.iter_mut().zip(["hard", spec.as_str()]) {
                row.push(bench.score(&study, spec, ideal, Some(("penumbra", &edges)))?.rmse);
            }
            tiles.push(Tile::new(format!("{kernel}×{kernel}, {}²", study.map), &study.look(&spec)?.picture)?);
        }
        for (name, row) in ["standard map, judged by", "CSM,"].iter().zip(&rows) {
            let cells = row.iter().map(|v| Cell::ours(*v, Unit::Number)).collect();
            table.row(format!("{name} {kernel}×{kernel}"), cells);
        }
        errors.push(rows);
    }
    page.verdict(hidden(&errors[1][0], &errors[1][1]));
    page.pictures("As in the figure: kernels from above, map sizes from left to right.", 4, tiles);
    page.table(table);
    Ok(page)
}

/// Errors of the standard map and of the CSM, by size.
fn hidden(hard: &[f64], csm: &[f64]) -> Verdict {
    let ratios = csm.iter().zip(hard).map(|(c, h)| c / h);
    Verdict::new(
        csm_says(
            "§5",
            "even small shadow map resolution can produce nice shadows without visible discretization artifacts, if a \
             large enough blur size is chosen",
        ),
        "A kernel of 7×7 hides the texels of small maps",
        Ran::new("spheres, 400×300, maps of 128² to 1024²", ["hard", "csm.kernel=7,sampling=trilinear"]),
        [
            at_most(
                "larger RMSE at shadow edges over that of the standard map, 128² and 256²",
                ratios.clone().take(2).reduce(f64::max),
                "one half",
                0.5,
            )
            .ours("what is hidden is at most half of what it was")
            .was("a half for maps of all sizes", "1024² had 0.595, where a blur of 7 texels is narrow"),
            less("the largest such quotient of all sizes", ratios.reduce(f64::max), "1", 1.0)
                .ours("a blur may not add what it ought to hide"),
        ],
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(minification(0.3, 0.25, 0.1).outcome(), Holds);
        assert_eq!(minification(0.05, 0.25, 0.1).outcome(), Differs);
        assert_eq!(minification(0.3, 0.05, 0.1).outcome(), Differs);
        assert_eq!(recovered(0.3, 0.25, 0.1).outcome(), Holds);
        assert_eq!(recovered(0.3, 0.05, 0.1).outcome(), Differs);
        assert_eq!(recovered(0.05, 0.3, 0.1).outcome(), Differs);
        assert_eq!(hidden(&[0.2, 0.1], &[0.05, 0.04]).outcome(), Holds);
        assert_eq!(hidden(&[0.2, 0.1], &[0.05, 0.06]).outcome(), Differs);
        assert_eq!(hidden(&[0.2, 0.2, 0.1], &[0.05, 0.06, 0.2]).outcome(), Differs);
    }
}
