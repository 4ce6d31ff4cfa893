//! Accessors: typed numbers out of bytes that nobody vouches for. Every range is checked against the
//! bytes that are there before anything is allocated.

use super::document::{Accessor, Document};
use crate::import::error::{Problem, invalid};

/// A document with its buffers.
#[derive(Debug)]
pub(super) struct Asset {
    pub(super) document: Document,
    /// One per buffer, as long as its `byteLength`; `None` where the data is defined elsewhere.
    pub(super) buffers: Vec<Option<Vec<u8>>>,
    /// One per buffer view, or fewer: the bytes of those that are compressed.
    pub(super) decoded: Vec<Option<Vec<u8>>>,
}

/// A component type.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Format {
    I8,
    U8,
    I16,
    U16,
    U32,
    F32,
}

impl Format {
    fn from_code(code: u64, element: &str) -> Result<Self, Problem> {
        Ok(match code {
            5120 => Self::I8,
            5121 => Self::U8,
            5122 => Self::I16,
            5123 => Self::U16,
            5125 => Self::U32,
            5126 => Self::F32,
            _ => {
                let allowed = "allowed are 5120, 5121, 5122, 5123, 5125 and 5126";
                return Err(invalid(format!("{element}.componentType"), code, allowed));
            }
        })
    }

    fn size(self) -> usize {
        match self {
            Self::I8 | Self::U8 => 1,
            Self::I16 | Self::U16 => 2,
            Self::U32 | Self::F32 => 4,
        }
    }
}

/// Where an accessor's elements lie.
#[derive(Debug, Clone, Copy)]
struct Layout {
    format: Format,
    /// Components of an element.
    width: usize,
    stride: usize,
}

impl Layout {
    fn element(self) -> usize {
        self.format.size() * self.width
    }
}

/// The elements of an accessor, packed, sparse ones in place.
#[derive(Debug)]
pub(super) struct Table {
    pub(super) format: Format,
    pub(super) normalized: bool,
    pub(super) shape: String,
    pub(super) width: usize,
    pub(super) count: usize,
    bytes: Vec<u8>,
}

impl Table {
    fn raw<const N: usize>(&self, i: usize, k: usize) -> [u8; N] {
        let at = (i * self.width + k) * N;
        self.bytes.get(at..at + N).and_then(|b| b.try_into().ok()).unwrap_or([0; N])
    }

    /// Component `k` of element `i` as a number, normalised integers mapped to [0,1] or [−1,1].
    pub(super) fn float(&self, i: usize, k: usize) -> f32 {
        let scale = |value: f32, max: f32| if self.normalized { (value / max).max(-1.0) } else { value };
        match self.format {
            Format::I8 => scale(f32::from(i8::from_le_bytes(self.raw(i, k))), 127.0),
            Format::U8 => scale(f32::from(u8::from_le_bytes(self.raw(i, k))), 255.0),
            Format::I16 => scale(f32::from(i16::from_le_bytes(self.raw(i, k))), 32767.0),
            Format::U16 => scale(f32::from(u16::from_le_bytes(self.raw(i, k))), 65535.0),
            Format::U32 => u32::from_le_bytes(self.raw(i, k)) as f32,
            Format::F32 => f32::from_le_bytes(self.raw(i, k)),
        }
    }

    /// Component `k` of element `i` of an unsigned integer table; 0 for the other formats.
    pub(super) fn unsigned(&self, i: usize, k: usize) -> u32 {
        match self.format {
            Format::U8 => u8::from_le_bytes(self.raw(i, k)).into(),
            Format::U16 => u16::from_le_bytes(self.raw(i, k)).into(),
            Format::U32 => u32::from_le_bytes(self.raw(i, k)),
            _ => 0,
        }
    }
}

