//! Stratified percentage-closer filtering: the casters are drawn n² times, jittered within a texel.
//!
//! Each pass shifts the image plane by a fraction of a texel and fills one channel, so that a texel
//! holds n² depths of its own area: the resolution of a map n times as large, and as many levels of
//! grey, in ⌈n²/4⌉ fetches. The casters are drawn n² times, which is its price, and the footprint never
//! reaches beyond a texel.
//!
//! Brabec & Seidel 2001, "Hardware-accelerated rendering of antialiased shadows with shadow maps", §3.

use super::{About, Constant, Description, Encode, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter},
    precision::Precision,
};
use glam::Vec2;

/// Stratified percentage-closer filtering. ⌈n²/4⌉ fetches and n² caster passes; 16·⌈n²/4⌉ bytes per texel,
/// half of that at 12 or 16 bits, a quarter at 8.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stratified {
    /// Samples along one side of a texel, 2 to 4.
    pub grid: u32,
    /// How exactly depth is stored.
    pub precision: Precision,
}

impl Default for Stratified {
    fn default() -> Self {
        Self { grid: 2, precision: Precision::Float32 }
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
            self.precision.parameter(),
        ]
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let n = self.grid;
        let at = |i: u32| (i as f32 + 0.5) / n as f32 - 0.5;
        let fetches = (n * n).div_ceil(4);
        let (wgsl, map) =
            (include_str!("stratified.wgsl"), ("jittered depth", fetches, Encode::Texel("stratified_encode")));
        let mut described = Description::stored_depth(self.about(), wgsl, map, self.precision, device);
        described.constants.push(Constant::Count("stratified_grid", n));
        described.sample_offsets = (0..n * n).map(|k| Vec2::new(at(k % n), at(k / n))).collect();
        Ok(Description { fetches, ..described })
    }
    fn variants(&self) -> Vec<&'static str> {
        [&Precision::VARIANTS[..], &["grid=4"]].concat()
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
