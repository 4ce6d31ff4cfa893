//! Materials and images of OBJ files.

use super::files::Files;
use super::library::{self, Entry};
use super::map::Map;
use crate::import::image;
use crate::import::notes::Notes;
use crate::import::options::Blend;
use crate::{AlphaMode, Image, Material};
use glam::{Vec2, Vec3};
use std::collections::HashMap;

/// Alpha from which a point is there.
const HALF: f32 = 0.5;
/// Most pixels of a colour and a mask together; see [`image`].
const MAX_PIXELS: u64 = 1 << 26;

/// The scene's materials while its meshes are made.
#[derive(Debug, Default)]
pub(super) struct Materials {
    list: Vec<Surface>,
    images: Vec<Image>,
    /// Materials by their names, and by their names in small letters.
    names: HashMap<String, usize>,
    lower: HashMap<String, usize>,
    plain: Option<usize>,
}

#[derive(Debug)]
struct Surface {
    material: Material,
    /// How its image lies on it.
    map: Option<Map>,
    left_out: bool,
}

impl Materials {
    /// Reads libraries and images; what cannot be read is noted.
    pub(super) fn read(libraries: &[String], files: &Files, blend: Blend, notes: &mut Notes) -> Self {
        let mut materials = Self::default();
        let mut known = HashMap::new();
        for (home, entry) in library::read(libraries, files, notes) {
            let number = materials.list.len();
            materials.names.insert(entry.name.clone(), number);
            materials.lower.entry(entry.name.to_lowercase()).or_insert(number);
            let surface = materials.surface(entry, &home, blend, &mut known, notes);
            materials.list.push(surface);
        }
        materials
    }

    /// The number of a material by its name, as it is written or in other letters; a plain one if there is
    /// none.
    pub(super) fn number(&mut self, name: &str, notes: &mut Notes) -> usize {
        let known = self.names.get(name).or_else(|| self.lower.get(&name.to_lowercase()));
        if let Some(&number) = known {
            return number;
        }
        if !name.is_empty() {
            notes.add(format!("material '{name}'"), "is in no library that could be read; it is plain");
            // Once is enough.
            let plain = self.plain();
            self.names.insert(name.into(), plain);
        }
        self.plain()
    }

    fn plain(&mut self) -> usize {
        let next = self.list.len();
        *self.plain.get_or_insert_with(|| {
            self.list.push(Surface { material: Material::default(), map: None, left_out: false });
            next
        })
    }

    /// Whether nothing of the material is there.
    pub(super) fn is_left_out(&self, number: usize) -> bool {
        self.list[number].left_out
    }

    /// Moves texture coordinates to where the material's image is.
    pub(super) fn place(&self, uvs: &mut [Vec2], number: usize) {
        if let Some(map) = &self.list[number].map {
            uvs.iter_mut().for_each(|uv| *uv = map.place(*uv));
        }
    }

    pub(super) fn finish(self) -> (Vec<Material>, Vec<Image>) {
        (self.list.into_iter().map(|surface| surface.material).collect(), self.images)
    }

    fn surface(
        &mut self,
        entry: Entry,
        files: &Files,
        blend: Blend,
        known: &mut HashMap<String, usize>,
        notes: &mut Notes,
    ) -> Surface {
        let element = format!("material '{}'", entry.name);
        if entry.moves {
            notes.add(element.clone(), "has a displacement map, which is left out");
        }
        let load = |map: &Option<Map>, otherwise: &str, notes: &mut Notes| -> Option<Image> {
            let map = map.as_ref().filter(|map| !map.file.is_empty())?;
            let path = files.find(&map.file).unwrap_or_else(|| files.missing(&map.file));
            let bytes = files.read(&path).map_err(|error| error.to_string());
            let image = bytes.and_then(|bytes| image::decode(&bytes));
            let unreadable = |error: &String| {
                let said = format!("an image that cannot be read ({error}); {otherwise}");
                notes.add(format!("{element} names '{}'", map.file), said);
            };
            let image = image.inspect_err(unreadable).ok()?;
            Some(Image { repeat: [map.repeats; 2], ..image })
        };
        let color = load(&entry.color_map, "the plain colour is used", notes);
        let mask = load(&entry.mask_map, "the surface is taken as solid", notes);
        let (map, cut) = match (&entry.color_map, &entry.mask_map, mask.is_some()) {
            (_, Some(map), true) => (Some(map), true),
            (map, ..) => (map.as_ref().filter(|_| color.is_some()), color.as_ref().is_some_and(is_cut)),
        };
        if let (Some(of_color), Some(of_mask), true) = (&entry.color_map, map, color.is_some())
            && !of_color.lies_as(of_mask)
        {
            notes.add(
                element.clone(),
                "lays its colours and its mask out differently; both lie as the mask does",
            );
        }
        let base = if color.is_some() { Vec3::ONE } else { entry.color.unwrap_or(Vec3::ONE) };
        let channel = entry.mask_map.as_ref().and_then(|map| map.channel);
        let image = combined(color, mask.map(|mask| alphas(mask, channel)));
        // A mask says all there is to say of the surface's holes.
        let opacity = if cut { 1.0 } else { entry.opacity.unwrap_or(1.0) };
        let left_out = is_left_out(opacity, blend);
        if left_out {
            notes.add(element, lets_light_through(blend));
        }
        let map = map.cloned();
        let image = image.map(|image| self.image(image, &entry, known));
        let alpha = if cut { AlphaMode::Mask { cutoff: HALF } } else { AlphaMode::Opaque };
        let material = Material {
            name: entry.name,
            base_color: base.extend(1.0),
            base_color_image: image,
            alpha,
            ..Material::default()
        };
        Surface { material, map, left_out }
    }