/// The entry of a list that `owner` refers to.
pub(super) fn follow<'a, T>(list: &'a [T], name: &str, index: usize, owner: &str) -> Result<&'a T, Problem> {
    list.get(index).ok_or_else(|| {
        let allowed = match list.len() {
            0 => format!("there are no {name}"),
            n => format!("{name} has the indices 0 to {}", n - 1),
        };
        invalid(owner, index, allowed)
    })
}

impl Asset {
    /// Checks every buffer view and accessor, used or not.
    pub(super) fn check(&self) -> Result<(), Problem> {
        for (i, view) in self.document.buffer_views.iter().enumerate() {
            let element = format!("bufferViews[{i}]");
            let buffer =
                follow(&self.document.buffers, "buffers", view.buffer, &format!("{element}.buffer"))?;
            if view.byte_offset.checked_add(view.byte_length).is_none_or(|end| end > buffer.byte_length) {
                return Err(invalid(
                    element,
                    format!("{} bytes at {}", view.byte_length, view.byte_offset),
                    format!("buffers[{}] has {} bytes", view.buffer, buffer.byte_length),
                ));
            }
            if let Some(stride) = view.byte_stride
                && !(4..=252).contains(&stride)
            {
                return Err(invalid(format!("{element}.byteStride"), stride, "allowed are 4 to 252"));
            }
        }
        (0..self.document.accessors.len()).try_for_each(|i| self.layout(i).map(|_| ()))
    }

    /// The bytes of a buffer view.
    pub(super) fn view(&self, index: usize, owner: &str) -> Result<&[u8], Problem> {
        let view = follow(&self.document.buffer_views, "bufferViews", index, owner)?;
        if let Some(Some(decoded)) = self.decoded.get(index) {
            return Ok(decoded);
        }
        let buffer = self.buffers.get(view.buffer).and_then(Option::as_deref);
        let Some(buffer) = buffer else {
            let element = format!("bufferViews[{index}].buffer");
            return Err(invalid(element, view.buffer, "that buffer has neither a URI nor a binary chunk"));
        };
        let end = view.byte_offset.saturating_add(view.byte_length);
        buffer.get(view.byte_offset..end).ok_or_else(|| {
            invalid(format!("bufferViews[{index}]"), end, format!("its buffer ends at {}", buffer.len()))
        })
    }

    /// Whether `count` elements of `size` bytes, `stride` apart, fit a view behind `offset`.
    fn fits(
        &self,
        view: usize,
        owner: &str,
        [offset, count, stride, size]: [usize; 4],
    ) -> Result<(), Problem> {
        let length =
            follow(&self.document.buffer_views, "bufferViews", view, &format!("{owner}.bufferView"))?
                .byte_length;
        let need = count.checked_sub(1).map_or(Some(0), |gaps| stride.checked_mul(gaps)?.checked_add(size));
        match need.and_then(|need| need.checked_add(offset)) {
            Some(end) if end <= length => Ok(()),
            _ => Err(invalid(
                owner,
                format!("{count} elements of {size} bytes, {stride} apart, from byte {offset}"),
                format!("bufferViews[{view}] has {length} bytes"),
            )),
        }
    }

