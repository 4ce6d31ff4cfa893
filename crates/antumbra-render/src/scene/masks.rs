//! The holes of masked materials, for lookups that ask about them where rays meet triangles.

use crate::{Gpu, layout::loaded_buffer};
use antumbra_scene::{AlphaMode, Geometry};
use bytemuck::{Pod, Zeroable};
use std::collections::BTreeMap;

/// Rust side of `Mask` in `covers.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct Mask {
    pub(super) start: u32,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) repeats: u32,
    pub(super) alpha: f32,
    pub(super) cutoff: f32,
    pub(super) first: u32,
}

/// Alphas of the images, and which part of them the corners of masked triangles show.
#[derive(Debug)]
pub(crate) struct Masks {
    pub(crate) layout: wgpu::BindGroupLayout,
    pub(crate) group: wgpu::BindGroup,
}

/// Why lookups cannot ask about the holes of cut-outs, which then are as coarse as the texels of maps.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what} take {bytes} bytes, and {adapter} binds {max} at a time: {remedy}")]
pub struct CoarseCutouts {
    what: &'static str,
    bytes: u64,
    adapter: String,
    max: u64,
    remedy: &'static str,
}

impl Masks {
    /// `None` where nothing is masked.
    pub(super) fn new(gpu: &Gpu, geometry: &Geometry) -> Result<Option<Self>, CoarseCutouts> {
        let masked = |m: usize| matches!(geometry.materials[m].alpha, AlphaMode::Mask { .. });
        let groups = geometry.groups.iter().filter(|group| masked(group.0));
        let Some(first) = groups.map(|group| group.1.start).min() else { return Ok(None) };
        let (masks, alphas) = masks(geometry, first);
        let corners = corners(geometry, first);
        let contents: [&[u8]; 3] = [bytemuck::cast_slice(&masks), &alphas, bytemuck::cast_slice(&corners)];
        let max = gpu.device.limits().max_storage_buffer_binding_size;
        let told = [
            ("cut-outs' materials", "leave out parts of the scene"),
            ("the alphas of cut-outs' images", "scale the images down"),
            ("the corners of cut-outs' triangles", "leave out parts of the scene"),
        ];
        for ((what, remedy), bytes) in told.into_iter().zip(contents.map(|bytes| bytes.len() as u64)) {
            if bytes > max {
                return Err(CoarseCutouts { what, bytes, adapter: gpu.info.name.clone(), max, remedy });
            }
        }
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("masks"),
            entries: &[0, 1, 2].map(loaded_buffer),
        });
        let buffers = contents.map(|bytes| gpu.buffer("masks", bytes, wgpu::BufferUsages::STORAGE));
        let entries: Vec<_> = (0..)
            .zip(&buffers)
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("masks"),
            layout: &layout,
            entries: &entries,
        });
        Ok(Some(Self { layout, group }))
    }
}

/// A mask for each material, given the first masked triangle, and the alphas of the images that masked
/// materials show, in whole words. What has no image shows a single opaque texel.
fn masks(geometry: &Geometry, first: u32) -> (Vec<Mask>, Vec<u8>) {
    let mut alphas = vec![u8::MAX; 4];
    let mut starts = BTreeMap::new();
    let mut masks = Vec::with_capacity(geometry.materials.len());
    for material in &geometry.materials {
        let alpha = material.base_color.w;
        let mut mask = Mask { start: 0, width: 1, height: 1, repeats: 3, alpha, cutoff: -1.0, first };
        if let AlphaMode::Mask { cutoff } = material.alpha {
            mask.cutoff = cutoff;
            let image = material.base_color_image.and_then(|i| Some((i, geometry.images.get(i)?)));
            if let Some((i, image)) = image {
                let start = *starts.entry(i).or_insert_with(|| {
                    let start = alphas.len() as u32;
                    alphas.extend(image.rgba.chunks_exact(4).map(|pixel| pixel[3]));
                    start
                });
                let repeats = u32::from(image.repeat[0]) | u32::from(image.repeat[1]) << 1;
                mask = Mask { start, width: image.width, height: image.height, repeats, ..mask };
            }
        }
        masks.push(mask);
    }
    alphas.resize(alphas.len().next_multiple_of(4), 0);
    (masks, alphas)
}

/// An entry of `mask_corners` in `covers.wgsl`.
pub(super) type Corner = [f32; 4];

fn corners(geometry: &Geometry, first: u32) -> Vec<Corner> {
    let corner = |&i: &u32| {
        let (uv, color) = (geometry.uvs[i as usize], geometry.colors[i as usize]);
        [uv.x, uv.y, color.w, 0.0]
    };
    geometry.indices[3 * first as usize..].iter().map(corner).collect()
}
