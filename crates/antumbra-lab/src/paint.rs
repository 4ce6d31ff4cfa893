//! Drawing into pictures: rectangles, other pictures, smooth lines, small letters.

use crate::image::Rgba8Image;
use embedded_graphics::{
    Pixel,
    draw_target::DrawTarget,
    geometry::{OriginDimensions, Point, Size},
    mono_font::{MonoTextStyle, ascii},
    pixelcolor::{Rgb888, RgbColor},
    text::{Alignment, Baseline, Text, TextStyleBuilder},
};
use std::convert::Infallible;

/// An opaque sRGB colour.
pub(crate) type Colour = [u8; 3];

pub(crate) const WHITE: Colour = [255; 3];
pub(crate) const INK: Colour = [32, 36, 42];

/// Which point of a text lies where it is put.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Height of a line of letters; the letters are fixed bitmaps.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Letters {
    /// 6 by 10 pixels.
    Small,
    /// 10 by 20 pixels.
    Large,
}

impl Letters {
    /// Pixels from one letter to the next.
    pub(crate) fn advance(self) -> u32 {
        match self {
            Self::Small => 6,
            Self::Large => 10,
        }
    }
}

/// A picture of one colour.
pub(crate) fn blank(width: u32, height: u32, colour: Colour) -> Rgba8Image {
    let pixel = [colour[0], colour[1], colour[2], 255];
    Rgba8Image { width, height, rgba: pixel.repeat(width as usize * height as usize) }
}

/// Mixes a colour into a pixel; nothing happens outside of the picture.
fn mix(image: &mut Rgba8Image, x: i64, y: i64, colour: Colour, share: f64) {
    if !(0..i64::from(image.width)).contains(&x) || !(0..i64::from(image.height)).contains(&y) {
        return;
    }
    let at = 4 * (y as usize * image.width as usize + x as usize);
    for (old, new) in image.rgba[at..at + 3].iter_mut().zip(colour) {
        *old = (f64::from(*old) + share * (f64::from(new) - f64::from(*old))).round() as u8;
    }
}

/// Copies a picture to column `x`, row `y`; what does not fit is cut off.
pub(crate) fn put(image: &mut Rgba8Image, other: &Rgba8Image, x: u32, y: u32) {
    let columns = other.width.min(image.width.saturating_sub(x)) as usize;
    for row in 0..other.height.min(image.height.saturating_sub(y)) {
        let from = 4 * (row as usize * other.width as usize);
        let to = 4 * ((y + row) as usize * image.width as usize + x as usize);
        image.rgba[to..to + 4 * columns].copy_from_slice(&other.rgba[from..from + 4 * columns]);
    }
}

/// Lines from point to point, smooth: each pixel is covered by what lies within half of `width` of
/// its centre. Coordinates are in pixels, (0, 0) is a corner.
pub(crate) fn lines(image: &mut Rgba8Image, points: &[[f64; 2]], width: f64, colour: Colour) {
    let size = [f64::from(image.width), f64::from(image.height)];
    let reach = width / 2.0 + 1.0;
    // Joints are covered by two lines and must not be drawn twice.
    let mut covered = std::collections::HashMap::new();
    for pair in points.windows(2) {
        let range = |axis: usize| {
            let [a, b] = [pair[0][axis], pair[1][axis]];
            let [low, high] = [a.min(b) - reach, a.max(b) + reach].map(|v| v.clamp(0.0, size[axis]));
            low as i64..high.ceil() as i64
        };
        for y in range(1) {
            for x in range(0) {
                let distance = distance([x as f64 + 0.5, y as f64 + 0.5], pair[0], pair[1]);
                let share = (width / 2.0 + 0.5 - distance).clamp(0.0, 1.0);
                let old = covered.entry((x, y)).or_insert(0.0_f64);
                *old = old.max(share);
            }
        }
    }
    for ((x, y), share) in covered {
        mix(image, x, y, colour, share);
    }
}

