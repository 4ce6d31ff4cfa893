//! Shadows of the first triangle of each texel.

use crate::First;
use antumbra::{
    Capabilities, Description, Parameter, Technique, Unsupported,
    store::{OwnStore, Store},
    technique::{About, CasterStorage, Family},
};

/// Answers by the plane of that triangle, which stands for all of the texel.
#[derive(Debug, Clone)]
pub struct Plane {
    /// What keeps the triangle.
    pub store: &'static dyn Store,
}

impl Default for Plane {
    fn default() -> Self {
        Self { store: &First }
    }
}

impl Technique for Plane {
    fn about(&self) -> About {
        About { name: "plane", title: "First planes", family: Family::Geometry, paper: "none" }
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        Vec::new()
    }
    fn describe(&self, _: &Capabilities) -> Result<Description, Unsupported> {
        let storage = CasterStorage::Own(OwnStore(self.store));
        Ok(Description::triangles(self.about(), include_str!("plane.wgsl"), storage))
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}
