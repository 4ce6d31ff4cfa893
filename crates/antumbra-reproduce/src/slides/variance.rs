//! Variance shadow maps beside PCF; speed and memory of three bases.

use crate::{
    gallery,
    numbers::Measured,
    page::{Cell, Page, Table, Unit},
    stored_image::difference,
    verdict::{Fact, Ran, Verdict, at_most, less, more, slides},
    workbench::Workbench,
};
use antumbra_lab::truth::Truth;
use anyhow::Result;

/// Spec, name.
const ROW: [(&str, &str); 4] = [
    ("hard", "SM"),
    ("pcf.kernel=5,taps=nearest", "PCF 5×5"),
    ("pcf.kernel=5", "bilinear PCF 5×5"),
    ("vsm.kernel=5", "VSM"),
];
/// A box, whose sums are known.
const PLANAR: &str = "vsm.kernel=5,weights=box,sampling=bilinear";

pub(super) fn row(bench: &Workbench<'_>) -> Result<Page> {
    let study = bench.study(bench.shot("spheres", [640, 480]), bench.map(512), &ROW.map(|r| r.0))?;
    let ideal = &bench.truths(&study, &[Truth::LightSpace(5)])?[0];
    let estimated = study.look(ROW[2].0)?.visibility()?.values;
    let mut table = Table::new(
        "RMSE to what rays see through 5×5; mean distance from bilinear PCF of 5×5, where shadow can be.",
        &["technique", "RMSE", "from bilinear PCF"],
    );
    let (mut apart, mut pictures) = (Vec::new(), Vec::new());
    for (spec, name) in ROW {
        let rmse = bench.score(&study, spec, ideal, None)?.rmse;
        let values = study.look(spec)?.visibility()?.values;
        let mean = distance(&values, &estimated, &ideal.truth.shadowable);
        table.row(name, [rmse, mean].map(|v| Cell::ours(v, Unit::Number)).into());
        apart.push(mean);
        pictures.push((name, &study.look(spec)?.picture));
    }
    pictures.push(("rays, filtered 5×5 in light space", &ideal.picture));
    let mut page = Page::default();
    page.verdict(estimates(apart[3], apart[0]));
    page.verdict(equality(planar(bench)?));
    let window = gallery::window(&difference(pictures[0].1, &ideal.picture), pictures[0].1, 8);
    let captions = ["As on the slide.", "Enlarged: where the standard map looks most wrong."];
    gallery::rows(&mut page, captions, 5, &pictures, window)?;
    page.table(table);
    Ok(page)
}

fn distance(a: &[f32], b: &[f32], mask: &[bool]) -> f64 {
    let all = || a.iter().zip(b).zip(mask).filter(|(_, m)| **m).map(|((a, b), _)| f64::from((a - b).abs()));
    all().sum::<f64>() / all().count().max(1) as f64
}

/// Largest difference between a VSM's bound and the share of lit texels, across the edge of a plane in
/// front of the plane that receives.
fn planar(bench: &Workbench<'_>) -> Result<f64> {
    let positions: Vec<f32> = (-200..200_i16).map(|i| (f32::from(i) + 0.5) / 40.0).collect();
    // The texels that the caster leaves are at 1, and so are the receivers.
    let answers = bench.edge(PLANAR, 1.0, &positions)?;
    let differences = positions.iter().zip(answers).map(|(x, v)| (f64::from(v) - share(f64::from(*x))).abs());
    Ok(differences.fold(0.0, f64::max))
}

/// Share of lit texels in a bilinear lookup of means of 5×5 at `x` texels from the edge.
fn share(x: f64) -> f64 {
    let lit = |texel: f64| (-2..=2).filter(|t| texel + f64::from(*t) >= 0.0).count() as f64 / 5.0;
    let (texel, part) = ((x - 0.5).floor(), (x - 0.5).rem_euclid(1.0));
    lit(texel) * (1.0 - part) + lit(texel + 1.0) * part
}

fn estimates(vsm: f64, hard: f64) -> Verdict {
    Verdict::new(
        slides("Variance shadow maps", "Estimate PCF outcome with statistics"),
        "A VSM is closer to bilinear PCF of its kernel than a standard map is",
        Ran::new("spheres, 640×480, 512²", ROW.map(|r| r.0)),
        [less("distance of the VSM", vsm, "half of that of the standard map", 0.5 * hard)
            .ours("an estimate leaves out less than half of what filtering does")],
    )
}

