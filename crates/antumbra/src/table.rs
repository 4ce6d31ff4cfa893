//! Summed-area tables in whole numbers that wrap.
//!
//! A box's sum is a difference of four entries. Floating-point entries grow until differences are
//! noise: at 2048² single-precision entries of values in [0,1] are wrong by whole units. Whole
//! numbers that wrap around are exact as long as the sum over one box fits, however large the table.
//!
//! Crow 1984, "Summed-area tables for texture mapping"; Lauritzen 2007, "Summed-area variance shadow
//! maps".

/// Longest side of a box in texels. Kernels may be as wide, footprints are cut off there.
pub(crate) const MAX_SUMMED: u32 = 255;

/// Bits that the sum over a box needs beside those of one value.
const SUM_BITS: u32 = 16;

/// How the values of a [`Map`](crate::technique::Map) are held in a summed-area table.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// What zero and the greatest whole number stand for, in each of 1, 2 or 4 channels.
    pub ranges: Vec<[f32; 2]>,
    /// Words of 32 bits that hold one channel: 1, 2 or 4.
    pub words: u32,
    /// Whole numbers that a channel's range is divided into.
    pub steps: f32,
}

impl Table {
    /// A table whose values have at least that many bits: at most 16 for one word per channel, 48 for
    /// two, 112 for four.
    #[must_use]
    pub fn new(ranges: Vec<[f32; 2]>, bits: u32) -> Self {
        let words = [1, 2, 4].into_iter().find(|n| 32 * n >= bits + SUM_BITS).unwrap_or(4);
        Self { ranges, words, steps: 2f32.powi((32 * words - SUM_BITS) as i32) }
    }

    /// A table of values that are multiples of 1/255 of their range, without any rounding.
    #[must_use]
    pub fn bytes(ranges: Vec<[f32; 2]>) -> Self {
        Self { ranges, words: 1, steps: 255.0 }
    }

    /// Texture layers of four words that one layer of values takes.
    #[must_use]
    pub fn parts(&self) -> u32 {
        (self.ranges.len() as u32 * self.words).div_ceil(4)
    }

    /// `words_top`: what 1 becomes in the highest word.
    pub(crate) fn top(&self) -> f32 {
        self.steps / 2f32.powi(32 * (self.words as i32 - 1))
    }

    /// Stem of the WGSL that calculates with so many words.
    pub(crate) fn arithmetic(&self) -> &'static str {
        match self.words {
            1 => "words_1",
            2 => "words_2",
            _ => "words_4",
        }
    }

    /// What zero stands for, and the distance to the other end, in all four channels.
    pub(crate) fn scale(&self) -> [Vec<f32>; 2] {
        let range = |i: usize| self.ranges.get(i).copied().unwrap_or([0.0, 1.0]);
        [(0..4).map(|i| range(i)[0]).collect(), (0..4).map(|i| range(i)[1] - range(i)[0]).collect()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_box_fits() {
        for (bits, words) in [(8, 1), (16, 1), (17, 2), (48, 2), (49, 4), (112, 4)] {
            let table = Table::new(vec![[0.0, 1.0]], bits);
            assert_eq!(table.words, words, "{bits} bits");
            // The sum of a full box, fractions of its border texels included, in shares of what the
            // words can hold.
            let most = f64::from(MAX_SUMMED + 1).powi(2) * f64::from(table.steps);
            assert!(most <= 2f64.powi(32 * words as i32));
        }
        assert!(f64::from(MAX_SUMMED).powi(2) * 255.0 < 2f64.powi(32));
    }
}
