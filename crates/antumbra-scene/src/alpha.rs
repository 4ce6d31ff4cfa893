//! Cut-out surfaces: the one alpha lookup that rays and raster agree on.

use crate::{AlphaMode, Geometry, Image};
use glam::Vec2;

impl Image {
    /// Alpha from 0 to 1 at texture coordinates `uv` on the base level (mip 0): the four nearest texels,
    /// weighted bilinearly, as a GPU's linear sampler reads them with this image's addressing.
    ///
    /// An image whose `rgba` is shorter than its size says reads as opaque there.
    #[must_use]
    pub fn alpha_linear(&self, uv: Vec2) -> f32 {
        let (x0, x1, fx) = taps(uv.x, self.width, self.repeat[0]);
        let (y0, y1, fy) = taps(uv.y, self.height, self.repeat[1]);
        let texel = |x: u32, y: u32| {
            let place = 4 * (y as usize * self.width as usize + x as usize) + 3;
            f32::from(self.rgba.get(place).copied().unwrap_or(u8::MAX)) / 255.0
        };
        let top = texel(x0, y0) + fx * (texel(x1, y0) - texel(x0, y0));
        let bottom = texel(x0, y1) + fx * (texel(x1, y1) - texel(x0, y1));
        top + fy * (bottom - top)
    }
}

/// The two texel numbers that a linear sampler reads along one axis, and the weight of the second.
fn taps(coordinate: f32, size: u32, repeat: bool) -> (u32, u32, f32) {
    let texels = f64::from(size);
    // Texel i is centred on (i + ½)/size.
    let place = f64::from(coordinate) * texels - 0.5;
    let floor = place.floor();
    let address = |i: f64| -> u32 {
        let wrapped = if repeat { i.rem_euclid(texels) } else { i };
        // The cast saturates and turns NaN into 0, so any coordinate is a legal one.
        (wrapped.max(0.0) as u32).min(size.saturating_sub(1))
    };
    let fraction = (place - floor) as f32;
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

    /// Alpha in the point `(1−u−v)·a + u·b + v·c` of triangle `t` with corners a, b, c: base colour
    /// alpha × vertex alpha × image alpha, the image sampled by [`Image::alpha_linear`]. It is what
    /// the file says, whatever the material's [`AlphaMode`]; usually from 0 to 1.
    ///
    /// `t` must be below [`Geometry::triangle_count`].
    #[must_use]
    pub fn alpha_at(&self, t: usize, u: f32, v: f32) -> f32 {
        let Some(material) = self.material_of(t).and_then(|m| self.materials.get(m)) else { return 1.0 };
        let corners = self.corners(t);
        let weights = [1.0 - u - v, u, v];
        let vertex: f32 = corners.iter().zip(weights).map(|(&i, w)| self.colors[i].w * w).sum();
        let image = material.base_color_image.and_then(|i| self.images.get(i)).map_or(1.0, |image| {
            let uv: Vec2 = corners.iter().zip(weights).map(|(&i, w)| self.uvs[i] * w).sum();
            image.alpha_linear(uv)
        });
        material.base_color.w * vertex * image
    }

    /// Whether the point with barycentric coordinates `(1−u−v, u, v)` of triangle `t` is cut out,
    /// for cameras and for shadows alike: always false for opaque materials, else alpha < cutoff.
    ///
    /// `t` must be below [`Geometry::triangle_count`].
    #[must_use]
    pub fn is_cut(&self, t: usize, u: f32, v: f32) -> bool {
        match self.material_of(t).and_then(|m| self.materials.get(m)).map(|m| m.alpha) {
            Some(AlphaMode::Mask { cutoff }) => self.alpha_at(t, u, v) < cutoff,
            _ => false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Instance, Material, Mesh, Scene};
    use glam::{Mat4, Vec3, Vec4};

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
            assert!((image.alpha_linear(Vec2::splat(0.5)) - 0.4).abs() < 1e-6, "mean of the four");
        }
    }

    #[test]
    fn addressing_differs_outside() {
        let at = |repeat, x| image(repeat).alpha_linear(Vec2::new(x, 0.25));
        assert_eq!(at(false, 0.0), 0.0);
        assert_eq!(at(true, 0.0), 0.5, "half way between the last and the first texel");
        assert_eq!(at(false, 7.3), 1.0);
        assert!((at(true, -3.25) - 1.0).abs() < 1e-6);
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e30, -1e30] {
            assert!(at(false, x).is_finite() && at(true, x).is_finite());
        }
    }

    #[test]
    fn alpha_multiplies_colour_vertex_and_image() {
        let mask = Material {
            base_color: Vec4::new(1.0, 1.0, 1.0, 0.5),
            base_color_image: Some(0),
            alpha: AlphaMode::Mask { cutoff: 0.2 },
            ..Material::default()
        };
        let mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            normals: vec![Vec3::Z; 3],
            uvs: vec![Vec2::new(0.75, 0.25); 3],
            colors: [1.0, 0.0, 1.0].map(|a| Vec4::new(1.0, 1.0, 1.0, a)).to_vec(),
            indices: vec![0, 1, 2],
            material: 1,
            ..Mesh::default()
        };
        let scene = Scene {
            meshes: vec![mesh],
            instances: vec![Instance { mesh: 0, world_from_mesh: Mat4::IDENTITY }],
            materials: vec![Material::default(), mask],
            images: vec![image(true)],
            ..Scene::default()
        };
        let geometry = scene.flatten();
        assert_eq!(geometry.material_of(0), Some(1));
        assert_eq!(geometry.material_of(1), None);
        assert!((geometry.alpha_at(0, 0.25, 0.25) - 0.375).abs() < 1e-6);
        assert!(!geometry.is_cut(0, 0.5, 0.25));
        assert!(geometry.is_cut(0, 0.75, 0.125));
    }
}
