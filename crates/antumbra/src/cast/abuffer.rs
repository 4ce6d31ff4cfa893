//! The A-buffer: lists of all triangles that touch each texel, for [`CasterStorage::ABuffer`]. Triangles are
//! drawn once to count them, texels are given entries, and triangles are drawn again to fill them.
//!
//! [`CasterStorage::ABuffer`]: crate::technique::CasterStorage::ABuffer

use super::{Array, Element, Image, Owner, Site, Step, Store};

/// Texels across and, at most, down of the image of ids, as in `abuffer/fill.wgsl.in`.
const ROW: u32 = 2048;
/// Texels of an invocation of `abuffer/scan.wgsl.in`.
const SEGMENT: u32 = 128;
/// Invocations of its workgroups.
const WORKGROUP: u32 = 64;

/// All triangles of each texel.
#[derive(Debug)]
pub(super) struct ABuffer;

/// Entries of a layer.
fn entries(site: &Site<'_>) -> u32 {
    (site.texels() * u64::from(site.capacity.triangles_per_texel)).min(u64::from(u32::MAX)) as u32
}

impl Store for ABuffer {
    fn name(&self) -> &'static str {
        "A-buffer"
    }

    fn arrays(&self, site: &Site<'_>) -> Vec<Array> {
        let word = |name, title, length, owner| {
            let element = Element::Word;
            Array { name, title, element, length, owner, cleared: true, looked_up: false }
        };
        vec![
            word("abuffer_counts", "counts", site.texels(), Owner::Shared),
            // Entries, longest list.
            word("abuffer_totals", "totals", 2, Owner::Layer),
        ]
    }

    fn images(&self, site: &Site<'_>) -> Vec<Image> {
        let entries = entries(site);
        let (rows, layers) = (entries.div_ceil(ROW).min(ROW), entries.div_ceil(ROW * ROW));
        let size = [site.size.width, site.size.height];
        vec![
            // Of each texel the first entry of its list, and the one behind its last.
            Image { name: "abuffer_ranges", title: "ranges", size, layers: 2 },
            // Entry i in texel (i mod 2048, ⌊i / 2048⌋ mod 2048) of layer ⌊i / 2048²⌋.
            Image { name: "abuffer_ids", title: "ids", size: [ROW, rows], layers },
        ]
    }

    fn steps(&self, site: &Site<'_>) -> Vec<Step> {
        let words = |fills| [fills, entries(site)];
        let scan = Step::Compute {
            label: "scan",
            wgsl: include_str!("abuffer/scan.wgsl.in"),
            texels: SEGMENT * WORKGROUP,
            words: words(0),
        };
        vec![Step::Draw { words: words(0) }, scan, Step::Draw { words: words(1) }]
    }

    fn wgsl(&self) -> &'static str {
        include_str!("abuffer/fill.wgsl.in")
    }

    fn lookups(&self, _: &Site<'_>) -> String {
        include_str!("abuffer/lookup.wgsl.in").into()
    }

    fn totals(&self) -> Option<&'static str> {
        Some("abuffer_totals")
    }

    fn explain(&self, site: &Site<'_>) -> String {
        format!(
            "lists of {} triangles, {} per texel, of {} different ones in each view; abuffer_totals() and triangles_drawn() tell whether that was enough, Options::capacity sets it",
            entries(site),
            site.capacity.triangles_per_texel,
            site.capacity.triangles
        )
    }
}
