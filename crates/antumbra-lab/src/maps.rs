//! What a shadow map holds, as pictures: each channel of each layer, and all of them on one sheet
//! [Annen et al. 2007, figure 5].

use crate::{
    gpu::{Gpu, Wait},
    image::{GrayImage, Rgba8Image, diverging},
    paint::{self, Anchor, Colour, INK, Letters},
    session::Session,
    texels,
};
use antumbra::glam::Vec3;
use antumbra::{DEPTH_FORMAT, ShadowMap, View};
use antumbra_render::{GpuScene, ViewMatrices};
use anyhow::{Context, Result, bail};
use serde::Serialize;

/// How numbers became colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Scale {
    /// Black at the least value, white at the largest.
    Linear,
    /// The same of logarithms: for positive values that differ by factors over 1000.
    Log,
    /// White at zero, blue above, red below.
    Signed,
}

/// One channel of one layer as a picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// `basis-3-g`, or `depth`.
    pub name: String,
    /// How numbers became colours.
    pub scale: Scale,
    /// Least and largest number; those that are not finite are left out and shown magenta.
    pub range: [f32; 2],
    /// The colours.
    pub image: Rgba8Image,
}

impl Picture {
    /// A picture of `plane`. Where numbers are stored with their zero at `zero`, that is taken off
    /// and what is left of the range to 1 counts as one.
    #[must_use]
    pub fn new(name: String, plane: &GrayImage, zero: f32) -> Self {
        let numbers = || plane.values.iter().map(|v| (v - zero) / (1.0 - zero));
        let finite = || numbers().filter(|v| v.is_finite());
        let range = [finite().fold(f32::INFINITY, f32::min), finite().fold(f32::NEG_INFINITY, f32::max)];
        let range = if range[0] <= range[1] { range } else { [0.0; 2] };
        let [low, high] = range;
        let scale = match range {
            _ if zero > 0.0 || low < 0.0 => Scale::Signed,
            // The quotient may overflow.
            _ if low > 0.0 && high.ln() - low.ln() > 1000_f32.ln() => Scale::Log,
            _ => Scale::Linear,
        };
        let largest = low.abs().max(high.abs()).max(f32::MIN_POSITIVE);
        let extent = if zero > 0.0 { 1.0 } else { largest };
        // Also right where high − low overflows.
        let share = |v: f32| match scale {
            Scale::Log => (v.ln() - low.ln()) / (high.ln() - low.ln()),
            _ if high > low => (v / extent - low / extent) / (high / extent - low / extent),
            _ => 0.0,
        };
        let colour = |v: f32| match scale {
            _ if !v.is_finite() => [255, 0, 255],
            Scale::Signed => diverging(-v / extent),
            Scale::Linear | Scale::Log => [(255.0 * share(v)).round() as u8; 3],
        };
        let rgba = numbers().flat_map(|v| {
            let [r, g, b] = colour(v);
            [r, g, b, 255]
        });
        let image = Rgba8Image { width: plane.width, height: plane.height, rgba: rgba.collect() };
        Self { name, scale, range, image }
    }
}

/// Hands pictures of a session's first technique to `take`, one after the other (large maps would not fit
/// into memory all at once): linear depth of the casters in each view, then every channel of every layer of
/// every map at mip level `level`.
///
/// # Errors
/// No technique, a level that a map lacks, a lost device, what `take` returns.
pub fn pictures(
    gpu: &Gpu,
    session: &Session<'_>,
    level: u32,
    take: &mut dyn FnMut(Picture) -> Result<()>,
) -> Result<()> {
    let first = session.prepared().first().context("no technique was named")?;
    session.draw_and_ask(first)?;
    let (views, size) = (session.views(), session.shot().map_size);
    for (number, view) in views.iter().enumerate() {
        let name = cascade_prefix(views, number) + "depth";
        take(depth(gpu, session.scene(), view, [size; 2], name)?)?;
    }
    channels(gpu, &first.shadows, level, take)
}

