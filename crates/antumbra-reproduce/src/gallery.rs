//! Rows of pictures as most figures have them: whole, and enlarged where they differ.

use crate::{
    page::{Page, Tile},
    stored_image::{StoredImage, Window, busiest},
};
use anyhow::Result;

/// A row of whole pictures, with the window framed, and one of that window enlarged.
pub(crate) fn rows(
    page: &mut Page,
    captions: [&str; 2],
    columns: usize,
    pictures: &[(&str, &StoredImage)],
    window: Window,
) -> Result<()> {
    let whole = pictures.iter().map(|(name, picture)| Tile::new(*name, &picture.framed(window)));
    page.pictures(captions[0], columns, whole.collect::<Result<_>>()?);
    close_ups(page, captions[1], columns, pictures, window)
}

/// A row of one window enlarged.
pub(crate) fn close_ups(
    page: &mut Page,
    caption: &str,
    columns: usize,
    pictures: &[(&str, &StoredImage)],
    window: Window,
) -> Result<()> {
    let close = pictures.iter().map(|(name, picture)| Tile::close_up(*name, picture, window));
    page.pictures(caption, columns, close.collect::<Result<_>>()?);
    Ok(())
}

/// A window of a `part`th of the picture each way, where the weights are largest.
pub(crate) fn window(weights: &[f64], picture: &StoredImage, part: u32) -> Window {
    busiest(weights, picture.size, picture.size.map(|n| n / part))
}
