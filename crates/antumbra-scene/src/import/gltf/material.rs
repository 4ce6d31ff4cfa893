//! Materials and the images of their base colours.

use super::accessor::{Asset, follow};
use super::container;
use super::document::{Extensions, SpecularGlossiness, TextureTransform, TextureUse};
use super::primitive::Coordinates;
use crate::import::error::{Problem, invalid};
use crate::import::image;
use crate::{AlphaMode, Image, Material};
use glam::{Affine2, Mat2, Vec2};
use std::collections::HashMap;
use std::path::Path;

/// All materials of a document.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    pub(super) materials: Vec<Material>,
    /// Texture coordinates of each material.
    pub(super) coordinates: Vec<Coordinates>,
    pub(super) images: Vec<Image>,
    pub(super) notes: Vec<String>,
    /// Places in `images` by source image and addressing; `None` for those that failed.
    seen: HashMap<(usize, [u64; 2]), Option<usize>>,
}

const CLAMP: u64 = 33_071;
const MIRROR: u64 = 33_648;
const REPEAT: u64 = 10_497;

impl Surfaces {
    /// Reads every material; `folder` is where image files are looked for.
    pub(super) fn read(asset: &Asset, folder: Option<&Path>) -> Result<Self, Problem> {
        let mut surfaces = Self::default();
        for index in 0..asset.document.materials.len() {
            surfaces.add(asset, index, folder)?;
        }
        Ok(surfaces)
    }

    /// Index of the material for primitives that name none.
    pub(super) fn plain(&mut self) -> usize {
        let name = "glTF default";
        self.materials.iter().position(|m| m.name == name).unwrap_or_else(|| {
            let plain = Material { name: name.into(), double_sided: false, ..Material::default() };
            self.materials.push(plain);
            self.coordinates.push(Coordinates::default());
            self.materials.len() - 1
        })
    }

    fn add(&mut self, asset: &Asset, index: usize, folder: Option<&Path>) -> Result<(), Problem> {
        let element = format!("materials[{index}]");
        let source = &asset.document.materials[index];
        let name = source.name.clone().unwrap_or_else(|| element.clone());
        let pbr = &source.pbr_metallic_roughness;
        let (mut factor, mut texture) = (pbr.base_color_factor, pbr.base_color_texture.clone());
        let old = "KHR_materials_pbrSpecularGlossiness";
        if let Some(other) = container::extension::<SpecularGlossiness>(&source.extensions, old, &element)? {
            (factor, texture) = (other.diffuse_factor, other.diffuse_texture);
        }
        let alpha = match source.alpha_mode.as_deref() {
            None | Some("OPAQUE") => AlphaMode::Opaque,
            Some("MASK") => AlphaMode::Mask { cutoff: source.alpha_cutoff.unwrap_or(0.5) },
            Some("BLEND") => {
                self.notes.push(format!("material '{name}' blends; it is imported as opaque"));
                AlphaMode::Opaque
            }
            Some(other) => {
                let allowed = "allowed are OPAQUE, MASK and BLEND";
                return Err(invalid(format!("{element}.alphaMode"), format!("'{other}'"), allowed));
            }
        };
        let mut material = Material {
            base_color: factor.into(),
            metallic: pbr.metallic_factor,
            roughness: pbr.roughness_factor,
            alpha,
            double_sided: source.double_sided,
            base_color_image: None,
            name,
        };
        let mut coordinates = Coordinates::default();
        if let Some(texture) = texture {
            let element = format!("{element} base colour texture");
            (material.base_color_image, coordinates) =
                self.texture(asset, &texture, &element, folder, alpha != AlphaMode::Opaque)?;
        }
        self.materials.push(material);
        self.coordinates.push(coordinates);
        Ok(())
    }

    /// The image of a texture, decoded once for each addressing, and the coordinates it wants.
    fn texture(
        &mut self,
        asset: &Asset,
        texture: &TextureUse,
        element: &str,
        folder: Option<&Path>,
        decides_shape: bool,
    ) -> Result<(Option<usize>, Coordinates), Problem> {
        let document = &asset.document;
        let mut coordinates = coordinates(texture, &texture.extensions, element)?;
        let texture = follow(&document.textures, "textures", texture.index, element)?;
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
        let loaded = match texture.source {
            Some(source) if self.seen.contains_key(&(source, wrap)) => {
                if let Some(Some(place)) = self.seen.get(&(source, wrap)) {
                    return Ok((Some(*place), coordinates));
                }
                load(asset, source, folder, element)
            }
            Some(source) => load(asset, source, folder, element),
            None => Err(Problem::Image {
                element: element.into(),
                message: "the texture has no PNG or JPEG source".into(),
            }),
        };
        let place = match loaded {
            Ok(mut image) => {
                image.repeat = wrap.map(|w| w != CLAMP);
                (0..2).filter(|&axis| wrap[axis] == MIRROR).for_each(|axis| double(&mut image, axis));
                self.images.push(image);
                Some(self.images.len() - 1)
            }
            Err(problem @ (Problem::Image { .. } | Problem::Resource { .. })) if !decides_shape => {
                self.notes.push(format!("{problem}; the plain colour is used"));
                None
            }
            Err(problem) => return Err(problem),
        };
        if let Some(source) = texture.source {
            self.seen.insert((source, wrap), place);
        }
        Ok((place, coordinates))
    }
}

fn load(asset: &Asset, index: usize, folder: Option<&Path>, owner: &str) -> Result<Image, Problem> {
    let source = follow(&asset.document.images, "images", index, owner)?;
    let element = format!("images[{index}]");
    let decoded = match (&source.uri, source.buffer_view) {
        (Some(uri), _) => image::decode(&container::resource(uri, &element, folder)?),
        (None, Some(view)) => image::decode(asset.view(view, &format!("{element}.bufferView"))?),
        (None, None) => Err("it has neither uri nor bufferView".into()),
    };
    match decoded {
        Ok(image) => Ok(Image { name: source.name.clone().unwrap_or(element), ..image }),
        Err(message) => Err(Problem::Image { element, message }),
    }
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
