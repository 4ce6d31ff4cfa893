//! Claims of techniques that filter functions of depth.

use crate::scene::*;
use antumbra::technique::Bias;
use antumbra_testing::Gpu;

pub(crate) fn vsm_bleeds_between_two_layers(gpu: &Gpu) {
    let leak = |spec| largest(&at(&picture(gpu, spec, Bias::Auto), two_layers));
    let (vsm, reduced, esm) = (leak("vsm"), leak("vsm.reduction=0.4"), leak("esm"));
    assert!(vsm > 0.2, "the bound must bleed: {vsm}");
    assert!(reduced < 0.5 * vsm, "reduction must cut it: {reduced} of {vsm}");
    assert!(esm < 0.02, "an exponential must not: {esm}");
}

/// Of the light that vsm lets through where the disc's rim lies over the sheet, the share that a
/// technique lets through.
pub(crate) fn share_of_leak(gpu: &Gpu, spec: &str) -> f32 {
    let leak = |spec| mean(&at(&picture(gpu, spec, Bias::Auto), two_layers));
    leak(spec) / leak("vsm")
}

/// Share of the open, slanted ground that is not quite lit.
pub(crate) fn acne(gpu: &Gpu, spec: &str) -> f32 {
    let open = at(&picture(gpu, spec, Bias::Auto), open);
    open.iter().filter(|v| **v < 0.9).count() as f32 / open.len() as f32
}

pub(crate) fn evsm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("evsm") < 0.02, "{} of vsm's", leak("evsm"));
    assert!(leak("evsm.format=float16") < 0.2, "{} of vsm's", leak("evsm.format=float16"));
    assert!(leak("evsm.positive=1,negative=1") > 0.5, "nearly linear warps are vsm");
    assert_eq!(acne(gpu, "evsm") + acne(gpu, "evsm.format=float16"), 0.0);
}

pub(crate) fn msm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("msm") < 0.2, "{} of vsm's", leak("msm"));
    assert_eq!(acne(gpu, "msm") + acne(gpu, "msm.format=float32"), 0.0);
}

pub(crate) fn lvsm_bleeds_less_than_vsm(gpu: &Gpu) {
    let leak = |spec| share_of_leak(gpu, spec);
    assert!(leak("lvsm") < 0.2, "{} of vsm's", leak("lvsm"));
    assert_eq!(acne(gpu, "lvsm"), 0.0);
    // The ground crosses four fifths of the depth range.
    assert_eq!(acne(gpu, "lvsm.intervals=5"), 0.0);
    assert!(acne(gpu, "lvsm.intervals=5,overlap=0") > 0.0, "an overlap keeps slopes lit");
}

pub(crate) fn csm_is_brighter_at_contact_with_fewer_terms(gpu: &Gpu) {
    let foot = |u: f32, v: f32| {
        (0.68..0.87).contains(&u) && up_the_ramp(u, v).is_some_and(|t| (0.03..0.07).contains(&t))
    };
    let contact = |spec| mean(&at(&picture(gpu, spec, Bias::Auto), foot));
    let (few, many, hard) = (contact("csm.terms=4"), contact("csm.terms=16"), contact("hard"));
    assert!(few > many + 0.1, "4 terms {few}, 16 terms {many}");
    assert!(many > hard, "both are brighter than the truth");
}

pub(crate) fn esm_needs_no_bias(gpu: &Gpu) {
    let acne = |spec| {
        let open = at(&picture(gpu, spec, Bias::NONE), open);
        open.iter().filter(|v| **v < 0.5).count() as f32 / open.len() as f32
    };
    let (esm, hard) = (acne("esm"), acne("hard"));
    assert_eq!(esm, 0.0);
    assert!(hard > 0.2, "without bias a comparison shadows a tilted plane: {hard}");
}