fn equality(largest: f64) -> Verdict {
    Verdict::new(
        slides("Variance shadow maps", "Becomes equality for single planar occluder and receiver"),
        "Chebyshev's bound is the share of lit texels for one planar occluder and receiver",
        Ran::new(
            "a plane at a quarter of the depth range over the left half of the map, receivers at its end",
            [PLANAR],
        ),
        [at_most("largest difference across the edge", largest, "a 256th", 1.0 / 256.0)
            .ours("less than a step of 8 bits is equal")],
    )
}

/// Spec, name, the slide's frames per second and megabytes.
const THREE: [(&str, &str, f64, f64); 3] = [
    ("esm.kernel=5,sampling=trilinear", "ESM", 66.0, 21.0),
    ("csm.kernel=5,sampling=trilinear", "CSM", 21.0, 170.0),
    ("vsm.kernel=5,sampling=trilinear", "VSM", 60.0, 42.0),
];

pub(super) fn quality(bench: &Workbench<'_>) -> Result<Page> {
    let (shot, map) = (bench.shot("fence", [800, 600]), bench.map(2048));
    let study = bench.study(shot, map, &THREE.map(|t| t.0))?;
    let times = bench.times(shot, &THREE.map(|t| (map, t.0)), bench.rounds())?;
    let mut table = Table::new(
        "Memory with mip levels; frame time over that of ESM.",
        &["technique", "memory", "frame time"],
    );
    let (mut bytes, mut pictures) = (Vec::new(), Vec::new());
    for ((spec, name, fps, megabytes), time) in THREE.iter().zip(&times) {
        let look = study.look(spec)?;
        bytes.push(look.memory.kept_bytes as f64);
        let memory = Cell::ours(bytes[bytes.len() - 1], Unit::Bytes);
        let memory = memory.paper((!bench.quick).then_some(megabytes * 1_048_576.0));
        let ratio = Cell::ours(time.over(&times[0]).value, Unit::Times).paper(THREE[0].2 / fps);
        table.row(*name, vec![memory, ratio]);
        pictures.push((*name, &look.picture));
    }
    let mut page = Page::default();
    page.verdict(order(times[1].over(&times[0]), times[2].over(&times[0])));
    page.fact(memory([0, 1, 2].map(|i| bytes[i] / bytes[0])));
    let window = gallery::window(&difference(pictures[1].1, pictures[2].1), pictures[1].1, 8);
    let captions = ["The fence.", "Enlarged: where CSM and VSM differ most."];
    gallery::rows(&mut page, captions, 3, &pictures, window)?;
    page.table(table);
    Ok(page)
}

/// Frame times of CSM and of VSM over that of ESM.
fn order(csm: Measured, vsm: Measured) -> Verdict {
    let rates = "the slide: 66 frames per second of ESM, 21 of CSM, 60 of VSM";
    Verdict::new(
        slides("Results: quality comparison", "66 FPS, 21 MB 21 FPS, 170 MB 60 FPS, 42 MB"),
        "ESM is faster than CSM and VSM",
        Ran::new("fence, 800×600, 2048²", THREE.map(|t| t.0)),
        [
            more("frame time of CSM over that of ESM", csm, "1", 1.0).document(rates),
            more("frame time of VSM over that of ESM", vsm, "1", 1.0).document(rates),
        ],
    )
}

fn memory([_, csm, vsm]: [f64; 3]) -> Fact {
    Fact {
        claim: "ESM takes the least memory, VSM twice that, CSM eight times.".into(),
        source: slides("Results: quality comparison", "66 FPS, 21 MB 21 FPS, 170 MB 60 FPS, 42 MB"),
        found: format!("All that lookups need: VSM {vsm:.2} times, CSM {csm:.2} times what ESM takes."),
        because: "one float, two floats and 32 bytes a texel".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::Outcome::{Differs, Holds, Open};

    #[test]
    fn verdicts_follow_their_numbers() {
        assert_eq!(estimates(0.01, 0.03).outcome(), Holds);
        assert_eq!(estimates(0.02, 0.03).outcome(), Differs);
        assert_eq!(equality(1e-4).outcome(), Holds);
        assert_eq!(equality(0.1).outcome(), Differs);
        let exact = Measured::exact;
        assert_eq!(order(exact(3.0), exact(1.1)).outcome(), Holds);
        assert_eq!(order(exact(3.0), exact(0.9)).outcome(), Differs);
        assert_eq!(order(exact(3.0), Measured { value: 1.0, low: 0.9, high: 1.1 }).outcome(), Open);
    }

    #[test]
    fn the_share_of_an_edge_is_symmetric() {
        assert_eq!([share(-4.0), share(4.0), share(0.0)], [0.0, 1.0, 0.5]);
        assert!((share(0.7) + share(-0.7) - 1.0).abs() < 1e-12);
    }
}
