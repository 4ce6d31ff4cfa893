//! What the laws must reject: the techniques and the store, broken on purpose.

use antumbra::{
    Technique,
    store::{Array, Site, Step, Store},
};
use antumbra_proof::{Exponential, First, Plane};
use antumbra_testing::{
    broken::Broken,
    laws::{
        Law, is_dark_behind_a_blocker, is_lit_without_casters, shrinks_to_the_hard_shadow,
        stays_within_zero_and_one, views_do_not_matter, widths_in_the_world_are_texels_of_the_view,
    },
};
use std::sync::LazyLock;

/// The store with something else in its place.
#[derive(Debug)]
pub(crate) struct Other {
    needs: &'static [&'static str],
    wgsl: LazyLock<String>,
}

/// It needs a file that does not exist.
pub(crate) static NEEDY: Other =
    Other { needs: &["key", "keyhole"], wgsl: LazyLock::new(|| First.wgsl().into()) };
static ONE_VIEW: Other = saying(|| First.wgsl().replace("caster_view.layer *", "0u *"));
static NEIGHBOUR: Other =
    saying(|| First.wgsl().replace("texel.y) * size.x + texel.x", "texel.y) * size.x + texel.y"));
static NOTHING: Other = saying(|| First.wgsl().replace("first_keys_max(", "// first_keys_max("));

const fn saying(wgsl: fn() -> String) -> Other {
    Other { needs: &["key"], wgsl: LazyLock::new(wgsl) }
}

impl Store for Other {
    fn name(&self) -> &'static str {
        First.name()
    }
    fn arrays(&self, site: &Site<'_>) -> Vec<Array> {
        First.arrays(site)
    }
    fn steps(&self, site: &Site<'_>) -> Vec<Step> {
        First.steps(site)
    }
    fn needs(&self) -> &'static [&'static str] {
        self.needs
    }
    fn varyings(&self) -> &'static [(&'static str, &'static str)] {
        First.varyings()
    }
    fn wgsl(&self) -> &'static str {
        self.wgsl.clone().leak()
    }
    fn lookups(&self, site: &Site<'_>) -> String {
        First.lookups(site)
    }
    fn explain(&self, site: &Site<'_>) -> String {
        First.explain(site)
    }
}

/// Faults, and the law that notices each.
pub(crate) fn all(exponential: &Exponential, plane: &Plane) -> Vec<(&'static str, Law, Box<dyn Technique>)> {
    let basis = |right, wrong| Box::new(Broken::of(exponential).replacing(right, wrong));
    let triangles = |right, wrong| Box::new(Broken::of(plane).replacing(right, wrong));
    let stored = |store: &'static Other| Box::new(Plane { store });
    vec![
        ("unbounded", stays_within_zero_and_one, basis("* filtered, 1.0)", "* filtered, 2.0)")),
        (
            "no casters that are dark",
            is_lit_without_casters,
            basis("exp(-exponential_c()", "0.5 * exp(-exponential_c()"),
        ),
        (
            "the sign of d − z reversed",
            is_dark_behind_a_blocker,
            basis("exp(-exponential_c()", "exp(exponential_c()"),
        ),
        (
            "half a texel aside",
            shrinks_to_the_hard_shadow,
            basis("uv, view, tile_layer", "uv + 0.5 / tile_size(view), view, tile_layer"),
        ),
        ("the first view's layer always", views_do_not_matter, basis("tile_layer(view)", "tile_layer(0u)")),
        (
            "other weights where the width is fixed",
            widths_in_the_world_are_texels_of_the_view,
            Box::new(Broken::of(exponential).weights(0.97)),
        ),
        (
            "corners of the first view",
            views_do_not_matter,
            triangles("shadow_corner(view, id, 0u)", "shadow_corner(0u, id, 0u)"),
        ),
        ("empty texels that are dark", is_lit_without_casters, triangles("return 1.0", "return 0.0")),
        ("a shadow in front", shrinks_to_the_hard_shadow, triangles("met < depth", "met > depth")),
        ("a store of one view's texels", views_do_not_matter, stored(&ONE_VIEW)),
        ("a store of other texels", shrinks_to_the_hard_shadow, stored(&NEIGHBOUR)),
        ("a store of nothing", is_dark_behind_a_blocker, stored(&NOTHING)),
    ]
}