    fn layout(&self, index: usize) -> Result<Layout, Problem> {
        let element = format!("accessors[{index}]");
        let accessor = follow(&self.document.accessors, "accessors", index, &element)?;
        let format = Format::from_code(accessor.component_type, &element)?;
        let width = match accessor.shape.as_str() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" | "MAT2" => 4,
            "MAT3" => 9,
            "MAT4" => 16,
            other => {
                let allowed = "allowed are SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 and MAT4";
                return Err(invalid(format!("{element}.type"), format!("'{other}'"), allowed));
            }
        };
        let mut layout = Layout { format, width, stride: format.size() * width };
        if let Some(view) = accessor.buffer_view {
            let stride = self.document.buffer_views.get(view).and_then(|v| v.byte_stride);
            layout.stride = stride.unwrap_or(layout.stride);
            if layout.stride < layout.element() {
                return Err(invalid(
                    format!("bufferViews[{view}].byteStride"),
                    layout.stride,
                    format!("{element} needs at least {}", layout.element()),
                ));
            }
            let placement = [accessor.byte_offset, accessor.count, layout.stride, layout.element()];
            self.fits(view, &element, placement)?;
        } else {
            // Zeros without bytes behind them: no more than the file could need.
            let max =
                self.document.buffers.iter().map(|b| b.byte_length).fold(1 << 16, usize::saturating_add);
            if accessor.count > max {
                let allowed = format!("without a bufferView at most {max} are allowed");
                return Err(invalid(format!("{element}.count"), accessor.count, allowed));
            }
        }
        self.check_sparse(accessor, &element, layout)?;
        Ok(layout)
    }

    fn check_sparse(&self, accessor: &Accessor, element: &str, layout: Layout) -> Result<(), Problem> {
        let Some(sparse) = &accessor.sparse else { return Ok(()) };
        if sparse.count == 0 || sparse.count > accessor.count {
            let allowed = format!("allowed are 1 to {}, the accessor's count", accessor.count);
            return Err(invalid(format!("{element}.sparse.count"), sparse.count, allowed));
        }
        let place = format!("{element}.sparse.indices");
        let size = Format::from_code(sparse.indices.component_type, &place)?.size();
        let placement = [sparse.indices.byte_offset, sparse.count, size, size];
        self.fits(sparse.indices.buffer_view, &place, placement)?;
        let size = layout.element();
        let placement = [sparse.values.byte_offset, sparse.count, size, size];
        self.fits(sparse.values.buffer_view, &format!("{element}.sparse.values"), placement)
    }

    /// Reads an accessor; `owner` is the path of whoever refers to it.
    pub(super) fn table(&self, index: usize, owner: &str) -> Result<Table, Problem> {
        let accessor = follow(&self.document.accessors, "accessors", index, owner)?;
        let layout = self.layout(index)?;
        let size = layout.element();
        let element = format!("accessors[{index}]");
        if accessor.count == 0 {
            return Err(invalid(format!("{element}.count"), 0, "at least 1 is needed where it is used"));
        }
        let mut bytes = match accessor.buffer_view {
            None => vec![0; accessor.count * size],
            Some(view) => {
                let data = self.view(view, &element)?.get(accessor.byte_offset..).unwrap_or_default();
                let mut packed = Vec::with_capacity(accessor.count * size);
                for place in data.chunks(layout.stride).take(accessor.count) {
                    packed.extend_from_slice(place.get(..size).unwrap_or_default());
                }
                packed
            }
        };
        if let Some(sparse) = &accessor.sparse {
            let format = Format::from_code(sparse.indices.component_type, &element)?;
            let behind = |view: usize, offset: usize, length: usize| -> Result<Vec<u8>, Problem> {
                let data = self.view(view, &element)?.get(offset..).unwrap_or_default();
                Ok(data.get(..length).unwrap_or_default().to_vec())
            };
            let indices = Table {
                format,
                normalized: false,
                shape: "SCALAR".into(),
                width: 1,
                count: sparse.count,
                bytes: behind(
                    sparse.indices.buffer_view,
                    sparse.indices.byte_offset,
                    sparse.count * format.size(),
                )?,
            };
            let values = behind(sparse.values.buffer_view, sparse.values.byte_offset, sparse.count * size)?;
            for (i, value) in values.chunks_exact(size).enumerate() {
                let at = indices.unsigned(i, 0) as usize;
                if at >= accessor.count {
                    let allowed = format!("it must be below {}, the accessor's count", accessor.count);
                    return Err(invalid(format!("{element}.sparse.indices[{i}]"), at, allowed));
                }
                bytes[at * size..(at + 1) * size].copy_from_slice(value);
            }
        }
        Ok(Table {
            format: layout.format,
            normalized: accessor.normalized,
            shape: accessor.shape.clone(),
            width: layout.width,
            count: accessor.count,
            bytes,
        })
    }
}
