//! Rows of pictures as most figures have them: whole, and enlarged where they differ.

use crate::{
    page::{Page, Tile},
    raster::{Raster, Window, busiest},
};
use anyhow::Result;

/// A row of whole pictures, with the window framed, and one of that window enlarged.
pub(crate) fn rows(
    page: &mut Page,
    captions: [&str; 2],
    columns: usize,
    pictures: &[(&str, &Raster)],
    window: Window,
) -> Result<()> {
    let mut whole = Vec::new();
    let mut close = Vec::new();
    for (name, picture) in pictures {
        whole.push(Tile::new(*name, &picture.framed(window))?);
        close.push(Tile::close_up(*name, picture, window)?);
    }
    page.pictures(captions[0], columns, whole);
    page.pictures(captions[1], columns, close);
    Ok(())
}

/// A window of a `part`th of the picture each way, where the weights are largest.
pub(crate) fn window(weights: &[f64], picture: &Raster, part: u32) -> Window {
    busiest(weights, picture.size, picture.size.map(|n| n / part))
}
