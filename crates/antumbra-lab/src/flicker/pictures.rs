//! What one sees: a part of the picture as a film, as a strip, and one row of it over time.

use super::{Request, truths::FrameSample};
use crate::{
    animation,
    image::{Rgba8Image, crop},
    motion::Path,
    paint::{self, Anchor, Colour, Letters, WHITE},
    prepared::Prepared,
};
use antumbra::technique;
use anyhow::Result;
use std::collections::BTreeMap;

/// Largest part that is shown, pixels.
const WINDOW: [u32; 2] = [160, 120];
/// Height of a name, pixels; in a strip, which is shown smaller.
const NAME: u32 = 14;
const LARGE_NAME: u32 = 26;
/// Pixels between panels.
const GAP: u32 = 4;
/// Frames of a strip.
const STRIP: usize = 6;
/// How often each pixel of a strip or a row over time is repeated.
const ZOOM: u32 = 2;
/// Most frames of a film; of longer paths it leaves out some.
const FILM: usize = 240;
const FRAMES_PER_SECOND: u16 = 15;
/// Gray of pixels that do not count.
const UNCOUNTED: u8 = 120;
const BAR: Colour = [32, 36, 42];

/// The picture of all panels in motion.
pub const FILM_FILE: &str = "film.png";
/// That of a few frames of each panel.
pub const STRIP_FILE: &str = "strip.png";
/// That of one row of each panel over time.
pub const ROW_FILE: &str = "row.png";

/// One thing that is shown, frame by frame.
#[derive(Debug)]
struct Panel {
    name: String,
    frames: Vec<Vec<u8>>,
}

/// The hard truth and every technique.
#[derive(Debug)]
pub(super) struct Pictures {
    resolution: [u32; 2],
    /// Left, top, width, height.
    window: [u32; 4],
    panels: Vec<Panel>,
}

impl Pictures {
    /// Chooses the part with most edges of shadows in the first frame; where the camera moves away, the
    /// middle.
    pub(super) fn new(request: &Request, first: &FrameSample, prepared: &[Prepared]) -> Self {
        let resolution = request.shot.resolution;
        let edges = edges(&first.truth.hard, resolution);
        let [width, height] = [0, 1].map(|k| WINDOW[k].min(resolution[k]));
        let centre = [(resolution[0] - width) / 2, (resolution[1] - height) / 2];
        let [left, top] = match request.path {
            Path::Recede => centre,
            _ => busiest(&edges, resolution, [width, height]),
        };
        let specs = prepared.iter().map(|c| technique::spec(c.shadows.technique()));
        let panels = std::iter::once("truth".to_string()).chain(specs);
        Self {
            resolution,
            window: [left, top, width, height],
            panels: panels.map(|name| Panel { name, frames: Vec::new() }).collect(),
        }
    }

    pub(super) fn add(&mut self, sample: &FrameSample) {
        let truth: Vec<f32> = sample.truth.hard.iter().map(|v| v.unwrap_or(0.0)).collect();
        for (panel, values) in self.panels.iter_mut().zip(std::iter::once(&truth).chain(&sample.answers)) {
            let counted = sample.truth.hard.iter().zip(values);
            let bytes: Vec<u8> =
                counted.map(|(truth, v)| truth.map_or(UNCOUNTED, |_| (v * 255.0).round() as u8)).collect();
            // The window lies inside: it was chosen so.
            panel.frames.push(crop(&bytes, self.resolution, self.window).unwrap_or_default());
        }
    }

    /// Draws everything.
    pub(super) fn files(&self, images: &mut BTreeMap<String, Vec<u8>>) -> Result<()> {
        images.insert(FILM_FILE.into(), self.film()?);
        images.insert(STRIP_FILE.into(), self.strip().to_png()?);
        images.insert(ROW_FILE.into(), self.row_over_time().to_png()?);
        Ok(())
    }

    fn count(&self) -> usize {
        self.panels.first().map_or(0, |panel| panel.frames.len())
    }

    /// Panels in about as many rows as columns; all move together.
    fn film(&self) -> Result<Vec<u8>> {
        let [.., width, height] = self.window;
        let (mut sheet, places) = self.sheet(width, height);
        let step = self.count().div_ceil(FILM).max(1);
        let mut frames = Vec::new();
        for number in (0..self.count()).step_by(step) {
            for (panel, [x, y]) in self.panels.iter().zip(&places) {
                paint::put(&mut sheet, &gray(&panel.frames[number], width, 1), *x, *y);
            }
            frames.push(sheet.rgba.iter().step_by(4).copied().collect());
        }
        Ok(animation::gray([sheet.width, sheet.height], &frames, FRAMES_PER_SECOND)?)
    }

    /// A row for each panel, frames from first to last side by side.
    fn strip(&self) -> Rgba8Image {
        let [.., width, height] = self.window.map(|pixels| ZOOM * pixels);
        let last = self.count().saturating_sub(1);
        let mut picks: Vec<usize> = (0..STRIP).map(|i| i * last / (STRIP - 1)).collect();
        picks.dedup();
        let rows = self.panels.len() as u32;
        let columns = picks.len() as u32;
        let mut image =
            paint::blank(columns * (width + GAP) - GAP, rows * (LARGE_NAME + height + GAP) + LARGE_NAME, BAR);
        for (column, pick) in picks.iter().enumerate() {
            let x = column as u32 * (width + GAP);
            name(&mut image, Letters::Large, &format!("frame {pick}"), x, 0);
            for (row, panel) in self.panels.iter().enumerate() {
                let y = LARGE_NAME + row as u32 * (LARGE_NAME + height + GAP);
                if column == 0 {
                    name(&mut image, Letters::Large, &panel.name, 0, y);
                }
                let [.., width, _] = self.window;
                paint::put(&mut image, &gray(&panel.frames[*pick], width, ZOOM), x, y + LARGE_NAME);
            }
        }
        image
    }

