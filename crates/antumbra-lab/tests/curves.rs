//! Curves are the techniques' formulas as the GPU evaluates them.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

use antumbra::{
    Capabilities,
    technique::{self, csm, csm::Csm, esm, vsm},
};
use antumbra_lab::{curve, gpu::Gpu};
use antumbra_testing::Trials;

const CASTER: f32 = 0.5;

fn main() {
    let mut trials = Trials::default();
    trials.add("curves_are_the_formulas", formulas);
    trials.add("every_curve_falls_from_lit_to_shadow", every_technique);
    trials.run();
}

fn receivers() -> Vec<f32> {
    (0..=400).map(|i| CASTER - 0.2 + 0.001 * i as f32).collect()
}

fn measure(gpu: &antumbra_testing::Gpu, spec: &str) -> Vec<f32> {
    let gpu = Gpu::adopt(gpu.device.clone(), gpu.queue.clone(), gpu.info.clone());
    curve::visibility(&gpu, technique::parse(spec).unwrap().as_ref(), CASTER, &receivers()).unwrap()
}

/// Largest difference between a curve and a formula of the receiver's depth.
fn difference(curve: &[f32], formula: impl Fn(f64) -> f64) -> f64 {
    let pairs = receivers().into_iter().zip(curve);
    pairs.map(|(d, v)| (f64::from(*v) - formula(f64::from(d))).abs()).fold(0.0, f64::max)
}

fn formulas(gpu: &antumbra_testing::Gpu) {
    let z = f64::from(CASTER);
    let of_esm = |c: f64| move |d: f64| esm::reference::ratio(d, esm::reference::encode(z, c), c).min(1.0);
    let esm = measure(gpu, "esm.c=40");
    assert!(difference(&esm, of_esm(40.0)) < 1e-4);
    assert!(difference(&esm, of_esm(44.0)) > 1e-2, "another steepness passes for this one");
    let vsm = |d: f64| vsm::reference::bound(d, [z, z * z], 1e-6, 0.0);
    assert!(difference(&measure(gpu, "vsm"), vsm) < 0.1, "cancellation of squares in f32");
    // Eight bits a coefficient: at most half a step in each of 32, weighted by 2/c_k.
    let series = |terms: u32| {
        move |d: f64| {
            let csm = Csm { terms, ..Csm::default() };
            let (span, ramp) = (f64::from(csm.span()), f64::from(csm.ramp()));
            csm::reference::series(&csm, span * d - ramp, span * z).clamp(0.0, 1.0)
        }
    };
    let csm = measure(gpu, "csm");
    assert!(difference(&csm, series(16)) < 0.01, "{}", difference(&csm, series(16)));
    assert!(difference(&csm, series(15)) > 0.02);
}

fn every_technique(gpu: &antumbra_testing::Gpu) {
    for technique in technique::all() {
        let name = technique.about().name;
        let curve = measure(gpu, name);
        let (first, last) = (curve[0], curve[curve.len() - 1]);
        let slack = 0.01 + technique.describe(&Capabilities::of(&gpu.device)).unwrap().ringing;
        assert!(first >= 1.0 - slack && last <= slack, "{name}: from {first} to {last}");
        let lit = curve.iter().filter(|v| **v > 0.5).count();
        assert!((195..=250).contains(&lit), "{name}: lit at {lit} of 401 receivers, half of them in front");
    }
}
