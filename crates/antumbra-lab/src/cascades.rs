//! Which cascade shades which pixel, in colour.

use crate::{
    gpu::Gpu,
    image::{ImageError, Rgba8Image},
    map_views::MapViews,
    readback,
};
use antumbra_render::GpuScene;
use antumbra_scene::Camera;
use anyhow::Result;

/// Colours of the cascades, nearest first, sRGB: neighbours differ in hue and in lightness.
pub const COLOURS: [[u8; 3]; 8] = [
    [232, 96, 76],
    [92, 200, 110],
    [70, 130, 240],
    [245, 200, 70],
    [190, 110, 220],
    [70, 205, 205],
    [240, 150, 190],
    [150, 150, 150],
];
/// Colour of surfaces that no cascade shades, sRGB.
pub const OUTSIDE: [u8; 3] = [20, 20, 20];
/// How much of a cascade's colour goes into the picture.
const TINT: f32 = 0.45;

/// What a pixel sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pixel {
    /// No geometry.
    Nothing,
    /// Geometry that no view of the light contains.
    Outside,
    /// Geometry that the view of that number shades.
    Cascade(usize),
}

/// Which view shades each pixel of the surfaces that the scene holds. Waits.
///
/// # Errors
/// If the device is lost.
pub fn pixels(gpu: &Gpu, scene: &GpuScene, camera: &Camera, maps: &MapViews) -> Result<Vec<Pixel>> {
    let eye = camera.position.as_dvec3();
    let positions = readback::positions(gpu, scene.surfaces())?;
    Ok(positions
        .into_iter()
        .map(|arm| match arm.map(|arm| maps.number(eye + arm.as_dvec3())) {
            None => Pixel::Nothing,
            Some(None) => Pixel::Outside,
            Some(Some(number)) => Pixel::Cascade(number),
        })
        .collect())
}

/// A picture in the colours of the cascades that shade it.
///
/// # Errors
/// [`ImageError::Length`] if the two do not have the same number of pixels.
pub fn tint(picture: &Rgba8Image, pixels: &[Pixel]) -> Result<Rgba8Image, ImageError> {
    let mixed = picture.rgba.chunks_exact(4).zip(pixels).flat_map(|(own, pixel)| {
        let colour = match pixel {
            Pixel::Nothing => return [own[0], own[1], own[2], 255],
            Pixel::Outside => OUTSIDE,
            Pixel::Cascade(number) => COLOURS[number % COLOURS.len()],
        };
        // Shadows stay readable: the colour is darkened as the picture is.
        let light = own[..3].iter().map(|c| f32::from(*c)).sum::<f32>() / (3.0 * 255.0);
        let mix = |c: usize| {
            let tinted = f32::from(colour[c]) * (0.35 + 0.65 * light);
            (f32::from(own[c]) * (1.0 - TINT) + tinted * TINT).round() as u8
        };
        [mix(0), mix(1), mix(2), 255]
    });
    Rgba8Image::new(picture.width, picture.height, mixed.collect())
}

/// Share of each of `count` views among the pixels that see geometry, 0..1.
#[must_use]
pub fn shares(pixels: &[Pixel], count: usize) -> Vec<f64> {
    let geometry = pixels.iter().filter(|p| **p != Pixel::Nothing).count().max(1);
    let of = |number| pixels.iter().filter(|p| **p == Pixel::Cascade(number)).count();
    (0..count).map(|number| of(number) as f64 / geometry as f64).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_take_the_colour_of_their_cascade_and_the_sky_keeps_its_own() {
        let picture = Rgba8Image::new(4, 1, [90, 90, 90, 255].repeat(4)).unwrap();
        let pixels = [Pixel::Nothing, Pixel::Outside, Pixel::Cascade(0), Pixel::Cascade(2)];
        let tinted = tint(&picture, &pixels).unwrap();
        let of: Vec<&[u8]> = tinted.rgba.chunks_exact(4).map(|p| &p[..3]).collect();
        assert_eq!(of[0], [90; 3]);
        assert!(of[1][0] < 90 && of[2][0] > of[2][2] && of[3][2] > of[3][0], "{of:?}");
        assert!(tint(&picture, &pixels[..2]).is_err());
        assert_eq!(shares(&pixels, 3), [1.0 / 3.0, 0.0, 1.0 / 3.0]);
    }
}