/// Distance from a point to a line between two others.
fn distance(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let arm = [point[0] - from[0], point[1] - from[1]];
    let length_squared = along[0] * along[0] + along[1] * along[1];
    let t = if length_squared > 0.0 {
        ((arm[0] * along[0] + arm[1] * along[1]) / length_squared).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (arm[0] - t * along[0]).hypot(arm[1] - t * along[1])
}

/// A line of text, its letters centred on row `y`. What is no ASCII becomes a question mark.
pub(crate) fn text(
    image: &mut Rgba8Image,
    [x, y]: [i32; 2],
    anchor: Anchor,
    text: &str,
    letters: Letters,
    colour: Colour,
) {
    let font = match letters {
        Letters::Small => &ascii::FONT_6X10,
        Letters::Large => &ascii::FONT_10X20,
    };
    let [r, g, b] = colour;
    let alignment = match anchor {
        Anchor::Start => Alignment::Left,
        Anchor::Middle => Alignment::Center,
        Anchor::End => Alignment::Right,
    };
    let style = TextStyleBuilder::new().alignment(alignment).baseline(Baseline::Middle).build();
    let letters = MonoTextStyle::new(font, Rgb888::new(r, g, b));
    let text = Text::with_text_style(text, Point::new(x, y), letters, style);
    let Ok(_) = embedded_graphics::Drawable::draw(&text, &mut Target(image));
}

/// A picture as the text renderer takes it.
struct Target<'a>(&'a mut Rgba8Image);

impl OriginDimensions for Target<'_> {
    fn size(&self) -> Size {
        Size::new(self.0.width, self.0.height)
    }
}

impl DrawTarget for Target<'_> {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<Rgb888>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        for Pixel(at, colour) in pixels {
            mix(self.0, at.x.into(), at.y.into(), [colour.r(), colour.g(), colour.b()], 1.0);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ink(image: &Rgba8Image, x: u32, y: u32) -> u8 {
        255 - image.rgba[4 * (y * image.width + x) as usize]
    }

    #[test]
    fn lines_cover_their_width_and_joints_once() {
        let mut image = blank(20, 10, WHITE);
        lines(&mut image, &[[2.0, 5.0], [10.0, 5.0], [18.0, 5.0]], 2.0, [0; 3]);
        assert_eq!((ink(&image, 10, 4), ink(&image, 10, 5)), (255, 255));
        assert_eq!((ink(&image, 10, 2), ink(&image, 10, 7)), (0, 0));
        let mut thin = blank(20, 10, WHITE);
        lines(&mut thin, &[[2.0, 5.0], [10.0, 5.0], [18.0, 5.0]], 1.0, [0; 3]);
        assert_eq!(ink(&thin, 9, 4), ink(&thin, 5, 4), "no knot where lines meet");
    }

    #[test]
    fn what_leaves_the_picture_is_cut_off() {
        let mut image = blank(4, 4, WHITE);
        lines(&mut image, &[[-50.0, -50.0], [90.0, 90.0]], 1.0, [0; 3]);
        put(&mut image, &blank(9, 9, [0; 3]), 2, 3);
        text(&mut image, [-3, 1], Anchor::Middle, "wide", Letters::Small, [0; 3]);
        assert_eq!((image.rgba.len(), ink(&image, 3, 3)), (64, 255));
    }

    #[test]
    fn text_stands_where_its_anchor_says() {
        let columns = |anchor| {
            let mut image = blank(60, 12, WHITE);
            text(&mut image, [30, 6], anchor, "mm", Letters::Small, [0; 3]);
            let used = (0..60).filter(|x| (0..12).any(|y| ink(&image, *x, y) > 0));
            let used: Vec<u32> = used.collect();
            [used[0], used[used.len() - 1]]
        };
        assert!(columns(Anchor::Start)[0] >= 30 && columns(Anchor::End)[1] <= 30);
        let [left, right] = columns(Anchor::Middle);
        assert!((left + right).abs_diff(60) <= 2);
    }
}
