//! Mip chain: each level is the mean of 2×2 texels of the level above.

use super::{Place, Slot, Step};

/// One step per layer and level.
pub(super) fn steps(slot: Slot, layers: u32, levels: u32) -> impl Iterator<Item = Step> {
    (1..levels).flat_map(move |mip| {
        (0..layers).map(move |layer| Step {
            label: "mips",
            shader: include_str!("mips.wgsl").to_string(),
            source: Place { slot, layer, mip: mip - 1 },
            targets: vec![Place { slot, layer, mip }],
        })
    })
}
