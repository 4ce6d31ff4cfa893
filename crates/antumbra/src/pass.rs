//! The pre-filter as a list of full-screen draws, planned on the CPU.
//!
//! A [`Step`] reads one texture layer and writes one or more; [`plan`] turns what a technique asks
//! for into steps. Nothing here knows a technique by name or touches a device.

use crate::{
    capabilities::Capabilities,
    light::Size,
    shader,
    technique::{Caster, Map, Pass, Technique},
};

mod blur;
mod mips;

/// Which texture a [`Place`] is in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) enum Slot {
    /// The casters' depth of the view.
    Casters,
    /// Entry of `Technique::maps`; layers count from the view's first.
    Map(usize),
    /// One layer of the size and format of that map, shared by all its blurs.
    Scratch(usize),
}

/// One layer and mip level of a texture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(crate) struct Place {
    pub(crate) slot: Slot,
    pub(crate) layer: u32,
    pub(crate) mip: u32,
}

/// A full-screen draw. Steps that share shader text and formats share a pipeline.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Step {
    /// `convert`, `blur` or `mips`: also the name under which it is timed.
    pub(crate) label: &'static str,
    /// A whole WGSL module with `vertex` and `fragment`.
    pub(crate) shader: String,
    pub(crate) source: Place,
    pub(crate) targets: Vec<Place>,
}

/// Mip levels of a full chain.
pub(crate) fn mip_levels(size: Size) -> u32 {
    size.width.max(size.height).ilog2() + 1
}

/// Mip levels that a map keeps.
pub(crate) fn levels(map: &Map, size: Size) -> u32 {
    if map.passes.contains(&Pass::Mips) { mip_levels(size) } else { 1 }
}

/// All steps between casting and lighting of one view.
pub(crate) fn plan(technique: &dyn Technique, device: &Capabilities, maps: &[Map], size: Size) -> Vec<Step> {
    let mut steps = Vec::new();
    if technique.caster() != Caster::Depth {
        return steps;
    }
    for (index, map) in maps.iter().enumerate() {
        let slot = Slot::Map(index);
        let together = device.targets_per_pass(map.format);
        for first in (0..map.layers).step_by(together as usize) {
            let count = together.min(map.layers - first);
            steps.push(Step {
                label: "convert",
                shader: shader::convert(technique, device, map, first, count),
                source: Place { slot: Slot::Casters, layer: 0, mip: 0 },
                targets: (first..first + count).map(|layer| Place { slot, layer, mip: 0 }).collect(),
            });
        }
        for pass in &map.passes {
            match pass {
                Pass::Blur(kernel) => steps.extend(blur::steps(kernel, index, map.layers)),
                Pass::Mips => steps.extend(mips::steps(slot, map.layers, mip_levels(size))),
            }
        }
    }
    steps
}
