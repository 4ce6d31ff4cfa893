//! Techniques that are broken on purpose: what a test that cannot tell them from whole ones is worth.

use antumbra::{
    Capabilities, Parameter, Technique, Unsupported, technique,
    technique::{About, Constant, Description, Pass},
};
use std::{fmt, sync::Arc};

type Edit = Arc<dyn Fn(&mut Description) + Send + Sync>;

/// A technique whose description was edited; everything else is that of `inner`.
#[derive(Clone)]
pub struct Broken {
    inner: Box<dyn Technique>,
    edits: Vec<Edit>,
}

impl Broken {
    /// A technique of the library, nothing wrong yet.
    ///
    /// # Panics
    /// If the library cannot read `spec`.
    #[must_use]
    #[allow(clippy::expect_used, reason = "tests fail by panicking")]
    pub fn new(spec: &str) -> Self {
        Self::of(technique::parse(spec).expect("a technique").as_ref())
    }

    /// Any technique, nothing wrong yet.
    #[must_use]
    pub fn of(technique: &dyn Technique) -> Self {
        Self { inner: technique.clone_box(), edits: Vec::new() }
    }

    /// With this wrong in its description, too.
    #[must_use]
    pub fn with(mut self, edit: impl Fn(&mut Description) + Send + Sync + 'static) -> Self {
        self.edits.push(Arc::new(edit));
        self
    }

    /// A technique of the library with other words in its WGSL.
    ///
    /// # Panics
    /// As [`new`](Self::new) and [`replacing`](Self::replacing).
    #[must_use]
    pub fn saying(spec: &str, right: &str, wrong: &str) -> Self {
        Self::new(spec).replacing(right, wrong)
    }

    /// With other words in its WGSL.
    ///
    /// # Panics
    /// When it is described, if `right` is not in it.
    #[must_use]
    pub fn replacing(self, right: &str, wrong: &str) -> Self {
        let [right, wrong] = [right, wrong].map(String::from);
        self.with(move |described| {
            assert!(described.wgsl.contains(&right), "{right}");
            described.wgsl = described.wgsl.replace(&right, &wrong).into();
        })
    }

    /// With another value of a uniform.
    ///
    /// # Panics
    /// When it is described, if it has no such uniform.
    #[must_use]
    pub fn uniform(self, name: &'static str, wrong: f32) -> Self {
        self.with(move |described| {
            let uniform = described.uniforms.iter_mut().find(|(n, _)| *n == name);
            let Some((_, value)) = uniform else { panic!("no uniform {name}") };
            *value = wrong;
        })
    }

    /// With this factor of all kernel weights.
    #[must_use]
    pub fn weights(self, factor: f32) -> Self {
        self.with(move |described| {
            for pass in described.maps.iter_mut().flat_map(|map| &mut map.passes) {
                if let Pass::Blur(kernel, _) = pass {
                    kernel.taps.iter_mut().for_each(|w| *w *= factor);
                }
            }
            for constant in &mut described.constants {
                if let Constant::Array(_, values) = constant {
                    values.iter_mut().for_each(|w| *w *= factor);
                }
            }
        })
    }
}

impl fmt::Debug for Broken {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Broken {:?}", self.inner)
    }
}

impl Technique for Broken {
    fn about(&self) -> About {
        self.inner.about()
    }
    fn parameters(&mut self) -> Vec<Parameter<'_>> {
        self.inner.parameters()
    }
    fn describe(&self, device: &Capabilities) -> Result<Description, Unsupported> {
        let mut described = self.inner.describe(device)?;
        self.edits.iter().for_each(|edit| edit(&mut described));
        Ok(described)
    }
    fn clone_box(&self) -> Box<dyn Technique> {
        Box::new(self.clone())
    }
}
