//! The index codecs: triangles by the edges that they share with earlier ones, and plain sequences.

use super::{Reader, Reason, SHORT, unfold, version};

const TRIANGLES: u8 = 0xe0;
const SEQUENCE: u8 = 0xd0;

/// The last sixteen of something, the newest at 0.
#[derive(Debug)]
struct Recent<T> {
    entries: [T; 16],
    next: usize,
}

impl<T: Copy> Recent<T> {
    fn new(empty: T) -> Self {
        Self { entries: [empty; 16], next: 0 }
    }

    fn push(&mut self, entry: T) {
        self.entries[self.next] = entry;
        self.next = (self.next + 1) % 16;
    }

    fn get(&self, age: u8) -> T {
        self.entries[(self.next + 15 - usize::from(age & 15)) % 16]
    }
}

/// What both ends remember of the triangles so far.
#[derive(Debug)]
struct State<'a> {
    edges: Recent<[u32; 2]>,
    vertices: Recent<u32>,
    /// The first vertex that no triangle has used.
    fresh: u32,
    /// The last vertex that was written out.
    last: u32,
    data: Reader<'a>,
}

/// Decodes `count` indices (a multiple of 3) of a triangle list.
pub(super) fn triangles(bytes: &[u8], count: usize) -> Result<Vec<u32>, Reason> {
    let (&header, body) = bytes.split_first().ok_or(SHORT)?;
    let version = version(header, TRIANGLES, 1)?;
    let (codes, rest) = body.split_at_checked(count / 3).ok_or(SHORT)?;
    let (data, table) = rest.split_at_checked(rest.len().wrapping_sub(16)).ok_or(SHORT)?;
    let mut state = State {
        edges: Recent::new([u32::MAX; 2]),
        vertices: Recent::new(u32::MAX),
        fresh: 0,
        last: 0,
        data: Reader(data),
    };
    let mut out = Vec::with_capacity(count);
    for &code in codes {
        out.extend(match code {
            0..0xf0 => state.beside(code, if version == 0 { 15 } else { 13 })?,
            0xf0..0xfe => state.apart(table[usize::from(code & 15)], 0)?,
            _ => {
                let pair = state.data.byte()?;
                if pair == 0 {
                    state.fresh = 0;
                }
                state.apart(pair, if code == 0xfe { 0 } else { 15 })?
            }
        });
    }
    state.data.finish()?;
    Ok(out)
}

impl State<'_> {
    fn fresh(&mut self) -> u32 {
        let fresh = self.fresh;
        self.fresh = fresh.wrapping_add(1);
        fresh
    }

    /// A vertex written out as its difference from the last such one.
    fn far(&mut self) -> Result<u32, Reason> {
        self.last = self.last.wrapping_add(unfold(self.data.number()?));
        Ok(self.last)
    }

    /// A triangle on a recent edge; `near` is the first code of a vertex that is not a recent one.
    fn beside(&mut self, code: u8, near: u8) -> Result<[u32; 3], Reason> {
        let [a, b] = self.edges.get(code >> 4);
        let third = code & 15;
        let c = match third {
            0 => self.fresh(),
            _ if third < near => self.vertices.get(third),
            15 => self.far()?,
            // 13 and 14 are one before and one behind the last.
            _ => {
                let step = if third == 13 { u32::MAX } else { 1 };
                self.last = self.last.wrapping_add(step);
                self.last
            }
        };
        if third == 0 || third >= near {
            self.vertices.push(c);
        }
        self.edges.push([c, b]);
        self.edges.push([a, c]);
        Ok([a, b, c])
    }

    /// A triangle on no recent edge. The halves of `pair` tell its second and third vertex, `first`
    /// its first: 0 a fresh one, 15 one written out, else a recent one.
    fn apart(&mut self, pair: u8, first: u8) -> Result<[u32; 3], Reason> {
        let codes = [first, pair >> 4, pair & 15];
        // Fresh and recent ones are meant before any is written out or remembered.
        let mut corners = [0; 3];
        for (corner, code) in corners.iter_mut().zip(codes) {
            *corner = match code {
                0 => self.fresh(),
                15 => 0,
                // An entry's age counts from 1 here.
                recent => self.vertices.get(recent - 1),
            };
        }
        for (corner, code) in corners.iter_mut().zip(codes) {
            if code == 15 {
                *corner = self.far()?;
            }
        }
        for (corner, code) in corners.into_iter().zip(codes) {
            if code == 0 || code == 15 {
                self.vertices.push(corner);
            }
        }
        let [a, b, c] = corners;
        [[b, a], [c, b], [a, c]].into_iter().for_each(|edge| self.edges.push(edge));
        Ok(corners)
    }
}

/// Decodes `count` indices of any order: each as its difference from one of two baselines.
pub(super) fn sequence(bytes: &[u8], count: usize) -> Result<Vec<u32>, Reason> {
    let (&header, body) = bytes.split_first().ok_or(SHORT)?;
    version(header, SEQUENCE, 1)?;
    // Four bytes at the end say nothing.
    let (data, _) = body.split_at_checked(body.len().wrapping_sub(4)).ok_or(SHORT)?;
    let mut data = Reader(data);
    let mut last = [0_u32; 2];
    let mut out = Vec::new();
    for _ in 0..count {
        let value = data.number()?;
        let base = &mut last[(value & 1) as usize];
        *base = base.wrapping_add(unfold(value >> 1));
        out.push(*base);
    }
    data.finish()?;
    Ok(out)
}
