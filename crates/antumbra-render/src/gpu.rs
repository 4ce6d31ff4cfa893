//! The graphics device, and what is made on it.

use crate::RenderError;
use antumbra::Capabilities;
use std::sync::{Arc, Mutex, PoisonError};

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
    refused: Arc<Mutex<Option<Refusal>>>,
}

/// What an error of the device says. In browsers the error itself cannot go to another thread.
#[derive(Debug)]
enum Refusal {
    OutOfMemory,
    Other(String),
}

impl From<wgpu::Error> for Refusal {
    fn from(error: wgpu::Error) -> Self {
        match error {
            wgpu::Error::OutOfMemory { .. } => Self::OutOfMemory,
            error => Self::Other(error.to_string().split_whitespace().collect::<Vec<_>>().join(" ")),
        }
    }
}

/// Features that the library and those who measure use but do without.
const OPTIONAL: wgpu::Features = Capabilities::OPTIONAL_FEATURES.union(wgpu::Features::TIMESTAMP_QUERY);

/// Bytes per pixel of the targets that surfaces are drawn into.
const TARGET_BYTES: u32 = 48;

impl Gpu {
    /// Opens the adapter that wgpu prefers among those of an instance.
    ///
    /// # Errors
    /// No adapter (and how to install one), or no device with enough room for the targets.
    pub async fn open(instance: &wgpu::Instance) -> Result<Self, RenderError> {
        let adapter = instance
            .request_adapter(&wgpu::RequestAdapterOptions {
                power_preference: wgpu::PowerPreference::HighPerformance,
                ..Default::default()
            })
            .await
            .map_err(RenderError::NoAdapter)?;
        let (info, limits) = (adapter.get_info(), adapter.limits());
        let max = limits.max_color_attachment_bytes_per_sample;
        if max < TARGET_BYTES {
            return Err(RenderError::Targets { adapter: info.name, max, needed: TARGET_BYTES });
        }
        let (device, queue) = adapter
            .request_device(&wgpu::DeviceDescriptor {
                label: Some("antumbra"),
                required_features: adapter.features() & OPTIONAL,
                required_limits: limits,
                ..Default::default()
            })
            .await
            .map_err(|source| RenderError::NoDevice { adapter: info.name.clone(), source })?;
        Ok(Self::adopt(device, queue, info))
    }

    /// A device that the caller has opened. From now on an error that it reports outside of every
    /// error scope is kept for [`check`](Self::check), where it would have ended the program.
    #[must_use]
    pub fn adopt(device: wgpu::Device, queue: wgpu::Queue, info: wgpu::AdapterInfo) -> Self {
        let refused = Arc::new(Mutex::new(None));
        let slot = Arc::clone(&refused);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            // Later ones follow from the first.
            slot.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_with(|| error.into());
        }));
        Self { device, queue, info, refused }
    }

    /// Whether the adapter is a driver that runs on the processor.
    #[must_use]
    pub fn is_software(&self) -> bool {
        self.info.device_type == wgpu::DeviceType::Cpu
    }

    /// Whether the device has accepted everything since the last check. Whatever it refused since
    /// then has no effect.
    ///
    /// # Errors
    /// The first thing that it refused.
    pub fn check(&self) -> Result<(), RenderError> {
        let adapter = self.info.name.clone();
        match self.refused.lock().unwrap_or_else(PoisonError::into_inner).take() {
            None => Ok(()),
            Some(Refusal::OutOfMemory) => Err(RenderError::OutOfMemory { adapter }),
            Some(Refusal::Other(reason)) => Err(RenderError::Refused { adapter, reason }),
        }
    }

    /// Names of the optional features in use.
    #[must_use]
    pub fn features(&self) -> Vec<String> {
        names(self.device.features() & OPTIONAL)
    }

    /// Names of the optional features that this device lacks.
    #[must_use]
    pub fn missing_features(&self) -> Vec<String> {
        names(OPTIONAL.difference(self.device.features()))
    }

    /// Submits what was encoded, and does not wait for it.
    ///
    /// # Errors
    /// As [`check`](Self::check).
    pub fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<(), RenderError> {
        let commands = encoder.finish();
        self.check()?;
        self.queue.submit([commands]);
        Ok(())
    }

    /// A 2-D render target that can be sampled and copied.
    #[must_use]
    pub fn target(
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

    /// A shader module.
    #[must_use]
    pub fn shader(&self, label: &str, source: wgpu::ShaderSource<'_>) -> wgpu::ShaderModule {
        self.device.create_shader_module(wgpu::ShaderModuleDescriptor { label: Some(label), source })
    }

    /// A buffer that holds `bytes`, a multiple of 4 of them.
    #[must_use]
    pub fn buffer(&self, label: &str, bytes: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: (bytes.len() as u64).next_multiple_of(16).max(16),
            usage: usage | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        self.queue.write_buffer(&buffer, 0, bytes);
        buffer
    }
}

fn names(features: wgpu::Features) -> Vec<String> {
    features.iter_names().map(|(name, _)| name.to_lowercase().replace('_', "-")).collect()
}
