//! The uniform buffers of receivers and of the convert pass.

use super::{MemoryItem, Options};
use crate::{
    bias::BiasTerms,
    describe::{Description, Pass},
    kernel::{Adaptive, MOST_SIDE, Width},
    light::{Size, View},
    tile::Tile,
};

/// Rust side of `ShadowView` in the receiver's glue.
#[repr(C)]
#[derive(Debug, Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ShadowView {
    clip_from_world: [[f32; 4]; 4],
    depth_plane: [f32; 4],
    to_light: [f32; 4],
    linear_over: [f32; 4],
    linear_under: [f32; 4],
    tile: [f32; 4],
    texel_world: f32,
    reach_x: f32,
    reach_y: f32,
    layer: u32,
    depth_per_world: f32,
    lean_x: f32,
    lean_y: f32,
}

/// Without what follows it.
const VIEW_BYTES: u64 = size_of::<ShadowView>() as u64;

/// What follows `ShadowView`: widths of kernels in texels, the variance of a blur.
#[derive(Debug)]
struct PerView {
    widths: Vec<Width>,
    blur: Option<Adaptive>,
}

impl PerView {
    fn of(description: &Description) -> Self {
        let widths = description.widths.iter().map(|(_, width)| *width).collect();
        Self { widths, blur: description.blur }
    }

    fn len(&self) -> usize {
        self.widths.len() + usize::from(self.blur.is_some())
    }

    /// Size of one view's part of the receivers' buffer.
    fn bytes(&self) -> u64 {
        (VIEW_BYTES + 4 * self.len() as u64).next_multiple_of(16)
    }

    fn at(&self, texel_world: f32) -> impl Iterator<Item = f32> {
        let widths = self.widths.iter().map(move |width| width.in_texels(texel_world));
        widths.chain(self.blur.map(|blur| blur.variance(texel_world)))
    }
}

/// Both buffers and the bytes that are written to them each frame.
#[derive(Debug)]
pub(super) struct Uniforms {
    receiver: wgpu::Buffer,
    convert: wgpu::Buffer,
    /// Size of the convert settings of one view, and distance between those of two.
    convert_bytes: u64,
    stride: u64,
    room: usize,
    lights: usize,
    /// Texels of a layer.
    size: Size,
    bytes: Vec<u8>,
    /// width, height, bias: what follows `views` and `view_count`, then the settings.
    scalars: Vec<f32>,
    settings: usize,
    reach_texels: f32,
    /// What each view's part of the receivers' buffer ends with.
    per_view: PerView,
    /// The blur whose weights each view's convert settings begin with.
    blur: Option<Adaptive>,
}

impl Uniforms {
    pub(super) fn new(device: &wgpu::Device, description: &Description, options: &Options) -> Self {
        let scalars = scalars(description, options.bias.terms(description.bias), options.size);
        let per_view = PerView::of(description);
        let settings = description.uniforms.len();
        let room = options.views as usize;
        let buffer = |label, size: u64| {
            device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size: size.next_multiple_of(16),
                usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let alignment = u64::from(device.limits().min_uniform_buffer_offset_alignment);
        let convert_bytes = convert_bytes(settings + per_view.len());
        let stride = convert_bytes.next_multiple_of(alignment);
        let passes = description.maps.iter().flat_map(|map| &map.passes);
        let blur = passes.filter_map(|pass| match pass {
            Pass::Blur(kernel, _) => kernel.adaptive,
            Pass::Mips(_) | Pass::Sum(_) => None,
        });
        let receiver = buffer("shadow receiver", bytes(description, options));
        Self {
            convert: buffer("shadow convert", room as u64 * stride),
            bytes: Vec::with_capacity(receiver.size().max(room as u64 * stride) as usize),
            receiver,
            convert_bytes,
            stride,
            room,
            size: options.size,
            lights: options.lights as usize,
            scalars,
            settings,
            reach_texels: description.filter_radius_texels,
            per_view,
            blur: blur.into_iter().next(),
        }
    }

    /// Takes the numbers of another description with as many, or of another bias.
    pub(super) fn adjust(&mut self, description: &Description, options: &Options) {
        self.scalars = scalars(description, options.bias.terms(description.bias), options.size);
    }

    /// Takes views, where they lie, and how many of them, in order, are each light's.
    pub(super) fn write(
        &mut self,
        queue: &wgpu::Queue,
        (views, tiles): (&[View], &[Tile]),
        of_lights: impl Iterator<Item = usize>,
    ) {
        let placed = views.iter().zip(tiles);
        view_bytes_of(&mut self.bytes, placed.clone(), self.room, self.reach_texels, &self.per_view);
        if self.lights > 1 {
            light_bytes(&mut self.bytes, of_lights, self.lights);
        }
        self.bytes.extend_from_slice(&(views.len() as u32).to_ne_bytes());
        self.bytes.extend_from_slice(bytemuck::cast_slice(&self.scalars));
        queue.write_buffer(&self.receiver, 0, &self.bytes);

        let settings = &self.scalars[self.scalars.len() - self.settings..];
        self.bytes.clear();
        for (i, (view, tile)) in placed.enumerate() {
            self.bytes.resize(i * self.stride as usize, 0);
            let (side, reach) = self.blur.map_or(([0.0; MOST_SIDE], 0), |blur| blur.side(view.texel_world));
            self.bytes.extend_from_slice(bytemuck::cast_slice(&side));
            self.bytes.extend_from_slice(bytemuck::cast_slice(&view.linear_from_clip));
            self.bytes.extend_from_slice(bytemuck::cast_slice(&numbers(tile)));
            let Size { width, height } = self.size;
            extend(&mut self.bytes, [width as f32, height as f32, reach as f32].into_iter());
            self.bytes.extend_from_slice(bytemuck::cast_slice(settings));
            extend(&mut self.bytes, self.per_view.at(view.texel_world));
        }
        queue.write_buffer(&self.convert, 0, &self.bytes);
    }

    pub(super) fn receiver(&self) -> wgpu::BindingResource<'_> {
        self.receiver.as_entire_binding()
    }

