//! Which of a light's views shades a point, and how its texels lie there.

use antumbra::View;
use antumbra_truth::{MapTexels, TexelAxes};
use anyhow::{Result, bail};
use glam::{DVec2, DVec3};

/// Which of a light's views shades a point, as techniques choose: the first that contains the point
/// and all that a filter reads around it.
#[derive(Debug, Clone)]
pub struct MapViews {
    /// At least one.
    views: Vec<View>,
    /// How far from the middle of the map, 0 to ½, a point may be.
    within: f64,
}

impl MapViews {
    /// The views of maps of `size` × `size` texels behind a filter of `kernel` taps and a bilinear lookup.
    ///
    /// # Errors
    /// No views.
    pub fn new(views: &[View], size: u32, kernel: u32) -> Result<Self> {
        Self::reaching(views, size, 0.5 * (f64::from(kernel) + 1.0))
    }

    /// The views of maps of `size` × `size` texels, for lookups that read up to `reach` texels around a
    /// point.
    ///
    /// # Errors
    /// No views.
    pub fn reaching(views: &[View], size: u32, reach: f64) -> Result<Self> {
        if views.is_empty() {
            bail!("no view of the light to shade with");
        }
        Ok(Self { views: views.to_vec(), within: 0.5 - (reach / f64::from(size)).min(0.499) })
    }

    /// Number of the view that shades a point in the world, if any does.
    #[must_use]
    pub fn number(&self, point: DVec3) -> Option<usize> {
        self.views.iter().position(|view| {
            let clip = view.clip_from_world.as_dmat4() * point.extend(1.0);
            let uv = 0.5 * DVec2::new(clip.x, clip.y) / clip.w;
            let linear = view.depth_plane.as_dvec4().dot(point.extend(1.0));
            clip.w > 0.0 && uv.abs().max_element() <= self.within && (0.0..=1.0).contains(&linear)
        })
    }

    /// The view that shades a point; the last one where none does.
    #[must_use]
    pub fn view(&self, point: DVec3) -> &View {
        &self.views[self.number(point).unwrap_or(self.views.len() - 1)]
    }

    /// World size, at a point, of a texel of the view that shades it.
    #[must_use]
    pub fn texel(&self, point: DVec3) -> f64 {
        let view = self.view(point);
        let distance = view.clip_from_world.as_dmat4().row(3).dot(point.extend(1.0));
        f64::from(view.texel_world) * distance
    }
}

impl MapTexels for MapViews {
    fn axes(&self, point: DVec3) -> TexelAxes {
        texel_axes(self.view(point))
    }
}

/// How the texels of a view lie in the world, for the light-space ideal.
#[must_use]
pub fn texel_axes(view: &View) -> TexelAxes {
    let texel = f64::from(view.texel_world);
    let axis = |row: usize| view.clip_from_world.row(row).truncate().as_dvec3().normalize();
    TexelAxes { right_per_texel: axis(0) * texel, down_per_texel: -axis(1) * texel }
}
