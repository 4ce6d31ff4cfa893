//! Takes the views of a frame, or says why not.

use super::ShadowMap;
use crate::{
    light::{Size, View},
    pass,
    tile::{Placed, Tile},
};

impl ShadowMap {
    /// Takes the light's views for this frame, nearest first; the first that contains a receiver
    /// is the one that shades it. Without any everything is lit. Each takes the layer with its number; of several
    /// lights they are the first's, and the others light everything.
    ///
    /// Writes buffers through the queue: what is submitted next sees what was written last, so two cameras
    /// in one submission take two maps.
    ///
    /// # Errors
    /// [`PrepareError`], and then the previous views stay.
    pub fn prepare(&mut self, queue: &wgpu::Queue, views: &[View]) -> Result<(), PrepareError> {
        self.take(queue, views.iter().map(|view| Placed::from(*view)), [views.len()].into_iter())
    }

    /// The same for views that lie in [tiles](Tile) of layers.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    pub fn prepare_tiles(&mut self, queue: &wgpu::Queue, views: &[Placed]) -> Result<(), PrepareError> {
        self.prepare_lights(queue, &[views])
    }

    /// The same for several lights, which `shadow_visibility` tells apart by their numbers here
    /// ([`Options::lights`](crate::Options::lights)). A light without views lights everything. Views without a tile take the layer
    /// with their number among those of all lights.
    ///
    /// # Errors
    /// As [`prepare`](Self::prepare).
    pub fn prepare_lights(&mut self, queue: &wgpu::Queue, lights: &[&[Placed]]) -> Result<(), PrepareError> {
        let max = self.options.lights as usize;
        if lights.len() > max {
            return Err(PrepareError::TooManyLights { given: lights.len(), max });
        }
        let views = lights.iter().flat_map(|views| views.iter().copied());
        self.take(queue, views, lights.iter().map(|views| views.len()))
    }

    fn take(
        &mut self,
        queue: &wgpu::Queue,
        views: impl Iterator<Item = Placed> + Clone,
        of_lights: impl Iterator<Item = usize>,
    ) -> Result<(), PrepareError> {
        let (given, max) = (views.clone().count(), self.options.views as usize);
        if given > max {
            return Err(PrepareError::TooManyViews { given, max });
        }
        self.check_depth(views.clone().map(|placed| placed.view))?;
        let located =
            |(number, placed): (u32, Placed)| placed.tile.unwrap_or(Tile::whole(number, self.options.size));
        self.next_tiles.clear();
        self.next_tiles.extend((0..).zip(views.clone()).map(located));
        self.check_tiles(views.clone().map(|placed| placed.tile.is_some()))?;

        std::mem::swap(&mut self.tiles, &mut self.next_tiles);
        self.views.clear();
        self.views.extend(views.map(|placed| placed.view));
        self.caster_views.clear();
        let offsets = &self.composition.description.sample_offsets;
        let jittered = |(view, tile): (&View, &Tile)| {
            let (view, size) = (*view, tile.size);
            offsets.iter().map(move |offset| view.jittered(size, *offset))
        };
        self.caster_views.extend(self.views.iter().zip(&self.tiles).flat_map(jittered));
        self.uniforms.write(queue, (&self.views, &self.tiles), of_lights);
        self.cast.write(queue, &self.views, &self.tiles);
        Ok(())
    }

    fn check_depth(&self, mut views: impl Iterator<Item = View> + Clone) -> Result<(), PrepareError> {
        let reversed = self.textures.is_reversed();
        if let Some(view) = views.clone().position(|view| view.is_reversed() != reversed) {
            return Err(PrepareError::Depth { view, reversed: !reversed });
        }
        match views.position(|view| view.is_warped() && !self.options.warped) {
            Some(view) => Err(PrepareError::Warped { view }),
            None => Ok(()),
        }
    }

    /// Whether views lie in the map, and none where another does.
    fn check_tiles(&self, placed: impl Iterator<Item = bool>) -> Result<(), PrepareError> {
        let (tiles, size) = (&self.next_tiles, self.options.size);
        let Some(layers) = self.options.layers else {
            let view = placed.into_iter().position(|placed| placed);
            return view.map_or(Ok(()), |view| Err(PrepareError::Untiled { view }));
        };
        let mips = self.description().maps.iter().any(|map| pass::levels(map, Size::square(2)) > 1);
        for (view, tile) in tiles.iter().enumerate() {
            let tile = *tile;
            if tile.size.width == 0 || tile.size.height == 0 {
                return Err(PrepareError::EmptyTile { view, tile });
            }
            // A whole layer has the levels that it has.
            let mips = mips && tile != Tile::whole(tile.layer, size);
            let step = tile.step(mips);
            if tile.layer >= layers || !tile.fits(size, mips) {
                return Err(PrepareError::TileOutside { view, tile, size, layers, step });
            }
            if tile.origin.iter().any(|x| !x.is_multiple_of(step)) {
                return Err(PrepareError::TileUnaligned { view, tile, step });
            }
            if let Some(other) = tiles[..view].iter().position(|other| tile.overlaps(other, mips)) {
                return Err(PrepareError::TilesOverlap { view, tile, other });
            }
        }
        Ok(())
    }
}

