//! The k-buffer: the first triangles that touch each texel, for [`CasterStorage::KBuffer`]. An atomic maximum
//! for each entry of a texel passes the lesser key on to the next entry, so that all end in order, whatever
//! order fragments come in.
//!
//! [`CasterStorage::KBuffer`]: crate::technique::CasterStorage::KBuffer

use super::{Array, Element, Owner, Site, Step, Store, refused};
use crate::error::Unsupported;

/// The first `k` triangles of each texel.
#[derive(Debug)]
pub(super) struct KBuffer {
    pub(super) k: u32,
}

impl Store for KBuffer {
    fn name(&self) -> &'static str {
        "k-buffer"
    }

    fn arrays(&self, site: &Site<'_>) -> Vec<Array> {
        vec![Array {
            name: "kbuffer_keys",
            title: "keys",
            element: Element::Word,
            length: site.texels() * u64::from(self.k),
            owner: Owner::Layer,
            cleared: true,
            looked_up: true,
        }]
    }

    fn steps(&self, site: &Site<'_>) -> Vec<Step> {
        vec![Step::Draw { words: [self.k, site.capacity.id_bits()] }]
    }

    fn needs(&self) -> &'static [&'static str] {
        &["key"]
    }

    fn varyings(&self) -> &'static [(&'static str, &'static str)] {
        // Depth gained per texel; 1 where the near side is seen.
        &[("slope", "vec2f"), ("near", "u32")]
    }

    fn wgsl(&self) -> &'static str {
        include_str!("kbuffer/keep.wgsl.in")
    }

    fn lookups(&self, site: &Site<'_>) -> String {
        include_str!("kbuffer/lookup.wgsl.in").replace("{bits}", &site.capacity.id_bits().to_string())
    }

    fn keeps_depth(&self) -> bool {
        true
    }

    fn explain(&self, site: &Site<'_>) -> String {
        format!(
            "{} triangles per texel, of {} different ones in each view; triangles_drawn() tells whether that was enough, Options::capacity sets it",
            self.k, site.capacity.triangles
        )
    }

    fn check(&self, site: &Site<'_>) -> Result<(), Unsupported> {
        match self.k {
            0 => refused(site.technique, "0 triangles per texel".into(), "keep at least one".into()),
            _ => Ok(()),
        }
    }
}
