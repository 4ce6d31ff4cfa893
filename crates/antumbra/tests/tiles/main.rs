//! Views in tiles of a layer, against the same views with maps of their own; what tiles may not be; lights as ranges
//! of views.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod agree;
mod casters;
mod refused;

use antumbra::technique;
use antumbra_testing::{Trials, broken::Broken, settings};

/// What must differ: techniques that do not ask where a view lies, or not as they should.
fn broken() -> Vec<(&'static str, Broken)> {
    let saying = Broken::saying;
    vec![
        ("the layer with the view's number", saying("hard", "tile_layer(view)", "view")),
        (
            "another view's texels",
            saying(
                "pcf.taps=nearest",
                "taps_lit(casters, compare, uv, view,",
                "taps_lit(casters, compare, uv, 0u,",
            ),
        ),
        ("lookups beyond the tile", saying("footprint", "tile_uv(view, place)", "tile_corner(view, place)")),
        ("coordinates of the layer", saying("poisson", "tile_uv(view, place * texel)", "place * texel")),
        ("texels of the layer", saying("stratified", "tile_texel(view, vec2i(texel))", "vec2i(texel)")),
        ("another layer's moments", saying("vsm", "tile_layer(view)", "0u")),
        (
            "the sampler's own mip levels",
            saying(
                "csm",
                "lookup_filtered(map, map_sampler, uv,",
                "textureSampleLevel(map, map_sampler, uv,",
            )
            .with(|d| {
                d.wgsl = d
                    .wgsl
                    .replace(
                        " view, tile_layer(view) * layers + layer, ddx, ddy)",
                        " tile_layer(view) * layers + layer, 0.0)",
                    )
                    .into();
            }),
        ),
        ("triangles of the layer", saying("rgsm", "tile_texel(view, texel)", "texel")),
        ("keys of the layer", saying("dpm", "tile_index(view, texel)", "tile_index(0u, texel)")),
        ("lists of the first view", saying("exact", "shadow_list(view,", "shadow_list(0u,")),
    ]
}

fn main() {
    let mut trials = Trials::default();
    for spec in settings::variants() {
        trials.add(format!("{spec}: tiles are as maps of their own"), move |gpu| {
            agree::tiles_are_maps(gpu, technique::parse(&spec).unwrap().as_ref()).unwrap();
        });
    }
    for (what, broken) in broken() {
        trials.add(format!("rejected: {what} ({broken:?})"), move |gpu| {
            agree::tiles_are_maps(gpu, &broken).expect_err("tiles must differ");
        });
    }
    for spec in
        ["vsm", "vsm.width=0.3", "packed", "esm.storage=log32", "csm.sampling=summed,kernel=5", "evsm"]
    {
        trials.add(format!("{spec}: neighbours leak without tiles"), move |gpu| {
            agree::neighbours_leak(gpu, technique::parse(spec).unwrap().as_ref());
        });
    }
    trials.add("tiles move from frame to frame", agree::tiles_move);
    trials.add("depth that is brought lies in tiles", agree::brought_depth);
    trials.add("a tile may be a whole layer", agree::whole_layers);
    trials.add("tiles that cannot be are named", refused::unfit_tiles);
    trials.add("techniques that know no tiles are named", refused::techniques);
    trials.add("lights have their own views", refused::lights);
    trials.add("maps tell of tiles", refused::told);
    trials.run();
}