/// Why a shadow map does not take views.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// There are more than the map was made for.
    #[error("{given} views for a shadow map that was made for {max}; see Options::views")]
    TooManyViews {
        /// Views given, of all lights.
        given: usize,
        /// Views that the map was made for.
        max: usize,
    },
    /// There are more lights than the map was made for.
    #[error("{given} lights for a shadow map that was made for {max}; see Options::lights")]
    TooManyLights {
        /// Lights given.
        given: usize,
        /// Lights that the map was made for.
        max: usize,
    },
    /// The map has a layer for each view.
    #[error("views[{view}] has a tile, and views of this shadow map a layer each; see Options::tiled")]
    Untiled {
        /// Index of the view, among those of all lights, as in what follows.
        view: usize,
    },
    /// A tile without texels.
    #[error("views[{view}] has a tile without texels: {tile}; both sides must be at least 1")]
    EmptyTile {
        /// Index of the view.
        view: usize,
        /// Where it was to lie.
        tile: Tile,
    },
    /// A tile that is not within the map.
    #[error(
        "views[{view}] has {tile}, which is not in the map: it has layers 0 to {}, of {}×{} texels{}",
        layers - 1, size.width, size.height,
        if *step > 1 { format!(", and with its mip levels the tile takes {step} texels along each side at least") } else { String::new() }
    )]
    TileOutside {
        /// Index of the view.
        view: usize,
        /// Where it was to lie.
        tile: Tile,
        /// Texels of a layer.
        size: Size,
        /// Layers of the map.
        layers: u32,
        /// Least texels along each side that its mip levels cover, 1 without.
        step: u32,
    },
    /// Two tiles with texels in common.
    #[error(
        "views[{view}] has {tile}, where views[{other}] lies; tiles, with what their coarsest mip levels cover, must not overlap"
    )]
    TilesOverlap {
        /// Index of the view.
        view: usize,
        /// Where it was to lie.
        tile: Tile,
        /// Index of the view that is there.
        other: usize,
    },
    /// A tile that begins within a texel of one of its mip levels.
    #[error(
        "views[{view}] has {tile}; with mip levels it must begin at multiples of {step}, the texels that its coarsest level has in one"
    )]
    TileUnaligned {
        /// Index of the view.
        view: usize,
        /// Where it was to lie.
        tile: Tile,
        /// Of what both coordinates of its origin must be multiples.
        step: u32,
    },
    /// The map is not made for warped views.
    #[error(
        "views[{view}] is warped: its linear depth depends on the place in the picture; see Options::warped"
    )]
    Warped {
        /// Index of the view.
        view: usize,
    },
    /// Depth runs the other way than in the map.
    #[error(
        "views[{view}] has depth that {} with the distance, and the map's {}; a map of reversed depth is made by from_depth with Depth::reversed",
        if *reversed { "falls" } else { "grows" },
        if *reversed { "grows" } else { "falls" }
    )]
    Depth {
        /// Index of the view.
        view: usize,
        /// Whether the view's depth is reversed.
        reversed: bool,
    },
}
