//! Stratified percentage-closer filtering: the casters are drawn n² times, jittered within a texel.
//!
//! Each pass shifts the image plane by a fraction of a texel and fills one channel, so that a texel
//! holds n² depths of its own area: the resolution of a map n times as large, and as many levels of
//! grey, in ⌈n²/4⌉ fetches. The casters are drawn n² times, which is its price, and the footprint never
//! reaches beyond a texel.
//!
//! Brabec & Seidel 2001, "Hardware-accelerated rendering of antialiased shadows with shadow maps", §3.

use super::{BiasTerms, Binding, Constant, Encode, Family, Map, Page, Technique};
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
    fn page(&self) -> Page {
        Page {
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
    fn jitter(&self) -> Vec<Vec2> {
        let n = self.grid;
        let at = |i: u32| (i as f32 + 0.5) / n as f32 - 0.5;
        (0..n * n).map(|k| Vec2::new(at(k % n), at(k / n))).collect()
    }
    fn maps(&self, device: &Capabilities) -> Result<Vec<Map>, Unsupported> {
        Ok(vec![Map {
            name: "jittered depth",
            format: self.precision.rgba(device),
            layers: (self.grid * self.grid).div_ceil(4),
            encode: Encode::Texel("stratified_encode"),
            passes: Vec::new(),
        }])
    }
    fn fallbacks(&self, device: &Capabilities) -> Vec<String> {
        self.precision.fallbacks(device)
    }
    fn bindings(&self) -> Vec<Binding> {
        vec![Binding::Map(0)]
    }
    fn wgsl(&self) -> &'static str {
        include_str!("stratified.wgsl")
    }
    fn constants(&self) -> Vec<Constant> {
        let own = [Constant::Count("stratified_grid", self.grid)];
        own.into_iter().chain(self.precision.constants()).collect()
    }
    fn parts(&self, _: &Capabilities) -> Vec<&'static str> {
        vec![self.precision.part()]
    }
    fn bias(&self) -> BiasTerms {
        BiasTerms::TEXELS
    }
    fn depth_step(&self) -> f32 {
        self.precision.step()
    }
    fn reach_texels(&self) -> f32 {
        0.5
    }
    fn lookups(&self) -> u32 {
        (self.grid * self.grid).div_ceil(4)
    }
    fn boxed(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
