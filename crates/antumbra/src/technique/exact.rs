//! The limit of shadow maps that keep triangles: every texel has a list of all triangles that touch it,
//! and lookups intersect the receiver's ray with each of them.
//!
//! The answer is that of a ray through the same triangles, up to the rounding of 32-bit coordinates;
//! the size of the map decides how fast it comes, not what it is. Casters are drawn twice, to count and
//! to fill the lists. Memory is allocated once, for the map's [`Capacity`]; triangles beyond that are left
//! out, and light leaks there ([`ShadowMap::abuffer_totals`](crate::ShadowMap::abuffer_totals) tells). Holes of cut-out casters have the
//! resolution of the map, unless lookups ask about them ([`Options::cutouts`](crate::Options)): then that of their
//! images.
//!
//! What Lecocq et al. 2014, "Sub-Pixel Shadow Mapping", §3.1, call intractable.

use super::{About, CasterStorage, Description, Family, Technique};
use crate::{
    capabilities::Capabilities, capacity::Capacity, error::Unsupported, parameter::Parameter,
};

/// Lists of all triangles. 16 bytes per texel, 4 for each triangle per texel of the map's [`Capacity`], 48
/// for each of its triangles; 2 lookups, and 4 for every triangle of a list until one shadows.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Exact;

impl Technique for Exact {
    fn about(&self) -> About {
        About {
            name: "exact",
            title: "Lists of all triangles",
            family: Family::Geometry,
            paper: "limit of Lecocq et al. 2014",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        Ok(Description {
            // Those of a list that fills the default capacity.
            fetches: 2 + 4 * Capacity::default().triangles_per_texel,
            ..Description::triangles(self.about(), include_str!("exact.wgsl"), CasterStorage::ABuffer)
        })
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}

/// The answer in f64.
#[doc(hidden)]
pub mod reference {
    /// Depth of a triangle with corners (x, y, depth) at a point; infinite if it does not cover it.
    #[must_use]
    pub fn depth(corners: [[f64; 3]; 3], point: [f64; 2]) -> f64 {
        let at = corners.map(|c| [c[0] - point[0], c[1] - point[1]]);
        let area = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let weights = [0, 1, 2].map(|k| area(at[(k + 1) % 3], at[(k + 2) % 3]));
        let inside = weights.iter().all(|w| *w >= 0.0) || weights.iter().all(|w| *w <= 0.0);
        let depth: f64 = (0..3).map(|k| weights[k] * corners[k][2]).sum();
        if inside { depth / weights.iter().sum::<f64>() } else { f64::INFINITY }
    }
}
