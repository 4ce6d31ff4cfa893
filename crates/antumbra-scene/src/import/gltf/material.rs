//! Materials: base colours, cut-outs, and what lets light through.

use super::accessor::Asset;
use super::container;
use super::document::{self, SpecularGlossiness, Transmission};
use super::primitive::Coordinates;
use super::texture;
use crate::import::error::{Problem, invalid};
use crate::import::notes::Notes;
use crate::import::options::Blend;
use crate::{AlphaMode, Image, Material};
use std::collections::HashMap;
use std::path::Path;

/// All materials of a document.
#[derive(Debug, Default)]
pub(super) struct Surfaces {
    pub(super) materials: Vec<Material>,
    /// Texture coordinates of each material.
    pub(super) coordinates: Vec<Coordinates>,
    /// How each material lets light through.
    pub(super) passing: Vec<Passing>,
    pub(super) images: Vec<Image>,
    /// Places in `images` by source image and addressing.
    pub(super) seen: HashMap<(usize, [u64; 2]), usize>,
}

/// How a surface lets light through.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Passing {
    /// Not at all, or where its mask cuts it out.
    #[default]
    None,
    /// It blends, and is imported as a mask.
    Blend,
    /// It is left out whole.
    All,
}

/// Where surfaces are read from, and how.
#[derive(Debug)]
pub(super) struct Source<'a> {
    pub(super) asset: &'a Asset,
    /// Where image files are looked for.
    pub(super) folder: Option<&'a Path>,
    pub(super) blend: Blend,
}

impl Surfaces {
    /// Reads every material.
    pub(super) fn read(source: &Source<'_>, notes: &mut Notes) -> Result<Self, Problem> {
        let mut surfaces = Self::default();
        for index in 0..source.asset.document.materials.len() {
            surfaces.add(source, index, notes)?;
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
            self.passing.push(Passing::None);
            self.materials.len() - 1
        })
    }

    fn add(&mut self, source: &Source<'_>, index: usize, notes: &mut Notes) -> Result<(), Problem> {
        let element = format!("materials[{index}]");
        let material = &source.asset.document.materials[index];
        let pbr = &material.pbr_metallic_roughness;
        let (mut factor, mut texture) = (pbr.base_color_factor, pbr.base_color_texture.clone());
        let old = "KHR_materials_pbrSpecularGlossiness";
        if let Some(other) = container::extension::<SpecularGlossiness>(&material.extensions, old, &element)?
        {
            (factor, texture) = (other.diffuse_factor, other.diffuse_texture);
        }
        let name = "KHR_materials_transmission";
        let transmission: Transmission =
            container::extension(&material.extensions, name, &element)?.unwrap_or_default();
        let (alpha, mut passing) = presence(material, &transmission, &element, source.blend)?;
        let mut read = Material {
            name: material.name.clone().unwrap_or_else(|| element.clone()),
            base_color: factor.into(),
            metallic: pbr.metallic_factor,
            roughness: pbr.roughness_factor,
            alpha,
            double_sided: material.double_sided,
            base_color_image: None,
        };
        let mut coordinates = Coordinates::default();
        if let Some(texture) = texture {
            let user = texture::User {
                element: format!("{element} base colour texture"),
                decides_shape: alpha != AlphaMode::Opaque,
            };
            (read.base_color_image, coordinates) = self.texture(source, &texture, &user, notes)?;
        }
        if passing == Passing::All && source.blend == Blend::Mask {
            let read = (&mut read, &mut coordinates);
            passing = self.mask_by_transmission(source, &transmission, read, notes)?;
        }
        self.materials.push(read);
        self.coordinates.push(coordinates);
        self.passing.push(passing);
        Ok(())
    }
}

/// Where a surface is there, and how it lets light through.
fn presence(
    material: &document::Material,
    transmission: &Transmission,
    element: &str,
    blend: Blend,
) -> Result<(AlphaMode, Passing), Problem> {
    // As with alpha: what lets half of the light or more through is not there.
    let clear = transmission.transmission_factor >= 0.5 && blend != Blend::Cast;
    let half = AlphaMode::Mask { cutoff: 0.5 };
    Ok(match (material.alpha_mode.as_deref(), blend) {
        (None | Some("OPAQUE"), _) if clear => (AlphaMode::Opaque, Passing::All),
        (Some("MASK" | "BLEND"), _) if clear => (half, Passing::All),
        (None | Some("OPAQUE"), _) | (Some("BLEND"), Blend::Cast) => (AlphaMode::Opaque, Passing::None),
        (Some("MASK"), _) => {
            (AlphaMode::Mask { cutoff: material.alpha_cutoff.unwrap_or(0.5) }, Passing::None)
        }
        (Some("BLEND"), Blend::Mask) => (half, Passing::Blend),
        (Some("BLEND"), Blend::Ignore) => (half, Passing::All),
        (Some(other), _) => {
            let allowed = "allowed are OPAQUE, MASK and BLEND";
            return Err(invalid(format!("{element}.alphaMode"), format!("'{other}'"), allowed));
        }
    })
}
