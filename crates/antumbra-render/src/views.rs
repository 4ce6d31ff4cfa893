//! Views of a scene's light.

use crate::RenderError;
use antumbra::{Bounds, Cascades, ShadowMap, View};
use antumbra_scene::{Aabb, Light};
use glam::Mat4;

// Scenes and the library know the same spots.
const _: () = assert!(Light::MAX_OUTER_ANGLE == antumbra::Light::MAX_OUTER_ANGLE);

/// The light as the library knows it.
#[must_use]
pub fn library_light(light: &Light) -> antumbra::Light {
    match *light {
        Light::Directional { direction } => antumbra::Light::Directional { direction },
        Light::Spot { position, direction, outer_angle } => {
            antumbra::Light::Spot { position, direction, outer_angle }
        }
    }
}

/// The views of a light for a camera's matrix and a scene's box, nearest first: `cascades` of a sun where
/// the camera sees something in each, one of a spot. The margin is that of the widest kernel of `maps`; `lean` is
/// [`antumbra::Fit::lean`].
///
/// # Errors
/// No map; a light or camera without a view.
pub fn fit(
    camera: Mat4,
    scene: Aabb,
    light: &Light,
    cascades: u32,
    maps: &[&ShadowMap],
    lean: bool,
) -> Result<Vec<View>, RenderError> {
    let fit = antumbra::CameraFit {
        camera,
        scene: Bounds { min: scene.min, max: scene.max },
        size: maps.first().ok_or(RenderError::NoMap)?.size(),
        margin_texels: maps.iter().map(|s| s.margin_texels()).fold(1.0, f32::max),
        lean,
    };
    Ok(library_light(light).views(&fit, Cascades::new(cascades))?)
}
