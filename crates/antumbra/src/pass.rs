//! The pre-filter as a list of full-screen steps, planned on the CPU.
//!
//! A [`FilterStep`] reads one texture and writes one or more layers; [`filter_steps`] turns what a technique asks
//! for into steps. Nothing here knows a technique by name or touches a device.

use crate::{
    capabilities::Capabilities,
    describe::{CasterStorage, Combine, Map, Pass},
    light::Size,
    shader::Composition,
};
use convert::Source;

mod blur;
mod convert;
mod mips;
mod sum;

/// Which texture a [`Place`] is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Holder {
    /// The casters' depth of the view.
    Casters,
    /// The depths of some of several caster passes of the view.
    Casts {
        /// Number of the first of them.
        first: u32,
        /// How many.
        count: u32,
        /// How many caster passes the view has.
        of: u32,
    },
    /// Entry of `Description::maps`; layers count from the view's first.
    Map(usize),
    /// A few layers of the size and format of that map, between the two halves of a separable filter.
    Scratch(usize),
}

/// Where in a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Place {
    pub(crate) holder: Holder,
    pub(crate) layer: u32,
    pub(crate) mip: u32,
}

/// How a step covers its targets.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Work {
    /// A triangle over all of the view; one colour attachment per target.
    Draw,
    /// Compute invocations, each a row or a column of the view in one storage texture.
    Lanes(Axis),
}

/// What invocations of a compute step go along.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Axis {
    Rows,
    Columns,
}

/// What steps know of the view that they are run for, beside converting ones.
const UNIFORM: &str = include_str!("pass/uniform.wgsl");

/// Invocations of a workgroup, as in the WGSL of compute steps.
pub(crate) const WORKGROUP: u32 = 64;

/// One pass over the texels. Steps that share shader text and formats share a pipeline.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FilterStep {
    /// `convert`, `blur`, `mips` or `sum`: also the name under which it is timed.
    pub(crate) label: &'static str,
    /// A whole WGSL module with `vertex` and `fragment`, or with `compute`.
    pub(crate) shader: String,
    pub(crate) work: Work,
    /// Layers from here on are bound as one array; of the only depth of the casters, one.
    pub(crate) source: Place,
    pub(crate) source_layers: u32,
    pub(crate) targets: Vec<Place>,
}

impl FilterStep {
    /// The caster pass that it follows, if not the last.
    pub(crate) fn cast(&self) -> Option<u32> {
        match self.source.holder {
            Holder::Casts { first, count, .. } => Some(first + count - 1),
            _ => None,
        }
    }
}

/// A run of layers that one step can write.
#[derive(Debug, Clone, Copy)]
struct Span {
    map: usize,
    first: u32,
    count: u32,
}

impl Span {
    /// Those layers of the map.
    fn kept(self, mip: u32) -> impl Iterator<Item = Place> {
        (self.first..self.first + self.count).map(move |layer| Place {
            holder: Holder::Map(self.map),
            layer,
            mip,
        })
    }

    /// Runs of at most so many layers, and how many layers come before each.
    fn parts(self, most: u32) -> impl Iterator<Item = (u32, Self)> {
        (0..self.count).step_by(most as usize).map(move |skipped| {
            let count = most.min(self.count - skipped);
            (skipped, Self { first: self.first + skipped, count, ..self })
        })
    }

    /// The first layers of its scratch texture.
    fn scratch(self) -> impl Iterator<Item = Place> {
        (0..self.count).map(move |layer| Place { holder: Holder::Scratch(self.map), layer, mip: 0 })
    }

    fn step(
        self,
        label: &'static str,
        shader: String,
        from: Place,
        targets: impl Iterator<Item = Place>,
    ) -> FilterStep {
        let targets = targets.take(self.count as usize).collect();
        FilterStep { label, shader, work: Work::Draw, source: from, source_layers: self.count, targets }
    }
}

/// Mip levels of a full chain.
pub(crate) fn mip_levels(size: Size) -> u32 {
    size.width.max(size.height).ilog2() + 1
}

/// Mip levels that a map keeps.
pub(crate) fn levels(map: &Map, size: Size) -> u32 {
    let has_mips = map.passes.iter().any(|p| matches!(p, Pass::Mips(_)));
    if has_mips { mip_levels(size) } else { 1 }
}

/// Layers that a step over such a map writes at most.
fn together(map: &Map, device: &Capabilities) -> u32 {
    device.targets_per_pass(map.format).min(map.layers)
}

/// Layers of scratch that a map needs.
pub(crate) fn scratch_layers(map: &Map, device: &Capabilities) -> u32 {
    let needs = |pass: &Pass| match pass {
        Pass::Blur(..) => together(map, device),
        Pass::Sum(_) => 1,
        Pass::Mips(_) => 0,
    };
    map.passes.iter().map(needs).max().unwrap_or(0)
}

/// All steps between casting and lighting of a view in one layer; where views are tiles, those that a view as large as
/// a layer takes.
pub(crate) fn filter_steps(composition: &Composition, device: &Capabilities, size: Size) -> Vec<FilterStep> {
    let mut steps = Vec::new();
    let Composition { description, tiled, .. } = composition;
    let tiled = *tiled;
    if description.storage != CasterStorage::Depth {
        return steps;
    }
    let casts = description.sample_offsets.len() as u32;
    for (index, map) in description.maps.iter().enumerate() {
        let source = Source::new(composition, map);
        if casts > 1 {
            let layer = |first| Span { map: index, first: first / 4, count: 1 };
            steps.extend((0..casts).step_by(4).map(|first| source.channels(first, casts, layer(first))));
            continue;
        }
        if let [Pass::Sum(table)] = map.passes.as_slice() {
            steps.extend(sum::steps(&source, table, index, map.layers, tiled));
            continue;
        }
        let together = together(map, device);
        for first in (0..map.layers).step_by(together as usize) {
            let span = Span { map: index, first, count: together.min(map.layers - first) };
            steps.extend(span_steps(&source, map, span, (size, tiled)));
        }
    }
    steps
}

/// Converts and filters a run of layers.
fn span_steps(source: &Source, map: &Map, span: Span, (size, tiled): (Size, bool)) -> Vec<FilterStep> {
    let mut steps = Vec::new();
    let mut passes = map.passes.iter().peekable();
    // Rows of a blur that comes first take encoded depths as they need them: two passes instead of
    // three, and no rounding in between.
    match passes.peek() {
        Some(Pass::Blur(kernel, combine)) if source.is_cheap() => {
            steps.push(source.rows(kernel, *combine, span));
            steps.extend(blur::columns(kernel, *combine, span, tiled));
            passes.next();
        }
        _ => steps.push(source.plain(span)),
    }
    for pass in passes {
        match pass {
            Pass::Blur(kernel, combine) => steps.extend(blur::steps(kernel, *combine, span, tiled)),
            Pass::Mips(combine) => steps.extend(mips::steps(*combine, span, mip_levels(size), tiled)),
            Pass::Sum(_) => {}
        }
    }
    steps
}

/// WGSL of a way to put texels together.
fn combine(how: Combine) -> String {
    match how {
        Combine::Mean => include_str!("pass/combine/mean.wgsl").into(),
        Combine::Greatest => include_str!("pass/combine/greatest.wgsl").into(),
        Combine::LogMean(c) => {
            format!("const combine_steepness: f32 = {c:?};\n{}", include_str!("pass/combine/log_mean.wgsl"))
        }
    }
}

/// Members of the fragment shader's output, one per layer of a span.
fn targets(count: u32) -> String {
    (0..count).map(|i| format!("    @location({i}) layer_{i}: vec4f,\n")).collect()
}
