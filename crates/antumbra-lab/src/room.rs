//! Whether a technique that keeps triangles by number had room for all of them.

use crate::gpu::Gpu;
use antumbra::{ShadowMap, technique, technique::Caster};
use anyhow::Result;

/// What the casters needed of such a shadow map, and what there was.
#[derive(Debug, Clone, PartialEq)]
pub struct Room {
    /// Spec of the technique.
    pub spec: String,
    /// Triangles of the casters.
    pub drawn: u32,
    /// Triangles that there was room for.
    pub triangles: u32,
    /// Where all triangles are listed.
    pub lists: Option<Lists>,
}

/// Lengths of the lists of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Lists {
    /// Entries that the casters needed in the view that needed most.
    pub entries: u32,
    /// Texels of a view.
    pub texels: u64,
    /// Entries per texel that there was room for.
    pub per_texel: u32,
    /// Length of the longest list.
    pub longest: u32,
}

impl Lists {
    /// Mean length, 0 or more.
    #[must_use]
    pub fn mean(&self) -> f64 {
        f64::from(self.entries) / self.texels as f64
    }
}

impl Room {
    /// Of casters that were drawn; `None` if the technique numbers no triangles. Waits.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read(gpu: &Gpu, shadows: &ShadowMap) -> Result<Option<Self>> {
        let spec = technique::spec(shadows.technique());
        let drawn = shadows.triangles_drawn();
        let (totals, per_texel, triangles) = match (shadows.technique().caster(), shadows.list_totals()) {
            (Caster::Lists { per_texel, triangles }, Some(totals)) => (totals, per_texel, triangles),
            (Caster::Ranked { triangles, .. }, _) => {
                return Ok(Some(Self { spec, drawn, triangles, lists: None }));
            }
            _ => return Ok(None),
        };
        let staging = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("list totals"),
            size: totals.size(),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        encoder.copy_buffer_to_buffer(totals, 0, &staging, 0, totals.size());
        gpu.finish(encoder)?;
        let bytes = gpu.map(&staging)?;
        let words: Vec<u32> =
            bytes.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
        let most = |of: usize| words.iter().skip(of).step_by(2).copied().max().unwrap_or(0);
        let lists = Lists {
            entries: most(0),
            texels: u64::from(shadows.size().width) * u64::from(shadows.size().height),
            per_texel,
            longest: most(1),
        };
        Ok(Some(Self { spec, drawn, triangles, lists: Some(lists) }))
    }

    /// What did not fit and what to set, if anything.
    #[must_use]
    pub fn shortage(&self) -> Option<String> {
        let spec = &self.spec;
        if self.drawn > self.triangles {
            let (found, room) = (self.drawn, self.triangles);
            return Some(format!(
                "{spec}: no room for {found} triangles, light leaks; set triangles={found} (is {room})"
            ));
        }
        let lists = self.lists.as_ref()?;
        let needed = lists.mean().ceil();
        (needed > f64::from(lists.per_texel)).then(|| {
            let room = lists.per_texel;
            format!("{spec}: no room for {needed} triangles per texel, light leaks; set per_texel={needed} (is {room})")
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortages_say_what_to_set() {
        let lists = Lists { entries: 3000, texels: 1000, per_texel: 3, longest: 9 };
        let enough = Room { spec: "exact".into(), drawn: 50, triangles: 50, lists: Some(lists.clone()) };
        assert_eq!(enough.shortage(), None);
        let longer = Some(Lists { entries: 3001, ..lists });
        let short = Room { lists: longer, ..enough.clone() }.shortage();
        assert!(short.is_some_and(|text| text.contains("set per_texel=4 (is 3)")));
        let short = Room { drawn: 77, lists: None, ..enough }.shortage();
        assert!(short.is_some_and(|text| text.contains("set triangles=77 (is 50)")));
    }
}
