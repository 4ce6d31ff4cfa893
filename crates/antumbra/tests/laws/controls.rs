//! What laws must reject: techniques that are broken on purpose.

use antumbra::Description;
use antumbra_testing::{
    broken::Broken,
    laws::{
        Law, darkens_with_depth, fallbacks_agree, filtering_keeps_the_mean, is_dark_behind_a_blocker,
        is_lit_without_casters, shrinks_to_the_hard_shadow, stays_within_zero_and_one, views_do_not_matter,
        widths_in_the_world_are_texels_of_the_view,
    },
};

type Control = (&'static str, Law, Broken);

/// For each law, what it must reject.
pub(crate) fn broken() -> Vec<Control> {
    [comparison(), basis(), bounds(), geometry()].concat()
}

fn comparison() -> Vec<Control> {
    vec![
        (
            "weights that sum to one but for rounding",
            stays_within_zero_and_one,
            Broken::saying("pcf", "plane), 1.0)", "plane), 2.0)").weights(1.000_001),
        ),
        (
            "half a texel aside",
            shrinks_to_the_hard_shadow,
            Broken::saying("pcf", "compare, uv, view", "compare, uv + vec2f(0.5) / tile_size(view), view"),
        ),
        (
            "no half texel towards the four texels' corner",
            shrinks_to_the_hard_shadow,
            Broken::saying("packed", "vec2f(0.5, -0.5)", "vec2f(1.5, -0.5)"),
        ),
        (
            "the first view's samples always",
            views_do_not_matter,
            Broken::saying("stratified", "tile_layer(view) * LAYERS + layer", "layer"),
        ),
        (
            "the sum of points instead of their mean",
            stays_within_zero_and_one,
            Broken::saying("poisson", "min(lit / f32(poisson_points), 1.0)", "lit"),
        ),
        (
            "the neighbouring texel",
            shrinks_to_the_hard_shadow,
            Broken::saying("hard", "tile_uv(view, centre)", "tile_uv(view, centre + 1.0 / size)"),
        ),
        (
            "the first view's depth always",
            views_do_not_matter,
            Broken::saying("pcf", "uv, view, depth", "uv, 0u, depth"),
        ),
    ]
}

fn basis() -> Vec<Control> {
    vec![
        (
            "empty texels that store zero",
            is_lit_without_casters,
            Broken::saying(
                "esm",
                "exp(esm_c() * depth), 0.0, 0.0",
                "select(exp(esm_c() * depth), 0.0, depth == 1.0), 0.0, 0.0",
            ),
        ),
        ("a series without offset", is_lit_without_casters, Broken::new("csm").uniform("offset", 0.0)),
        (
            "the sign of d − z reversed",
            is_dark_behind_a_blocker,
            Broken::saying("esm", "exp(-esm_c() * depth) * filtered", "exp(esm_c() * depth) * filtered"),
        ),
        (
            "the sign of Eq. 11",
            is_dark_behind_a_blocker,
            Broken::saying("csm", "(basis.y * b.x - basis.x * b.y)", "(basis.x * b.y - basis.y * b.x)"),
        ),
        (
            "the first view's layer always",
            views_do_not_matter,
            Broken::saying("esm", "uv, view, tile_layer(view), ddx", "uv, view, 0u, ddx"),
        ),
    ]
}

fn bounds() -> Vec<Control> {
    vec![
        (
            "depth upside down",
            darkens_with_depth,
            Broken::saying("vsm", "vsm_bound(depth,", "vsm_bound(1.0 - depth,"),
        ),
        (
            "far too much variance",
            shrinks_to_the_hard_shadow,
            Broken::new("vsm").uniform("least_variance", 0.01),
        ),
        (
            "a light that leaks at the receiver's own scale",
            is_dark_behind_a_blocker,
            Broken::saying("evsm.moments=two", "min(abs(warped), abs(moments.x))", "abs(warped)"),
        ),
        (
            "a warp whose order is reversed",
            is_lit_without_casters,
            Broken::saying("evsm", "-exp(-evsm_negative() * z)", "exp(-evsm_negative() * z)"),
        ),
        ("moments without bias", is_lit_without_casters, Broken::new("msm").uniform("moment_bias", 0.0)),
        (
            "a root on the wrong side",
            is_dark_behind_a_blocker,
            Broken::saying("msm", "} else if x <= far {", "} else if x >= far {"),
        ),
        (
            "the receiver's interval without those before it",
            darkens_with_depth,
            Broken::saying(
                "lvsm",
                "bound = min(bound, lvsm_one(depth, moments.xy",
                "bound = min(1.0, lvsm_one(depth, moments.xy",
            ),
        ),
        (
            "other weights where the width is fixed",
            widths_in_the_world_are_texels_of_the_view,
            Broken::new("vsm").weights(0.97),
        ),
        ("a blur that brightens", filtering_keeps_the_mean, Broken::new("vsm").weights(1.01)),
        ("no interpolation on lesser devices", fallbacks_agree, Broken::new("vsm").with(careless)),
    ]
}

fn geometry() -> Vec<Control> {
    vec![
        (
            "planes upside down",
            shrinks_to_the_hard_shadow,
            Broken::saying(
                "spsm",
                "spsm_plane(words, at, size) + slack.z",
                "1.0 - spsm_plane(words, at, size)",
            ),
        ),
        (
            "the other side of a triangle",
            is_lit_without_casters,
            Broken::saying(
                "spsm",
                "if !packing_holds(words) {\n        return spsm_lit;",
                "if !packing_holds(words) {\n        return spsm_shadowed;",
            ),
        ),
        (
            "light between stored triangles",
            is_dark_behind_a_blocker,
            Broken::new("rgsm.missed=lit,neighbours=1"),
        ),
        (
            "shadow on the surface itself",
            shrinks_to_the_hard_shadow,
            Broken::saying("rgsm", "slack.xy / size, abs(at)) < depth", "slack.xy / size, abs(at)) > depth"),
        ),
        (
            "the first view's triangles",
            views_do_not_matter,
            Broken::saying("dpm", "shadow_corner(view, n", "shadow_corner(0u, n"),
        ),
        (
            "corners of the first view",
            views_do_not_matter,
            Broken::saying("exact", "shadow_corner(view, id", "shadow_corner(0u, id"),
        ),
    ]
}

/// One texel where the shader should interpolate by itself.
fn careless(described: &mut Description) {
    if described.slots.contains(&"level_manual") {
        described.slots = vec!["lookup_nearest"];
        described.constants.retain(|constant| constant.name() != "blur_everywhere");
    }
}