    /// The number of an image: the same for the same files in the same use.
    fn image(&mut self, image: Image, entry: &Entry, known: &mut HashMap<String, usize>) -> usize {
        let maps = [&entry.color_map, &entry.mask_map];
        let names = maps.map(|map| map.as_ref().map_or(String::new(), |map| map.file.replace('\\', "/")));
        let name = names.into_iter().filter(|name| !name.is_empty()).collect::<Vec<_>>().join("+");
        let channel = entry.mask_map.as_ref().and_then(|map| map.channel);
        let next = self.images.len();
        let number = *known.entry(format!("{name} {:?} {channel:?}", image.repeat)).or_insert(next);
        if number == next {
            self.images.push(Image { name, ..image });
        }
        number
    }
}

fn is_left_out(opacity: f32, blend: Blend) -> bool {
    match blend {
        Blend::Mask => opacity < HALF,
        Blend::Cast => false,
        Blend::Ignore => opacity < 1.0,
    }
}

fn lets_light_through(blend: Blend) -> &'static str {
    match blend {
        Blend::Ignore => "lets light through and is left out, as asked for",
        _ => {
            "lets half of the light or more through, so it is left out and casts no shadow (--blend cast keeps it)"
        }
    }
}

/// Whether an image has holes. One that is nothing but holes has an alpha channel that means something else.
fn is_cut(image: &Image) -> bool {
    let there = image.rgba.chunks_exact(4).filter(|pixel| pixel[3] >= 128).count();
    there > 0 && 4 * there < image.rgba.len()
}

/// A mask with its values in the alpha channel: that channel if it says anything, else grey.
fn alphas(mut mask: Image, channel: Option<char>) -> Image {
    let has_alpha = mask.rgba.chunks_exact(4).any(|pixel| pixel[3] < 255);
    let channel = channel.unwrap_or(if has_alpha { 'm' } else { 'l' });
    for pixel in mask.rgba.chunks_exact_mut(4) {
        let [r, g, b, a] = [0, 1, 2, 3].map(|k| u16::from(pixel[k]));
        pixel[3] = match channel {
            'r' => r as u8,
            'g' => g as u8,
            'b' => b as u8,
            'm' => a as u8,
            // Rec. 709, in parts of 256; exact for grey.
            _ => ((54 * r + 183 * g + 19 * b) / 256) as u8,
        };
    }
    mask
}

/// One image with the colours of one and the alpha of the other, in the larger size; white without colours.
fn combined(color: Option<Image>, mask: Option<Image>) -> Option<Image> {
    let Some(mask) = mask else { return color };
    let holes = color.as_ref().is_some_and(is_cut);
    let mut size = [mask.width, mask.height];
    if let Some(color) = &color {
        let larger = [size[0].max(color.width), size[1].max(color.height)];
        if u64::from(larger[0]) * u64::from(larger[1]) <= MAX_PIXELS {
            size = larger;
        }
    }
    let mask = resized(mask, size);
    let mut image = match color {
        Some(color) => Image { repeat: mask.repeat, ..resized(color, size) },
        None => Image { rgba: vec![255; mask.rgba.len()], ..mask.clone() },
    };
    for (pixel, mask) in image.rgba.chunks_exact_mut(4).zip(mask.rgba.chunks_exact(4)) {
        pixel[3] = if holes { mask[3].min(pixel[3]) } else { mask[3] };
    }
    Some(image)
}

/// An image in another size, interpolated between pixels; repeats or not as the image does.
fn resized(image: Image, [width, height]: [u32; 2]) -> Image {
    if [image.width, image.height] == [width, height] {
        return image;
    }
    let taps = |to: u32, from: u32, repeats: bool| -> Vec<[(usize, f32); 2]> {
        let at = |i: u32| (i as f32 + 0.5) * from as f32 / to as f32 - 0.5;
        let wrap = |i: i64| {
            let count = i64::from(from);
            (if repeats { i.rem_euclid(count) } else { i.clamp(0, count - 1) }) as usize
        };
        (0..to)
            .map(at)
            .map(|x| {
                let low = x.floor();
                [(wrap(low as i64), 1.0 - (x - low)), (wrap(low as i64 + 1), x - low)]
            })
            .collect()
    };
    let columns = taps(width, image.width, image.repeat[0]);
    let rows = taps(height, image.height, image.repeat[1]);
    let mut rgba = Vec::with_capacity(4 * columns.len() * rows.len());
    for row in &rows {
        for column in &columns {
            rgba.extend([0, 1, 2, 3].map(|k| {
                let of = |(y, down): (usize, f32), (x, across): (usize, f32)| {
                    down * across * f32::from(image.rgba[4 * (y * image.width as usize + x) + k])
                };
                let sum: f32 = row.iter().flat_map(|y| column.map(|x| of(*y, x))).sum();
                (sum + 0.5) as u8
            }));
        }
    }
    Image { width, height, rgba, ..image }
}
