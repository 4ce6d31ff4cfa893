//! Annen, Mertens, Seidel, Flerackers and Kautz 2008, Exponential shadow maps.

use crate::target::{Source, Target};

mod failures;

pub(crate) const SOURCE: Source = Source {
    key: "esm",
    name: "Annen et al. 2008, Exponential shadow maps",
    targets: &[Target {
        id: "esm/table-3",
        title: "How many pixels break the assumption",
        paper: "In a backyard of 800×800 pixels, 2.8 % of the pixels (Threshold) or 3.0 % (Z-Max) see casters behind the \
                receiver in their kernel and are filtered by hand; with kernels of 7×7 it is 7.1 % and 9.3 %.",
        ours: "The scene backyard, 800×800 pixels, a 2048² map, both classifiers with their default tolerance. Shares are \
               of the pixels that see geometry, which are fewer than all.",
        seconds: [30, 6],
        run: failures::table_3,
    }],
};
