//! Mip chain: each level puts 2×2 texels of the level above together.

use super::{Run, Step, combine, targets};
use crate::describe::Combine;

/// One step per level.
pub(super) fn steps(how: Combine, run: Run, levels: u32) -> impl Iterator<Item = Step> {
    let shader = shader(how, run.count);
    (1..levels).filter_map(move |mip| {
        let from = run.kept(mip - 1).next()?;
        Some(run.step("mips", shader.clone(), from, run.kept(mip)))
    })
}

fn shader(how: Combine, count: u32) -> String {
    let layers: String =
        (0..count).map(|i| format!("    targets.layer_{i} = mip(low, high, {i});\n")).collect();
    combine(how)
        + &include_str!("mips.wgsl.in").replace("{targets}", &targets(count)).replace("{layers}", &layers)
}
