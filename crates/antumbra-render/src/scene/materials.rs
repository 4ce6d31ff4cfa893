//! Materials and their textures.

use crate::{Gpu, RenderError, layout::uniform};
use antumbra_scene::{AlphaMode, Geometry, Image, Material};
use bytemuck::{Pod, Zeroable};

/// Rust side of `Material` in `scene/frame.wgsl`.
#[repr(C)]
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
pub(super) struct MaterialUniform {
    pub(super) base_color: [f32; 4],
    pub(super) metallic: f32,
    pub(super) roughness: f32,
    pub(super) cutoff: f32,
    /// Its number.
    pub(super) mask: u32,
}

/// One bind group per material of the geometry.
#[derive(Debug)]
pub(super) struct Materials {
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) groups: Vec<wgpu::BindGroup>,
}

impl Materials {
    pub(super) fn new(gpu: &Gpu, geometry: &Geometry) -> Result<Self, RenderError> {
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("material"),
            entries: &[
                uniform(0),
                entry(
                    1,
                    wgpu::BindingType::Texture {
                        sample_type: wgpu::TextureSampleType::Float { filterable: true },
                        view_dimension: wgpu::TextureViewDimension::D2,
                        multisampled: false,
                    },
                ),
                entry(2, wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering)),
            ],
        });
        let white =
            Image { name: "white".into(), width: 1, height: 1, rgba: vec![255; 4], repeat: [true; 2] };
        let white = texture(gpu, &white)?;
        let textures: Vec<wgpu::TextureView> =
            geometry.images.iter().map(|i| texture(gpu, i)).collect::<Result<_, _>>()?;
        let group = |(number, material): (u32, &Material)| {
            let image = material.base_color_image;
            let view = image.and_then(|i| textures.get(i)).unwrap_or(&white);
            let repeat = image.and_then(|i| geometry.images.get(i)).map_or([true; 2], |i| i.repeat);
            let sampler = sampler(gpu, repeat);
            let bytes = material_uniform(number, material);
            let buffer = gpu.buffer(&material.name, bytemuck::bytes_of(&bytes), wgpu::BufferUsages::UNIFORM);
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(&material.name),
                layout: &layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() },
                    wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(view) },
                    wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(&sampler) },
                ],
            })
        };
        let groups = (0..).zip(&geometry.materials).map(group).collect();
        Ok(Self { layout, groups })
    }
}

fn material_uniform(mask: u32, material: &Material) -> MaterialUniform {
    MaterialUniform {
        base_color: material.base_color.to_array(),
        metallic: material.metallic,
        roughness: material.roughness,
        cutoff: match material.alpha {
            AlphaMode::Opaque => -1.0,
            AlphaMode::Mask { cutoff } => cutoff,
        },
        mask,
    }
}

fn sampler(gpu: &Gpu, repeat: [bool; 2]) -> wgpu::Sampler {
    let [u, v] = repeat.map(|r| if r { wgpu::AddressMode::Repeat } else { wgpu::AddressMode::ClampToEdge });
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("base colour"),
        address_mode_u: u,
        address_mode_v: v,
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    })
}

/// Uploads an image with its mip chain, averaged in sRGB values: good enough to look at.
fn texture(gpu: &Gpu, image: &Image) -> Result<wgpu::TextureView, RenderError> {
    let max = gpu.device.limits().max_texture_dimension_2d;
    let (mut width, mut height, mut pixels) = (image.width, image.height, image.rgba.clone());
    if width > max || height > max {
        return Err(RenderError::Image { name: image.name.clone(), width, height, max });
    }
    let levels = image.width.max(image.height).ilog2() + 1;
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(&image.name),
        size: wgpu::Extent3d { width: image.width, height: image.height, depth_or_array_layers: 1 },
        mip_level_count: levels,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: wgpu::TextureFormat::Rgba8UnormSrgb,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    for mip_level in 0..levels {
        gpu.queue.write_texture(
            wgpu::TexelCopyTextureInfo { mip_level, ..texture.as_image_copy() },
            &pixels,
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        (width, height, pixels) = halved(width, height, &pixels);
    }
    Ok(texture.create_view(&Default::default()))
}

fn halved(width: u32, height: u32, pixels: &[u8]) -> (u32, u32, Vec<u8>) {
    let (w, h) = ((width / 2).max(1), (height / 2).max(1));
    let at = |x: u32, y: u32, c: u32| {
        u32::from(pixels[(4 * (y.min(height - 1) * width + x.min(width - 1)) + c) as usize])
    };
    let mean = |x: u32, y: u32, c: u32| {
        ((at(2 * x, 2 * y, c)
            + at(2 * x + 1, 2 * y, c)
            + at(2 * x, 2 * y + 1, c)
            + at(2 * x + 1, 2 * y + 1, c)
            + 2)
            / 4) as u8
    };
    let texels = (0..h).flat_map(|y| (0..w).flat_map(move |x| (0..4).map(move |c| (x, y, c))));
    (w, h, texels.map(|(x, y, c)| mean(x, y, c)).collect())
}
