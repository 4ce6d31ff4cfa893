//! Where a view lies: a part of a layer, or all of one.

use crate::light::{Size, View};
use std::fmt;

/// A part of a layer of a shadow map: where a view's texels lie.
///
/// A map that is [made for tiles](crate::Options::tiled) holds many views in few layers, each as large as its light
/// deserves; tiles may be others in every frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Tile {
    /// Layer of the map.
    pub layer: u32,
    /// Texel of the layer that is the view's first: from the left, from the top.
    pub origin: [u32; 2],
    /// Texels of the view.
    pub size: Size,
}

impl fmt::Display for Tile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { layer, origin: [x, y], size: Size { width, height } } = self;
        write!(f, "{width}×{height} texels from ({x}, {y}) on in layer {layer}")
    }
}

impl Tile {
    /// All of a layer.
    pub(crate) fn whole(layer: u32, size: Size) -> Self {
        Self { layer, origin: [0, 0], size }
    }

    /// The level of its mip chain that is one texel.
    pub(crate) fn coarsest(&self) -> u32 {
        self.size.width.max(self.size.height).max(1).ilog2()
    }

    /// The same at a mip level, in texels of that.
    pub(crate) fn at_level(&self, mip: u32) -> Self {
        let Size { width, height } = self.size;
        let size = Size { width: (width >> mip).max(1), height: (height >> mip).max(1) };
        Self { origin: self.origin.map(|x| x >> mip), size, ..*self }
    }

    /// Of what its origin must be a multiple, so that texels of its levels are none of its neighbours': as many
    /// texels as its coarsest level has in one. 1 without mip levels.
    pub(crate) fn step(&self, mips: bool) -> u32 {
        if mips { 1 << self.coarsest() } else { 1 }
    }

    /// The texels behind its last ones, with those that its coarsest level covers.
    fn ends(&self, mips: bool) -> [u64; 2] {
        let step = u64::from(self.step(mips));
        let [x, y] = self.origin.map(u64::from);
        [x + u64::from(self.size.width).max(step), y + u64::from(self.size.height).max(step)]
    }

    /// Whether it, with its mip levels, is within textures of that size.
    pub(crate) fn fits(&self, size: Size, mips: bool) -> bool {
        let [right, bottom] = self.ends(mips);
        right <= u64::from(size.width) && bottom <= u64::from(size.height)
    }

    /// Whether two of them, with their mip levels, have texels in common.
    pub(crate) fn overlaps(&self, other: &Self, mips: bool) -> bool {
        let (ours, theirs) = (self.ends(mips), other.ends(mips));
        let within = |i: usize| u64::from(self.origin[i]) < theirs[i] && u64::from(other.origin[i]) < ours[i];
        self.layer == other.layer && within(0) && within(1)
    }
}

/// A view, and where its texels lie.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placed {
    /// What is seen.
    pub view: View,
    /// Where it lies; none for all of the layer that has the view's number.
    pub tile: Option<Tile>,
}

impl From<View> for Placed {
    fn from(view: View) -> Self {
        Self { view, tile: None }
    }
}

impl View {
    /// The view in a part of a layer. It should be fitted to the tile's [`size`](Tile::size).
    #[must_use]
    pub fn at(self, tile: Tile) -> Placed {
        Placed { view: self, tile: Some(tile) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile(origin: [u32; 2], width: u32, height: u32) -> Tile {
        Tile { layer: 0, origin, size: Size { width, height } }
    }

    #[test]
    fn levels_of_tiles_lie_within_what_they_claim() {
        for (width, height) in [(1, 1), (8, 1), (5, 3), (12, 12), (3, 16)] {
            let step = tile([0, 0], width, height).step(true);
            let tile = tile([3 * step, step], width, height);
            for mip in 0..=tile.coarsest() {
                let level = tile.at_level(mip);
                let ends = [level.origin[0] + level.size.width, level.origin[1] + level.size.height];
                assert!(ends.iter().zip(tile.ends(true)).all(|(end, claim)| u64::from(end << mip) <= claim));
                assert_eq!(level.origin.map(|x| x << mip), tile.origin);
            }
            assert_eq!(tile.at_level(tile.coarsest()).size, Size::square(1));
        }
    }

    #[test]
    fn neighbours_do_not_overlap_but_in_their_levels() {
        let (a, b) = (tile([0, 0], 8, 1), tile([0, 1], 8, 1));
        assert!(!a.overlaps(&b, false) && a.overlaps(&b, true) && a.overlaps(&a, false));
        assert!(!a.overlaps(&Tile { layer: 1, ..a }, true));
        assert!(!a.overlaps(&tile([8, 0], 8, 8), true));
        assert!(a.fits(Size { width: 8, height: 1 }, false) && !a.fits(Size { width: 8, height: 7 }, true));
        assert!(!tile([u32::MAX, 0], u32::MAX, 1).fits(Size::square(64), false));
    }
}
