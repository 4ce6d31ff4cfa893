//! Surfaces that transmit light in some places only, such as a bottle with a label: what is stopped
//! becomes the alpha of a mask.

use super::document::Transmission;
use super::material::{Passing, Source, Surfaces};
use super::primitive::Coordinates;
use super::texture::User;
use crate::import::error::Problem;
use crate::import::notes::Notes;
use crate::{AlphaMode, Image, Material};

impl Surfaces {
    /// Turns a material whose transmission has a texture into a mask; says how it lets light through.
    pub(super) fn mask_by_transmission(
        &mut self,
        source: &Source<'_>,
        transmission: &Transmission,
        (material, coordinates): (&mut Material, &mut Coordinates),
        notes: &mut Notes,
    ) -> Result<Passing, Problem> {
        let Some(used) = &transmission.transmission_texture else { return Ok(Passing::All) };
        let shown = format!("material '{}'", material.name);
        let user = User { element: format!("{shown} transmission texture"), decides_shape: true };
        let (Some(place), own) = self.texture(source, used, &user, notes)? else {
            return Ok(Passing::None);
        };
        let clear = &self.images[place];
        let color = material.base_color_image.and_then(|i| self.images.get(i));
        if color.is_some_and(|color| color.repeat != clear.repeat || *coordinates != own) {
            notes.add(
                shown,
                "its transmission texture lies otherwise than its colour and is not read; all of it is taken to let \
                 light through",
            );
            return Ok(Passing::All);
        }
        // Without MASK or BLEND alpha means nothing.
        let opaque = material.alpha == AlphaMode::Opaque;
        let mask = stopped(clear, color, opaque, transmission.transmission_factor);
        if opaque {
            material.base_color.w = 1.0;
        }
        material.alpha = AlphaMode::Mask { cutoff: 0.5 };
        material.base_color_image = Some(self.images.len());
        *coordinates = own;
        self.images.push(mask);
        Ok(Passing::Blend)
    }
}

/// The colour (white if there is none) with the share of light that is stopped as its alpha.
fn stopped(clear: &Image, color: Option<&Image>, opaque: bool, factor: f32) -> Image {
    let (width, height) = color.map_or((clear.width, clear.height), |color| (color.width, color.height));
    let texel = |image: &Image, x: u32, y: u32| {
        // Images of other sizes are asked at the same place.
        let scaled = |at: u32, from: u32, to: u32| (u64::from(at) * u64::from(to) / u64::from(from)) as usize;
        let place = scaled(y, height, image.height) * image.width as usize + scaled(x, width, image.width);
        <[u8; 4]>::try_from(&image.rgba[4 * place..4 * place + 4]).unwrap_or([u8::MAX; 4])
    };
    let mut rgba = Vec::with_capacity(4 * width as usize * height as usize);
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let [red, green, blue, alpha] = color.map_or([u8::MAX; 4], |color| texel(color, x, y));
        let alpha = if opaque { u8::MAX } else { alpha };
        let passed = factor * f32::from(texel(clear, x, y)[0]) / 255.0;
        rgba.extend([red, green, blue, (f32::from(alpha) * (1.0 - passed)) as u8]);
    }
    Image { name: format!("{} as a mask", clear.name), width, height, rgba, repeat: clear.repeat }
}
