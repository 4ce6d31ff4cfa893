//! Separable convolution: rows into scratch layers, columns back.
//!
//! The taps are written out with their weights as literals and fetched through a nearest sampler,
//! whose clamping repeats the edge: the form that software drivers compile best, and no worse on
//! GPUs. Kernels whose width depends on the view loop over weights from a uniform buffer.

use super::{FilterStep, Holder, Place, Span, UNIFORM, combine, targets};
use crate::{describe::Combine, kernel::Kernel};

/// Layers that are convolved at once: with more, software drivers run out of registers.
const TOGETHER: u32 = 4;

/// Rows and columns.
pub(super) fn steps(
    kernel: &Kernel,
    how: Combine,
    span: Span,
    tiled: bool,
) -> impl Iterator<Item = FilterStep> {
    let rows = span.parts(TOGETHER).map(move |(skipped, part)| {
        let from = Place { holder: Holder::Map(span.map), layer: part.first, mip: 0 };
        part.step(
            "blur",
            shader(kernel, how, (part.count, tiled), "x"),
            from,
            span.scratch().skip(skipped as usize),
        )
    });
    rows.chain(columns(kernel, how, span, tiled))
}

/// Columns of scratch layers that hold blurred rows.
pub(super) fn columns(
    kernel: &Kernel,
    how: Combine,
    span: Span,
    tiled: bool,
) -> impl Iterator<Item = FilterStep> {
    span.parts(TOGETHER).map(move |(layer, part)| {
        let from = Place { holder: Holder::Scratch(span.map), layer, mip: 0 };
        part.step("blur", shader(kernel, how, (part.count, tiled), "y"), from, part.kept(0))
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

fn shader(kernel: &Kernel, how: Combine, (count, tiled): (u32, bool), axis: &str) -> String {
    let taps = taps(kernel, "blur", |offset, weight| {
        let at = match tiled {
            true => format!("clamp(position.xy + {offset} * step, low, high) * texel"),
            false => format!("(position.xy + {offset} * step) * texel"),
        };
        (0..count).map(|i| format!(
            "    sum_{i} = combine_add(sum_{i}, {weight}, textureSampleLevel(source, nearest, {at}, {i}, 0.0));\n"
        )).collect()
    });
    let start: String = (0..count).map(|i| format!("    var sum_{i} = combine_none();\n")).collect();
    let stores: String =
        (0..count).map(|i| format!("    targets.layer_{i} = combine_result(sum_{i});\n")).collect();
    // The sampler repeats the texture's edge.
    let edges = "    let low = blur.tile.xy + 0.5;\n    let high = blur.tile.xy + blur.tile.zw - 0.5;\n";
    combine(how)
        + UNIFORM
        + &include_str!("blur.wgsl.in")
            .replace("{edges}", if tiled { edges } else { "" })
            .replace("{axis}", axis)
            .replace("{targets}", &targets(count))
            .replace("{start}", &start)
            .replace("{taps}", &taps)
            .replace("{stores}", &stores)
}
