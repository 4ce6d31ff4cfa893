//! Summed-area table: each compute invocation adds up one row of encoded depths, then one column of
//! those sums. Serial, but every texel is read and written once; on the software driver many times
//! faster than logarithmic passes, and GPUs hide the latency behind thousands of rows.

use super::{Axis, FilterStep, Holder, Place, UNIFORM, Work, convert::Source};
use crate::{shader, table::Table};

/// Two steps per layer of the table.
pub(super) fn steps(source: &Source, table: &Table, map: usize, layers: u32, tiled: bool) -> Vec<FilterStep> {
    let scratch = Place { holder: Holder::Scratch(map), layer: 0, mip: 0 };
    let step = |shader, axis, source, target| FilterStep {
        label: "sum",
        shader,
        work: Work::Lanes(axis),
        source,
        source_layers: 1,
        targets: vec![target],
    };
    // This pass knows no technique: the arithmetic alone.
    let arithmetic = shader::file(table.arithmetic()).unwrap_or_default().to_string();
    let columns = arithmetic + &placed(include_str!("sum/columns.wgsl.in"), "rows", tiled.then_some("blur"));
    let columns = if tiled { UNIFORM.to_string() + &columns } else { columns };
    (0..layers)
        .flat_map(|layer| {
            let rows = placed(include_str!("sum/rows.wgsl.in"), "casters", tiled.then_some("convert"))
                .replace("{layer}", &(layer / table.parts()).to_string())
                .replace("{part}", &(layer % table.parts()).to_string());
            let casters = Place { holder: Holder::Casters, layer: 0, mip: 0 };
            let kept = Place { holder: Holder::Map(map), layer, mip: 0 };
            [
                step(source.wgsl().to_string() + &rows, Axis::Rows, casters, scratch),
                step(columns.clone(), Axis::Columns, scratch, kept),
            ]
        })
        .collect()
}

/// A text with the size of the view and the place of its texel (x, y): in a texture that is the view's, or as a uniform says.
fn placed(text: &str, texture: &str, uniform: Option<&str>) -> String {
    let (size, at) = match uniform {
        None => (format!("vec2i(textureDimensions({texture}))"), "vec2i(x, y)".to_string()),
        Some(name) => (format!("vec2i({name}.tile.zw)"), format!("vec2i({name}.tile.xy) + vec2i(x, y)")),
    };
    text.replace("{size}", &size).replace("{at}", &at)
}
