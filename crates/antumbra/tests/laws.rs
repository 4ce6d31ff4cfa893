//! Laws that every technique obeys, for every member of `all()`.

mod common;

use antumbra::{Size, technique};
use common::{Receiver, depth_texture, shadow_map, visibility};

const SIZE: Size = Size::square(64);

fn main() {
    let mut trials = antumbra_testing::Trials::default();
    for spec in technique::all().iter().map(|t| t.page().name) {
        trials.add(format!("{spec}: lit where nothing casts"), move |gpu| {
            let depth = depth_texture(gpu, SIZE, |_, _| 1.0);
            let technique = technique::parse(spec).unwrap();
            let shadows = shadow_map(gpu, technique.as_ref(), &depth, SIZE.into());
            let receivers: Vec<_> = (0..64).map(|i| Receiver::point(0.3, 0.6, i as f32 / 64.0)).collect();
            for (r, v) in receivers.iter().zip(visibility(gpu, &shadows, &receivers)) {
                assert!((0.999 - technique.ripple()..=1.0).contains(&v), "depth {}: {v}", r.depth);
            }
        });
    }
    trials.run();
}
