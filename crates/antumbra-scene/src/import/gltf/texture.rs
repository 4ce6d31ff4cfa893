//! Textures: which of their images is read, how it is addressed, and where.

use super::accessor::{Asset, follow};
use super::container;
use super::document::{Extensions, OtherSource, Texture, TextureTransform, TextureUse};
use super::material::{Source, Surfaces};
use super::primitive::Coordinates;
use crate::Image;
use crate::import::error::{Problem, invalid};
use crate::import::image;
use crate::import::notes::Notes;
use glam::{Affine2, Mat2, Vec2};
use std::path::Path;

const CLAMP: u64 = 33_071;
const MIRROR: u64 = 33_648;
const REPEAT: u64 = 10_497;

/// Extensions that offer an image of another format beside or instead of PNG or JPEG.
const OTHERS: [&str; 4] = ["EXT_texture_webp", "KHR_texture_basisu", "EXT_texture_avif", "MSFT_texture_dds"];

/// Who uses a texture.
#[derive(Debug)]
pub(super) struct User {
    pub(super) element: String,
    /// Whether its alpha decides about shape.
    pub(super) decides_shape: bool,
}

impl Surfaces {
    /// The image of a texture, decoded once for each addressing, and the coordinates it wants.
    pub(super) fn texture(
        &mut self,
        source: &Source<'_>,
        used: &TextureUse,
        user: &User,
        notes: &mut Notes,
    ) -> Result<(Option<usize>, Coordinates), Problem> {
        let document = &source.asset.document;
        let element = &user.element;
        let mut coordinates = coordinates(used, &used.extensions, element)?;
        let texture = follow(&document.textures, "textures", used.index, element)?;
        let wrap = match texture.sampler {
            Some(i) => {
                let sampler = follow(&document.samplers, "samplers", i, element)?;
                [sampler.wrap_s, sampler.wrap_t].map(|w| w.unwrap_or(REPEAT))
            }
            None => [REPEAT; 2],
        };
        if let Some(other) = wrap.iter().find(|w| ![CLAMP, MIRROR, REPEAT].contains(w)) {
            let allowed = format!("allowed are {CLAMP}, {MIRROR} and {REPEAT}");
            return Err(invalid(format!("{element}: wrap mode"), other, allowed));
        }
        // A mirrored image is stored with its mirror image beside it and then repeats.
        let shrink = Vec2::from(wrap.map(|w| if w == MIRROR { 0.5 } else { 1.0 }));
        coordinates.transform = Affine2::from_scale(shrink) * coordinates.transform;
        let candidates = candidates(texture, element)?;
        let mut failure = None;
        for candidate in candidates {
            match self.image(source, candidate, wrap, element) {
                Ok(place) => return Ok((Some(place), coordinates)),
                Err(problem) => failure = failure.or(Some(problem)),
            }
        }
        let problem = failure.unwrap_or_else(|| Problem::ImageFormat {
            element: element.clone(),
            format: "a texture without a source that is known".into(),
        });
        lose(problem, user, notes)?;
        Ok((None, coordinates))
    }

    /// The place of a decoded image.
    fn image(
        &mut self,
        source: &Source<'_>,
        index: usize,
        wrap: [u64; 2],
        element: &str,
    ) -> Result<usize, Problem> {
        if let Some(&place) = self.seen.get(&(index, wrap)) {
            return Ok(place);
        }
        let mut image = load(source.asset, index, source.folder, element)?;
        image.repeat = wrap.map(|w| w != CLAMP);
        (0..2).filter(|&axis| wrap[axis] == MIRROR).for_each(|axis| double(&mut image, axis));
        self.images.push(image);
        self.seen.insert((index, wrap), self.images.len() - 1);
        Ok(self.images.len() - 1)
    }
}

/// The images that a texture offers, the usual one first.
fn candidates(texture: &Texture, element: &str) -> Result<Vec<usize>, Problem> {
    let mut all: Vec<usize> = texture.source.into_iter().collect();
    for name in OTHERS {
        let other: Option<OtherSource> = container::extension(&texture.extensions, name, element)?;
        all.extend(other.and_then(|other| other.source));
    }
    Ok(all)
}

/// Goes on without an image where that is sensible: on surfaces whose shape does not depend on it,
/// and where the image is sound but is not here, or in a format that is not decoded.
fn lose(problem: Problem, user: &User, notes: &mut Notes) -> Result<(), Problem> {
    let (image, why, absent) = match &problem {
        Problem::Resource { element, uri, source } => {
            (format!("{element} '{uri}'"), format!("the file cannot be read: {source}"), true)
        }
        Problem::ImageFormat { element, format } => (
            element.clone(),
            format!("{format} is not decoded; convert it to PNG, JPEG or WebP{}", image::converter(format)),
            true,
        ),
        Problem::Image { element, message } => {
            (element.clone(), format!("the image cannot be decoded: {message}"), false)
        }
        _ => return Err(problem),
    };
    match (user.decides_shape, absent) {
        (false, _) => notes.add(image, format!("{why}; the plain colour is used")),
        (true, true) => notes.add(
            format!("{} ({image})", user.element),
            format!("the mask is lost, so the whole surface is there and casts: {why}"),
        ),
        (true, false) => return Err(problem),
    }
    Ok(())
}

fn load(asset: &Asset, index: usize, folder: Option<&Path>, owner: &str) -> Result<Image, Problem> {
    let source = follow(&asset.document.images, "images", index, owner)?;
    let element = format!("images[{index}]");
    let decode = |bytes: &[u8]| {
        image::decode(bytes).map_err(|message| match image::other_format(bytes) {
            Some(format) => Problem::ImageFormat { element: element.clone(), format: format.into() },
            None => Problem::Image { element: element.clone(), message },
        })
    };
    let decoded = match (&source.uri, source.buffer_view) {
        (Some(uri), _) => decode(&container::resource(uri, &element, folder)?)?,
        (None, Some(view)) => decode(asset.view(view, &format!("{element}.bufferView"))?)?,
        (None, None) => {
            return Err(Problem::Image { element, message: "it has neither uri nor bufferView".into() });
        }
    };
    Ok(Image { name: source.name.clone().unwrap_or(element), ..decoded })
}

/// Texture coordinates with `KHR_texture_transform`: scale, then rotate, then move.
fn coordinates(texture: &TextureUse, extensions: &Extensions, element: &str) -> Result<Coordinates, Problem> {
    let name = "KHR_texture_transform";
    let Some(t) = container::extension::<TextureTransform>(extensions, name, element)? else {
        return Ok(Coordinates { set: texture.tex_coord, transform: Affine2::IDENTITY });
    };
    // Counter-clockwise as one looks at the image, whose v axis points down.
    let matrix = Mat2::from_angle(-t.rotation) * Mat2::from_diagonal(t.scale.into());
    Ok(Coordinates {
        set: t.tex_coord.unwrap_or(texture.tex_coord),
        transform: Affine2::from_mat2_translation(matrix, t.offset.into()),
    })
}

/// Puts the mirror image beside (axis 0) or below (axis 1) an image.
fn double(image: &mut Image, axis: usize) {
    let row = 4 * image.width as usize;
    if axis == 0 {
        let mirrored = |row: &[u8]| row.rchunks_exact(4).flatten().copied().collect::<Vec<u8>>();
        image.rgba = image.rgba.chunks_exact(row).flat_map(|r| [r.to_vec(), mirrored(r)].concat()).collect();
        image.width *= 2;
    } else {
        let below: Vec<u8> = image.rgba.rchunks_exact(row).flatten().copied().collect();
        image.rgba.extend(below);
        image.height *= 2;
    }
}
