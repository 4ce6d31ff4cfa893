//! Summed-area table: each compute invocation adds up one row of encoded depths, then one column of
//! those sums. Serial, but every texel is read and written once; on the software driver many times
//! faster than logarithmic passes, and GPUs hide the latency behind thousands of rows.

use super::{Place, Slot, Step, Work, convert::Source};
use crate::{light::Size, shader, table::Table};

/// Two steps per layer of the table.
pub(super) fn steps(source: &Source, table: &Table, map: usize, layers: u32, size: Size) -> Vec<Step> {
    let scratch = Place { slot: Slot::Scratch(map), layer: 0, mip: 0 };
    let step = |shader, lanes, source, target| Step {
        label: "sum",
        shader,
        work: Work::Lanes(lanes),
        source,
        source_layers: 1,
        targets: vec![target],
    };
    // This pass knows no technique: the arithmetic alone.
    let columns =
        shader::file(table.arithmetic()).unwrap_or_default().to_string() + include_str!("sum/columns.wgsl");
    (0..layers)
        .flat_map(|layer| {
            let rows = include_str!("sum/rows.wgsl.in")
                .replace("{layer}", &(layer / table.parts()).to_string())
                .replace("{part}", &(layer % table.parts()).to_string());
            let casters = Place { slot: Slot::Casters, layer: 0, mip: 0 };
            let kept = Place { slot: Slot::Map(map), layer, mip: 0 };
            [
                step(source.wgsl().to_string() + &rows, size.height, casters, scratch),
                step(columns.clone(), size.width, scratch, kept),
            ]
        })
        .collect()
}