    /// Of one view, at a dynamic offset.
    pub(super) fn convert(&self) -> wgpu::BindingResource<'_> {
        wgpu::BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.convert,
            offset: 0,
            size: std::num::NonZeroU64::new(self.convert_bytes),
        })
    }

    /// Where those of a view begin.
    pub(super) fn offset(&self, view: usize) -> u32 {
        (view as u64 * self.stride) as u32
    }

    pub(super) fn memory(&self) -> [MemoryItem; 2] {
        [
            MemoryItem::buffer("receiver uniforms", &self.receiver),
            MemoryItem::buffer("convert uniforms", &self.convert),
        ]
    }
}

/// Size of the receivers' buffer: views, ranges of several lights, the views' count, nine scalars, settings.
pub(super) fn bytes(description: &Description, options: &Options) -> u64 {
    let scalars = 4 * (10 + description.uniforms.len() as u64);
    let lights = if options.lights > 1 { 16 * u64::from(options.lights) } else { 0 };
    (u64::from(options.views) * view_bytes(description) + lights + scalars).next_multiple_of(16)
}

/// Size of one view's part of the receivers' buffer.
pub(super) fn view_bytes(description: &Description) -> u64 {
    PerView::of(description).bytes()
}

/// Size of one view's convert settings: blur weights, the rows that make depth linear, tile and layer, the blur's reach, settings
/// and what each view has of its own.
fn convert_bytes(settings: usize) -> u64 {
    (4 * (MOST_SIDE as u64 + 15 + settings as u64)).next_multiple_of(16)
}

/// What follows `views` and `view_count`: size, bias, settings.
fn scalars(description: &Description, bias: BiasTerms, size: Size) -> Vec<f32> {
    let (width, height) = (size.width as f32, size.height as f32);
    let fixed = [
        width,
        height,
        bias.constant_texels,
        bias.slope_texels,
        bias.normal_offset_texels,
        bias.grazing_offset_texels,
        bias.receiver_plane,
        bias.depth_steps * description.depth_quantum,
        bias.depth_steps,
    ];
    fixed.into_iter().chain(description.uniforms.iter().map(|(_, value)| *value)).collect()
}

fn extend(bytes: &mut Vec<u8>, numbers: impl Iterator<Item = f32>) {
    for number in numbers {
        bytes.extend_from_slice(&number.to_ne_bytes());
    }
}

/// Origin and size.
fn numbers(tile: &Tile) -> [f32; 4] {
    let Tile { origin: [x, y], size: Size { width, height }, .. } = *tile;
    [x, y, width, height].map(|texels| texels as f32)
}

/// `ShadowUniforms` of the receiver's glue begins with them: views, and blank ones up to `room`.
fn view_bytes_of<'a>(
    bytes: &mut Vec<u8>,
    placed: impl Iterator<Item = (&'a View, &'a Tile)>,
    room: usize,
    reach_texels: f32,
    per_view: &PerView,
) {
    let stride = per_view.bytes() as usize;
    bytes.clear();
    for (i, (view, tile)) in placed.enumerate() {
        bytes.resize(i * stride, 0);
        // Receivers take all depth as growing; maps of reversed depth are read likewise.
        let v = view.forward();
        let tile_numbers = numbers(tile);
        // A lookup within half a texel of the border would read beyond it; so does a kernel.
        let reach = |texels: f32| (reach_texels * (1.0 / texels)).min(0.499);
        let view = ShadowView {
            clip_from_world: v.clip_from_world.to_cols_array_2d(),
            depth_plane: v.depth_plane.to_array(),
            to_light: v.to_light.to_array(),
            linear_over: v.linear_from_clip[0].to_array(),
            linear_under: v.linear_from_clip[1].to_array(),
            tile: tile_numbers,
            texel_world: v.texel_world,
            reach_x: reach(tile_numbers[2]),
            reach_y: reach(tile_numbers[3]),
            layer: tile.layer,
            depth_per_world: 1.0 / v.depth_world,
            lean_x: v.lean().x,
            lean_y: v.lean().y,
        };
        bytes.extend_from_slice(bytemuck::bytes_of(&view));
        extend(bytes, per_view.at(view.texel_world));
    }
    bytes.resize(room * stride, 0);
}

/// Of each light the first of its views, and the one behind its last; nothing of those up to `room`.
fn light_bytes(bytes: &mut Vec<u8>, of_lights: impl Iterator<Item = usize>, room: usize) {
    let end = bytes.len() + 16 * room;
    let mut first = 0;
    for count in of_lights {
        bytes.extend_from_slice(bytemuck::cast_slice(&[first, first + count as u32, 0, 0]));
        first += count as u32;
    }
    bytes.resize(end, 0);
}

#[cfg(test)]
mod tests;
