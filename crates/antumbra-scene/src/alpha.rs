//! Cut-out surfaces: the one alpha lookup that rays and raster agree on.
//!
//! The point `a + u·(b − a) + v·(c − a)` of a triangle of a material with a mask is cut out where
//!
//! base colour alpha · vertex alpha · image alpha < cutoff.
//!
//! Vertex alpha and texture coordinates are interpolated as that formula says, and so are the four texels
//! around the place `coordinate · size − ½` of the image's base level: `x + fraction · (y − x)` across, then
//! down. Texels are the `f32` nearest to byte/255, as graphics cards read them, so that a surface whose alpha
//! is its cutoff throughout stays whole; all else is computed in f64 here. Graphics cards do the same in f32
//! with fractions of some 8 bits, so only at the very border do they differ.

use crate::{AlphaMode, Geometry, Image};
use glam::DVec2;

impl Image {
    /// Alpha from 0 to 1 at texture coordinates `uv` on the base level (mip 0): the four nearest texels,
    /// weighted bilinearly, as a GPU's linear sampler reads them with this image's addressing.
    ///
    /// An image whose `rgba` is shorter than its size says reads as opaque there.
    #[must_use]
    pub fn alpha_linear(&self, uv: DVec2) -> f64 {
        let (x0, x1, fx) = taps(uv.x, self.width, self.repeat[0]);
        let (y0, y1, fy) = taps(uv.y, self.height, self.repeat[1]);
        let texel = |x: u32, y: u32| {
            let place = 4 * (y as usize * self.width as usize + x as usize) + 3;
            f64::from(f32::from(self.rgba.get(place).copied().unwrap_or(u8::MAX)) / 255.0)
        };
        let top = texel(x0, y0) + fx * (texel(x1, y0) - texel(x0, y0));
        let bottom = texel(x0, y1) + fx * (texel(x1, y1) - texel(x0, y1));
        top + fy * (bottom - top)
    }
}

/// The two texel numbers that a linear sampler reads along one axis, and the weight of the second.
fn taps(coordinate: f64, size: u32, repeat: bool) -> (u32, u32, f64) {
    let texels = f64::from(size);
    // Texel i is centred on (i + ½)/size.
    let place = coordinate * texels - 0.5;
    let floor = place.floor();
    let address = |i: f64| -> u32 {
        let wrapped = if repeat { i.rem_euclid(texels) } else { i };
        // The cast saturates and turns NaN into 0, so any coordinate is a legal one.
        (wrapped.max(0.0) as u32).min(size.saturating_sub(1))
    };
    let fraction = place - floor;
    (address(floor), address(floor + 1.0), if fraction.is_finite() { fraction } else { 0.0 })
}

impl Geometry {
    /// Index of the material of triangle `t`; `None` if there is no such triangle.
    ///
    /// Cost: a binary search in the groups.
    #[must_use]
    pub fn material_of(&self, t: usize) -> Option<usize> {
        let group = self.groups.partition_point(|(_, range)| (range.end as usize) <= t);
        self.groups.get(group).map(|(material, _)| *material)
    }

    /// Alpha in the point `a + u·(b − a) + v·(c − a)` of triangle `t` with corners a, b, c: base colour
    /// alpha × vertex alpha × image alpha, the image sampled by [`Image::alpha_linear`]. It is what
    /// the file says, whatever the material's [`AlphaMode`]; usually from 0 to 1.
    ///
    /// `t` must be below [`Geometry::triangle_count`].
    #[must_use]
    pub fn alpha_at(&self, t: usize, u: f64, v: f64) -> f64 {
        let Some(material) = self.material_of(t).and_then(|m| self.materials.get(m)) else { return 1.0 };
        let corners = self.corners(t);
        let [a, b, c] = corners.map(|i| f64::from(self.colors[i].w));
        let vertex = a + u * (b - a) + v * (c - a);
        let image = material.base_color_image.and_then(|i| self.images.get(i)).map_or(1.0, |image| {
            let [a, b, c] = corners.map(|i| self.uvs[i].as_dvec2());
            image.alpha_linear(a + u * (b - a) + v * (c - a))
        });
        f64::from(material.base_color.w) * vertex * image
    }

