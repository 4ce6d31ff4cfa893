//! Section 3.2.3: other bases than Fourier's, computed in double precision.

use crate::{
    page::{Block, Cell, Page, Table, Unit},
    verdict::{Fact, csm},
    workbench::Workbench,
};
use antumbra_lab::chart::{Curve, Panel};
use anyhow::Result;

/// Coefficients of every basis: those of 16 terms.
const COUNT: usize = 32;
/// How far d − z goes each way.
const REACH: f64 = 0.2;
/// Depths of casters: over two blocks and a bit, around the middle.
const CASTERS: usize = 81;

/// A basis: its name and its f(d, z).
type Basis = (&'static str, fn(f64, f64) -> f64);
const BASES: [Basis; 4] =
    [("Fourier", fourier), ("block", block), ("hat", hat), ("Taylor, of a sigmoid as steep", taylor)];

/// Eq. 13 with 16 terms.
fn fourier(d: f64, z: f64) -> f64 {
    let term = |k: usize| {
        let c = std::f64::consts::PI * (2 * k + 1) as f64;
        (c * (z - d)).sin() / c
    };
    0.5 + 2.0 * (0..COUNT / 2).map(term).sum::<f64>()
}

/// Each of equal parts of the depth range has the mean of the test over it.
fn block(d: f64, z: f64) -> f64 {
    let end = (z * COUNT as f64).floor() + 1.0;
    (end - d * COUNT as f64).clamp(0.0, 1.0)
}

/// The test at equally distant depths, with lines between them.
fn hat(d: f64, z: f64) -> f64 {
    let at = z * (COUNT - 1) as f64;
    let (node, part) = (at.floor(), at.fract());
    let test = |node: f64| if d * (COUNT - 1) as f64 <= node { 1.0 } else { 0.0 };
    test(node) * (1.0 - part) + test(node + 1.0) * part
}

/// Powers of d − z below the 32nd of 1 / (1 + exp(s (d − z))), s so that it is as steep as 16 terms are.
fn taylor(d: f64, z: f64) -> f64 {
    // The slope of 16 terms is 32, that of the sigmoid s / 4.
    let (s, t) = (4.0 * COUNT as f64, z - d);
    // y' = s y (1 − y) gives each coefficient from those before it.
    let mut all = vec![0.5];
    for n in 0..COUNT - 1 {
        let square: f64 = (0..=n).map(|i| all[i] * all[n - i]).sum();
        all.push(s * (all[n] - square) / (n + 1) as f64);
    }
    all.iter().rev().fold(0.0, |sum, a| sum * t + a)
}

/// The depth of caster i.
fn caster(i: usize) -> f64 {
    0.45 + 2.5 / COUNT as f64 * i as f64 / (CASTERS - 1) as f64
}

/// d − z from one end to the other.
fn behind() -> impl Iterator<Item = f64> {
    (0..400).map(|i| REACH * (f64::from(i) + 0.5 - 200.0) / 200.0)
}

/// Mean distance from the step for each caster.
fn errors(f: fn(f64, f64) -> f64) -> Vec<f64> {
    let error = |i: usize| {
        let z = caster(i);
        let wrong = |t: f64| (f(z + t, z).clamp(0.0, 1.0) - if t > 0.0 { 0.0 } else { 1.0 }).abs();
        behind().map(wrong).sum::<f64>() / behind().count() as f64
    };
    (0..CASTERS).map(error).collect()
}

/// Largest change of the answer where caster and receiver move on together by a thousandth of the range.
fn popping(f: fn(f64, f64) -> f64) -> f64 {
    let change = |i: usize| {
        let z = caster(i);
        behind()
            .map(|t| (clamped(f, z + t, z) - clamped(f, z + t + 1e-3, z + 1e-3)).abs())
            .fold(0.0, f64::max)
    };
    (0..CASTERS).map(change).fold(0.0, f64::max)
}

fn clamped(f: fn(f64, f64) -> f64, d: f64, z: f64) -> f64 {
    f(d, z).clamp(0.0, 1.0)
}

pub(super) fn bases(_: &Workbench<'_>) -> Result<Page> {
    let mut table = Table::new(
        "Mean distance from the step up to 0.2 before and behind it, over the caster's depth, clamped to 0..1; popping: \
         the largest change of an answer where all moves on by a thousandth.",
        &["32 coefficients", "least", "largest", "largest over least", "popping", "unclamped at d − z = 0.2"],
    );
    let (mut spread, mut pops, mut curves) = (Vec::new(), Vec::new(), Vec::new());
    for (name, f) in BASES {
        let all = errors(f);
        let [least, most] =
            [all.iter().copied().fold(f64::MAX, f64::min), all.iter().copied().fold(0.0, f64::max)];
        let pop = popping(f);
        let far = f(caster(0) + REACH, caster(0));
        let numbers = [least, most, most / least, pop, far];
        table.row(name, numbers.map(|v| Cell::ours(v, Unit::Number)).into());
        spread.push(most / least);
        pops.push(pop);
        let z = caster(CASTERS / 3);
        let points = behind().map(|t| [t, f(z + t, z).clamp(-0.5, 1.5)]).collect();
        curves.push(Curve { name: name.into(), points });
    }
    let mut page = Page::default();
    page.fact(variable([spread[0], spread[1], spread[2]], [pops[0], pops[1], pops[2]]));
    page.fact(diverges(taylor(caster(0) + REACH, caster(0))));
    page.table(table);
    let panel = Panel {
        curves,
        x: [-REACH, REACH],
        y: [-0.5, 1.5],
        x_label: "d - z, as a share of the light's depth range".into(),
        y_label: "the test's value".into(),
    };
    page.blocks.push(Block::Plot(vec![panel], "One caster, cut off at −0.5 and 1.5.".into()));
    Ok(page)
}

fn variable(spread: [f64; 3], pops: [f64; 3]) -> Fact {
    let list = |n: [f64; 3]| format!("{:.3} (Fourier), {:.3} (block), {:.3} (hat)", n[0], n[1], n[2]);
    Fact {
        claim: "Block and hat functions err by where the caster is, and pop; Fourier's do not.".into(),
        source: csm(
            "§3.2.3",
            "Locally supported functions like the block or hat basis, also produce a variable error because they lack \
             shift-invariance.",
        ),
        found: format!("Largest over least error: {}. Popping: {}.", list(spread), list(pops)),
        because: "a sum of waves depends on d − z alone, one of local functions on z too".into(),
    }
}

fn diverges(far: f64) -> Fact {
    Fact {
        claim: "A Taylor series diverges away from the step.".into(),
        source: csm(
            "§3.2.3",
            "it often happens that |d − z| is large, in which case the approximation diverges",
        ),
        found: format!("At d − z = 0.2 its 32 coefficients add up to {far:.1e}."),
        because: "the sigmoid's poles bound the circle in which its series converges".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bases_approximate_the_step_near_it() {
        for (name, f) in BASES {
            assert!((f(0.5, 0.5) - 0.5).abs() <= 0.51, "{name}");
            if name != BASES[3].0 {
                assert!(f(0.3, 0.6) > 0.9 && f(0.6, 0.3) < 0.1, "{name}: {} {}", f(0.3, 0.6), f(0.6, 0.3));
            }
        }
        // Within its circle the series is the sigmoid.
        let sigmoid = 1.0 / (1.0 + (128.0_f64 * 0.01).exp());
        assert!((taylor(0.51, 0.5) - sigmoid).abs() < 1e-3, "{} {sigmoid}", taylor(0.51, 0.5));
        assert!(taylor(0.7, 0.5).abs() > 1e3);
    }

    #[test]
    fn only_waves_move_on_without_a_change() {
        let spread = |f| {
            let all = errors(f);
            all.iter().copied().fold(0.0, f64::max) / all.iter().copied().fold(f64::MAX, f64::min)
        };
        assert!(spread(fourier) < 1.001 && spread(block) > 1.1 && spread(hat) > 1.1);
        assert!(popping(fourier) < 1e-6 && popping(block) > 0.01);
    }
}
