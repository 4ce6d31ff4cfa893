//! The vertex codec, versions 0 and 1.
//!
//! Vertices come in blocks. In each, byte k of every vertex lies beside byte k of the next; of such a
//! lane the differences are stored, sixteen in a group, in as few bits as most of them need.

use super::{LONG, Reader, Reason, SHORT, unfold, version};

const MARK: u8 = 0xa0;
/// Bytes of a block, most vertices of a block, bytes of a group.
const BLOCK_BYTES: usize = 8192;
const BLOCK: usize = 256;
const GROUP: usize = 16;
/// Bits of a difference, by the two bits that choose them: of version 0, and of both kinds of lane of
/// version 1.
const BITS_0: [usize; 4] = [0, 2, 4, 8];
const BITS_1: [[usize; 4]; 2] = [[0, 1, 2, 4], [1, 2, 4, 8]];

/// Four lanes of a block.
type Lanes = [[u8; BLOCK]; 4];

/// Decodes `count` vertices of `size` bytes (a multiple of 4, at most 256).
pub(super) fn decode(bytes: &[u8], count: usize, size: usize) -> Result<Vec<u8>, Reason> {
    let (&header, body) = bytes.split_first().ok_or(SHORT)?;
    let version = version(header, MARK, 1)?;
    // At the end: the vertex before the first, and, since version 1, the kind of each four lanes.
    let (kinds, min) = if version == 0 { (0, 32) } else { (size / 4, 24) };
    let tail = size + kinds;
    let start = body.len().checked_sub(tail.max(min)).ok_or(SHORT)?;
    let mut reader = Reader(&body[..start]);
    let (first, kinds) = body[body.len() - tail..].split_at(size);
    let mut last = first.to_vec();
    let per_block = (BLOCK_BYTES / size / GROUP * GROUP).min(BLOCK);
    let mut out = Vec::new();
    let mut lanes: Lanes = [[0; BLOCK]; 4];
    while out.len() < count * size {
        let block = (count - out.len() / size).min(per_block);
        let place = out.len();
        out.resize(place + block * size, 0);
        let controls = if version == 0 { &[] } else { reader.take(size / 4)? };
        for k in (0..size).step_by(4) {
            for (j, lane) in lanes.iter_mut().enumerate() {
                let control = controls.get(k / 4).map(|c| usize::from(c >> (2 * j) & 3));
                read_lane(&mut reader, lane, block, control)?;
            }
            let kind = kinds.get(k / 4).copied().unwrap_or(0);
            add_up(&lanes, &mut out[place..], [block, size, k], &last[k..k + 4], kind)?;
        }
        last.copy_from_slice(&out[place + (block - 1) * size..]);
    }
    if reader.0.is_empty() { Ok(out) } else { Err(LONG) }
}

/// One byte of each vertex of a block; `control` is what version 1 says of it.
fn read_lane(
    reader: &mut Reader<'_>,
    lane: &mut [u8; BLOCK],
    block: usize,
    control: Option<usize>,
) -> Result<(), Reason> {
    let bits = match control {
        Some(3) => {
            lane[..block].copy_from_slice(reader.take(block)?);
            return Ok(());
        }
        Some(2) => {
            lane.fill(0);
            return Ok(());
        }
        Some(kind) => BITS_1[kind],
        None => BITS_0,
    };
    let groups = block.div_ceil(GROUP);
    let header = reader.take(groups.div_ceil(4))?;
    for (i, group) in lane.chunks_exact_mut(GROUP).take(groups).enumerate() {
        read_group(reader, group, bits[usize::from(header[i / 4] >> (i % 4 * 2) & 3)])?;
    }
    Ok(())
}

/// Sixteen differences. All ones in `bits` bits stand for a whole byte behind the group.
fn read_group(reader: &mut Reader<'_>, group: &mut [u8], bits: usize) -> Result<(), Reason> {
    if bits == 0 {
        group.fill(0);
        return Ok(());
    }
    let packed = reader.take(GROUP * bits / 8)?;
    for (i, value) in group.iter_mut().enumerate() {
        let byte = packed[i * bits / 8];
        // Within a byte the highest bits come first, but for single ones.
        let shift = if bits == 1 { i % 8 } else { 8 - bits - i * bits % 8 };
        let escape = (1_u16 << bits) - 1;
        let found = u16::from(byte) >> shift & escape;
        *value = if found == escape && bits < 8 { reader.byte()? } else { found as u8 };
    }
    Ok(())
}

/// Adds the differences of four lanes up, from the vertex before on. Writes bytes `k..k + 4` of each
/// of `block` vertices of `size` bytes.
fn add_up(
    lanes: &Lanes,
    out: &mut [u8],
    [block, size, k]: [usize; 3],
    last: &[u8],
    kind: u8,
) -> Result<(), Reason> {
    let mut last: [u8; 4] = std::array::from_fn(|j| last[j]);
    for i in 0..block {
        let found: [u8; 4] = std::array::from_fn(|j| lanes[j][i]);
        last = match kind & 3 {
            // Four bytes, two words of 16 bits, or the changed bits of one of 32.
            0 => std::array::from_fn(|j| (unfold(found[j].into()) as u8).wrapping_add(last[j])),
            1 => {
                let sum = |j: usize| {
                    let value = unfold(u16::from_le_bytes([found[j], found[j + 1]]).into()) as u16;
                    value.wrapping_add(u16::from_le_bytes([last[j], last[j + 1]])).to_le_bytes()
                };
                let (low, high) = (sum(0), sum(2));
                [low[0], low[1], high[0], high[1]]
            }
            2 => {
                let turned = u32::from_le_bytes(found).rotate_right(u32::from(kind >> 4));
                (turned ^ u32::from_le_bytes(last)).to_le_bytes()
            }
            _ => return Err("the last bytes name an unknown kind of lane"),
        };
        out[i * size + k..][..4].copy_from_slice(&last);
    }
    Ok(())
}
