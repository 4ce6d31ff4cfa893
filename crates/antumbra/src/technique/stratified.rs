//! Stratified percentage-closer filtering: the casters are drawn n² times, jittered within a texel.
//!
//! Each pass shifts the image plane by a fraction of a texel and fills one channel, so that a texel
//! holds n² depths of its own area: the resolution of a map n times as large, and as many levels of
//! grey, in ⌈n²/4⌉ fetches. The casters are drawn n² times, which is its price, and the footprint never
//! reaches beyond a texel. [`Jitter::Random`] shifts each pass by a number of its own within its cell, the
//! stochastic sampling of maps that the paper names for regular grids' aliasing: all texels of a pass share
//! the shift, since one image plane is drawn.
//!
//! Brabec & Seidel 2001, "Hardware-accelerated rendering of antialiased shadows with shadow maps", §3.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter, choice},
    precision::Precision,
};
use glam::{UVec2, Vec2};

choice! {
    /// Where in its cell of a texel a pass samples.
    Jitter {
        /// In the middle: the samples are a finer grid.
        Centred = "centred",
        /// At a place of its own, the same every time.
        Random = "random",
    }
}

impl Jitter {
    /// Place of sample `k` in its cell, 0 to 1: 16 bits of a hash each way, which `stratified.wgsl` computes
    /// likewise.
    fn place(self, k: u32) -> Vec2 {
        if self == Self::Centred {
            return Vec2::splat(0.5);
        }
        let state = k.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
        let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
        let hash = (word >> 22) ^ word;
        UVec2::new(hash & 0xffff, hash >> 16).as_vec2() / 65536.0
    }
}

/// Stratified percentage-closer filtering. ⌈n²/4⌉ fetches and n² caster passes; 16·⌈n²/4⌉ bytes per texel,
/// half of that at 12 or 16 bits, a quarter at 8.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stratified {
    /// Samples along one side of a texel, 2 to 4.
    pub grid: u32,
    /// Where in its cell each pass samples.
    pub jitter: Jitter,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Stratified {
    fn default() -> Self {
        Self { grid: 2, jitter: Jitter::Centred, precision: Precision::Float32 }
    }
}

impl Technique for Stratified {
    fn about(&self) -> About {
        About {
            name: "stratified",
            title: "Stratified percentage-closer filtering",
            family: Family::Comparison,
            paper: "Brabec & Seidel 2001",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new(
                "grid",
                "samples",
                Field::Count(&mut self.grid, 2..=4),
                "depths along one side of a texel; the casters are drawn as often as there are depths",
            ),
            Parameter::new(
                "jitter",
                "",
                Field::Choice(&mut self.jitter),
                "where in its cell of a texel each pass samples",
            ),
            self.precision.parameter(),
        ]
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let n = self.grid;
        let at = |k: u32| (UVec2::new(k % n, k / n).as_vec2() + self.jitter.place(k)) / n as f32 - 0.5;
        let fetches = (n * n).div_ceil(4);
        let (wgsl, map) =
            (include_str!("stratified.wgsl"), ("jittered depth", fetches, Encode::Texel("stratified_encode")));
        let mut described = Description::stored_depth(self.about(), wgsl, map, self.precision, device);
        described.constants.extend([
            Constant::Count("stratified_grid", n),
            Constant::Count("stratified_random", u32::from(self.jitter == Jitter::Random)),
        ]);
        described.sample_offsets = (0..n * n).map(at).collect();
        Ok(Description { fetches, ..described })
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Precision::VARIANTS[..], &["grid=4", "grid=3,jitter=random"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
