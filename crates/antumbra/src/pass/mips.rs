//! Mip chain: each level puts 2×2 texels of the level above together.

use super::{FilterStep, Span, UNIFORM, combine, targets};
use crate::describe::Combine;

/// One step per level.
pub(super) fn steps(how: Combine, span: Span, levels: u32, tiled: bool) -> impl Iterator<Item = FilterStep> {
    let shader = shader(how, span.count, tiled);
    (1..levels).filter_map(move |mip| {
        let from = span.kept(mip - 1).next()?;
        Some(span.step("mips", shader.clone(), from, span.kept(mip)))
    })
}

/// The view's last texel at the level that is read.
const LAST: &str = "vec2i(textureDimensions(source)) - 1";
/// The same where the view is a part of the texture, whose sizes tell the level.
const LAST_OF_TILE: &str = "mips_last(vec2u(textureDimensions(source)))";

fn shader(how: Combine, count: u32, tiled: bool) -> String {
    let layers: String =
        (0..count).map(|i| format!("    targets.layer_{i} = mip(low, high, {i});\n")).collect();
    combine(how)
        + if tiled { UNIFORM } else { "" }
        + if tiled { include_str!("mips/tile.wgsl") } else { "" }
        + &include_str!("mips.wgsl.in")
            .replace("{last}", if tiled { LAST_OF_TILE } else { LAST })
            .replace("{targets}", &targets(count))
            .replace("{layers}", &layers)
}
