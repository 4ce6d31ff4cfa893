//! All shaders of a technique, without a device: for those who check or compile them beforehand.

use crate::{
    capabilities::Capabilities,
    cast,
    describe::Technique,
    error::Unsupported,
    options::{DEPTH_FORMAT, Options},
    pass::{self, Holder, Work},
    shader::{Composition, Shader, ShaderText},
};

impl Shader {
    /// Every shader that a map of a technique with these options may compile on such a device, each text
    /// once; the receiver's is [`ShaderText::receiver`]. With `cutout`, the caller's WGSL for
    /// [`ShadowMap::cutout_caster`](crate::ShadowMap::cutout_caster), that pipeline's too.
    ///
    /// # Errors
    /// As [`Technique::describe`], or [`Unsupported::Description`].
    pub fn all(
        technique: &dyn Technique,
        device: &Capabilities,
        options: &Options,
        cutout: Option<&str>,
    ) -> Result<Vec<Self>, Unsupported> {
        let composition = Composition::of(technique, device, options)?;
        let plan = cast::plan(&composition, device, options);
        let holed = cutout.and_then(|wgsl| plan.cutout(wgsl));
        let mut shaders: Vec<Self> = plan.shaders().into_iter().chain(holed).collect();
        for step in pass::filter_steps(&composition, device, options.size) {
            let format = |holder| match holder {
                Holder::Map(i) | Holder::Scratch(i) => composition.description.maps[i].format,
                Holder::Casters | Holder::Casts { .. } => DEPTH_FORMAT,
            };
            let targets = match step.work {
                Work::Draw => step.targets.iter().map(|target| format(target.holder)).collect(),
                Work::Lanes(_) => Vec::new(),
            };
            let shader = Self { pass: step.label, text: step.shader, targets };
            if !shaders.contains(&shader) {
                shaders.push(shader);
            }
        }
        Ok(shaders)
    }
}

impl ShaderText {
    /// What [`ShadowMap::wgsl`](crate::ShadowMap::wgsl) gives for a map with these options on such a
    /// device, bound in `group`.
    ///
    /// # Errors
    /// As [`Technique::describe`], or [`Unsupported::Description`].
    pub fn receiver(
        technique: &dyn Technique,
        device: &Capabilities,
        options: &Options,
        group: u32,
    ) -> Result<Self, Unsupported> {
        let composition = Composition::of(technique, device, options)?;
        let plan = cast::plan(&composition, device, options);
        Ok(composition.receiver(|group, first| plan.lookups(group, first), (group, 0)))
    }
}
