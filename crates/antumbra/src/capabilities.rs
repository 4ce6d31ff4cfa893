//! What a device can do, asked once.

use wgpu::{Features, TextureFormat};

/// The features and limits that decide which formats and which shader files are used.
#[derive(Debug, Clone)]
pub struct Capabilities {
    /// Features of the device (not of the adapter: only what was requested counts).
    pub features: Features,
    /// Limits of the device.
    pub limits: wgpu::Limits,
}

impl Capabilities {
    /// The features that the library makes use of where a device has them, and does without
    /// elsewhere. Request `adapter.features() & Capabilities::OPTIONAL_FEATURES` with your device;
    /// what each is good for stands in the [table of the crate](crate#devices).
    pub const OPTIONAL_FEATURES: Features = Features::FLOAT32_FILTERABLE
        .union(Features::DEPTH_CLIP_CONTROL)
        .union(Features::PRIMITIVE_INDEX)
        .union(Features::CONSERVATIVE_RASTERIZATION)
        .union(Features::VERTEX_WRITABLE_STORAGE)
        .union(Features::TEXTURE_FORMAT_16BIT_NORM)
        .union(Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);

    /// Asks a device.
    #[must_use]
    pub fn of(device: &wgpu::Device) -> Self {
        Self { features: device.features(), limits: device.limits() }
    }

    /// A device with all [`OPTIONAL_FEATURES`](Self::OPTIONAL_FEATURES) and the limits that WebGPU
    /// guarantees, for descriptions without a device.
    #[must_use]
    pub fn full() -> Self {
        Self { features: Self::OPTIONAL_FEATURES, ..Self::least() }
    }

    /// A device with no more than WebGPU guarantees.
    #[must_use]
    pub fn least() -> Self {
        Self { features: Features::empty(), limits: wgpu::Limits::default() }
    }

    /// Whether a sampler may interpolate this format.
    #[must_use]
    pub fn filters(&self, format: TextureFormat) -> bool {
        matches!(
            format.sample_type(None, Some(self.features)),
            Some(wgpu::TextureSampleType::Float { filterable: true })
        )
    }

    /// Whether a map may have this format: guaranteed, or allowed by adapters that offer the format
    /// (16-bit norm: every one that does can render to it, but only a device that was asked for
    /// `TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES` lets us).
    #[must_use]
    pub fn renders(&self, format: TextureFormat) -> bool {
        let usages = format.guaranteed_format_features(self.features).allowed_usages;
        self.features.contains(format.required_features())
            && (usages.contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
                || self.features.contains(Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES))
    }

    /// `wanted`, of 16 bits a channel, where a map may have it; else `instead`, of 32 bits, and what is to be
    /// told of `what` it holds.
    pub(crate) fn norm16(
        &self,
        what: &str,
        wanted: TextureFormat,
        instead: TextureFormat,
    ) -> (TextureFormat, Option<String>) {
        if self.renders(wanted) {
            return (wanted, None);
        }
        let note = format!(
            "{what} in 32 bits instead of 16, twice the memory: {wanted:?} cannot be rendered to without TEXTURE_FORMAT_16BIT_NORM and TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES"
        );
        (instead, Some(note))
    }

    /// How many layers of this format one render pass can write.
    #[must_use]
    pub fn targets_per_pass(&self, format: TextureFormat) -> u32 {
        let bytes = format.target_pixel_byte_cost().unwrap_or(16).max(1);
        (self.limits.max_color_attachment_bytes_per_sample / bytes)
            .clamp(1, self.limits.max_color_attachments.min(8))
    }

    /// Whether fragments know the number of their triangle, so that triangles may share vertices.
    #[must_use]
    pub fn numbers_triangles(&self) -> bool {
        self.features.contains(Features::PRIMITIVE_INDEX)
    }

    /// Whether the rasteriser finds every texel that a triangle touches.
    #[must_use]
    pub fn rasterises_conservatively(&self) -> bool {
        self.numbers_triangles() && self.features.contains(Features::CONSERVATIVE_RASTERIZATION)
    }

    /// Whether vertices can leave what all fragments of a triangle share.
    #[must_use]
    pub fn stores_from_vertices(&self) -> bool {
        self.features.contains(Features::VERTEX_WRITABLE_STORAGE)
    }

    /// Whether casters in front of the near plane can be kept by depth clamping.
    #[must_use]
    pub fn clamps_depth(&self) -> bool {
        self.features.contains(Features::DEPTH_CLIP_CONTROL)
    }
}
