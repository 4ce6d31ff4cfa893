//! How many triangles a map has memory for.

use crate::error::{SettingError, Unsupported};

/// Memory that a [`ShadowMap`](crate::ShadowMap) allocates for triangles, where its technique
/// [keeps them by id](crate::technique::CasterStorage::keeps_ids). All others ignore it.
///
/// It follows from the scene. Triangles beyond it cast no shadow;
/// [`ShadowMap::triangles_drawn`](crate::ShadowMap::triangles_drawn) and
/// [`ShadowMap::abuffer_totals`](crate::ShadowMap::abuffer_totals) tell what a scene needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Capacity {
    /// Triangles of one view, 1 to 2³⁰: those of the scene, or twice as many under a spot, which may cut each
    /// in two. 48 bytes each in every view. By default 524,288.
    pub triangles: u32,
    /// Length of a texel's list on average over the map, 1 or more, where all triangles are listed
    /// ([`CasterStorage::ABuffer`](crate::technique::CasterStorage::ABuffer)). 4 bytes each in every texel. By
    /// default 6.
    pub triangles_per_texel: u32,
}

impl Default for Capacity {
    fn default() -> Self {
        Self { triangles: 1 << 19, triangles_per_texel: 6 }
    }
}

impl Capacity {
    /// Most triangles of a view: their ids leave one bit of a key for depth and one for the side.
    pub const MAX_TRIANGLES: u32 = 1 << 30;

    /// Bits of the ids of its triangles, 1 to 30.
    #[must_use]
    pub fn id_bits(self) -> u32 {
        self.triangles.clamp(2, Self::MAX_TRIANGLES).next_power_of_two().ilog2()
    }
}

/// Whether a capacity holds anything, and ids can tell all of it apart.
pub(crate) fn check(capacity: Capacity) -> Result<(), Unsupported> {
    let within = |name: &str, value: u32, max: u32| match (1..=max).contains(&value) {
        true => Ok(()),
        false => Err(Unsupported::Setting(SettingError::OutOfRange {
            parameter: format!("Options::capacity.{name}"),
            value: value.to_string(),
            allowed: format!("1 to {max}"),
        })),
    };
    within("triangles", capacity.triangles, Capacity::MAX_TRIANGLES)?;
    within("triangles_per_texel", capacity.triangles_per_texel, u32::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_have_as_many_bits_as_they_need() {
        let bits = |triangles| Capacity { triangles, ..Capacity::default() }.id_bits();
        assert_eq!([0, 1, 2, 3, 4, 5].map(bits), [1, 1, 1, 2, 2, 3]);
        assert_eq!([1 << 19, (1 << 19) + 1, u32::MAX].map(bits), [19, 20, 30]);
    }
}
