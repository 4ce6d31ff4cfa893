//! The laws for every member of `all()` and the variants of each, and what they must reject.

#![allow(clippy::unwrap_used, reason = "tests fail by panicking")]

mod controls;

use antumbra::{Capacity, technique};
use antumbra_testing::{Trials, laws, settings};

fn main() {
    let mut trials = Trials::default();
    for spec in settings::variants() {
        laws::add(&mut trials, &spec, technique::parse(&spec).unwrap().as_ref());
    }
    for (fault, law, broken) in controls::broken() {
        laws::add_rejected(&mut trials, fault, law, &broken);
    }
    let triangles = settings::keeping_ids().into_iter().map(|spec| (spec, 1, 6));
    for (spec, triangles, triangles_per_texel) in triangles.chain([("exact", 1 << 14, 1)]) {
        let name = format!("rejected: {triangles} triangles, {triangles_per_texel} per texel ({spec})");
        trials.add(name, move |gpu| {
            let technique = technique::parse(spec).unwrap();
            let capacity = Capacity { triangles, triangles_per_texel };
            laws::is_dark_within(gpu, technique.as_ref(), capacity)
                .expect_err("too little capacity must tell");
            let enough = Capacity { triangles: 1 << 14, triangles_per_texel: 6 };
            laws::is_dark_within(gpu, technique.as_ref(), enough)
                .expect("a square of three triangles in each of 64² texels");
        });
    }
    trials.run();
}
