//! Storage arrays in as many buffers as bindings of the device need.

use super::{objects, split::Split};
use crate::memory::MemoryItem;
use std::ops::Range;
use wgpu::{BindingResource, Buffer, BufferUsages};

/// The buffers of one array.
#[derive(Debug)]
pub(super) struct Pieces {
    split: Split,
    /// Of an element.
    bytes: u64,
    buffers: Vec<Buffer>,
}

impl Pieces {
    /// Of elements of `bytes` bytes each.
    pub(super) fn new(device: &wgpu::Device, label: &str, split: Split, bytes: u64) -> Self {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_DST | BufferUsages::COPY_SRC;
        let buffer = |elements| objects::buffer(device, label, elements * bytes, usage);
        Self { split, bytes, buffers: split.sizes().map(buffer).collect() }
    }

    /// What shaders bind, in order.
    pub(super) fn bindings(&self) -> impl Iterator<Item = BindingResource<'_>> {
        self.buffers.iter().map(Buffer::as_entire_binding)
    }

    /// Its first buffer: all of it, unless it is large.
    pub(super) fn first(&self) -> Option<&Buffer> {
        self.buffers.first()
    }

    /// Fills some elements with zeros.
    pub(super) fn clear(&self, encoder: &mut wgpu::CommandEncoder, elements: Range<u64>) {
        for (buffer, first) in self.buffers.iter().zip((0..).step_by(self.split.each as usize)) {
            let end = elements.end.min(first + self.split.each);
            let start = elements.start.max(first);
            if start < end {
                let bytes = |elements: u64| elements * self.bytes;
                encoder.clear_buffer(buffer, bytes(start - first), Some(bytes(end - start)));
            }
        }
    }

    /// All of it as one item.
    pub(super) fn memory(&self, name: &str) -> MemoryItem {
        let bytes = self.buffers.iter().map(Buffer::size).sum();
        MemoryItem { bytes, ..MemoryItem::buffer(name, &self.buffers[0]) }
    }
}
