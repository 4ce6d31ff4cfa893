//! Separable convolution: rows into a scratch layer, columns back.

use super::{Place, Slot, Step};
use crate::kernel::Kernel;

/// Two steps per layer of map `index`.
pub(super) fn steps(kernel: &Kernel, index: usize, layers: u32) -> impl Iterator<Item = Step> {
    let [rows, columns] = ["x", "y"].map(|axis| shader(kernel, axis));
    (0..layers).flat_map(move |layer| {
        let map = Place { slot: Slot::Map(index), layer, mip: 0 };
        let scratch = Place { slot: Slot::Scratch(index), layer: 0, mip: 0 };
        [(&rows, map, scratch), (&columns, scratch, map)].map(|(shader, source, target)| Step {
            label: "blur",
            shader: shader.clone(),
            source,
            targets: vec![target],
        })
    })
}

/// The taps are written out with their weights as literals and fetched through a nearest sampler,
/// whose clamping repeats the edge: the form that software drivers compile best, and no worse on
/// GPUs.
fn shader(kernel: &Kernel, axis: &str) -> String {
    let centre = (kernel.taps.len() as f32 - 1.0) / 2.0;
    let taps: String = kernel
        .taps
        .iter()
        .enumerate()
        .map(|(i, weight)| {
            let offset = i as f32 - centre;
            format!("    sum += {weight:?} * textureSampleLevel(source, nearest, (position.xy + {offset:?} * step) * texel, 0.0);\n")
        })
        .collect();
    include_str!("blur.wgsl.in").replace("{axis}", axis).replace("{taps}", &taps)
}
