//! What a shadow map costs in bytes, item by item.

use crate::light::Size;

/// Whether an allocation holds the shadow map or only serves to make it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(rename_all = "snake_case"))]
pub enum Lifetime {
    /// Read by receivers.
    Kept,
    /// Read by later passes of the same frame only; could be shared between maps.
    Transient,
    /// Belongs to the caller.
    Borrowed,
}

/// One allocation.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MemoryItem {
    /// What it is.
    pub name: String,
    /// Texture format, such as `rg32float`, or `buffer`.
    pub format: String,
    /// Texels across (1 for buffers that are not by texel).
    pub width: u32,
    /// Texels down, likewise.
    pub height: u32,
    /// Array layers.
    pub layers: u32,
    /// Mip levels.
    pub mips: u32,
    /// Bytes of all layers and levels, without the driver's padding.
    pub bytes: u64,
    /// How long it must live; `kept` in files, which is what the reports of the lab call it.
    #[cfg_attr(feature = "serde", serde(rename = "kept"))]
    pub lifetime: Lifetime,
}

impl MemoryItem {
    pub(crate) fn texture(name: &str, texture: &wgpu::Texture, lifetime: Lifetime) -> Self {
        let (width, height) = (texture.width(), texture.height());
        let (layers, mips) = (texture.depth_or_array_layers(), texture.mip_level_count());
        let texel = match texture.format() {
            wgpu::TextureFormat::Depth24Plus => 4,
            format => u64::from(format.block_copy_size(None).unwrap_or(4)),
        };
        let level = |mip: u32| u64::from((width >> mip).max(1)) * u64::from((height >> mip).max(1));
        let bytes = texel * u64::from(layers) * (0..mips).map(level).sum::<u64>();
        Self {
            name: name.into(),
            format: format!("{:?}", texture.format()).to_lowercase(),
            width,
            height,
            layers,
            mips,
            bytes,
            lifetime,
        }
    }

    pub(crate) fn buffer(name: &str, buffer: &wgpu::Buffer) -> Self {
        Self {
            name: name.into(),
            format: "buffer".into(),
            width: 1,
            height: 1,
            layers: 1,
            mips: 1,
            bytes: buffer.size(),
            lifetime: Lifetime::Kept,
        }
    }

    /// The same buffer, told as words of 4 bytes for each texel, as many as `layers`.
    pub(crate) fn texels(self, size: Size) -> Self {
        let Size { width, height } = size;
        let layers = (self.bytes / (4 * u64::from(width) * u64::from(height))) as u32;
        Self { width, height, layers, ..self }
    }
}

/// All allocations of a shadow map.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Memory {
    /// One entry per texture or buffer.
    pub items: Vec<MemoryItem>,
}

impl Memory {
    /// Bytes of the items of one lifetime.
    #[must_use]
    pub fn bytes(&self, lifetime: Lifetime) -> u64 {
        self.items.iter().filter(|i| i.lifetime == lifetime).map(|i| i.bytes).sum()
    }
}
