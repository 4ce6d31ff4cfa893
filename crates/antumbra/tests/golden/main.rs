//! One small picture per technique, and what each picture must show.
//!
//! The scene, in the light's own space: a tilted ground; a disc far above it; a sheet just above
//! the ground that reaches under the disc's rim; a bar of about one texel; a ramp that rises from
//! the ground. White is lit.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod basis;
mod comparison;
mod geometry;
mod scene;

use antumbra::{
    Capabilities, Technique, technique,
    technique::{Bias, CasterStorage},
};
use antumbra_testing::{
    Gpu, Trials,
    broken::Broken,
    image::{Image, Tolerance},
};
use scene::{SIDE, picture, picture_of};
use std::path::PathBuf;

const TOLERANCE: Tolerance = Tolerance { mean: 2.0, max: 32 };
/// Where graphics cards rasterise triangles: texels whose centres lie on an edge fall on either side.
const ON_EDGES: Tolerance = Tolerance { mean: 0.25, max: 255 };

type Claim = (&'static str, &'static str, fn(&Gpu));
const CLAIMS: &[Claim] = &[
    ("hard", "two levels", comparison::hard_has_two_levels),
    ("pcf", "as many levels as taps", comparison::pcf_has_as_many_levels_as_taps),
    ("poisson", "turns bands into noise", comparison::poisson_turns_bands_into_noise),
    ("bicubic", "smoothest edge of four lookups", comparison::bicubic_has_the_smoothest_edge_of_four_lookups),
    ("footprint", "grows with the pixel", comparison::footprint_grows_with_the_pixel),
    ("packed", "all its levels", comparison::packed_has_all_its_levels),
    ("stratified", "as many levels as samples", comparison::stratified_has_as_many_levels_as_samples),
    ("stratified", "resolves as a finer map", comparison::stratified_resolves_as_a_finer_map),
    ("vsm", "bleeds between two layers", basis::vsm_bleeds_between_two_layers),
    ("csm", "brighter at contact with fewer terms", basis::csm_is_brighter_at_contact_with_fewer_terms),
    ("esm", "needs no bias", basis::esm_needs_no_bias),
    ("evsm", "bleeds less than vsm", basis::evsm_bleeds_less_than_vsm),
    ("msm", "bleeds less than vsm", basis::msm_bleeds_less_than_vsm),
    ("lvsm", "bleeds less than vsm", basis::lvsm_bleeds_less_than_vsm),
    ("dpm", "everything where texels have room", geometry::dpm_resolves_what_has_room),
    ("exact", "everything", geometry::exact_resolves_everything),
    ("rgsm", "edges of large triangles", geometry::rgsm_resolves_edges_of_large_triangles),
    ("spsm", "edges finer than texels", geometry::spsm_resolves_edges_below_a_texel),
];

fn main() {
    let path =
        |name: &str| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("tests/golden/{name}.png"));
    let mut trials = Trials::default();
    for name in technique::all().iter().map(|t| t.about().name) {
        trials.add(format!("{name}: picture"), move |gpu| {
            let image = Image::grey(SIDE, &picture(gpu, name, Bias::Auto));
            let triangles = technique::parse(name).unwrap().describe(&Capabilities::full()).unwrap().storage
                != CasterStorage::Depth;
            let tolerance = if triangles && !gpu.is_software() { ON_EDGES } else { TOLERANCE };
            image.compare_with_reference(&path(name), tolerance).unwrap();
        });
        trials.add_plain(format!("{name}: has a claim"), move || {
            assert!(CLAIMS.iter().any(|c| c.0 == name));
        });
    }
    for (name, claim, check) in CLAIMS {
        trials.add(format!("{name}: {claim}"), *check);
    }
    trials.add("rejected: the picture of another technique", move |gpu| {
        let image = Image::grey(SIDE, &picture(gpu, "esm", Bias::Auto));
        image.compare(&Image::read(&path("vsm")).unwrap(), TOLERANCE).unwrap_err();
        image.compare(&Image::read(&path("hard")).unwrap(), TOLERANCE).unwrap_err();
    });
    let aside = "compare, uv + vec2f(0.5) / tile_size(view), view";
    for (what, broken) in [
        ("half a texel aside", Broken::saying("pcf", "compare, uv, view", aside)),
        ("weights that do not sum to one", Broken::new("pcf").weights(0.97)),
        ("a tap dropped", Broken::saying("stratified", "k < COUNT", "k + 1u < COUNT")),
        ("a tap dropped", Broken::saying("poisson", "var i = 0u; i <", "var i = 1u; i <")),
        (
            "no half texel towards the four texels' corner",
            Broken::saying("packed", "vec2f(0.5, -0.5)", "vec2f(0.0, 0.0)"),
        ),
    ] {
        let name = broken.about().name;
        let path = path(name);
        trials.add(format!("rejected: {what} ({name})"), move |gpu| {
            let image = Image::grey(SIDE, &picture_of(gpu, &broken, Bias::Auto));
            image.compare(&Image::read(&path).unwrap(), TOLERANCE).unwrap_err();
        });
    }
    trials.run();
}
