//! What the renderer drew, as images. Everything here waits.

use crate::{
    gpu::{Gpu, Wait},
    image::{GrayImage, Rgba8Image},
};
use antumbra_render::{GpuScene, Lighting, Pictures, Surfaces};
use antumbra_scene::Geometry;
use anyhow::Result;
use glam::Vec3;

/// The visibility buffer.
///
/// # Errors
/// If the device is lost.
pub fn visibility(gpu: &Gpu, lighting: &Lighting) -> Result<GrayImage> {
    let texture = lighting.visibility();
    Ok(GrayImage::new(texture.width(), texture.height(), gpu.read_texels(texture)?)?)
}

/// The lit picture.
///
/// # Errors
/// If the device is lost.
pub fn picture(gpu: &Gpu, pictures: &Pictures) -> Result<Rgba8Image> {
    let texture = pictures.picture();
    Ok(Rgba8Image::new(texture.width(), texture.height(), gpu.read(texture)?)?)
}

/// Positions of what is drawn, relative to the eye; `None` where nothing is.
///
/// # Errors
/// If the device is lost.
pub fn positions(gpu: &Gpu, surfaces: &Surfaces) -> Result<Vec<Option<Vec3>>> {
    let texels: Vec<[f32; 4]> = gpu.read_texels(surfaces.positions())?;
    Ok(texels.into_iter().map(|[x, y, z, w]| (w != 0.0).then_some(Vec3::new(x, y, z))).collect())
}

/// The id of the triangle that the rasteriser shows in each pixel, row by row; `u32::MAX` for background. For
/// the coverage check.
///
/// # Errors
/// Too much geometry, as [`antumbra_render::Gpu::check`], or if the device is lost.
pub fn triangle_ids(gpu: &Gpu, scene: &GpuScene, geometry: &Geometry) -> Result<Vec<u32>> {
    let target = gpu.run(|encoder| Ok(scene.encode_triangle_ids(gpu, geometry, encoder)?))?;
    // Ids are stored plus one.
    Ok(gpu.read_texels::<u32>(&target)?.into_iter().map(|id| id.wrapping_sub(1)).collect())
}