    /// Whether the point `a + u·(b − a) + v·(c − a)` of triangle `t` is cut out,
    /// for cameras and for shadows alike: always false for opaque materials, else alpha < cutoff.
    ///
    /// `t` must be below [`Geometry::triangle_count`].
    #[must_use]
    pub fn is_cut(&self, t: usize, u: f64, v: f64) -> bool {
        match self.material_of(t).and_then(|m| self.materials.get(m)).map(|m| m.alpha) {
            Some(AlphaMode::Mask { cutoff }) => self.alpha_at(t, u, v) < f64::from(cutoff),
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Instance, Material, Mesh, Scene};
    use glam::{DMat4, Vec2, Vec3, Vec4};

    fn image(repeat: bool) -> Image {
        let rgba = [0, 255, 102, 51].iter().flat_map(|&a| [9, 9, 9, a]).collect();
        Image { name: "four".into(), width: 2, height: 2, rgba, repeat: [repeat; 2] }
    }

    #[test]
    fn texel_centres_read_their_texel() {
        for repeat in [false, true] {
            let image = image(repeat);
            for (uv, want) in
                [([0.25, 0.25], 0.0), ([0.75, 0.25], 1.0), ([0.25, 0.75], 0.4), ([0.75, 0.75], 0.2)]
            {
                assert!((image.alpha_linear(uv.into()) - want).abs() < 1e-6);
            }
            assert!((image.alpha_linear(DVec2::splat(0.5)) - 0.4).abs() < 1e-6, "mean of the four");
        }
    }

    #[test]
    fn addressing_differs_outside() {
        let at = |repeat, x| image(repeat).alpha_linear(DVec2::new(x, 0.25));
        assert_eq!(at(false, 0.0), 0.0);
        assert_eq!(at(true, 0.0), 0.5, "half way between the last and the first texel");
        assert_eq!(at(false, 7.3), 1.0);
        assert!((at(true, -3.25) - 1.0).abs() < 1e-6);
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e30, -1e30] {
            assert!(at(false, x).is_finite() && at(true, x).is_finite());
        }
    }

    /// One triangle whose corners have these texture coordinates and vertex alphas.
    fn masked(cutoff: f32, image: Image, uvs: [Vec2; 3], alphas: [f32; 3]) -> Geometry {
        let mask = Material {
            base_color: Vec4::new(1.0, 1.0, 1.0, 0.5),
            base_color_image: Some(0),
            alpha: AlphaMode::Mask { cutoff },
            ..Material::default()
        };
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: uvs.to_vec(),
            colors: alphas.map(|a| Vec4::new(1.0, 1.0, 1.0, a)).to_vec(),
            indices: vec![0, 1, 2],
            material: 1,
            ..Mesh::default()
        };
        let scene = Scene {
            meshes: vec![mesh],
            instances: vec![Instance::new(0, DMat4::IDENTITY)],
            materials: vec![Material::default(), mask],
            images: vec![image],
            ..Scene::default()
        };
        scene.flatten()
    }

    #[test]
    fn alpha_multiplies_colour_vertex_and_image() {
        let geometry = masked(0.2, image(true), [Vec2::new(0.75, 0.25); 3], [1.0, 0.0, 1.0]);
        assert_eq!(geometry.material_of(0), Some(1));
        assert_eq!(geometry.material_of(1), None);
        assert!((geometry.alpha_at(0, 0.25, 0.25) - 0.375).abs() < 1e-6);
        assert!(!geometry.is_cut(0, 0.5, 0.25));
        assert!(geometry.is_cut(0, 0.75, 0.125));
    }

    #[test]
    fn borders_are_as_sharp_as_f64_far_along_a_repeated_image() {
        // 4096 repetitions of an image of 2 texels: alpha crosses the cutoff between every two texels.
        let wide = [Vec2::ZERO, Vec2::new(4096.0, 0.0), Vec2::ZERO];
        let rgba = [0, 255, 0, 255].iter().flat_map(|&a| [9, 9, 9, a]).collect();
        let geometry = masked(0.25, Image { rgba, ..image(true) }, wide, [1.0; 3]);
        // Half way from the last texel's centre but one to the last.
        let border = (4095.0 + 0.5) / 4096.0;
        assert!(geometry.is_cut(0, border - 1e-12, 0.0) && !geometry.is_cut(0, border + 1e-12, 0.0));
        // Negative control: single precision cannot tell the two points apart.
        assert_eq!((border - 1e-12) as f32, (border + 1e-12) as f32);
    }

    #[test]
    fn a_surface_whose_alpha_is_its_cutoff_is_whole() {
        for byte in 1..=u8::MAX {
            let rgba = [9, 9, 9, byte].repeat(4);
            let cutoff = 0.5 * (f32::from(byte) / 255.0);
            let uvs = [Vec2::new(0.1, 0.2), Vec2::new(3.3, 0.7), Vec2::new(-0.9, 1.9)];
            let geometry = masked(cutoff, Image { rgba, ..image(true) }, uvs, [1.0; 3]);
            assert!((0..99).all(|i| !geometry.is_cut(0, f64::from(i) / 99.0, 0.003)), "{byte}");
        }
    }
}
