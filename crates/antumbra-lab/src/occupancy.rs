//! Whether a shadow map that keeps triangles by id had memory for all of them.

use crate::gpu::{Gpu, Wait};
use antumbra::{Capacity, ShadowMap};
use anyhow::Result;

/// What the casters needed of such a shadow map, and what it had.
#[derive(Debug, Clone, PartialEq)]
pub struct Occupancy {
    /// Ids of triangles in the view that needed most: two for each under a spot.
    pub triangles: u32,
    /// Where all triangles are listed.
    pub lists: Option<Lists>,
    /// What the map has memory for.
    pub capacity: Capacity,
}

/// Lengths of the lists of triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct Lists {
    /// Entries that the casters needed in the view that needed most.
    pub entries: u32,
    /// Texels of a view.
    pub texels: u64,
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

impl Occupancy {
    /// Reads what the casters that were last drawn needed; `None` if the technique keeps no triangles by id.
    /// Waits.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn read(gpu: &Gpu, shadows: &ShadowMap) -> Result<Option<Self>> {
        if !shadows.description().storage.keeps_ids() {
            return Ok(None);
        }
        let (triangles, capacity) = (shadows.triangles_drawn(), shadows.capacity());
        let Some(totals) = shadows.abuffer_totals() else {
            return Ok(Some(Self { triangles, lists: None, capacity }));
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
        let max = |of: usize| words.iter().skip(of).step_by(2).copied().max().unwrap_or(0);
        let lists = Lists {
            entries: max(0),
            texels: u64::from(shadows.size().width) * u64::from(shadows.size().height),
            longest: max(1),
        };
        Ok(Some(Self { triangles, lists: Some(lists), capacity }))
    }

    /// Capacity that the casters would have needed, if the map has less.
    #[must_use]
    pub fn needed(&self) -> Option<Capacity> {
        let mean = self.lists.as_ref().map_or(0, |lists| lists.mean().ceil() as u32);
        let needed = Capacity {
            triangles: self.triangles.max(self.capacity.triangles),
            triangles_per_texel: mean.max(self.capacity.triangles_per_texel),
        };
        (needed != self.capacity).then_some(needed)
    }

    /// What the map has no memory for, in words, if anything.
    #[must_use]
    pub fn shortage(&self) -> Option<String> {
        let (needed, had) = (self.needed()?, self.capacity);
        let pairs = [
            (needed.triangles, had.triangles, "triangles"),
            (needed.triangles_per_texel, had.triangles_per_texel, "triangles per texel"),
        ];
        let short = pairs.into_iter().filter(|(needed, had, _)| needed > had);
        let parts: Vec<String> =
            short.map(|(needed, had, what)| format!("{needed} {what}, with memory for {had}")).collect();
        Some(format!("shadows are missing: {}", parts.join("; ")))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shortages_say_what_was_needed() {
        let lists = Lists { entries: 3000, texels: 1000, longest: 9 };
        let capacity = Capacity { triangles: 50, triangles_per_texel: 3 };
        let enough = Occupancy { triangles: 50, lists: Some(lists.clone()), capacity };
        assert_eq!((enough.needed(), enough.shortage()), (None, None));
        let longer = Some(Lists { entries: 3001, ..lists });
        let short = Occupancy { lists: longer, ..enough.clone() };
        assert_eq!(short.needed(), Some(Capacity { triangles_per_texel: 4, ..capacity }));
        assert!(
            short.shortage().is_some_and(|text| text.ends_with("4 triangles per texel, with memory for 3"))
        );
        let short = Occupancy { triangles: 77, lists: None, ..enough };
        assert_eq!(short.needed(), Some(Capacity { triangles: 77, ..capacity }));
        assert!(short.shortage().is_some_and(|text| text.ends_with("77 triangles, with memory for 50")));
    }
}