/// Linear depth of the casters as a view sees them, whatever the technique keeps, as a picture called `name`.
fn depth(
    gpu: &Gpu,
    scene: &GpuScene,
    view: &View,
    [width, height]: [u32; 2],
    name: String,
) -> Result<Picture> {
    let matrices = ViewMatrices::new(gpu, scene, &[*view]);
    let target = gpu.target("casters' depth", [width, height], DEPTH_FORMAT);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    {
        let attachment = target.create_view(&Default::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("casters' depth"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &attachment,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(1.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        scene.draw_depth(&matrices, 0, &mut pass);
    }
    gpu.finish(encoder)?;
    let mut planes = texels::planes(DEPTH_FORMAT, [width, height], &gpu.read(&target)?)?;
    for plane in &mut planes {
        for (i, z) in (0..).zip(&mut plane.values) {
            let [x, y] = [i % width, i / width].map(|texel| texel as f32 + 0.5);
            *z =
                view.linear_depth(Vec3::new(2.0 * x / width as f32 - 1.0, 1.0 - 2.0 * y / height as f32, *z));
        }
    }
    match planes.first() {
        Some(plane) => Ok(Picture::new(name, plane, 0.0)),
        None => bail!("depth has no channel"),
    }
}

/// What names of pictures of one view begin with, where there are several.
fn cascade_prefix(views: &[View], number: usize) -> String {
    if views.len() > 1 { format!("cascade-{number}-") } else { String::new() }
}

/// Hands every channel of every layer of every map to `take`, at mip level `level`.
fn channels(
    gpu: &Gpu,
    shadows: &ShadowMap,
    level: u32,
    take: &mut dyn FnMut(Picture) -> Result<()>,
) -> Result<()> {
    let described = shadows.description();
    for (index, map) in described.maps.iter().enumerate() {
        let Some(texture) = shadows.map_texture(index) else { continue };
        let levels = texture.mip_level_count();
        if level >= levels {
            bail!("--level {level}: {} of {} has levels 0 to {}", map.name, described.about.name, levels - 1);
        }
        let size = [texture.width(), texture.height()].map(|n| (n >> level).max(1));
        // Views begin at multiples of the map's layers; those that the light does not have were never filled.
        for layer in 0..map.layers * shadows.views().len() as u32 {
            let bytes = gpu.read_layer(texture, layer, level)?;
            let planes = texels::planes(texture.format(), size, &bytes)?;
            for (plane, channel) in planes.iter().zip(["r", "g", "b", "a"]) {
                let (view, layer) = (layer / map.layers, layer % map.layers);
                let cascade = cascade_prefix(shadows.views(), view as usize);
                let name = format!("{cascade}{}-{layer}-{channel}", map.name.replace(' ', "-"));
                take(Picture::new(name, plane, map.zero_level))?;
            }
        }
    }
    Ok(())
}

/// Small copies of many pictures with their names and ranges.
#[derive(Debug, Default)]
pub struct Sheet {
    cells: Vec<(Rgba8Image, [String; 2])>,
}

/// Pixels along the longer side of a small copy.
const THUMB: u32 = 256;
/// Pixels between small copies, and height of their names.
const GAP: u32 = 12;
const WORDS: u32 = 28;
/// Neither black nor white, which the pictures may be at their borders.
const PAPER: Colour = [214, 217, 213];

impl Sheet {
    /// Adds a picture.
    pub fn add(&mut self, picture: &Picture) {
        let longest = picture.image.width.max(picture.image.height);
        let small = shrink(&picture.image, longest.div_ceil(THUMB).max(1));
        let [low, high] = picture.range;
        let scale = match picture.scale {
            Scale::Linear => "linear",
            Scale::Log => "log",
            Scale::Signed => "signed",
        };
        let words = format!("{scale} {} to {}", short(low), short(high));
        self.cells.push((small, [picture.name.clone(), words]));
    }

    /// All of them in rows of four or eight; the first has a row of its own unless all fit into one,
    /// so that layers begin a row.
    #[must_use]
    pub fn image(&self) -> Rgba8Image {
        let count = self.cells.len() as u32;
        let columns = if count > 13 { 8 } else { 4.min(count.max(1)) };
        let empty = if count > columns { columns - 1 } else { 0 };
        let rows = (count + empty).div_ceil(columns);
        let place = |i: u32| if i == 0 { 0 } else { i + empty };
        let letter = Letters::Small.advance();
        let names = self.cells.iter().flat_map(|(_, words)| words).map(|w| w.len() as u32 * letter);
        let across = self.cells.iter().map(|(image, _)| image.width).chain(names).max().unwrap_or(1) + GAP;
        let down = self.cells.iter().map(|(image, _)| image.height).max().unwrap_or(1) + WORDS + GAP;
        let mut sheet = paint::blank(columns * across + GAP, rows * down + GAP, PAPER);
        for (i, (image, words)) in self.cells.iter().enumerate() {
            let place = place(i as u32);
            let (x, y) = (GAP + place % columns * across, GAP + place / columns * down);
            paint::put(&mut sheet, image, x, y);
            for (line, text) in words.iter().enumerate() {
                let at = [x as i32, (y + image.height) as i32 + 9 + 12 * line as i32];
                paint::text(&mut sheet, at, Anchor::Start, text, Letters::Small, INK);
            }
        }
        sheet
    }
}

/// Three or four digits.
fn short(value: f32) -> String {
    let size = value.abs();
    if size == 0.0 || (0.001..1e5).contains(&size) {
        let text = format!("{value:.4}");
        text.trim_end_matches('0').trim_end_matches('.').to_string()
    } else {
        format!("{value:.2e}")
    }
}

/// Means of squares of `factor` pixels; what is left over at the right and below is averaged too.
fn shrink(image: &Rgba8Image, factor: u32) -> Rgba8Image {
    let (width, height) = (image.width.div_ceil(factor), image.height.div_ceil(factor));
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let (right, below) = (image.width.min((x + 1) * factor), image.height.min((y + 1) * factor));
        let (mut sums, mut count) = ([0_u32; 4], 0);
        for row in y * factor..below {
            let from = 4 * (row as usize * image.width as usize);
            let line = &image.rgba[from + 4 * (x * factor) as usize..from + 4 * right as usize];
            for pixel in line.chunks_exact(4) {
                sums.iter_mut().zip(pixel).for_each(|(sum, v)| *sum += u32::from(*v));
                count += 1;
            }
        }
        rgba.extend(sums.map(|sum| ((sum + count / 2) / count.max(1)) as u8));
    }
    Rgba8Image { width, height, rgba }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(values: [f32; 4], zero: f32) -> Picture {
        Picture::new("x".into(), &GrayImage::new(4, 1, values.to_vec()).unwrap(), zero)
    }

    fn pixel(picture: &Picture, i: usize) -> [u8; 3] {
        std::array::from_fn(|c| picture.image.rgba[4 * i + c])
    }

    #[test]
    fn the_scale_follows_the_numbers() {
        let linear = picture([0.0, 0.25, 0.5, 1.0], 0.0);
        assert_eq!((linear.scale, pixel(&linear, 1)), (Scale::Linear, [64; 3]));
        let log = picture([1e-30, 1.0, 1e30, 1e30], 0.0);
        assert_eq!((log.scale, pixel(&log, 1)), (Scale::Log, [128; 3]));
        let same = picture([3.0; 4], 0.0);
        assert_eq!((same.scale, same.range, pixel(&same, 0)), (Scale::Linear, [3.0; 2], [0; 3]));
    }

    #[test]
    fn signed_numbers_are_blue_above_and_red_below() {
        for signed in [picture([0.0, 0.5, 1.0, 0.5], 0.5), picture([-2.0, 0.0, 2.0, f32::NAN], 0.0)] {
            assert_eq!((signed.scale, pixel(&signed, 1)), (Scale::Signed, [255; 3]));
            let [below, above] = [pixel(&signed, 0), pixel(&signed, 2)];
            assert!(below[0] > below[2] && above[2] > above[0], "{below:?} {above:?}");
        }
        assert_eq!(picture([0.0, 0.5, 1.0, 0.5], 0.5).range, [-1.0, 1.0]);
        assert_eq!(pixel(&picture([0.0, 1.0, f32::INFINITY, 0.5], 0.0), 2), [255, 0, 255]);
    }

    #[test]
    fn a_sheet_has_room_for_all_and_small_copies_keep_the_mean() {
        let mut image = paint::blank(5, 3, [10; 3]);
        image.rgba[0] = 50;
        let small = shrink(&image, 2);
        assert_eq!((small.width, small.height, small.rgba[0], small.rgba[4]), (3, 2, 20, 10));
        let mut sheet = Sheet::default();
        (0..13).for_each(|_| sheet.add(&picture([0.0, 1.0, 2.0, 3.0], 0.0)));
        let image = sheet.image();
        assert!(image.width >= 8 * (4 + GAP) && image.height >= 2 * (1 + WORDS));
        assert_eq!(image.rgba.len() as u32, 4 * image.width * image.height);
    }
}
