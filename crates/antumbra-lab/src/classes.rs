//! Kinds of pixels that a technique tells apart, counted and coloured
//! [Annen et al. 2008, figure 10 and table 3].

use crate::image::{GrayImage, ImageError, Rgba8Image};
use antumbra::technique::Class;
use serde::{Deserialize, Serialize};

/// How many pixels a technique takes for one of its kinds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ClassShare {
    /// What such pixels are.
    pub name: String,
    /// Their colour in pictures, sRGB.
    pub colour: [u8; 3],
    /// Share of the pixels that see geometry, 0..1.
    pub share: f64,
}

/// What a technique tells apart in one picture.
#[derive(Debug, Clone)]
pub struct Classes {
    /// Visibility with the pixels of each class in its colour.
    pub picture: Rgba8Image,
    /// The shares of the classes.
    pub shares: Vec<ClassShare>,
    /// Each pixel's number, as [`shares`] takes it.
    pub numbers: GrayImage,
}

impl Classes {
    /// What an answer `visibility` and the pixels' `numbers`, as [`shares`] takes them, show of `classes`.
    ///
    /// # Errors
    /// As [`picture`].
    pub fn new(visibility: &GrayImage, numbers: &GrayImage, classes: &[Class]) -> Result<Self, ImageError> {
        let picture = picture(visibility, numbers, classes)?;
        Ok(Self { picture, shares: shares(numbers, classes), numbers: numbers.clone() })
    }
}

/// Shares of the pixels that see geometry. `numbers` has, for each pixel, 0 for none of the classes,
/// 1 + the index of its class, or a negative number where there is no geometry.
#[must_use]
pub fn shares(numbers: &GrayImage, classes: &[Class]) -> Vec<ClassShare> {
    let geometry = numbers.values.iter().filter(|n| **n >= 0.0).count().max(1);
    let count = |class: usize| numbers.values.iter().filter(|n| **n == (class + 1) as f32).count();
    classes
        .iter()
        .enumerate()
        .map(|(i, class)| ClassShare {
            name: class.name.into(),
            colour: class.colour,
            share: count(i) as f64 / geometry as f64,
        })
        .collect()
}

/// Visibility in linear grey, pixels of a class in its colour: darker in shadow, but never black.
///
/// # Errors
/// [`ImageError::Length`] if the two do not have the same number of pixels.
pub fn picture(
    visibility: &GrayImage,
    numbers: &GrayImage,
    classes: &[Class],
) -> Result<Rgba8Image, ImageError> {
    let GrayImage { width, height, .. } = *visibility;
    let pixels = visibility.values.iter().zip(&numbers.values).flat_map(|(v, number)| {
        let v = v.clamp(0.0, 1.0);
        let class = (*number >= 1.0).then(|| classes.get(*number as usize - 1)).flatten();
        let [r, g, b] = match class {
            Some(class) => class.colour.map(|c| (f32::from(c) * (0.4 + 0.6 * v)).round() as u8),
            None => [(255.0 * v).round() as u8; 3],
        };
        [r, g, b, 255]
    });
    Rgba8Image::new(width, height, pixels.collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLASSES: [Class; 2] =
        [Class { name: "failed", colour: [200, 0, 0] }, Class { name: "unsure", colour: [0, 0, 200] }];

    #[test]
    fn shares_are_of_the_pixels_that_see_geometry() {
        let numbers = GrayImage::new(3, 2, vec![-1.0, 0.0, 1.0, 1.0, 2.0, -1.0]).unwrap();
        let shares = shares(&numbers, &CLASSES);
        assert_eq!(shares.iter().map(|s| s.share).collect::<Vec<_>>(), [0.5, 0.25]);
        assert_eq!((shares[0].name.as_str(), shares[1].colour), ("failed", [0, 0, 200]));
        assert_eq!(super::shares(&GrayImage::filled(2, 2, -1.0), &CLASSES)[0].share, 0.0);
    }

    #[test]
    fn pixels_of_a_class_have_its_colour_and_others_their_visibility() {
        let visibility = GrayImage::new(4, 1, vec![1.0, 0.0, 0.0, 1.0]).unwrap();
        let numbers = GrayImage::new(4, 1, vec![1.0, 2.0, 0.0, -1.0]).unwrap();
        let image = picture(&visibility, &numbers, &CLASSES).unwrap();
        let pixels: Vec<&[u8]> = image.rgba.chunks_exact(4).map(|p| &p[..3]).collect();
        assert_eq!(pixels, [[200, 0, 0], [0, 0, 80], [0, 0, 0], [255, 255, 255]]);
        assert!(picture(&visibility, &GrayImage::filled(2, 1, 0.0), &CLASSES).is_err());
    }
}
