//! Laws that every technique obeys, for every member of `all()` and a few settings of each.
//!
//! A law is a function that says what is wrong; each is also given a technique that is broken on
//! purpose, and must say so.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod answers;
mod cases;
#[path = "../common/mod.rs"]
mod common;
mod controls;
mod filters;

use answers::*;
use antumbra::{Capacity, Technique, technique};
use antumbra_testing::{Gpu, Trials, settings};
use filters::*;

type Law = fn(&Gpu, &dyn Technique) -> Result<(), String>;

const LAWS: [(&str, Law); 9] = [
    ("visibility within [0,1]", stays_within_zero_and_one),
    ("lit without casters", is_lit_without_casters),
    ("dark behind a blocker", is_dark_behind_a_blocker),
    ("darker with depth", darkens_with_depth),
    ("hard when the kernel shrinks", shrinks_to_the_hard_shadow),
    ("filtering keeps the mean", filtering_keeps_the_mean),
    ("the same in any view", views_do_not_matter),
    ("fallbacks agree", fallbacks_agree),
    ("a width in the world is texels of the view", widths_in_the_world_are_texels_of_the_view),
];

fn main() {
    let mut trials = Trials::default();
    for (law, check) in LAWS {
        for spec in settings::variants() {
            trials.add(format!("{spec}: {law}"), move |gpu| {
                check(gpu, technique::parse(&spec).unwrap().as_ref()).unwrap();
            });
        }
    }
    for (what, law, broken) in controls::broken() {
        let name = LAWS.iter().find(|(_, l)| std::ptr::fn_addr_eq(*l, law)).map_or("", |(name, _)| *name);
        trials.add(format!("rejected: {what} ({}; {name})", broken.about().name), move |gpu| {
            law(gpu, &broken).expect_err("a law must tell");
        });
    }
    for (spec, triangles, triangles_per_texel) in [("dpm", 1, 6), ("exact", 1, 6), ("exact", 1 << 14, 1)] {
        let name = format!("rejected: {triangles} triangles, {triangles_per_texel} per texel ({spec})");
        trials.add(name, move |gpu| {
            let technique = technique::parse(spec).unwrap();
            let capacity = Capacity { triangles, triangles_per_texel };
            is_dark_within(gpu, technique.as_ref(), capacity).expect_err("too little capacity must tell");
            is_dark_within(gpu, technique.as_ref(), Capacity { triangles: 1 << 14, triangles_per_texel: 6 })
                .expect("a square of three triangles in each of 64² texels");
        });
    }
    trials.run();
}
