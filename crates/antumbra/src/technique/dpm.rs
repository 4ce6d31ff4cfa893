//! Deep primitive maps: every texel keeps the numbers of the nearest triangles that touch it, and lookups
//! intersect the receiver's ray with those.
//!
//! As published, a texel keeps the triangles whose fragments come first and loses the others. Here an atomic
//! maximum per entry keeps the same triangles in the same order, whatever the order of their fragments: far sides
//! before near sides, and of each the ones nearer to the light first, by linear depth in as many steps as the bits
//! of ids leave. Far sides come first since no lit receiver lies on them, and since those of closed casters make
//! the whole shadow.
//!
//! A texel that more triangles touch than are kept may miss the one in the ray's way. Where it finds none, the
//! depths at the centres of the texels around decide, and edges fray: that is where many small triangles share a
//! texel.
//!
//! Story 2015, "Hybrid Ray-Traced Shadows" (Game Developers Conference); the k-buffer of Bavoil et al.
//! 2007.

use super::{About, Binding, CasterStorage, Class, Constant, Description, Family, Technique};
use crate::{
    capabilities::Capabilities,
    error::Unsupported,
    parameter::{Field, Parameter},
};

/// Deep primitive map. 4 bytes per texel and triangle kept, 4 for the depth of its centre, 48 for each
/// triangle of the map's [`Capacity`](crate::Capacity); 4 lookups for every triangle kept until one shadows, and up to 10 more where
/// some are missing.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Dpm {
    /// Triangles per texel.
    pub keeps: u32,
    /// Positions along one side of a pixel at which shadows are asked, 1 to 4: those in its corners, and
    /// where these differ all.
    pub samples: u32,
}

impl Default for Dpm {
    fn default() -> Self {
        Self { keeps: 4, samples: 1 }
    }
}

const CLASSES: [Class; 2] = [
    Class { name: "shadowed by a triangle of its texel", colour: [90, 110, 160] },
    Class { name: "uncertain", colour: [224, 32, 32] },
];

impl Technique for Dpm {
    fn about(&self) -> About {
        About {
            name: "dpm",
            title: "Deep primitive map",
            family: Family::Geometry,
            paper: "Story 2015, with triangles ranked",
        }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        vec![
            Parameter::new(
                "keeps",
                "triangles",
                Field::Count(&mut self.keeps, 1..=32),
                "triangles per texel of those that touch it: far sides, then near sides, from the light on",
            ),
            Parameter::new(
                "samples",
                "",
                Field::Count(&mut self.samples, 1..=4),
                "positions along one side of a pixel at which shadows are asked: corners, and where they differ all",
            ),
        ]
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let storage = CasterStorage::KBuffer { k: self.keeps };
        Ok(Description {
            constants: vec![
                Constant::Count("dpm_keeps", self.keeps),
                Constant::Count("dpm_samples", self.samples),
            ],
            bindings: vec![Binding::Depth],
            classes: &CLASSES,
            // Centres are asked a texel farther out.
            filter_radius_texels: 1.5,
            // Those of a full texel, with its centre.
            fetches: 4 * self.keeps + 1,
            ..Description::triangles(self.about(), include_str!("dpm.wgsl"), storage)
        })
    }
    fn variants(&self) -> Vec<&'static str> {
        vec!["keeps=1,samples=2", "keeps=9"]
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(*self)
    }
}
