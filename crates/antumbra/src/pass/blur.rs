//! Separable convolution: rows into scratch layers, columns back.
//!
//! The taps are written out with their weights as literals and fetched through a nearest sampler,
//! whose clamping repeats the edge: the form that software drivers compile best, and no worse on
//! GPUs. Kernels whose width depends on the view loop over weights from a uniform buffer.

use super::{Place, Run, Slot, Step, combine, targets};
use crate::{describe::Combine, kernel::Kernel};

/// Layers that are convolved at once: with more, software drivers run out of registers.
const TOGETHER: u32 = 4;

/// Rows and columns.
pub(super) fn steps(kernel: &Kernel, how: Combine, run: Run) -> impl Iterator<Item = Step> {
    let rows = run.parts(TOGETHER).map(move |(skipped, part)| {
        let from = Place { slot: Slot::Map(run.map), layer: part.first, mip: 0 };
        part.step("blur", shader(kernel, how, part.count, "x"), from, run.scratch().skip(skipped as usize))
    });
    rows.chain(columns(kernel, how, run))
}

/// Columns of scratch layers that hold blurred rows.
pub(super) fn columns(kernel: &Kernel, how: Combine, run: Run) -> impl Iterator<Item = Step> {
    run.parts(TOGETHER).map(move |(layer, part)| {
        let from = Place { slot: Slot::Scratch(run.map), layer, mip: 0 };
        part.step("blur", shader(kernel, how, part.count, "y"), from, part.kept(0))
    })
}

/// Statements for all taps: `tap` gets WGSL of a tap's distance from the middle in texels, and of its
/// weight. `uniforms` holds the weights of an adaptive kernel.
pub(super) fn taps(kernel: &Kernel, uniforms: &str, tap: impl Fn(&str, &str) -> String) -> String {
    if kernel.adaptive.is_none() {
        return kernel
            .offsets()
            .map(|(offset, weight)| tap(&format!("{offset:?}"), &format!("{weight:?}")))
            .collect();
    }
    format!(
        "    for (var i = -i32({uniforms}.reach); i <= i32({uniforms}.reach); i += 1) {{\n\
             let weight = {uniforms}.side[abs(i) / 4][abs(i) % 4];\n{}    }}\n",
        tap("f32(i)", "weight")
    )
}

fn shader(kernel: &Kernel, how: Combine, count: u32, axis: &str) -> String {
    let taps = taps(kernel, "blur", |offset, weight| {
        let at = format!("(position.xy + {offset} * step) * texel");
        (0..count).map(|i| format!(
            "    sum_{i} = combine_add(sum_{i}, {weight}, textureSampleLevel(source, nearest, {at}, {i}, 0.0));\n"
        )).collect()
    });
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