    /// One row of pixels of each panel, from the first frame at the top to the last: an edge that moves
    /// evenly is a smooth line.
    fn row_over_time(&self) -> Rgba8Image {
        let [.., width, _] = self.window;
        let (mut sheet, places) = self.sheet(ZOOM * width, ZOOM * self.count() as u32);
        let from = self.liveliest_row() * width as usize;
        for (panel, [x, y]) in self.panels.iter().zip(&places) {
            let rows: Vec<u8> =
                panel.frames.iter().flat_map(|frame| &frame[from..from + width as usize]).copied().collect();
            paint::put(&mut sheet, &gray(&rows, width, ZOOM), *x, *y);
        }
        sheet
    }

    /// The row in which the truth changes most often.
    fn liveliest_row(&self) -> usize {
        let width = self.window[2] as usize;
        let mut changes = vec![0; self.window[3] as usize];
        for pair in self.panels.first().map(|truth| truth.frames.windows(2)).into_iter().flatten() {
            let rows = pair[0].chunks_exact(width).zip(pair[1].chunks_exact(width));
            for (count, (a, b)) in changes.iter_mut().zip(rows) {
                *count += a.iter().zip(b).filter(|(a, b)| a != b).count();
            }
        }
        (0..changes.len()).max_by_key(|y| changes[*y]).unwrap_or(0)
    }

    /// An empty sheet with the names on it, and where the panels go.
    fn sheet(&self, width: u32, height: u32) -> (Rgba8Image, Vec<[u32; 2]>) {
        let count = self.panels.len() as u32;
        let columns = (1..=count).find(|n| n * n >= count).unwrap_or(1).min(5);
        let rows = count.div_ceil(columns);
        let size = [columns * (width + GAP) - GAP, rows * (NAME + height + GAP) - GAP];
        let mut sheet = paint::blank(size[0], size[1], BAR);
        let place = |i: u32| [(i % columns) * (width + GAP), (i / columns) * (NAME + height + GAP)];
        let places: Vec<[u32; 2]> = (0..count).map(place).collect();
        for (panel, [x, y]) in self.panels.iter().zip(&places) {
            name(&mut sheet, Letters::Small, &panel.name, *x, *y);
        }
        (sheet, places.into_iter().map(|[x, y]| [x, y + NAME]).collect())
    }
}

fn name(image: &mut Rgba8Image, letters: Letters, text: &str, x: u32, y: u32) {
    let height = if letters == Letters::Large { LARGE_NAME } else { NAME };
    let at = [x as i32 + 4, y as i32 + height as i32 / 2];
    paint::text(image, at, Anchor::Start, text, letters, WHITE);
}

/// Gray values `width` pixels wide as a picture, each pixel repeated `zoom` times both ways.
fn gray(values: &[u8], width: u32, zoom: u32) -> Rgba8Image {
    let zoom = zoom as usize;
    let row = |row: &[u8]| -> Vec<u8> {
        row.iter().flat_map(|v| [*v, *v, *v, 255].repeat(zoom)).collect::<Vec<u8>>().repeat(zoom)
    };
    let rgba: Vec<u8> = values.chunks_exact(width as usize).flat_map(row).collect();
    let height = (values.len() / width as usize * zoom) as u32;
    Rgba8Image { width: width * zoom as u32, height, rgba }
}

/// Whether a pixel differs from the one to its right or below it, both with a truth.
fn edges(truth: &[Option<f32>], [width, height]: [u32; 2]) -> Vec<bool> {
    let at = |x: u32, y: u32| truth[(y * width + x) as usize];
    let differ = |a: Option<f32>, b: Option<f32>| a.zip(b).is_some_and(|(a, b)| a != b);
    let edge = |x: u32, y: u32| {
        (x + 1 < width && differ(at(x, y), at(x + 1, y)))
            || (y + 1 < height && differ(at(x, y), at(x, y + 1)))
    };
    (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| edge(x, y)).collect()
}

/// Corner of the window with most marks, among every eighth pixel.
fn busiest(marks: &[bool], [width, height]: [u32; 2], window: [u32; 2]) -> [u32; 2] {
    let count = |[left, top]: [u32; 2]| {
        let rows = marks.chunks_exact(width as usize).skip(top as usize).take(window[1] as usize);
        rows.flat_map(|row| &row[left as usize..(left + window[0]) as usize]).filter(|mark| **mark).count()
    };
    let tops = (0..=height - window[1]).step_by(8);
    let corners = tops.flat_map(|top| (0..=width - window[0]).step_by(8).map(move |left| [left, top]));
    corners.max_by_key(|corner| count(*corner)).unwrap_or([0, 0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_busiest_part_is_found() {
        let truth: Vec<Option<f32>> = (0..64 * 48)
            .map(|i| Some(f32::from(u8::from(i % 64 > 40 && i / 64 > 24 && i % 2 == 0))))
            .collect();
        let [x, y] = busiest(&edges(&truth, [64, 48]), [64, 48], [16, 16]);
        assert!(x >= 40 && y >= 24, "{x} {y}");
        assert_eq!(busiest(&edges(&[None; 12], [4, 3]), [4, 3], [4, 3]), [0, 0]);
    }

    #[test]
    fn zooming_repeats_pixels() {
        let image = gray(&[1, 2, 3, 4], 2, 2);
        assert_eq!((image.width, image.height), (4, 4));
        let reds: Vec<u8> = image.rgba.iter().step_by(4).copied().collect();
        assert_eq!(reds, [1, 1, 2, 2, 1, 1, 2, 2, 3, 3, 4, 4, 3, 3, 4, 4]);
    }
}
