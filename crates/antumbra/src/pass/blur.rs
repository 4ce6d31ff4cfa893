//! Separable convolution: rows into scratch layers, columns back.
//!
//! The taps are written out with their weights as literals and fetched through a nearest sampler,
//! whose clamping repeats the edge: the form that software drivers compile best, and no worse on
//! GPUs.

use super::{Run, Step, combine, targets};
use crate::{kernel::Kernel, technique::Combine};

/// Rows and columns.
pub(super) fn steps(kernel: &Kernel, how: Combine, run: Run) -> impl Iterator<Item = Step> {
    let rows = shader(kernel, how, run.count, "x");
    let from = run.kept(0).next();
    let rows = from.map(|from| run.step("blur", rows, from, run.scratch()));
    rows.into_iter().chain([columns(kernel, how, run)])
}

/// Columns of scratch layers that hold blurred rows.
pub(super) fn columns(kernel: &Kernel, how: Combine, run: Run) -> Step {
    let from = super::Place { slot: super::Slot::Scratch(run.map), layer: 0, mip: 0 };
    run.step("blur", shader(kernel, how, run.count, "y"), from, run.kept(0))
}

fn shader(kernel: &Kernel, how: Combine, count: u32, axis: &str) -> String {
    let mut taps = String::new();
    for (offset, weight) in kernel.offsets() {
        let at = format!("(position.xy + {offset:?} * step) * texel");
        for i in 0..count {
            taps += &format!(
                "    sum_{i} = combine_add(sum_{i}, {weight:?}, textureSampleLevel(source, nearest, {at}, {i}, 0.0));\n"
            );
        }
    }
    let start: String = (0..count).map(|i| format!("    var sum_{i} = combine_none();\n")).collect();
    let stores: String =
        (0..count).map(|i| format!("    targets.layer_{i} = combine_result(sum_{i});\n")).collect();
    combine(how)
        + &include_str!("blur.wgsl.in")
            .replace("{axis}", axis)
            .replace("{targets}", &targets(count))
            .replace("{start}", &start)
            .replace("{taps}", &taps)
            .replace("{stores}", &stores)
}
