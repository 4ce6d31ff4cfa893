//! Buffers of casters that keep triangles by id, and the functions that write them, which hide how arrays
//! are split.

use super::split::{Split, Splits};
use crate::technique::Caster;

/// Bindings of group 0 that the passes of [`Caster::Ranked`] have before their buffers: view and pass.
pub(crate) const RANKED_FIRST: u32 = 2;
/// Bindings of group 0 of the passes of [`Caster::Lists`]; further buffers of counts follow.
pub(crate) const LIST_BINDINGS: u32 = 6;
/// Those of the scan; further buffers of counts follow.
pub(crate) const SCAN_BINDINGS: u32 = 4;

/// What the passes of a caster bind and call.
pub(super) fn of_casters(caster: Caster, splits: &Splits) -> String {
    match caster {
        Caster::Depth | Caster::Triangles(_) => String::new(),
        Caster::Lists => counts(splits.counts, LIST_BINDINGS, 2, "atomic<u32>") + &up(splits.counts),
        Caster::Ranked { .. } => ranked(splits),
    }
}

/// What the scan binds and calls.
pub(super) fn of_scan(splits: &Splits) -> String {
    let split = splits.counts;
    let [get, set] = [
        split.chosen("list_counts", |buffer, i| format!("return {buffer}[{i}];")),
        split.chosen("list_counts", |buffer, i| format!("{buffer}[{i}] = value; return;")),
    ];
    counts(split, SCAN_BINDINGS, 1, "u32")
        + &format!("fn list_count(i: u32) -> u32 {{ {get} }}\nfn list_set(i: u32, value: u32) {{ {set} }}\n")
}

fn counts(split: Split, behind: u32, first: u32, of: &str) -> String {
    split.declared("list_counts", "read_write", of, 0, |k| if k == 0 { first } else { behind + k - 1 })
}

fn up(split: Split) -> String {
    let up = split.chosen("list_counts", |buffer, i| format!("return atomicAdd(&{buffer}[{i}], 1u);"));
    format!("fn list_count_up(i: u32) -> u32 {{ {up} }}\n")
}

fn ranked(splits: &Splits) -> String {
    let Splits { keys, corners, .. } = *splits;
    let (keys_end, marks) = (RANKED_FIRST + keys.count(), RANKED_FIRST + keys.count() + corners.count());
    let load = keys.chosen("ranked_keys", |buffer, i| format!("return atomicLoad(&{buffer}[{i}]);"));
    let raise = keys.chosen("ranked_keys", |buffer, i| format!("return atomicMax(&{buffer}[{i}], key);"));
    let store =
        corners.chosen("ranked_corners", |buffer, i| format!("{buffer}[3u * {i} + corner] = place; return;"));
    [
        keys.declared("ranked_keys", "read_write", "atomic<u32>", 0, |k| RANKED_FIRST + k),
        corners.declared("ranked_corners", "read_write", "vec4f", 0, |k| keys_end + k),
        format!(
            "@group(0) @binding({marks}) var<storage, read_write> ranked_marks: array<atomic<u32>>; // by fragments\n"
        ),
        format!("fn ranked_key(i: u32) -> u32 {{ {load} }}\n"),
        format!("fn ranked_raise(i: u32, key: u32) -> u32 {{ {raise} }}\n"),
        format!("fn ranked_keep(i: u32, corner: u32, place: vec4f) {{ {store} }}\n"),
        format!("const ranked_records: u32 = {}u; // by ray\n", corners.elements / 2),
    ]
    .concat()
}
