//! The graphics device of the lab, and reading back from it.

use antumbra::Capabilities;
use anyhow::{Context, Result, bail};
use std::sync::{Arc, Mutex, PoisonError, mpsc};

/// Device, queue and what they are.
#[derive(Debug)]
pub struct Gpu {
    /// The device, with every optional feature that the library can use.
    pub device: wgpu::Device,
    /// Its queue.
    pub queue: wgpu::Queue,
    /// Name, driver, backend.
    pub info: wgpu::AdapterInfo,
    /// The first error that the device reported outside of every error scope.
    error: Arc<Mutex<Option<wgpu::Error>>>,
}

/// What the library and the lab can use but do without.
const OPTIONAL: wgpu::Features = Capabilities::OPTIONAL_FEATURES.union(wgpu::Features::TIMESTAMP_QUERY);

impl Gpu {
    /// Whether the adapter is a driver that runs on the processor.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// The adapter that wgpu prefers.
    ///
    /// # Errors
    /// No adapter (and how to install one), or no device with enough room for the lab's targets.
    pub fn new() -> Result<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::PRIMARY,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        pollster::block_on(async {
            let adapter = instance
                .request_adapter(&wgpu::RequestAdapterOptions {
                    power_preference: wgpu::PowerPreference::HighPerformance,
                    ..Default::default()
                })
                .await
                .context(
                    "no graphics adapter found (Vulkan, Metal or DX12). A software one will do: on Debian or Ubuntu \
                     run `apt-get install mesa-vulkan-drivers`",
                )?;
            let info = adapter.get_info();
            let limits = adapter.limits();
            if limits.max_color_attachment_bytes_per_sample < 48 {
                bail!(
                    "{} writes at most {} bytes per pixel in one pass; the lab's renderer needs 48",
                    info.name,
                    limits.max_color_attachment_bytes_per_sample
                );
            }
            let (device, queue) = adapter
                .request_device(&wgpu::DeviceDescriptor {
                    label: Some("antumbra lab"),
                    required_features: adapter.features() & OPTIONAL,
                    required_limits: limits,
                    ..Default::default()
                })
                .await
                .with_context(|| format!("{} gave no device", info.name))?;
            Ok(Self::adopt(device, queue, info))
        })
    }

    /// A device that the caller has opened. From now on an error that it reports outside of every
    /// error scope is kept for [`check`](Self::check), where it would have ended the program.
    #[must_use]
    pub fn adopt(device: wgpu::Device, queue: wgpu::Queue, info: wgpu::AdapterInfo) -> Self {
        let error = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&error);
        device.on_uncaptured_error(Arc::new(move |error| {
            // Later ones follow from the first.
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(error);
        }));
        Self { device, queue, info, error }
    }

    /// Whether the device has accepted everything since the last check. Whatever it refused since
    /// then has no effect.
    ///
    /// # Errors
    /// The first thing that it refused.
    pub fn check(&self) -> Result<()> {
        match self.error.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(wgpu::Error::OutOfMemory { .. }) => {
                bail!("{} is out of memory: try a smaller map or a lower resolution", self.info.name)
            }
            Some(error) => {
                let text = error.to_string();
                let words: Vec<&str> = text.split_whitespace().collect();
                bail!("{} refused: {}", self.info.name, words.join(" "))
            }
        }
    }

    /// Names of the optional features in use.
    #[must_use]
    pub fn features(&self) -> Vec<String> {
        (self.device.features() & OPTIONAL)
            .iter_names()
            .map(|(name, _)| name.to_lowercase().replace('_', "-"))
            .collect()
    }

    /// Optional features that this device lacks.
    #[must_use]
    pub fn missing_features(&self) -> Vec<String> {
        OPTIONAL
            .difference(self.device.features())
            .iter_names()
            .map(|(name, _)| name.to_lowercase().replace('_', "-"))
            .collect()
    }

    /// Submits and waits until the device is done.
    ///
    /// # Errors
    /// As [`check`](Self::check), or if the device is lost.
    pub fn finish(&self, encoder: wgpu::CommandEncoder) -> Result<()> {
        let commands = encoder.finish();
        self.check()?;
        self.queue.submit([commands]);
        self.device.poll(wgpu::PollType::wait_indefinitely()).context("the device was lost")?;
        self.check()
    }

    /// All bytes of a texture's first level, rows without padding. Waits.
    ///
    /// # Errors
    /// As [`check`](Self::check), or if the device is lost.
    pub fn read(&self, texture: &wgpu::Texture) -> Result<Vec<u8>> {
        self.read_layer(texture, 0, 0)
    }

    /// All bytes of one layer and mip level of a texture, rows without padding. Waits.
    ///
    /// # Errors
    /// As [`check`](Self::check), or if the device is lost.
    pub fn read_layer(&self, texture: &wgpu::Texture, layer: u32, mip_level: u32) -> Result<Vec<u8>> {
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

    /// Bytes of a buffer with `MAP_READ`. Waits.
    ///
    /// # Errors
    /// If the device is lost.
    pub fn map(&self, staging: &wgpu::Buffer) -> Result<Vec<u8>> {
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

    /// A 2-D render target that can be sampled and read back.
    pub(crate) fn target(
        &self,
        label: &str,
        [width, height]: [u32; 2],
        format: wgpu::TextureFormat,
    ) -> wgpu::Texture {
        use wgpu::TextureUsages as Usage;
        self.device.create_texture(&wgpu::TextureDescriptor {
            label: Some(label),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: Usage::RENDER_ATTACHMENT | Usage::TEXTURE_BINDING | Usage::COPY_SRC | Usage::COPY_DST,
            view_formats: &[],
        })
    }

    pub(crate) fn shader(&self, label: &str, source: wgpu::ShaderSource<'_>) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source })
    }

    pub(crate) fn buffer(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: (bytes.len() as u64).next_multiple_of(16).max(16),
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        // write_buffer wants multiples of four; the vertex formats here all are.
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }
}
