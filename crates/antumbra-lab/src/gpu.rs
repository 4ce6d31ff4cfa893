//! The graphics device of the lab: the renderer's, with waiting and reading back.

use anyhow::{Context, Result};
use std::sync::mpsc;

pub use antumbra_render::Gpu;

/// Opens the adapter that wgpu prefers. Waits.
///
/// # Errors
/// As [`Gpu::open`].
pub fn open() -> Result<Gpu> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends: wgpu::Backends::PRIMARY,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    Ok(pollster::block_on(Gpu::open(&instance))?)
}

/// What the renderer's device does for those who wait for what it draws.
pub trait Wait {
    /// Encodes, submits and waits until the device is done.
    ///
    /// # Errors
    /// As [`finish`](Self::finish); what `encode` returns.
    fn run<T>(&self, encode: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<T>) -> Result<T>;

    /// Submits and waits until the device is done.
    ///
    /// # Errors
    /// As [`Gpu::check`], or if the device is lost.
    fn finish(&self, encoder: wgpu::CommandEncoder) -> Result<()>;

    /// All bytes of a texture's first level, rows without padding. Waits.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    fn read(&self, texture: &wgpu::Texture) -> Result<Vec<u8>>;

    /// All texels of a texture's first level as plain data. Waits.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    fn read_texels<T: bytemuck::Pod>(&self, texture: &wgpu::Texture) -> Result<Vec<T>>;

    /// All bytes of one layer and mip level of a texture, rows without padding. Waits.
    ///
    /// # Errors
    /// As [`finish`](Self::finish).
    fn read_layer(&self, texture: &wgpu::Texture, layer: u32, mip_level: u32) -> Result<Vec<u8>>;

    /// Bytes of a buffer with `MAP_READ`. Waits.
    ///
    /// # Errors
    /// If the device is lost.
    fn map(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>>;
}

impl Wait for Gpu {
    fn run<T>(&self, encode: impl FnOnce(&mut wgpu::CommandEncoder) -> Result<T>) -> Result<T> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let result = encode(&mut encoder)?;
        self.finish(encoder)?;
        Ok(result)
    }

    fn finish(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        self.submit(encoder)?;
        self.device.poll(wgpu::PollType::wait_indefinitely()).context("the device was lost")?;
        Ok(self.check()?)
    }

    fn read(&self, texture: &wgpu::Texture) -> Result<Vec<u8>> {
        self.read_layer(texture, 0, 0)
    }

    fn read_texels<T: bytemuck::Pod>(&self, texture: &wgpu::Texture) -> Result<Vec<T>> {
        Ok(bytemuck::pod_collect_to_vec(&self.read(texture)?))
    }

    fn read_layer(&self, texture: &wgpu::Texture, layer: u32, mip_level: u32) -> Result<Vec<u8>> {
        let [width, height] = [texture.width(), texture.height()].map(|n| (n >> mip_level).max(1));
        let row = width * texture.format().block_copy_size(None).context("format cannot be copied")?;
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let staging = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("readback"),
            size: u64::from(padded) * u64::from(height),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                texture,
                mip_level,
                origin: wgpu::Origin3d { x: 0, y: 0, z: layer },
                aspect: wgpu::TextureAspect::All,
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        );
        self.finish(encoder)?;
        let bytes = self.map(&staging)?;
        Ok(bytes.chunks(padded as usize).flat_map(|line| &line[..row as usize]).copied().collect())
    }

    fn map(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>> {
        let (send, receive) = mpsc::channel();
        let slice = staging.slice(..);
        slice.map_async(wgpu::MapMode::Read, move |result| {
            // The receiver is gone only if waiting failed, which is reported there.
            let _ = send.send(result);
        });
        self.device.poll(wgpu::PollType::wait_indefinitely()).context("the device was lost")?;
        receive.recv().context("no answer to a readback")?.context("readback failed")?;
        let bytes = slice.get_mapped_range().context("readback failed")?.to_vec();
        staging.unmap();
        Ok(bytes)
    }
}
